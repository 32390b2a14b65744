#include "taut/kernels/cg_step.hpp"

#include "support/catch.hpp"

TEST_CASE("cg_step is in the tables")
{
    CHECK(taut::kernels::cg_step::info("", taut::Precision::float64).group_size > 0);
}
