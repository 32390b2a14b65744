#include "support/catch.hpp"

#include "taut/runtime/base/shown.hpp"

#include <cstdlib>
#include <limits>

TEST_CASE("numbers in messages keep their value and their sign, however small")
{
    CHECK(taut::shown(1e-9) == "1e-09");
    CHECK(taut::shown(0.1) == "0.1");
    CHECK(taut::shown(-0.25) == "-0.25");
    CHECK(taut::shown(3) == "3");
    CHECK(taut::shown(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(taut::shown(std::numeric_limits<double>::quiet_NaN()) == "nan");
    for (const double value : {1.0 / 3, -5e-324, std::numeric_limits<double>::lowest(), 6.02214076e23})
        CHECK(std::strtod(taut::shown(value).c_str(), nullptr) == value);
}

TEST_CASE("numbers shown with few digits are rounded as printf rounds them")
{
    CHECK(taut::shown(1.0 / 3, 3) == "0.333");
    CHECK(taut::shown(1234567, 4) == "1.235e+06");
    CHECK(taut::shown(-std::numeric_limits<double>::max(), 17) == "-1.7976931348623157e+308");
}

TEST_CASE("what is counted stands in its right form")
{
    CHECK(taut::counted(0, "entry", "entries") == "0 entries");
    CHECK(taut::counted(1, "entry", "entries") == "1 entry");
    CHECK(taut::counted(2, "entry", "entries") == "2 entries");
}
