#include "taut/kernels/hinge_rows.hpp"

#include "support/hinge_net.hpp"
#include "support/linear_groups.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kSprings = 5, kBefore = 2; ///< rows of springs, and of tetrahedra
constexpr float kScale = 0.3f;

template <typename Real>
struct Rows
{
    HingeNet<Real> net;
    std::vector<glm::vec<4, Real>> delta;
    std::vector<Real> multiplier; ///< of all rows
    std::uint32_t count() const { return static_cast<std::uint32_t>(net.hinge.size()); }

    glm::dvec3 move(std::uint32_t v) const { return glm::dvec3(delta[v]); }
    HingeTerm term(std::uint32_t k, bool further, std::size_t corner) const
    {
        HingeCorners x;
        double sum = 0;
        const auto vertex = net.corners(k);
        for (std::size_t v = 0; v < 4; ++v)
        {
            const glm::dvec3 place(net.position[vertex[v]]), moved = move(vertex[v]);
            x[v] = further ? place + moved : place;
            sum += glm::length(place) + glm::length(moved);
        }
        return hinge_term(net.hinge[k], x, sum, corner);
    }
    bool can_move(std::uint32_t k) const
    {
        double sum = 0;
        for (const std::uint32_t v : net.corners(k))
            sum += static_cast<double>(net.position[v].w);
        return sum > 0;
    }
};

/// Some hinges without an angle first. None near half a turn from rest, where both ways are right.
template <typename Real>
Rows<Real> random_rows(Random& random, std::uint32_t hinges)
{
    Rows<Real> out;
    out.net = hinge_net<Real>(random, hinges);
    for (const auto& position : out.net.position)
    {
        (void)position;
        out.delta.push_back(random.vec4<Real>(1e-3, random.uniform<Real>(0, 1e-3)));
    }
    for (std::uint32_t k = 0; k < std::min(4u, hinges) && hinges >= 8; ++k)
        for (const std::uint32_t v : out.net.corners(k))
            out.delta[v] = glm::vec<4, Real>(Real(0));
    for (std::uint32_t k = 0; k < out.count(); ++k)
        for (const bool further : {false, true})
        {
            const HingeTerm term = out.term(k, further, 0);
            if (term.shaped && std::abs(std::abs(term.value) - std::numbers::pi) < 0.05)
            {
                const double rest = static_cast<double>(out.net.hinge[k].rest_angle) + 1;
                out.net.hinge[k].rest_angle = static_cast<Real>(std::remainder(rest, 2 * std::numbers::pi));
            }
        }
    for (std::uint32_t r = 0; r < kSprings + kBefore + out.count(); ++r)
        out.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
    return out;
}

template <typename Real>
void expect_row(Case& c, const Rows<Real>& rows, std::uint32_t k, bool further, bool kept)
{
    const auto vertex = rows.net.corners(k);
    const double rate = 600, soft = static_cast<double>(rows.net.hinge[k].compliance) * rate * rate;
    double weight = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        const glm::dvec3 gradient = rows.term(k, further, v).gradient;
        weight += static_cast<double>(rows.net.position[vertex[v]].w) * glm::dot(gradient, gradient);
    }
    double value = 0, scale = 0;
    const bool usable = rows.term(k, further, 0).shaped && weight > 0;
    for (std::size_t v = 1; v < 4; ++v)
    {
        const HingeTerm term = rows.term(k, further, v);
        for (int axis = 0; axis < 3; ++axis)
            c.expected["gradient"].add(usable ? kScale * term.gradient[axis] : 0,
                                       usable ? kScale * term.gradient_scale : 0);
        c.expected["gradient"].add(soft, soft);
        const glm::dvec3 moved = rows.move(vertex[v]) - rows.move(vertex[0]);
        const double size = glm::length(rows.move(vertex[v])) + glm::length(rows.move(vertex[0]));
        value += further ? 0 : kScale * glm::dot(term.gradient, moved);
        scale += further ? 0 : kScale * term.gradient_scale * size;
        value += v == 1 ? kScale * term.value : 0;
        scale += v == 1 ? kScale * term.value_scale : 0;
    }
    const double before = static_cast<double>(rows.multiplier[kSprings + kBefore + k]);
    if (kept && further)
    {
        value -= soft * before;
        scale += soft * std::abs(before);
    }
    c.expected["b"].add(usable ? value : 0, usable ? scale : 0);
}

} // namespace

TEMPLATE_TEST_CASE("hinge_rows is the gradient of each angle and what a step leaves of its change", "", float,
                   double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool further = GENERATE(false, true), kept = GENERATE(false, true), report = GENERATE(false, true);
    CAPTURE(dealt.count, dealt.groups, further, kept, report);
    Random random(170 + dealt.count);
    const Rows<Real> rows = random_rows<Real>(random, dealt.count + 3);
    std::vector<layout::BendingConstraint<Real>> records(kBefore, rows.net.hinge.front());
    records.insert(records.end(), rows.net.hinge.begin(), rows.net.hinge.end());
    layout::StepValues<Real> step{};
    step.substep = Real(1) / Real(600);
    step.inverse_substep = Real(600);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"hinge", bytes_of(records)},
            {"position", bytes_of(rows.net.position)},
            {"delta", bytes_of(rows.delta)},
            {"step_values", bytes_of(std::vector{step})},
            {"events", no_events()},
            {"gradient", bytes_of(std::vector<Vec>(3 * records.size(), Vec(7)))},
            {"b", bytes_of(std::vector<Real>(rows.multiplier.size(), Real(7)))},
            {"multiplier", bytes_of(rows.multiplier)}};
    c.launches = {make_launch(kernels::hinge_rows::info(kept ? "kept" : "", c.precision),
                              kernels::hinge_rows::Params{dealt.count, dealt.chunk(), kBefore,
                                                          kSprings + kBefore, further, report, kScale},
                              dealt.dispatched())};
    for (std::uint32_t k = 0; k < 12 * kBefore; ++k)
        c.expected["gradient"].add(7, 0);
    for (std::uint32_t k = 0; k < kSprings + kBefore; ++k)
        c.expected["b"].add(7, 0);
    for (std::uint32_t k = 0; k < rows.count(); ++k)
    {
        if (k < dealt.count)
        {
            expect_row(c, rows, k, further, kept);
            const bool counts = report && !rows.term(k, further, 0).shaped && rows.can_move(k);
            c.events[TAUT_EVENT_DEGENERATE] += counts ? 1 : 0;
            continue;
        }
        for (int value = 0; value < 12; ++value)
            c.expected["gradient"].add(7, 0);
        c.expected["b"].add(7, 0);
    }
    check_on_every_device(c);
}
