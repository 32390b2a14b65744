#pragma once
// Kernels of mass_spring for an element against the slopes of its energy.

#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/element_terms.hpp"

namespace taut::elements_test {

using namespace conformance;

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

} // namespace taut::elements_test
