#include "taut/kernels/constraint_rows.hpp"

#include "support/constraint_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// The elements that divide by zero if nobody looks. Returns how many rows must be counted.
template <typename Real>
std::uint32_t plant(RowNet<Real>& net)
{
    if (net.rows() < 63)
        return 0;
    // One pair of vertices for each, so that no other row is hit by accident.
    const std::uint32_t v = net.vertices();
    for (std::uint32_t k = 0; k < 4; ++k)
    {
        net.position.push_back({Real(0), Real(3) + Real(k), Real(0), Real(1)});
        net.position.push_back({Real(0), Real(3) + Real(k), Real(0), Real(2)});
        net.delta.insert(net.delta.end(), 2, {Real(0), Real(0), Real(0), Real(0)});
    }
    for (std::uint32_t k = 0; k < 4; ++k)
        net.row[k] = {v + 2 * k, v + 2 * k + 1, Real(0.1), Real(0), Real(0), 0};
    net.row[1].rest_length = 0;          // at rest: empty, not counted
    net.position[v + 4].x = Real(1e-20); // nearly coincident: the same as coincident
    net.position[v + 6].x = Real(1e-12); // near, and a direction
    return 2;
}

} // namespace

TEMPLATE_TEST_CASE("constraint_rows forms directions and what is left of each length", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool kept = GENERATE(false, true);
    const std::uint32_t further = GENERATE(0u, 1u), swing = GENERATE(0u, 1u);
    CAPTURE(dealt.count, dealt.groups, kept, further, swing);
    Random random(40 + dealt.count);
    RowNet<Real> net = random_row_net<Real>(random, dealt.count + 3); // three stay as they are
    for (std::uint32_t r = 2; r < net.rows(); r += 5) // short for how far their ends move
        net.row[r].rest_length = random.uniform<Real>(0.005, 0.1);
    const std::uint32_t counted = plant(net);
    const std::vector<Real> multiplier = random_reals<Real>(random, net.rows(), -1e-3, 1e-3);

    Case c;
    c.precision = precision_of<Real>();
    const std::vector<typename RowNet<Real>::Vec> before(net.rows(), {7, 7, 7, 7});
    c.in = {{"row", bytes_of(net.row)},
            {"position", bytes_of(net.position)},
            {"delta", bytes_of(net.delta)},
            {"step_values", bytes_of(std::vector{net.step})},
            {"events", no_events()},
            {"direction", bytes_of(before)},
            {"b", bytes_of(std::vector<Real>(net.rows(), Real(7)))},
            {"multiplier", bytes_of(multiplier)}};
    c.launches = {make_launch(kernels::constraint_rows::info(kept ? "kept" : "", c.precision),
                              kernels::constraint_rows::Params{dealt.count, dealt.chunk(), further, 1, swing},
                              dealt.dispatched())};
    c.events[TAUT_EVENT_DEGENERATE] = counted;
    for (std::uint32_t r = 0; r < net.rows(); ++r)
    {
        if (r >= dealt.count)
        {
            add_vec4(c.expected["direction"], glm::dvec3(7), 0, 7);
            c.expected["b"].add(7, 0);
            continue;
        }
        const auto& s = net.row[r];
        const glm::dvec3 apart = wide3(net.position[s.a]) - wide3(net.position[s.b]);
        const glm::dvec3 moved = wide3(net.delta[s.a]) - wide3(net.delta[s.b]);
        const glm::dvec3 d = further ? apart + moved : apart;
        const double length = glm::length(d), rate = static_cast<double>(net.step.inverse_substep);
        const bool usable = length > 1e-18;
        const glm::dvec3 n = usable ? d / length : glm::dvec3(0);
        const double compliance = s.stiffness > 0 ? 1 / static_cast<double>(s.stiffness) : 0;
        const double share = 1 + static_cast<double>(s.damping) * compliance * rate;
        const double soft = compliance * rate * rate;
        const double change = glm::dot(n, moved), rest = static_cast<double>(s.rest_length);
        const double lambda = kept && further ? static_cast<double>(multiplier[r]) : 0;
        const bool swings = usable && glm::length(moved - n * change) > 0.3 * rest;
        c.events[TAUT_EVENT_SPEED_CLAMP] += swing != 0 && swings ? 1 : 0;
        const double value = length - rest + (further ? 0 : change) + (share - 1) * change - soft * lambda;
        const double size = glm::length(wide3(net.position[s.a])) + glm::length(wide3(net.position[s.b])) +
                            glm::length(wide3(net.delta[s.a])) + glm::length(wide3(net.delta[s.b]));
        add_vec4(c.expected["direction"], n, usable ? 1 + (further ? size / length : 0) : 0, soft / share,
                 soft / share);
        const double moved_size = share * glm::length(moved) + (share - 1) * glm::length(moved) + size * 1;
        c.expected["b"].add(usable ? value / share : 0,
                            usable ? (length + rest + moved_size + soft * std::abs(lambda)) / share : 0);
    }
    check_on_every_device(c);
}
