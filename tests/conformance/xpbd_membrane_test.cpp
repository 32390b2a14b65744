// XPBD of membranes, by the root of their energy.

#include "support/element_sweep.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/xpbd_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("membranes of woven cloth move by XPBD of their energy", "", float, double)
{
    check_sweep<MembraneEnergy, TestType, Membrane, kernels::xpbd_membrane::Params>(
        kernels::xpbd_membrane::info);
}
