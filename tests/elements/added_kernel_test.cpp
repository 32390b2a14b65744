// Kernels of elements that Taut does not have, made by the build from one GLSL file each, against XPBD by
// definition with the constraint and its gradients taken from the energy alone.

#include "elements/energies.hpp"
#include "support/element_sweep.hpp"

#include "taut/kernels/xpbd_cubic_spring.hpp"
#include "taut/kernels/xpbd_held_area.hpp"

using namespace taut;
using namespace taut::conformance;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a spring of a cubic law that Taut does not have moves by XPBD of its energy", "", float,
                   double)
{
    check_sweep<CubicSpringEnergy, TestType, CubicSpring, kernels::xpbd_cubic_spring::Params>(
        kernels::xpbd_cubic_spring::info);
}

TEMPLATE_TEST_CASE("a held area of three corners that Taut does not have moves by XPBD of its energy", "",
                   float, double)
{
    check_sweep<HeldAreaEnergy, TestType, HeldArea, kernels::xpbd_held_area::Params>(
        kernels::xpbd_held_area::info);
}
