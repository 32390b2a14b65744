// Every kernel compiles for GPUs of three generations, keeps to their registers, and grows only where
// somebody meant it: then tests/hardware/update.sh writes the table anew, and the commit says why.

#include "hardware/radv.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/runtime/base/registry.hpp"

#include <cstdlib>

using namespace taut;
using namespace taut::hardware;

namespace {

/// Says what is missing; a failure where drivers could be installed.
void missing_driver()
{
    const std::string what =
        "RADV: there is no radeon_icd*.json in the folders of Vulkan drivers; install the "
        "package mesa-vulkan-drivers";
    if (environment_has("TAUT_REQUIRE_DEVICE"))
        FAIL(what);
    TAUT_LEFT_OUT(what);
}

/// What every family makes of the kernels; empty, and said, where this Mesa compiles for no GPU but those
/// here.
Table compile_families(const std::string& driver)
{
    Table now;
    for (const char* family : kFamilies)
        try
        {
            const Compiled compiled = compile_all(family, driver);
            INFO(compiled.device);
            for (const std::string& failure : compiled.failed)
                FAIL_CHECK(family << " " << failure);
            CHECK(compiled.rows.size() == all_kernels().size());
            now.mesa = compiled.mesa;
            now.rows.insert(now.rows.end(), compiled.rows.begin(), compiled.rows.end());
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::no_device)
                throw;
            TAUT_LEFT_OUT("RADV of " << driver << " gives no " << family << " (" << error.what()
                                     << "); Mesa 22.3 does, 26.1 has RADV_FORCE_FAMILY no more");
            return {};
        }
    return now;
}

} // namespace

TEST_CASE("Every kernel compiles for AMD GPUs without spilling, in the registers of the table", "[hardware]")
{
    const std::string driver = radv_driver_file();
    if (driver.empty())
        return missing_driver();
    const Table now = compile_families(driver);
    if (now.rows.empty())
        return;
    if (environment_has("TAUT_RADV_UPDATE"))
        write_table(table_file(), now);
    const Table committed = read_table(table_file());
    for (const std::string& fault : faults(committed, now))
        FAIL_CHECK(fault);
    if (committed.mesa != now.mesa)
        TAUT_LEFT_OUT("growth of kernels is not compared: the table is of " << committed.mesa
                                                                            << ", the driver " << now.mesa);
}
