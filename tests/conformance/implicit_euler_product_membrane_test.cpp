// Products with the curvature of membranes, formed from places.

#include "support/element_system.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/implicit_euler_product_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("products with the curvature of membranes are those of the assembled matrix", "", float,
                   double)
{
    check_product<TestType, Membrane, kernels::implicit_euler_product_membrane::Params>(
        kernels::implicit_euler_product_membrane::info);
}
