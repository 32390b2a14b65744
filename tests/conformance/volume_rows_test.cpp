#include "taut/kernels/volume_rows.hpp"

#include "support/volume_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
void expect_row(Case& c, const VolumeNet<Real>& net, std::uint32_t r, bool further, bool kept)
{
    const auto& t = net.row[r];
    const std::uint32_t v[4] = {t.a, t.b, t.c, t.d};
    glm::dvec3 e[3], m[3];
    double size[3], move[3];
    for (int k = 0; k < 3; ++k)
    {
        const glm::dvec3 d0(net.delta[v[0]]), d1(net.delta[v[k + 1]]);
        const glm::dvec3 apart = glm::dvec3(net.position[v[k + 1]]) - glm::dvec3(net.position[v[0]]);
        m[k] = d1 - d0;
        move[k] = glm::length(m[k]);
        e[k] = further ? apart + m[k] : apart;
        size[k] = glm::length(apart) + (further ? move[k] : 0);
    }
    const glm::dvec3 g[3] = {glm::cross(e[1], e[2]) / 6.0, glm::cross(e[2], e[0]) / 6.0,
                             glm::cross(e[0], e[1]) / 6.0};
    const double gs[3] = {size[1] * size[2] / 6, size[2] * size[0] / 6, size[0] * size[1] / 6};
    const bool usable = glm::dot(g[0], g[0]) + glm::dot(g[1], g[1]) + glm::dot(g[2], g[2]) > 0;
    const double rate = net.step.inverse_substep;
    const double soft = std::min(static_cast<double>(t.compliance) * rate * rate,
                                 static_cast<double>(static_cast<Real>(1e30)));
    for (int k = 0; k < 3; ++k)
    {
        for (int axis = 0; axis < 3; ++axis)
            c.expected["gradient"].add(usable ? g[k][axis] : 0, usable ? gs[k] : 0);
        c.expected["gradient"].add(soft, soft);
    }
    double value = glm::dot(e[0], g[0]) - static_cast<double>(t.rest_volume);
    double scale = size[0] * gs[0] + static_cast<double>(t.rest_volume);
    for (int k = 0; k < 3 && !further; ++k)
    {
        value += glm::dot(g[k], m[k]);
        scale += gs[k] * move[k];
    }
    if (kept && further)
    {
        value -= soft * static_cast<double>(net.x[net.first + r]);
        scale += soft * std::abs(static_cast<double>(net.x[net.first + r]));
    }
    c.expected["b"].add(usable ? value : 0, usable ? scale : 0);
}

} // namespace

TEMPLATE_TEST_CASE("volume_rows is the gradient of each volume and what a step leaves of its change", "",
                   float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool further = GENERATE(false, true), kept = GENERATE(false, true), report = GENERATE(false, true);
    CAPTURE(dealt.count, dealt.groups, further, kept, report);
    Random random(70 + dealt.count);
    VolumeNet<Real> net = random_volume_net<Real>(random, dealt.count + 2);
    if (dealt.count > 10) // a point, and an inverted one
    {
        for (std::uint32_t v : {net.row[3].b, net.row[3].c, net.row[3].d})
        {
            net.position[v] = Vec(glm::vec<3, Real>(net.position[net.row[3].a]), net.position[v].w);
            net.delta[v] = net.delta[net.row[3].a];
        }
        std::swap(net.row[7].b, net.row[7].c);
    }
    std::uint32_t empty = 0;
    for (std::uint32_t r = 0; r < dealt.count; ++r)
    {
        const auto& t = net.row[r];
        const auto at = [&](std::uint32_t v) {
            return glm::dvec3(net.position[v]) + (further ? glm::dvec3(net.delta[v]) : glm::dvec3(0));
        };
        const glm::dvec3 a = at(t.b) - at(t.a), b = at(t.c) - at(t.a), d = at(t.d) - at(t.a);
        empty +=
            glm::length(glm::cross(a, b)) + glm::length(glm::cross(b, d)) + glm::length(glm::cross(d, a)) ==
            0;
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"tetrahedron", bytes_of(net.row)},
            {"position", bytes_of(net.position)},
            {"delta", bytes_of(net.delta)},
            {"step_values", bytes_of(std::vector{net.step})},
            {"events", no_events()},
            {"gradient", bytes_of(std::vector<Vec>(3 * net.rows(), Vec(7)))},
            {"b", bytes_of(std::vector<Real>(net.x.size(), Real(7)))},
            {"multiplier", bytes_of(net.x)}};
    c.launches = {
        make_launch(kernels::volume_rows::info(kept ? "kept" : "", c.precision),
                    kernels::volume_rows::Params{dealt.count, dealt.chunk(), net.first, further, report},
                    dealt.dispatched())};
    for (std::uint32_t k = 0; k < net.first; ++k)
        c.expected["b"].add(7, 0);
    for (std::uint32_t r = 0; r < dealt.count; ++r)
        expect_row(c, net, r, further, kept);
    for (std::uint32_t r = dealt.count; r < net.rows(); ++r)
    {
        for (int k = 0; k < 12; ++k)
            c.expected["gradient"].add(7, 0);
        c.expected["b"].add(7, 0);
    }
    c.events[TAUT_EVENT_DEGENERATE] = report ? empty : 0;
    check_on_every_device(c);
}
