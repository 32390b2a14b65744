// Places and velocities of vertices, read and set from outside, of all or of one body.
//
// Based on: velocities are those of src/world/at_step.cpp; a change of velocity is a Galilean one.
// Departures: none.

#include "taut/plan/contact_scene.hpp"
#include "taut/world/world_impl.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace taut {
namespace {

void require_all(std::span<const glm::dvec3> values, std::size_t count, double largest,
                 const std::string& who, const char* what)
{
    if (values.size() != count)
        throw Error(ErrorCode::bad_input, who + ": " + std::to_string(values.size()) + " " + what + " for " +
                                              std::to_string(count) + " vertices; give one a vertex");
    for (std::size_t v = 0; v < values.size(); ++v)
        if (!(glm::length(values[v]) <= largest)) // no number is not either
            throw Error(ErrorCode::bad_input, who + ": what is given for vertex " + std::to_string(v) +
                                                  " is not finite, or too large for a simulation");
}

/// The bytes of a vector of four of `value`.
template <typename Real>
std::vector<std::byte> four_of(Real value)
{
    const glm::vec<4, Real> four(value);
    std::vector<std::byte> out(sizeof four);
    std::memcpy(out.data(), &four, sizeof four);
    return out;
}

/// Which of the vertices wait, as ranges.
std::vector<Vertices> ranges(const std::vector<bool>& waits)
{
    std::vector<Vertices> out;
    for (std::uint32_t v = 0; v < waits.size(); ++v)
        if (waits[v])
        {
            if (out.empty() || out.back().first + out.back().count != v)
                out.push_back({v, 0});
            ++out.back().count;
        }
    return out;
}

} // namespace

Vertices World::Impl::of_body(std::size_t body, const char* who) const
{
    if (body >= scene.bodies.size())
        throw Error(ErrorCode::bad_input, std::string(who) + ": body " + std::to_string(body) + " of " +
                                              std::to_string(scene.bodies.size()) + ", numbered from 0");
    return {plan.body_start[body], plan.body_start[body + 1] - plan.body_start[body]};
}

template <typename Real>
void World::Impl::put_places(const Vertices& where, std::span<const glm::dvec3> x)
{
    using Vec = glm::vec<4, Real>;
    for (std::uint32_t k = 0; k < where.count; ++k)
    {
        const std::uint32_t v = where.first + k;
        const glm::dvec3& to = x[plan.original[v] - where.first];
        glm::vec<3, Real> high(0), rest(0);
        for (int axis = 0; axis < 3; ++axis)
        {
            // GCC 12 takes the conversion to float and back for nothing where it does it in vectors.
            const volatile Real rounded = static_cast<Real>(to[axis]);
            high[axis] = rounded;
            rest[axis] = static_cast<Real>(to[axis] - static_cast<double>(rounded));
        }
        std::memcpy(placed.position.data() + v * sizeof(Vec), &high, sizeof high);
        std::memcpy(placed.low.data() + v * sizeof(Vec), &rest, sizeof rest);
        placed.waits[v] = true;
    }
}

void World::Impl::put_at(const Vertices& where, std::span<const glm::dvec3> x, const char* who)
{
    require_all(x, where.count, kFarthest, who, "positions");
    if (where.count == 0)
        return;
    if (!placed.any) // the fourth numbers, inverse mass and gap, stay as the plan has them
        placed = {plan.buffers[plan.position].initial, plan.buffers[plan.low].initial,
                  std::vector<bool>(plan.vertex_count, false), true};
    if (plan.precision == Precision::float64)
        put_places<double>(where, x);
    else
        put_places<float>(where, x);
    guessed = false;
    ++placings;
}

std::vector<InputWrite> World::Impl::take_places()
{
    std::vector<InputWrite> out;
    const std::size_t each = 4 * real_bytes(plan.precision);
    for (const Vertices& range : ranges(placed.waits))
        for (const auto& [buffer, bytes] :
             {std::pair{plan.position, &placed.position}, {plan.low, &placed.low}})
        {
            const auto first = bytes->begin() + static_cast<std::ptrdiff_t>(range.first * each);
            out.push_back({buffer,
                           {first, first + static_cast<std::ptrdiff_t>(range.count * each)},
                           range.first * each});
        }
    if (!out.empty() && plan.contact.place != kNoBuffer)
        out.push_back(lists_forgotten());
    placed = {};
    return out;
}

InputWrite World::Impl::lists_forgotten() const
{
    return {plan.contact.place, plan.precision == Precision::float64 ? four_of<double>(kBeforeSearch)
                                                                     : four_of<float>(kBeforeSearch)};
}

/// Now, for who looks before the next step.
void World::Impl::hand_over_places() { write_now(take_places()); }

std::vector<glm::dvec3> World::Impl::positions(const Vertices& of)
{
    hand_over_places();
    return vectors(plan.position, plan.low, of);
}

/// All but the fourth numbers, which are not of the motion.
template <typename Real>
void World::Impl::replace(std::uint32_t buffer, const Vertices& of, const std::vector<glm::dvec3>& values)
{
    using Vec = glm::vec<4, Real>;
    const std::uint64_t offset = of.first * sizeof(Vec);
    std::vector<Vec> all = device->read<Vec>(buffers[buffer], of.count, offset);
    for (std::uint32_t k = 0; k < of.count; ++k)
        all[k] = Vec(glm::vec<3, Real>(values[k]), all[k].w);
    device->write<Vec>(buffers[buffer], all, offset);
}

template <typename Real>
void World::Impl::speed_up(const Vertices& where, std::span<const glm::dvec3> v)
{
    using Vec = glm::vec<4, Real>;
    const std::vector<std::byte>& initial = plan.buffers[plan.position].initial;
    const Pace now = pace();
    std::vector<glm::dvec3> velocity, delta, coasting;
    double energy = 0; // J, of the changes
    const auto vertices = kept<Real>(where);
    for (std::uint32_t k = 0; k < where.count; ++k)
    {
        Kept vertex = vertices[k];
        if (vertex.pull != Pull::held)
        {
            const glm::dvec3 change =
                v[plan.original[where.first + k] - where.first] - velocity_at_step(now, vertex);
            vertex.velocity += change;
            vertex.displacement += change * now.substep;
            vertex.coasting += change * now.substep;
            Vec held;
            std::memcpy(&held, initial.data() + (where.first + k) * sizeof(Vec), sizeof held);
            energy += 0.5 * glm::dot(change, change) / double(held.w);
        }
        velocity.push_back(vertex.velocity);
        delta.push_back(vertex.displacement);
        coasting.push_back(vertex.coasting);
    }
    replace<Real>(plan.velocity, where, velocity);
    replace<Real>(plan.delta, where, delta);
    if (plan.coasting != kNoBuffer)
        replace<Real>(plan.coasting, where, coasting);
    kick += std::sqrt(energy);
}

void World::Impl::set_velocities(const Vertices& where, std::span<const glm::dvec3> v, const char* who)
{
    constexpr double kFastest = 1e15; // m/s: squares stay finite in float
    require_all(v, where.count, kFastest, who, "velocities");
    if (where.count == 0)
        return;
    guessed = false;
    if (plan.precision == Precision::float64)
        speed_up<double>(where, v);
    else
        speed_up<float>(where, v);
}

std::vector<glm::dvec3> World::positions() const { return impl_->positions(impl_->all()); }
std::vector<glm::dvec3> World::velocities() const { return impl_->velocities(impl_->all()); }

std::vector<glm::dvec3> World::positions(std::size_t body) const
{
    return impl_->positions(impl_->of_body(body, "positions"));
}
std::vector<glm::dvec3> World::velocities(std::size_t body) const
{
    return impl_->velocities(impl_->of_body(body, "velocities"));
}

BodyRange World::body_range(std::size_t body) const
{
    const Vertices of = impl_->of_body(body, "body_range");
    return {of.first, of.count};
}

void World::set_positions(std::span<const glm::dvec3> positions)
{
    impl_->put_at(impl_->all(), positions, "set_positions");
}
void World::set_positions(std::size_t body, std::span<const glm::dvec3> positions)
{
    impl_->put_at(impl_->of_body(body, "set_positions"), positions, "set_positions");
}
void World::set_velocities(std::span<const glm::dvec3> velocities)
{
    impl_->set_velocities(impl_->all(), velocities, "set_velocities");
}
void World::set_velocities(std::size_t body, std::span<const glm::dvec3> velocities)
{
    impl_->set_velocities(impl_->of_body(body, "set_velocities"), velocities, "set_velocities");
}

} // namespace taut
