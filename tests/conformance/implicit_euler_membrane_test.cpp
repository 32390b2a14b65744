// Membranes in the system of a Newton step.

#include "support/element_system.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/implicit_euler_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a membrane is in the system of a Newton step with all of its strains", "", float, double)
{
    check_system<TestType, Membrane, kernels::implicit_euler_membrane::Params>(
        kernels::implicit_euler_membrane::info);
}
