// Kernels of vbd for elements that Taut does not have: what they bring to the block of a vertex, and to the
// sums of a body.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/element_blocks.hpp"

#include "taut/kernels/vbd_cubic_spring.hpp"
#include "taut/kernels/vbd_element_rise_cubic_spring.hpp"
#include "taut/kernels/vbd_element_rise_held_area.hpp"
#include "taut/kernels/vbd_element_rise_thin_rod.hpp"
#include "taut/kernels/vbd_held_area.hpp"
#include "taut/kernels/vbd_thin_rod.hpp"

using namespace taut;
using namespace taut::conformance;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("added elements bring slope and curvature to the blocks of vertices", "", float, double)
{
    SECTION("cubic spring")
    {
        check_blocks<TestType, CubicSpring, kernels::vbd_cubic_spring::Params>(
            kernels::vbd_cubic_spring::info);
    }
    SECTION("held area")
    {
        check_blocks<TestType, HeldArea, kernels::vbd_held_area::Params>(kernels::vbd_held_area::info);
    }
    SECTION("thin rod")
    {
        check_blocks<TestType, ThinRod, kernels::vbd_thin_rod::Params>(kernels::vbd_thin_rod::info);
    }
}

TEMPLATE_TEST_CASE("added elements add the rise of their energy to the sums of bodies", "", float, double)
{
    SECTION("cubic spring")
    {
        check_sums<TestType, CubicSpring, kernels::vbd_element_rise_cubic_spring::Params>(
            kernels::vbd_element_rise_cubic_spring::info);
    }
    SECTION("held area")
    {
        check_sums<TestType, HeldArea, kernels::vbd_element_rise_held_area::Params>(
            kernels::vbd_element_rise_held_area::info);
    }
    SECTION("thin rod")
    {
        check_sums<TestType, ThinRod, kernels::vbd_element_rise_thin_rod::Params>(
            kernels::vbd_element_rise_thin_rod::info);
    }
}
