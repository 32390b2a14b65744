// The roofline on paper: its sums by hand-made numbers, and the page against the table and the plans.

#include "hardware/roofline.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/registry.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace taut;
using namespace taut::hardware;

namespace {

constexpr std::uint32_t kPageSide = 1024; // of the largest cloth and the largest system on the page

constexpr Gpu kGpu = {"a GPU", "navi21", 10, 2, 1e9, 100e9, ""};

/// A table whose only row is of a kernel: 1,000 cycles of one wave, 100 of a full SIMD for 64 invocations.
Table table_of(const KernelInfo& kernel)
{
    return {"Mesa 1.2.3",
            {{"navi21", full_name(kernel), "float", {64, 40, 20, 0, 0, 0, 0, 16, 1000, 1000, 100}}}};
}

Dispatch pass_of(const KernelInfo& kernel, std::uint32_t count)
{
    Dispatch pass;
    pass.kernel = &kernel;
    pass.count = count;
    return pass;
}

} // namespace

TEST_CASE("The work of a pass is its waves times the compiler's cycles", "[hardware]")
{
    const KernelInfo& distance = find_kernel("xpbd_spring");
    const Work work = work_of(table_of(distance), "navi21", pass_of(distance, 6401)); // 101 groups of 64
    CHECK(work.dispatches == 1);
    CHECK(work.simd_cycles == 101 * 100);
    CHECK(work.wave_cycles == 1000);
    CHECK_THROWS_WITH(work_of(table_of(distance), "vega10", pass_of(distance, 1)),
                      Contains("vega10 xpbd_spring float"));

    const KernelInfo& dot = find_kernel("dot"); // a group kernel: `count` is of its groups
    const Work sums =
        work_of(table_of(dot), "navi21", pass_of(dot, 10), 4); // half the trips that were assumed
    CHECK(sums.simd_cycles == 10 * (dot.group_size / 64.0) * 100 / 2);
    CHECK(sums.wave_cycles == 500);
}

TEST_CASE("The largest roof dominates", "[hardware]")
{
    Work work;
    work += {2, 1e6, 2e5, 4000}; // 10 us of bytes, 10 us of 20 SIMDs, 4 us of waves
    const Roofs roofs = roofs_of(work, kGpu, 6e-6);
    CHECK(roofs.bytes == Approx(10e-6));
    CHECK(roofs.instructions == Approx(10e-6));
    CHECK(roofs.waves == Approx(4e-6));
    CHECK(roofs.dispatches == Approx(12e-6));
    CHECK(roofs.largest() == roofs.dispatches);
    CHECK(std::string(roofs.dominant()) == "dispatches");
    CHECK(std::string(roofs_of(work, kGpu, 1e-9).dominant()) != "dispatches");
}

TEST_CASE("The page of the roofline is what the table and the plans give", "[hardware]")
{
    std::ifstream file(TAUT_SOURCE_DIR "/docs/results/gpu.md");
    const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const Table table = read_table(table_file());
    CHECK_THAT(page, Contains(page_gpus()));
    CHECK_THAT(page, Contains(page_passes(table)));
    CHECK_THAT(page, Contains(page_cloth(table, kPageSide)));
    CHECK_THAT(page, Contains(page_dispatches(table, kPageSide)));
    CHECK_THAT(page, Contains(page_gradients(table, kPageSide)));
    CHECK_THAT(page, Contains(table.mesa));
}

// docs/results/update_gpu.sh
TEST_CASE("Writes the parts of the page", "[.page]")
{
    const char* folder = std::getenv("TAUT_PAGE_PARTS");
    REQUIRE(folder != nullptr);
    const Table table = read_table(table_file());
    const std::filesystem::path out(folder);
    write_file(out / "gpus", page_gpus());
    write_file(out / "cloth", page_cloth(table, kPageSide));
    write_file(out / "passes", page_passes(table));
    write_file(out / "dispatches", page_dispatches(table, kPageSide));
    write_file(out / "gradients", page_gradients(table, kPageSide));
}
