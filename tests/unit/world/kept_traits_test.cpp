// Costs of a device: by probes that agree, in a file that is never somebody else's.

#include "support/catch.hpp"

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/kept_traits.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <vector>

using namespace taut;
namespace fs = std::filesystem;

namespace {

constexpr DeviceCosts kTrue = {4000, 300, 2, 9};
constexpr const char* kTitle = "taut device costs 1: dispatch, group barrier, element, lane element (ns)\n";

/// Probes that find these costs one after another, the last of them again and again.
struct Probes
{
    std::vector<DeviceCosts> found;
    int asked = 0;

    DeviceCosts agreed()
    {
        return agreed_costs([this] {
            const auto at = static_cast<std::size_t>(asked++);
            return found[std::min(at, found.size() - 1)];
        });
    }
};

class Folder
{
public:
    Folder() : path_(fs::temp_directory_path() / ("taut_costs_" + std::to_string(getpid())))
    {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    fs::path operator/(const std::string& name) const { return path_ / name; }
    fs::path file(const std::string& name, const std::string& text) const
    {
        write_file(path_ / name, text);
        return path_ / name;
    }

private:
    fs::path path_;
};

std::string text_of(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("a probe that other work disturbed is not kept as the cost of a device")
{
    DeviceCosts dear = kTrue, cheap = kTrue, failed = kTrue;
    dear.dispatch_ns = 40'600;
    cheap.group_barrier_ns = 20;
    failed.element_ns = -3;
    for (const DeviceCosts& first : {dear, cheap, failed})
    {
        Probes probes{{first, kTrue}};
        CHECK(probes.agreed() == kTrue);
        CHECK(probes.asked >= kLeastProbes);
        CHECK(probes.asked < kMostProbes);
    }
    Probes quiet{{kTrue}};
    CHECK(quiet.agreed() == kTrue);
    CHECK(quiet.asked == kLeastProbes);
}

TEST_CASE("probes that never agree end all the same, with what was measured")
{
    DeviceCosts high = kTrue, none = kTrue; // as where a driver's threads share a core now and then
    high.dispatch_ns = 16'000;
    none.dispatch_ns = -1;
    Probes probes;
    for (int k = 0; k < kMostProbes; ++k)
        probes.found.push_back(k % 3 == 0 ? high : k % 3 == 1 ? kTrue : none);
    CHECK(probes.agreed() == kTrue);
    CHECK(probes.asked == kMostProbes);
}

TEST_CASE("a cost that no probe finds is the assumed one, not the least that a number can say")
{
    Probes probes{{DeviceCosts{-5, 0, 2, 1}}};
    const DeviceCosts costs = probes.agreed();
    CHECK(costs.dispatch_ns == DeviceTraits{}.dispatch_ns);
    CHECK(costs.group_barrier_ns == DeviceTraits{}.group_barrier_ns);
    CHECK(costs.element_ns == 2);
    CHECK(costs.lane_element_ns == 2); // a lane is no faster than the device
    CHECK(probes.asked == kMostProbes);
}

TEST_CASE("costs are added to a file whose comments and other lines stay")
{
    const Folder folder;
    const fs::path file = folder / "costs.txt";
    CHECK(read_costs(file).empty());
    REQUIRE(add_costs(file, "one", kTrue));
    folder.file("costs.txt", text_of(file) + "# by hand\n\ntwo\t1 2 3 4\n");
    REQUIRE(add_costs(file, "three", {5, 6, 7, 8}));
    REQUIRE(add_costs(file, "one", {9, 9, 9, 9}));
    CHECK(text_of(file) == std::string(kTitle) + "one\t9 9 9 9\n# by hand\n\ntwo\t1 2 3 4\nthree\t5 6 7 8\n");
    CHECK(read_costs(file).size() == 3);
    CHECK(read_costs(file)["two"] == DeviceCosts{1, 2, 3, 4});
}

TEST_CASE("a file that holds anything but costs is refused with what would be right, and left alone")
{
    const Folder folder;
    const std::string title = kTitle;
    for (const std::string& text :
         {std::string("a letter\n"), std::string("\n"), title + "device\t1 2 3\n", title + "device 1 2 3 4\n",
          title + "device\t1 2 3 4 5\n", title + "device\t1 2 0 4\n", title + "device\t1 2 x 4\n"})
    {
        const fs::path file = folder.file("precious.txt", text);
        INFO(text);
        const auto refuses = [&](const auto& act) {
            try
            {
                act();
                return false;
            }
            catch (const Error& error)
            {
                const std::string said = error.what();
                return error.code() == ErrorCode::bad_input && said.find(file.string()) != said.npos &&
                       said.find("would be right") != said.npos;
            }
        };
        CHECK(refuses([&] { keep_costs_in(file); }));
        CHECK(refuses([&] { add_costs(file, "device", kTrue); }));
        CHECK(text_of(file) == text);
    }
    CHECK(costs_kept_in().empty());
}

TEST_CASE("costs are kept in no folder, no pipe, and no folder that is missing")
{
    const Folder folder;
    fs::create_directory(folder / "folder");
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (const fs::path& place : {folder / "folder", folder / "pipe", folder / "missing" / "costs.txt"})
        try
        {
            keep_costs_in(place);
            FAIL(place.string() + " was taken");
        }
        catch (const Error& error)
        {
            CHECK(error.code() == ErrorCode::io);
            CHECK(std::string(error.what()).find(place.string()) != std::string::npos);
        }
    CHECK(fs::is_fifo(folder / "pipe"));
}
