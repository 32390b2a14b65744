// What a machine without memory is told.

#include "cli/program.hpp"
#include "support/catch.hpp"
#include "support/skip.hpp"
#include "unit/scene/child.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <string>

using namespace program;

namespace {

/// Address space of programs that are started meanwhile, bytes.
class Room
{
public:
    explicit Room(rlim_t bytes)
    {
        getrlimit(RLIMIT_AS, &before_);
        const rlimit less{std::min(bytes, before_.rlim_cur), before_.rlim_max};
        setrlimit(RLIMIT_AS, &less);
    }
    ~Room() { setrlimit(RLIMIT_AS, &before_); }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;

private:
    rlimit before_{};
};

} // namespace

TEST_CASE("a dense matrix that the host has no memory for is told with its bytes and what would do", "[cli]")
{
#if defined(TAUT_TEST_ASAN)
    TAUT_LEFT_OUT("a host without memory: a sanitizer reserves terabytes of addresses");
    return;
#endif
    const Folder folder;
    std::string text = "%%MatrixMarket matrix coordinate real symmetric\n20000 20000 20000\n";
    for (int k = 1; k <= 20000; ++k)
        text += std::to_string(k) + " " + std::to_string(k) + " 2\n";
    const std::string matrix = folder.file("wide.mtx", text);
    const auto solve = [&](const char* format) {
        const Room room(rlim_t{2} << 30);
        return folder.taut({"solve", matrix, "--format", format, "--device", "cpu:serial"});
    };
    const Result dense = solve("dense");
    CAPTURE(dense.out, dense.err);
    CHECK(dense.status == 1);
    CHECK(dense.err.find("format dense needs 3200000000 bytes of the host") != std::string::npos);
    CHECK(dense.err.find("take a sparser format") != std::string::npos);
    CHECK(solve("csr").status == 0);
}
