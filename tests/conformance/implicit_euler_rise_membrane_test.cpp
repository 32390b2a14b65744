// What a step and its halves do to the energy of membranes.

#include "support/element_system.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/implicit_euler_rise_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a step and its halves raise the energy of membranes by its difference", "", float, double)
{
    check_rise<TestType, Membrane, kernels::implicit_euler_rise_membrane::Params>(
        kernels::implicit_euler_rise_membrane::info);
}
