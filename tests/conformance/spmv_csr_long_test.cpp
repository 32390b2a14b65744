#include "taut/kernels/spmv_csr_long.hpp"

#include "support/catch.hpp"

TEST_CASE("spmv_csr_long is in the tables")
{
    CHECK(taut::kernels::spmv_csr_long::info("", taut::Precision::float64).group_size > 0);
}
