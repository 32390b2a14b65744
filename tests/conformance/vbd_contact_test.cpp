// What shared/vbd_contact.glsl does to the step of vbd_solve.

#include "taut/kernels/vbd_solve.hpp"

#include "support/block_parts.hpp"
#include "support/kernel_run.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct Surface
{
    glm::dvec3 normal{0}, drag{0};
    double least = 0, friction = 0;
};

/// Where the vertex goes and what holds it: by the written rules, with the inverse of H.
struct Stopped
{
    glm::dvec3 step{0}, reaction{0};
    double step_scale = 0, reaction_scale = 0;
    bool sticks = false, doubtful = false;
};

template <typename Real>
Stopped stopped(const Block<Real>& block, const glm::dvec3& d, const Surface& s)
{
    const glm::dmat3 inverse = glm::inverse(block.h);
    const double norm = std::sqrt(glm::dot(inverse[0], inverse[0]) + glm::dot(inverse[1], inverse[1]) +
                                  glm::dot(inverse[2], inverse[2]));
    const glm::dvec3 free = inverse * block.f, n = s.normal;
    const double doubt = 16 * double(std::numeric_limits<Real>::epsilon()); // rounding could decide otherwise
    Stopped out;
    out.step = free;
    out.step_scale = norm * (block.f_scale + block.h_scale * glm::length(free)) + glm::length(d);
    const double lack = s.least - glm::dot(n, d + free), size = out.step_scale + std::abs(s.least);
    out.doubtful = n != glm::dvec3(0) && std::abs(lack) < doubt * size;
    if (!(lack > 0) || n == glm::dvec3(0))
        return out;
    const glm::dvec3 stay = n * s.least + s.drag - d, hold = block.h * stay - block.f;
    const double hold_scale = block.h_scale * (glm::length(stay) + size) + block.f_scale;
    const double normal = glm::dot(n, hold), most = s.friction * normal;
    const glm::dvec3 along = hold - n * normal;
    out.doubtful = out.doubtful || std::abs(glm::length(along) - most) < doubt * hold_scale;
    if (glm::length(along) <= most)
    {
        out.sticks = true;
        out.step = stay;
        out.step_scale = glm::length(d) + std::abs(s.least) + glm::length(s.drag);
        out.reaction = hold;
        out.reaction_scale = hold_scale;
        return out;
    }
    glm::dvec3 q = n + s.friction * glm::normalize(along);
    const double straight = glm::dot(n, inverse * n);
    const double turn = 1 + s.friction * hold_scale / glm::length(along); // how well its direction is known
    out.doubtful = out.doubtful || std::abs(glm::dot(n, inverse * q) / straight - 0.25) < doubt * turn;
    if (glm::dot(n, inverse * q) <= 0.25 * straight)
        q = n;
    const double gives = glm::dot(n, inverse * q), force = lack / gives;
    const double condition = norm * block.h_scale;
    out.step = free + inverse * q * force;
    out.reaction = q * force;
    out.reaction_scale = (size / gives + std::abs(force) * norm / gives * (turn + condition)) * (1 + turn);
    out.step_scale = size + norm * (out.reaction_scale + condition * glm::length(out.reaction));
    return out;
}

/// Half of the vertices of rows meet something; others have no plane, or one far below.
template <typename Real>
std::vector<Surface> surfaces_of(const BlockNet<Real>& net, Random& random)
{
    std::vector<Surface> out(net.delta.size());
    for (std::size_t v = 0; v < out.size(); ++v)
    {
        const std::uint32_t kind = random.below(8);
        if (kind == 0)
            continue;
        Surface& s = out[v];
        s.normal = glm::dvec3(glm::vec<3, Real>(glm::normalize(glm::dvec3(random.vec4<double>(1, 0)))));
        s.drag =
            glm::dvec3(glm::vec<3, Real>(glm::cross(s.normal, glm::dvec3(random.vec4<double>(0.01, 0)))));
        s.least = double(static_cast<Real>(glm::dot(s.normal, glm::dvec3(net.delta[v])) +
                                           (kind == 1 ? -10 : random.uniform(-0.1, 0.1))));
        s.friction = double(random.uniform<Real>(0, kind == 2 ? 50 : 1));
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("vbd_solve holds what meets a surface, and lets it slip by Coulomb's law", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 65u, 1000u);
    const bool added = GENERATE(false, true);
    const Kinds kinds = added ? Kinds{true, true, Solids::elastic} : Kinds{};
    CAPTURE(count, added);
    Random random(1380 + count);
    auto net = block_net<Real>(random, count, kinds.hinges, added ? Solids::elastic : Solids::none);
    const auto n = static_cast<std::uint32_t>(net.delta.size());
    const std::vector<Surface> surfaces = surfaces_of(net, random);
    auto front = added ? random_blocks(random, net.predicted) : net.predicted;
    const auto known = front;
    for (const Surface& s : surfaces)
    {
        front.emplace_back(glm::dvec4(s.normal, s.least));
        front.emplace_back(glm::dvec4(s.drag, s.friction));
        front.emplace_back(glm::dvec4(7));
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = buffers_of(net, kinds);
    const std::string name = added ? "block" : "predicted";
    c.in[name] = bytes_of(front);
    c.launches = {make_launch(kernels::vbd_solve::info(added ? "added" : "", c.precision),
                              kernels::vbd_solve::Params{0, count, 0, 1.0f, added ? 3 * n : n}, count)};
    Field& delta = c.expected["delta"];
    Field& contacts = c.expected[name];
    for (const auto& value : known)
        for (int k = 0; k < 4; ++k)
            contacts.add(double(value[k]), 0);
    std::uint32_t stick = 0, slip = 0, open = 0;
    for (std::uint32_t v = 0; v < n; ++v)
    {
        Stopped end;
        const bool row = v >= kBefore && v < kBefore + count;
        if (row)
            end = stopped(block_of_row(net, kinds, v - kBefore, added ? &known : nullptr),
                          glm::dvec3(net.delta[v]), surfaces[v]);
        stick += end.sticks ? 1 : 0;
        slip += !end.sticks && end.reaction != glm::dvec3(0) ? 1 : 0;
        open += end.doubtful ? 1 : 0;
        for (int k = 0; k < 4; ++k)
            delta.add(double(net.delta[v][k]) + (k < 3 ? end.step[k] : 0), end.doubtful ? kAnyFinite
                                                                           : k < 3      ? end.step_scale
                                                                                        : 0);
        const Surface& s = surfaces[v];
        for (const glm::dvec4& same : {glm::dvec4(s.normal, s.least), glm::dvec4(s.drag, s.friction)})
            for (int k = 0; k < 4; ++k)
                contacts.add(same[k], 0);
        for (int k = 0; k < 4; ++k)
            contacts.add(!row         ? 7
                         : k < 3      ? end.reaction[k]
                         : end.sticks ? 1
                                      : 0,
                         !row           ? 0
                         : end.doubtful ? kAnyFinite
                         : k < 3        ? end.reaction_scale
                                        : 0);
    }
    CHECK(open * 20 <= count + 19);
    if (count == 1000)
        CHECK((stick > 30 && slip > 100 && stick + slip < 800));
    check_on_every_device(c);
}

// By hand: a vertex of 2 kg/s^2 that is to go (3, -4, 0), over a floor at -1 in its way.
TEMPLATE_TEST_CASE("a vertex on a floor stops within the cone of friction, else slips by its push", "", float,
                   double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const double friction = GENERATE(0.0, 0.5, 1.0, 2.0);
    // H = 2: the floor pushes with 2 (4 - 1) = 6, the way along it would take 2 * 3 to be held.
    const double way = friction < 1 ? 3 - friction * 3 : 0;
    const std::vector<Vec> front = {Vec(3, -4, 0, 2), Vec(0, 1, 0, -1), Vec(0, 0, 0, friction), Vec(7)};
    const Buffers in = {{"row", bytes_of(std::vector<std::uint32_t>{0, 0, 0, 1, 0, 0, 0, 1})},
                        {"end", bytes_of(std::vector<layout::Spring<Real>>(1))},
                        {"position", bytes_of(std::vector<Vec>{Vec(0, 0, 0, 1)})},
                        {"predicted", bytes_of(front)},
                        {"delta", bytes_of(std::vector<Vec>{Vec(0, 0, 0, Real(0.25))})},
                        {"events", no_events()}};
    const Launch launch = make_launch(kernels::vbd_solve::info("", precision_of<Real>()),
                                      kernels::vbd_solve::Params{0, 1, 0, 1.0f, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, friction);
        const Buffers out = run(*device, {launch}, in);
        const auto delta = reals_of<Real>(out.at("delta")), after = reals_of<Real>(out.at("predicted"));
        CHECK(delta[0] == Approx(way).margin(1e-6));
        CHECK((delta[1] == -1 && delta[2] == 0 && delta[3] == 0.25));
        CHECK(after[12] == Approx(friction < 1 ? -6 * friction : -6).margin(1e-5));
        CHECK(after[13] == Approx(6));
        CHECK(after[15] == (friction < 1 ? 0 : 1));
    }
}
