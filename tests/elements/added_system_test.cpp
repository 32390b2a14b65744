// Kernels of implicit_euler for elements that Taut does not have: slopes and curvature in the system of a
// Newton step, their product with a vector, and what a step does to the energy.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/element_system.hpp"

#include "taut/kernels/implicit_euler_cubic_spring.hpp"
#include "taut/kernels/implicit_euler_held_area.hpp"
#include "taut/kernels/implicit_euler_product_cubic_spring.hpp"
#include "taut/kernels/implicit_euler_product_held_area.hpp"
#include "taut/kernels/implicit_euler_product_thin_rod.hpp"
#include "taut/kernels/implicit_euler_rise_cubic_spring.hpp"
#include "taut/kernels/implicit_euler_rise_held_area.hpp"
#include "taut/kernels/implicit_euler_rise_thin_rod.hpp"
#include "taut/kernels/implicit_euler_thin_rod.hpp"

using namespace taut;
using namespace taut::conformance;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("a cubic spring is in the system of a Newton step", "", float, double)
{
    check_system<TestType, CubicSpring, kernels::implicit_euler_cubic_spring::Params>(
        kernels::implicit_euler_cubic_spring::info);
}

TEMPLATE_TEST_CASE("a held area is in the system of a Newton step", "", float, double)
{
    check_system<TestType, HeldArea, kernels::implicit_euler_held_area::Params>(
        kernels::implicit_euler_held_area::info);
}

TEMPLATE_TEST_CASE("a rod is in the system of a Newton step with its whole curvature", "", float, double)
{
    check_system<TestType, ThinRod, kernels::implicit_euler_thin_rod::Params>(
        kernels::implicit_euler_thin_rod::info);
}

TEMPLATE_TEST_CASE("products with the curvature of added elements are formed from places", "", float, double)
{
    SECTION("cubic spring")
    {
        check_product<TestType, CubicSpring, kernels::implicit_euler_product_cubic_spring::Params>(
            kernels::implicit_euler_product_cubic_spring::info);
    }
    SECTION("held area")
    {
        check_product<TestType, HeldArea, kernels::implicit_euler_product_held_area::Params>(
            kernels::implicit_euler_product_held_area::info);
    }
    SECTION("thin rod")
    {
        check_product<TestType, ThinRod, kernels::implicit_euler_product_thin_rod::Params>(
            kernels::implicit_euler_product_thin_rod::info);
    }
}

TEMPLATE_TEST_CASE("a step and its halves raise the energy of added elements by its difference", "", float,
                   double)
{
    SECTION("cubic spring")
    {
        check_rise<TestType, CubicSpring, kernels::implicit_euler_rise_cubic_spring::Params>(
            kernels::implicit_euler_rise_cubic_spring::info);
    }
    SECTION("held area")
    {
        check_rise<TestType, HeldArea, kernels::implicit_euler_rise_held_area::Params>(
            kernels::implicit_euler_rise_held_area::info);
    }
    SECTION("thin rod")
    {
        check_rise<TestType, ThinRod, kernels::implicit_euler_rise_thin_rod::Params>(
            kernels::implicit_euler_rise_thin_rod::info);
    }
}
