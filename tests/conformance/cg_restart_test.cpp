#include "taut/kernels/cg_restart.hpp"

#include "support/catch.hpp"

TEST_CASE("cg_restart is in the tables")
{
    CHECK(taut::kernels::cg_restart::info("", taut::Precision::float64).group_size > 0);
}
