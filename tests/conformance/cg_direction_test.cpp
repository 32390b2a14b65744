#include "taut/kernels/cg_direction.hpp"

#include "support/catch.hpp"

TEST_CASE("cg_direction is in the tables")
{
    CHECK(taut::kernels::cg_direction::info("", taut::Precision::float64).group_size > 0);
}
