#include "taut/kernels/cg_collect.hpp"

#include "support/catch.hpp"

TEST_CASE("cg_collect is in the tables")
{
    CHECK(taut::kernels::cg_collect::info("", taut::Precision::float64).group_size > 0);
}
