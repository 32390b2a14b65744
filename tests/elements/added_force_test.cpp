// Kernels of mass_spring for elements that Taut does not have: minus the slope of the energy at each corner.

#include "elements/terms.hpp"
#include "support/catch.hpp"
#include "support/colours.hpp"

#include "taut/kernels/mass_spring_cubic_spring.hpp"
#include "taut/kernels/mass_spring_held_area.hpp"
#include "taut/kernels/mass_spring_thin_rod.hpp"

using namespace taut;
using namespace taut::conformance;
using namespace taut::elements_test;

namespace {

template <typename Real, template <typename> typename Record, typename Params>
void check_forces(KernelTable info)
{
    constexpr std::size_t n = Record<Real>::Energy::corners;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    const ElementNet<Real, Record> net(std::max(count, 8u), count, 60 + count);
    const std::uint32_t first = 3;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(net.elements)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"slot", bytes_of(std::vector<glm::vec<4, Real>>(first + n * count + 1, glm::vec<4, Real>(7)))},
            {"events", no_events()}};
    c.launches = {make_launch(info("", c.precision), Params{count, first, 1}, count)};
    Field& field = c.expected["slot"];
    const auto untouched = [&](std::uint32_t slots) {
        for (std::uint32_t k = 0; k < 4 * slots; ++k)
            field.add(7, 0);
    };
    untouched(first);
    for (std::uint32_t k = 0; k < count; ++k)
    {
        double size = 0;
        const Terms<n> t = net.terms(k, net.low, size);
        for (std::size_t corner = 0; corner < n; ++corner)
        {
            for (int axis = 0; axis < 3; ++axis)
                field.add(-t.slope[corner][axis], glm::length(t.slope[corner]) + t.stiff * size);
            field.add(0, 0);
        }
    }
    untouched(1);
    check_on_every_device(c);
}

} // namespace

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
