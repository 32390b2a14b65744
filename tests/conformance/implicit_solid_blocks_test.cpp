#include "taut/kernels/implicit_solid_blocks.hpp"

#include "support/solid_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_solid_blocks gathers forces and blocks of tetrahedra", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(4u, 63u, 64u, 65u, 127u, 128u, 1000u);
    const bool diagonal_only = GENERATE(false, true);
    CAPTURE(count, diagonal_only);
    SolidNet<Real> in = random_solids<Real>(count, count, 1000 + count);
    in.net.diagonal_only = diagonal_only;
    make_solid_table(in);
    const Net<Real>& net = in.net;
    Random random(1001 + count);
    const auto state = random_reals<Real>(random, in.solids.size() * TAUT_SOLID_STATE);
    const auto side = random_reals<Real>(random, 3 * count);
    const auto before = random_reals<Real>(random, net.values());
    Case c;
    c.precision = precision_of<Real>();
    c.in = net.buffers();
    c.in["solid"] = bytes_of(in.solids);
    c.in["state"] = bytes_of(state);
    c.in["table"] = bytes_of(in.table);
    c.in["b"] = bytes_of(side);
    c.in["values"] = bytes_of(before);
    c.launches = {make_launch(kernels::implicit_solid_blocks::info("", c.precision),
                              kernels::implicit_solid_blocks::Params{count, net.lift}, count)};
    std::vector<Sized> pull(count);
    for (std::size_t t = 0; t < in.solids.size(); ++t)
        for (std::size_t k = 0; k < 4; ++k)
        {
            const std::uint32_t v = in.corners(t)[k];
            const glm::dvec3 row = row_of(in.solids[t], k);
            glm::dvec3 force(0);
            double size = 0;
            for (int column = 0; column < 3; ++column)
            {
                const Real* at = &state[TAUT_SOLID_STATE * t + 3u * static_cast<std::size_t>(column)];
                force -= row[column] * glm::dvec3(at[0], at[1], at[2]);
                for (std::size_t other = 1; other < 4; ++other)
                    size += std::abs(row_of(in.solids[t], other)[column]) * 2;
            }
            if (net.solved(v))
                pull[v].add(force, size);
        }
    Field& b = c.expected["b"];
    for (std::uint32_t v = 0; v < count; ++v)
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const double old = double(side[3 * v + k]), lift = double(net.lift);
            b.add(old + lift * pull[v].value[static_cast<int>(k)],
                  pull[v].size > 0 ? std::abs(old) + lift * pull[v].size : 0);
        }
    Field& values = c.expected["values"];
    for (const Real value : before)
        values.add(double(value), 0);
    for (const auto& [place, block] : solid_system(in, state))
        for (int e = 0; e < 9; ++e)
        {
            const std::size_t at = net.blocks.at(place) + 32u * static_cast<std::size_t>(e);
            const double old = place.first == place.second ? double(before[at]) : 0; // else its first holder
            values.value[at] = old + block.value[e % 3][e / 3];
            values.scale[at] = std::abs(old) + block.size;
        }
    look_on_every_device(c, nullptr);
}
