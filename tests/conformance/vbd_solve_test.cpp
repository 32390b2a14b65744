#include "taut/kernels/vbd_solve.hpp"

#include "support/hinge_net.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

using namespace taut;
using namespace taut::conformance;

namespace {

/// Rows of one colour: vertices that share elements only with others. 40 vertices stand before the rows, the
/// hinges' own behind them.
template <typename Real>
struct BlockNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<Vec> position, low, delta, predicted;
    std::vector<std::uint32_t> row;
    std::vector<layout::Spring<Real>> end;
    std::vector<layout::BendingConstraint<Real>> corner;

    glm::dvec3 before(std::uint32_t v) const { return glm::dvec3(position[v]); }
    glm::dvec3 place(std::uint32_t v) const { return before(v) + glm::dvec3(delta[v]); }
    double size(std::uint32_t v) const { return glm::length(before(v)) + glm::length(glm::dvec3(delta[v])); }
    bool held(std::uint32_t v) const { return !(position[v].w > 0); }

    std::uint32_t add_vertex(const glm::dvec3& x, Random& random, Real w)
    {
        position.push_back(Vec(glm::vec<3, Real>(x), w));
        low.push_back(random.vec4<Real>(0x1p-26, Real(0)));
        delta.push_back(random.vec4<Real>(1e-2, Real(1e-3)));
        predicted.push_back(random.vec4<Real>(1e-2, w > Real(0) ? Real(360000) / w : Real(0)));
        return static_cast<std::uint32_t>(position.size() - 1);
    }
};

constexpr std::uint32_t kBefore = 40;

template <typename Real>
void add_hinge(BlockNet<Real>& net, Random& random, std::uint32_t v, bool flat)
{
    const auto own = hinge_net<Real>(random, 1);
    const auto corner = random.below(4);
    const auto ids = own.corners(0);
    const glm::dvec3 shift = net.before(v) - glm::dvec3(own.position[ids[corner]]);
    std::uint32_t vertex[4];
    for (std::uint32_t k = 0; k < 4; ++k)
        vertex[k] = k == corner ? v
                                : net.add_vertex(glm::dvec3(own.position[ids[k]]) + shift, random,
                                                 random.inverse_mass<Real>());
    auto hinge = own.hinge[0];
    if (flat) // a wing on the edge
    {
        const std::uint32_t end = corner == 0 ? 1 : 0, wing = corner == 2 ? 3 : 2;
        net.position[vertex[wing]] = typename BlockNet<Real>::Vec(
            glm::vec<3, Real>(net.position[vertex[end]]), net.position[vertex[wing]].w);
        net.delta[vertex[wing]] = net.delta[vertex[end]];
    }
    hinge.edge0 = vertex[0];
    hinge.edge1 = vertex[1];
    hinge.wing0 = vertex[2];
    hinge.wing1 = vertex[3];
    // The displacements turned it: not near half a turn from rest.
    HingeCorners x;
    for (std::size_t k = 0; k < 4; ++k)
        x[k] = net.place(vertex[k]);
    if (!flat)
        hinge.rest_angle = static_cast<Real>(
            std::remainder(dual_angle(x).value + random.uniform(-2.8, 2.8), 2 * std::numbers::pi));
    net.corner.push_back(hinge);
}

template <typename Real>
BlockNet<Real> block_net(Random& random, std::uint32_t rows, bool hinges)
{
    BlockNet<Real> net;
    for (std::uint32_t i = 0; i < kBefore; ++i)
        net.add_vertex(glm::dvec3(random.vec4<double>(1, 0)), random, random.inverse_mass<Real>());
    for (std::uint32_t i = 0; i < rows; ++i)
        net.add_vertex(glm::dvec3(random.vec4<double>(1, 0)), random,
                       static_cast<Real>(std::pow(10.0, random.uniform(-1, 2))));
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        const std::uint32_t v = kBefore + i;
        net.row.insert(net.row.end(), {v, static_cast<std::uint32_t>(net.end.size()),
                                       static_cast<std::uint32_t>(net.corner.size()), rows});
        for (std::uint32_t k = random.below(13); k > 0; --k)
        {
            const double stiffness = std::pow(10.0, random.uniform(0, 7));
            net.end.push_back({v, random.below(kBefore), random.uniform<Real>(0, 1.5),
                               static_cast<Real>(stiffness),
                               static_cast<Real>(stiffness * random.uniform(0, 1e-2)), 0});
        }
        if (i == 3) // no direction: counted only where the other end is held, else at its own row
            for (const std::uint32_t other : {5u, 6u})
            {
                net.position[other] = net.position[v];
                net.position[other].w = other == 5 ? Real(0) : Real(1);
                net.delta[other] = net.delta[v];
                net.end.push_back({v, other, Real(0.5), Real(100), Real(1), 0});
                net.end.push_back({v, other, Real(0), Real(100), Real(1), 0});
            }
        for (std::uint32_t k = hinges ? random.below(4) : 0; k > 0; --k)
            add_hinge(net, random, v, i % 17 == 5);
    }
    net.row.insert(net.row.end(), {0, static_cast<std::uint32_t>(net.end.size()),
                                   static_cast<std::uint32_t>(net.corner.size()), rows});
    if (net.end.empty())
        net.end.push_back({});
    if (net.corner.empty())
        net.corner.push_back({});
    return net;
}

/// Newton's step of the vertex' own energy by the formulas of methods 5.1 and 5.8, and how far rounding may
/// take it: |H^-1| (what was added to f + what was added to H times the step).
template <typename Real>
struct Block
{
    glm::dvec3 f{0};
    glm::dmat3 h{0};
    double f_scale = 0, h_scale = 0;
    std::uint32_t degenerate = 0;

    void outer(const glm::dvec3& a, const glm::dvec3& b, double k) { h += k * glm::outerProduct(a, b); }

    void spring(const BlockNet<Real>& net, const layout::Spring<Real>& s, bool damped, double inverse_substep)
    {
        const double k = double(s.stiffness), rest = double(s.rest_length);
        const glm::dvec3 d = net.place(s.a) - net.place(s.b);
        const double length = glm::length(d), size = net.size(s.a) + net.size(s.b);
        if (length == 0)
        {
            degenerate += rest > 0 && (s.a < s.b || net.held(s.b)) ? 1 : 0;
            return;
        }
        const glm::dvec3 n = d / length;
        const double across = std::min(std::abs(1 - rest / length), 1.0), turn = size / length;
        f -= k * (length - rest) * n;
        h += k * across * glm::dmat3(1);
        outer(n, n, k * (1 - across));
        f_scale += k * (size + rest) + k * std::abs(length - rest) * (1 + turn);
        h_scale += k * (1 + turn) * (1 + rest / length);
        if (!damped)
            return;
        const double c = double(s.damping) * inverse_substep;
        const glm::dvec3 moved = (glm::dvec3(net.delta[s.a]) - glm::dvec3(net.low[s.a])) -
                                 (glm::dvec3(net.delta[s.b]) - glm::dvec3(net.low[s.b]));
        f -= c * glm::dot(n, moved) * n;
        outer(n, n, c);
        f_scale += c * (glm::length(glm::dvec3(net.delta[s.a])) + glm::length(glm::dvec3(net.delta[s.b]))) *
                   (1 + turn);
        h_scale += c * (1 + turn);
    }

    void hinge(const BlockNet<Real>& net, const layout::BendingConstraint<Real>& c, std::uint32_t v)
    {
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        HingeCorners x;
        double size = 0;
        std::size_t corner = 0, first = 4;
        for (std::size_t k = 0; k < 4; ++k)
        {
            x[k] = net.place(vertex[k]);
            size += net.size(vertex[k]);
            corner = vertex[k] == v ? k : corner;
            first = first == 4 && !net.held(vertex[k]) ? k : first;
        }
        const HingeTerm term = hinge_term(c, x, size, corner);
        if (!term.shaped)
        {
            degenerate += corner == first ? 1 : 0;
            return;
        }
        const double stiff = 1 / double(c.compliance), slope = glm::length(term.gradient);
        f -= stiff * term.value * term.gradient;
        outer(term.gradient, term.gradient, stiff);
        f_scale += stiff * (std::abs(term.value) * term.gradient_scale + slope * term.value_scale);
        h_scale += stiff * slope * term.gradient_scale;
    }
};

struct Kinds
{
    bool hinges = false, damped = false;
    std::string variant(bool tail) const
    {
        std::string word = tail ? "tail" : "";
        for (const auto& [on, name] : {std::pair{hinges, "hinges"}, std::pair{damped, "damped"}})
            if (on)
                word += (word.empty() ? "" : "_") + std::string(name);
        return word;
    }
};

template <typename Real>
Buffers buffers_of(const BlockNet<Real>& net)
{
    return {{"row", bytes_of(net.row)},           {"end", bytes_of(net.end)},
            {"position", bytes_of(net.position)}, {"predicted", bytes_of(net.predicted)},
            {"delta", bytes_of(net.delta)},       {"corner", bytes_of(net.corner)},
            {"low", bytes_of(net.low)},           {"events", no_events()}};
}

} // namespace

TEMPLATE_TEST_CASE("vbd_solve takes Newton's step of each vertex' own energy", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const Kinds kinds = {GENERATE(false, true), GENERATE(false, true)};
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 1300 + count;
    CAPTURE(count, kinds.variant(false), report, seed);
    Random random(seed);
    const auto net = block_net<Real>(random, count, kinds.hinges);
    const float relaxation = report != 0 ? 1.0f : 0.75f;
    Case c;
    c.precision = precision_of<Real>();
    c.in = buffers_of(net);
    c.launches = {make_launch(kernels::vbd_solve::info(kinds.variant(false), c.precision),
                              kernels::vbd_solve::Params{0, count, report, relaxation}, count)};
    std::vector<glm::dvec3> step(net.delta.size(), glm::dvec3(0));
    std::vector<double> scale(net.delta.size(), 0.0);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const std::uint32_t v = net.row[4 * i];
        const double inertia = double(net.predicted[v].w);
        Block<Real> block;
        const glm::dvec3 y(net.predicted[v]), d(net.delta[v]);
        block.f = inertia * (y - d);
        block.f_scale = inertia * (glm::length(y) + glm::length(d));
        block.h = glm::dmat3(inertia);
        block.h_scale = inertia;
        for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
            block.spring(net, net.end[k], kinds.damped, std::sqrt(inertia * double(net.position[v].w)));
        for (std::uint32_t k = net.row[4 * i + 2]; kinds.hinges && k < net.row[4 * i + 6]; ++k)
            block.hinge(net, net.corner[k], v);
        const glm::dmat3 inverse = glm::inverse(block.h);
        step[v] = double(relaxation) * (inverse * block.f);
        const double norm = std::sqrt(glm::dot(inverse[0], inverse[0]) + glm::dot(inverse[1], inverse[1]) +
                                      glm::dot(inverse[2], inverse[2]));
        scale[v] = norm * (block.f_scale + block.h_scale * glm::length(step[v])) + glm::length(d);
        c.events[TAUT_EVENT_DEGENERATE] += report != 0 ? block.degenerate : 0;
    }
    Field& field = c.expected["delta"];
    for (std::uint32_t v = 0; v < net.delta.size(); ++v)
        for (int k = 0; k < 4; ++k)
            field.add(double(net.delta[v][k]) + (k < 3 ? step[v][k] : 0), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("several colours in one group give what a dispatch a colour gives, bit for bit", "", float,
                   double)
{
    using Real = TestType;
    const Kinds kinds = {GENERATE(false, true), GENERATE(false, true)};
    CAPTURE(kinds.variant(true));
    Random random(1350);
    constexpr std::uint32_t rows = 300;
    auto net = block_net<Real>(random, rows, kinds.hinges);
    // The same rows cut into colours, whose springs now join rows of different colours.
    const std::uint32_t ends[] = {64, 65, 130, 193, 300};
    std::uint32_t colour = 0;
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        while (i >= ends[colour])
            ++colour;
        net.row[4 * i + 3] = ends[colour];
        const std::uint32_t begin = colour == 0 ? 0 : ends[colour - 1];
        for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
        {
            const std::uint32_t other = random.below(rows);
            if ((other < begin || other >= ends[colour]) && i != 3)
                net.end[k].b = kBefore + other;
        }
    }
    const Precision precision = precision_of<Real>();
    const Buffers in = buffers_of(net);
    std::vector<Launch> each;
    for (std::uint32_t c = 0, begin = 0; c < 5; begin = ends[c++])
        each.push_back(make_launch(kernels::vbd_solve::info(kinds.variant(false), precision),
                                   kernels::vbd_solve::Params{begin, ends[c] - begin, 1, 1.0f},
                                   ends[c] - begin));
    const std::vector<Launch> grouped = {make_launch(kernels::vbd_solve::info(kinds.variant(true), precision),
                                                     kernels::vbd_solve::Params{0, rows, 1, 1.0f}, 1)};
    const Buffers serial = run(*test_device("cpu:serial"), each, in);
    CHECK(serial.at("delta") != in.at("delta"));
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision) || !bitwise_equal_expected(device->info()))
            continue;
        CAPTURE(selector);
        CHECK(differing_buffers(serial, run(*device, grouped, in)) == "");
        CHECK(differing_buffers(serial, run(*device, each, in)) == "");
    }
}

TEMPLATE_TEST_CASE("a step that is no number is not taken, and counted", "", float, double)
{
    using Real = TestType;
    Random random(1360);
    auto net = block_net<Real>(random, 9, false);

    const Real inf = std::numeric_limits<Real>::infinity();
    net.predicted[kBefore].x = inf;
    const Precision precision = precision_of<Real>();
    const std::vector<Launch> launches = {
        make_launch(kernels::vbd_solve::info("", precision), kernels::vbd_solve::Params{0, 9, 0, 1.0f}, 9)};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, launches, buffers_of(net));
        const auto delta = values_of<glm::vec<4, Real>>(out.at("delta"));
        CHECK(delta[kBefore] == net.delta[kBefore]);
        CHECK(delta[kBefore + 1] != net.delta[kBefore + 1]);
        CHECK(values_of<std::uint32_t>(out.at("events"))[TAUT_EVENT_NON_FINITE] == 1);
    }
}
