// The judge of the table of registers notices what it is there for.

#include "hardware/table.hpp"
#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"

#include <filesystem>
#include <fstream>

using namespace taut;
using namespace taut::hardware;

namespace {

Row row(const std::string& kernel)
{
    return {"navi21", kernel, "float", {64, 40, 20, 0, 0, 0, 256, 16, 1000, 500, 100}};
}

Table table() { return {"Mesa 1.2.3", {row("distance"), row("bending")}}; }

/// The one fault of a table that differs from table() in one number.
std::string fault_of(Column column, std::int64_t value)
{
    Table now = table();
    now.rows[1].numbers[column] = value;
    const std::vector<std::string> found = faults(table(), now);
    return found.size() == 1 ? found.front() : std::to_string(found.size()) + " faults";
}

} // namespace

TEST_CASE("A table of registers has no fault beside itself", "[hardware]")
{
    CHECK(faults(table(), table()).empty());
}

TEST_CASE("Growth beyond a tenth is a fault with its kernel and both numbers", "[hardware]")
{
    CHECK(fault_of(kVgprs, 44) == "0 faults");
    CHECK(fault_of(kVgprs, 45) == "navi21 bending float: 45 vector registers, the table has 40");
    CHECK(fault_of(kSgprs, 23) == "navi21 bending float: 23 scalar registers, the table has 20");
    CHECK(fault_of(kCode, 1100) == "0 faults");
    CHECK(fault_of(kCode, 1101) == "navi21 bending float: 1101 bytes of code, the table has 1000");
    CHECK(fault_of(kInverseThroughput, 111) ==
          "navi21 bending float: 111 cycles of inverse throughput, the table has 100");
    CHECK(fault_of(kVgprs, 1) == "0 faults"); // narrower is welcome
}

TEST_CASE("Any spill is a fault, whatever the table says", "[hardware]")
{
    CHECK(fault_of(kSpilledVgprs, 1) == "navi21 bending float: spills 1 vector registers");
    CHECK(fault_of(kSpilledSgprs, 2) == "navi21 bending float: spills 2 scalar registers");
    CHECK(fault_of(kScratch, 64) == "navi21 bending float: spills 64 bytes into scratch memory");
    Table spilling = table();
    spilling.rows[0].numbers[kSpilledVgprs] = 1;
    CHECK(faults(spilling, spilling).size() == 1);
}

TEST_CASE("Tables and kernels name each other", "[hardware]")
{
    Table now = table();
    now.rows.push_back(row("new"));
    REQUIRE(faults(table(), now).size() == 1);
    CHECK_THAT(faults(table(), now).front(), Contains("navi21 new float: the table has no row"));
    REQUIRE(faults(now, table()).size() == 1);
    CHECK_THAT(faults(now, table()).front(), Contains("navi21 new float") && Contains("no such kernel"));
}

TEST_CASE("Another Mesa is judged by spills and rows, not by growth", "[hardware]")
{
    Table now = table();
    now.mesa = "Mesa 4.5.6";
    now.rows[0].numbers[kVgprs] = 400;
    CHECK(faults(table(), now).empty());
    now.rows[0].numbers[kSpilledVgprs] = 1;
    now.rows.pop_back();
    CHECK(faults(table(), now).size() == 2);
}

TEST_CASE("A table that is written is read again; one that is damaged names its line", "[hardware]")
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "taut_hardware_table.csv";
    write_table(file, table());
    const Table again = read_table(file);
    CHECK(again.mesa == "Mesa 1.2.3");
    CHECK(faults(table(), again).empty());
    CHECK(again.rows[1].numbers == table().rows[1].numbers);
    std::ofstream(file, std::ios::app) << "navi21,wind,float,64,many\n";
    CHECK_THROWS_WITH(read_table(file), Contains("taut_hardware_table.csv:5") && Contains("14 fields"));
    std::ofstream(file) << "family,kernel\n";
    CHECK_THROWS_WITH(read_table(file), Contains(":1: the first line is"));
    std::filesystem::remove(file);
    CHECK_THROWS_WITH(read_table(file), Contains("cannot be read"));
}
