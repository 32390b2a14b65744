#include "taut/kernels/surface_volume_sum.hpp"

#include "support/surface_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct Between
{
    glm::dvec3 value;
    double scale;
};

template <typename Real>
struct Reference
{
    const SurfaceNet<Real>& net;
    bool further;

    Between between(std::uint32_t from, std::uint32_t to) const
    {
        const auto& fine = further ? net.delta : net.low;
        const glm::dvec3 apart = glm::dvec3(net.position[to]) - glm::dvec3(net.position[from]);
        const glm::dvec3 rest = glm::dvec3(fine[to]) - glm::dvec3(fine[from]);
        return {apart + rest, glm::length(apart) + glm::length(rest)};
    }

    Between gradient(std::uint32_t entry) const
    {
        const std::uint32_t v = net.list[2 * entry], next = 2 * entry + 3;
        const std::size_t end = next < net.list.size() ? net.list[next] : net.corner.size() / 2;
        Between g{glm::dvec3(0), 0};
        for (std::size_t k = net.list[2 * entry + 1]; k < end; ++k)
        {
            const Between b = between(v, net.corner[2 * k]), c = between(v, net.corner[2 * k + 1]);
            g.value += glm::cross(b.value, c.value) / 6.0;
            g.scale += b.scale * c.scale / 6;
        }
        return g;
    }

    glm::dvec3 moved(std::uint32_t v) const { return glm::dvec3(net.delta[v]) - glm::dvec3(net.low[v]); }
};

/// By definition, about the origin.
template <typename Real>
double volume_by_triangles(const SurfaceNet<Real>& net, const Triangles& triangles, bool further)
{
    const auto at = [&](std::uint32_t v) {
        return glm::dvec3(net.position[v]) + glm::dvec3(further ? net.delta[v] : net.low[v]);
    };
    double six = 0;
    for (const auto& t : triangles)
        six += glm::dot(at(t[0]), glm::cross(at(t[1]), at(t[2])));
    return six / 6;
}

/// Gradients and sums into the case; the volume of each surface.
template <typename Real>
std::vector<double> expect_sums(Case& c, const SurfaceNet<Real>& net, bool further)
{
    const Reference<Real> reference{net, further};
    std::vector<double> volumes(net.triangles.size());
    for (std::uint32_t group = 0; group < net.group_count(); ++group)
    {
        const std::uint32_t origin = net.groups[6 * group + 2];
        double sum[3] = {}, scale[3] = {};
        for (std::uint32_t e = net.groups[6 * group]; e < net.groups[6 * group + 1]; ++e)
        {
            const std::uint32_t v = net.list[2 * e];
            const Between g = reference.gradient(e), x = reference.between(origin, v);
            const glm::dvec3 moved = reference.moved(v) - reference.moved(origin);
            const double w = net.position[v].w,
                         moves = glm::length(reference.moved(v)) + glm::length(reference.moved(origin));
            for (int axis = 0; axis < 3; ++axis)
                c.expected["gradient"].add(g.value[axis], g.scale);
            c.expected["gradient"].add(w, 0);
            sum[0] += glm::dot(g.value, x.value) / 3;
            sum[1] += glm::dot(g.value, moved);
            sum[2] += w * glm::dot(g.value, g.value);
            scale[0] += g.scale * x.scale;
            scale[1] += g.scale * moves;
            scale[2] += w * g.scale * g.scale;
        }
        volumes[net.groups[6 * group + 3]] += sum[0];
        for (int k = 0; k < 3; ++k)
            c.expected["partials"].add(sum[k], scale[k]);
    }
    return volumes;
}

} // namespace

TEMPLATE_TEST_CASE("surface_volume_sum gathers gradients and leaves three sums a group", "", float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(4u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::uint32_t chunk = GENERATE(128u, 256u);
    const bool further = GENERATE(false, true);
    CAPTURE(count, chunk, further);
    Random random(4100 + count);
    const auto net = surface_net<Real>(random, {count, 7}, chunk);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(net.table())},
            {"corner", bytes_of(net.corner)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"delta", bytes_of(net.delta)},
            {"gradient", bytes_of(std::vector<Vec>(net.listed(), Vec(7)))},
            {"partials", bytes_of(std::vector<Real>(3 * net.group_count(), Real(7)))}};
    // One group more than there is: what folding may bring.
    c.launches = {make_launch(kernels::surface_volume_sum::info("", c.precision),
                              kernels::surface_volume_sum::Params{net.group_count(), further},
                              net.group_count() + 1)};
    const std::vector<double> volumes = expect_sums(c, net, further);
    for (std::size_t k = 0; k < volumes.size(); ++k)
        CHECK(std::abs(volumes[k] - volume_by_triangles(net, net.triangles[k], further)) <
              1e-13 * static_cast<double>(net.triangles[k].size()));
    check_on_every_device(c);
}
