// Forces of membranes: minus the slope of the energy at each corner.

#include "support/element_forces.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/mass_spring_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a membrane pulls by the slope of its energy", "", float, double)
{
    check_forces<TestType, Membrane, kernels::mass_spring_membrane::Params>(
        kernels::mass_spring_membrane::info);
}
