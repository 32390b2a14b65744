// What membranes add to the sums of bodies.

#include "support/element_blocks.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/vbd_element_rise_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("membranes add the rise of their energy to the sums of bodies", "", float, double)
{
    check_sums<TestType, Membrane, kernels::vbd_element_rise_membrane::Params>(
        kernels::vbd_element_rise_membrane::info);
}
