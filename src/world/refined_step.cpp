// With the guarantee: a step in which what is held left others no place, though it may only have moved too
// far for one push to follow, is done again in parts, from what was before it.
//
// Based on: Bridson, Fedkiw, Anderson. Robust Treatment of Collisions, Contact and Friction for Cloth
//   Animation. SIGGRAPH 2002, section 7 (a step that cannot be resolved is done again with shorter ones).
// Departures: the parts have all substeps and searches of a step, so that forecasts are shorter, too; what
//   really has no place left is pinched in the finest parts as well, and goes on so.

#include "taut/kernels/shared/contact_rows.h"
#include "taut/world/planned.hpp"
#include "taut/world/separate_start.hpp"
#include "taut/world/world_impl.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Parts of a step, one after the other, until nothing is pinched.
constexpr std::uint32_t kParts[] = {4, 16, 64};
/// Steps given up in a row after which the pause grows no longer.
constexpr std::uint32_t kMostTimes = 4;
/// Steps between two trials to take apart what crosses.
constexpr std::uint64_t kTriedEvery = 8;

/// Of a way from 0 to 1, the places that `share` of it leads to; the ends are met to the bit.
std::vector<glm::dvec3> on_the_way(const PinMove& move, double share)
{
    if (!(share > 0) || !(share < 1))
        return share > 0 ? move.to : move.from;
    std::vector<glm::dvec3> out;
    for (std::size_t k = 0; k < move.from.size(); ++k)
        out.push_back(move.from[k] + share * (move.to[k] - move.from[k]));
    return out;
}

/// What a program moves between two shares of a step. Colliders and wind have their keys in the scene.
ProgramMotion between(const ProgramMotion& whole, double from, double to)
{
    ProgramMotion out = whole;
    for (std::size_t p = 0; p < out.pins.size(); ++p)
    {
        out.pins[p].from = on_the_way(whole.pins[p], from);
        out.pins[p].to = on_the_way(whole.pins[p], to);
    }
    return out;
}

} // namespace

void World::Impl::write_now(const std::vector<InputWrite>& writes)
{
    for (const InputWrite& write : writes)
        device->write(buffers[write.buffer], write.offset, write.bytes);
}

/// Steps through a stretch of time; whatever else is new has been written.
void World::Impl::do_again(const Stretch& stretch, const ProgramMotion& motion)
{
    device->replay(*recording, writes_of(buffers, step_inputs(scene, plan, stretch, motion)));
}

/// Of the counters of what was left out: what has been pinched, and with something led what may have been run
/// over, since it stood still for want of its pairs.
std::uint64_t World::Impl::pinches(const std::vector<std::uint32_t>& lost) const
{
    const std::uint64_t stood = std::uint64_t(lost[TAUT_CONTACT_CUT]) + lost[TAUT_CONTACT_CROWDED];
    return lost[TAUT_CONTACT_PINCHED] + (plan.moving_pins.empty() ? 0 : stood);
}

/// For parts of a step: the clock keeps the whole one.
void World::Impl::take_timestep(double seconds)
{
    const Pace before = pace();
    scene.timestep = plan.timestep = seconds;
    move_velocities(before);
    stale = true;
}

void World::Impl::step_in_parts(std::uint32_t count, const std::vector<InputWrite>& inputs)
{
    const double whole = scene.timestep, begin = clock.at(steps), end = clock.at(steps + 1);
    const auto at = [&](std::uint32_t part) {
        return part == count ? end : begin + (end - begin) * part / count;
    };
    parts = count;
    write_now(inputs);
    write_now({lists_forgotten()}); // those of the step that is given up
    try
    {
        take_timestep(whole / count);
        for (std::uint32_t p = 0; p < count; ++p)
            do_again({at(p), at(p + 1)}, between(program.values(), double(p) / count, double(p + 1) / count));
        take_timestep(whole);
    }
    catch (...)
    {
        scene.timestep = plan.timestep = whole;
        throw;
    }
}

/// Returns whether anything is pinched still.
bool World::Impl::refine_step(const std::vector<InputWrite>& before, const std::vector<InputWrite>& inputs)
{
    const std::uint64_t earlier = pinches(words_of(before, plan.contact.lost));
    const auto pinched = [&] { return pinches(lost_words()) != earlier; };
    const auto over = [&] {
        given_up.times = 0;
        given_up.until = 0;
        return false;
    };
    if (!pinched())
        return over();
    if (steps < given_up.until)
        return true;
    ++refined;
    const std::uint32_t missed = words_of(before, plan.contact.control)[TAUT_CONTACT_MISSING];
    for (const std::uint32_t count : kParts)
    {
        do
        {
            write_now(before);
            step_in_parts(count, inputs);
        } while (lengthen_lists(missed));
        if (!pinched())
            return over();
    }
    given_up.times = std::min(given_up.times + 1, kMostTimes);
    given_up.until = steps + (std::uint64_t(1) << given_up.times);
    return true;
}

/// Vertices keep their velocities. On the host, in double: the same places on every executor.
void World::Impl::untangle()
{
    Scene now = scene;
    const std::vector<glm::dvec3> before = positions(all());
    if (!std::all_of(before.begin(), before.end(),
                     [](const glm::dvec3& x) { return glm::length(x) < kFarthest; }))
        return;
    auto next = before.begin();
    for (Body& body : now.bodies)
    {
        const auto end = next + static_cast<std::ptrdiff_t>(body.mesh.positions.size());
        body.start_positions.assign(next, end);
        next = end;
    }
    const std::vector<glm::dvec3> after = untangled_places(now);
    given_up.tangled = after.empty();
    given_up.tried_until = after.empty() ? steps + kTriedEvery : 0;
    if (after.empty() || after == before)
        return;
    const std::uint64_t placed_before = placings; // no order of the program
    put_at(all(), after, "untangle");
    for (std::uint32_t v = 0; v < plan.vertex_count; ++v) // what stays keeps all its digits
        placed.waits[v] = after[plan.original[v]] != before[plan.original[v]];
    placings = placed_before;
    ++untangled;
}

} // namespace taut
