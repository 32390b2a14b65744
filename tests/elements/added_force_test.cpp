// Kernels of mass_spring for elements that Taut does not have: minus the slope of the energy at each corner.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/element_forces.hpp"

#include "taut/kernels/mass_spring_cubic_spring.hpp"
#include "taut/kernels/mass_spring_held_area.hpp"
#include "taut/kernels/mass_spring_thin_rod.hpp"

using namespace taut;
using namespace taut::conformance;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a spring of a cubic law pulls by the slope of its energy", "", float, double)
{
    check_forces<TestType, CubicSpring, kernels::mass_spring_cubic_spring::Params>(
        kernels::mass_spring_cubic_spring::info);
}

TEMPLATE_TEST_CASE("a held area pulls by the slope of its energy", "", float, double)
{
    check_forces<TestType, HeldArea, kernels::mass_spring_held_area::Params>(
        kernels::mass_spring_held_area::info);
}

TEMPLATE_TEST_CASE("a rod that gives its energy pulls by the slope of it", "", float, double)
{
    check_forces<TestType, ThinRod, kernels::mass_spring_thin_rod::Params>(
        kernels::mass_spring_thin_rod::info);
}
