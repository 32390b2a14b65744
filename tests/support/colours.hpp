#pragma once
// Constraints in colours: what the tests of constraint kernels share. A reference projects one constraint
// after another on a State in fp64 and says how large the terms were.

#include "support/expect.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>

#include <utility>

namespace taut::conformance {

inline constexpr std::uint32_t kTableFirst = 3; ///< words before the groups in the table of a tail

/// Input of a constraint kernel. Colour k has the constraints colour_start[k] .. colour_start[k + 1] - 1.
/// The tail variants take `groups` of colours {begin, end}; groups share no vertex.
template <typename Real, template <typename> typename Constraint>
struct Colours
{
    std::vector<glm::vec<4, Real>> position, delta;
    std::vector<Constraint<Real>> constraint;
    std::vector<std::uint32_t> colour_start = {0};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> groups;
    std::vector<Real> multiplier;
    layout::StepValues<Real> step{};

    Buffers buffers() const
    {
        return {{"constraint", bytes_of(constraint)},
                {"position", bytes_of(position)},
                {"delta", bytes_of(delta)},
                {"step_values", bytes_of(std::vector{step})},
                {"events", no_events()},
                {"table", bytes_of(table())},
                {"multiplier", bytes_of(multiplier)}};
    }

    /// What the tail variants read: unused words, two words per group, then the colours' first constraints.
    std::vector<std::uint32_t> table() const
    {
        std::vector<std::uint32_t> words(kTableFirst, 0xFFFFFFFFu);
        const std::size_t base = kTableFirst + 2 * groups.size();
        for (const auto& [begin, end] : groups)
        {
            words.push_back(static_cast<std::uint32_t>(base + begin));
            words.push_back(static_cast<std::uint32_t>(base + end));
        }
        words.insert(words.end(), colour_start.begin(), colour_start.end());
        return words;
    }
};

/// What a reference works on, with the size of everything that was added up so far per vertex and constraint.
struct State
{
    std::vector<glm::dvec4> position, delta;
    std::vector<double> multiplier, delta_scale, multiplier_scale;
    double inverse_substep = 0;
    bool lambda = false, first_iteration = false, report = false;
    Events events = {};

    /// Displaces a vertex; `size` is the size of what could have been rounded on the way.
    void push(std::uint32_t vertex, const glm::dvec3& by, double size)
    {
        if (position[vertex].w == 0)
            return;
        delta[vertex] += glm::dvec4(by, 0);
        delta_scale[vertex] += size + glm::length(glm::dvec3(delta[vertex]));
    }

    glm::dvec3 at(std::uint32_t vertex) const
    {
        return glm::dvec3(position[vertex]) + glm::dvec3(delta[vertex]);
    }

    Field delta_field() const
    {
        Field field;
        for (std::size_t i = 0; i < delta.size(); ++i)
            for (int k = 0; k < 4; ++k)
                field.add(delta[i][k], k < 3 ? delta_scale[i] : 0);
        return field;
    }
};

template <typename Input>
State state_of(const Input& in, bool lambda, bool first_iteration, bool report)
{
    State state;
    for (const auto& p : in.position)
        state.position.emplace_back(p);
    for (const auto& d : in.delta)
        state.delta.emplace_back(d);
    state.multiplier.assign(in.multiplier.begin(), in.multiplier.end());
    state.delta_scale.assign(in.delta.size(), 0);
    state.multiplier_scale.assign(in.multiplier.size(), 0);
    state.inverse_substep = static_cast<double>(in.step.inverse_substep);
    state.lambda = lambda;
    state.first_iteration = first_iteration;
    state.report = report;
    return state;
}

/// How constraints are launched. Kernel is the namespace's `info` function, Params its struct.
struct Mode
{
    bool tail = false, lambda = false, first_iteration = true, report = true;

    std::string variant() const
    {
        return tail ? (lambda ? "tail_lambda" : "tail") : (lambda ? "lambda" : "");
    }
};

using KernelTable = const KernelInfo& (*)(std::string_view, Precision);

/// The colours of all groups: one dispatch each, or all in one dispatch (tail).
template <typename Params, typename Input>
std::vector<Launch> colour_launches(KernelTable info, Precision precision, const Mode& mode, const Input& in)
{
    const KernelInfo& kernel = info(mode.variant(), precision);
    const std::uint32_t first_iteration = mode.first_iteration, report = mode.report;
    const auto groups = static_cast<std::uint32_t>(in.groups.size());
    if (mode.tail) // two groups too many, as a folded dispatch has: they must do nothing
        return {make_launch(kernel, Params{kTableFirst, groups, first_iteration, report}, groups + 2)};
    std::vector<Launch> launches;
    for (const auto& [begin, end] : in.groups)
        for (std::uint32_t c = begin; c < end; ++c)
        {
            const std::uint32_t count = in.colour_start[c + 1] - in.colour_start[c];
            launches.push_back(
                make_launch(kernel, Params{in.colour_start[c], count, first_iteration, report}, count));
        }
    return launches;
}

/// Projects the constraints of all groups by `project(state, constraint, k)`; checks every executor against
/// it.
template <typename Params, typename Input, typename Project>
void check_colours(KernelTable info, const Input& in, const Mode& mode, Precision precision, Project project)
{
    Case c;
    c.precision = precision;
    c.in = in.buffers();
    c.launches = colour_launches<Params>(info, precision, mode, in);
    State state = state_of(in, mode.lambda, mode.first_iteration, mode.report);
    for (const auto& [begin, end] : in.groups)
        for (std::uint32_t k = in.colour_start[begin]; k < in.colour_start[end]; ++k)
            project(state, in.constraint[k], k);
    c.expected["delta"] = state.delta_field();
    if (mode.lambda)
        c.expected["multiplier"] = {state.multiplier, state.multiplier_scale};
    c.events = state.events;
    check_on_every_device(c);
}

/// The same colours give the same bits: one dispatch a colour, or one dispatch for all groups.
template <typename Params, typename Input>
void check_tail_equals_dispatches(KernelTable info, const Input& in, Mode mode, Precision precision)
{
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        mode.tail = false;
        const auto each = colour_launches<Params>(info, precision, mode, in);
        mode.tail = true;
        const auto group = colour_launches<Params>(info, precision, mode, in);
        Buffers a = run(*device, each, in.buffers());
        Buffers b = run(*device, group, in.buffers());
        b.erase("table");
        CHECK(differing_buffers(b, a) == "");
    }
}

/// One iteration from a zero multiplier moves every vertex as the kernel without multipliers does.
template <typename Params, typename Input>
void check_first_iteration_equals_base(KernelTable info, const Input& in, Precision precision)
{
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        Mode mode;
        const auto base = colour_launches<Params>(info, precision, mode, in);
        mode.lambda = true;
        const auto first = colour_launches<Params>(info, precision, mode, in);
        const Buffers a = run(*device, base, in.buffers());
        const Buffers b = run(*device, first, in.buffers());
        CHECK(differing_buffers(a, b) == "");
    }
}

} // namespace taut::conformance
