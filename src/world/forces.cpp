// Forces on vertices, set from outside: a host's copy in the plan's order, handed over with the next step.

#include "taut/world/world_impl.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstring>
#include <string>

namespace taut {
namespace {

void require_finite(const glm::dvec3& force, std::size_t vertex, const char* who)
{
    if (!std::isfinite(force.x) || !std::isfinite(force.y) || !std::isfinite(force.z))
        throw Error(ErrorCode::bad_input,
                    std::string(who) + ": the force on vertex " + std::to_string(vertex) + " is not finite");
}

void require_effect(const Plan& plan, const char* who)
{
    if (plan.force == kNoBuffer)
        throw Error(ErrorCode::unsupported, std::string(who) + ": the scene does not call for external "
                                                               "forces; set external_forces to true");
}

template <typename Real>
void put(std::vector<std::byte>& bytes, std::size_t index, const glm::dvec3& force)
{
    const glm::vec<4, Real> value(glm::vec<3, Real>(force), Real(0));
    std::memcpy(bytes.data() + index * sizeof value, &value, sizeof value);
}

template <typename Real>
double sum_of_lengths(const std::vector<std::byte>& bytes)
{
    double sum = 0;
    glm::vec<4, Real> value;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof value)
    {
        std::memcpy(&value, bytes.data() + at, sizeof value);
        sum += glm::length(glm::dvec3(value));
    }
    return sum;
}

} // namespace

/// `bytes`: as on the device, which has them already.
void World::Impl::keep_forces(std::vector<std::byte> bytes)
{
    forces = std::move(bytes);
    place.resize(plan.vertex_count);
    for (std::uint32_t index = 0; index < plan.vertex_count; ++index)
        place[plan.original[index]] = index;
    weigh_forces();
    forces_changed = false;
}

void World::Impl::weigh_forces()
{
    force_sum =
        plan.precision == Precision::float64 ? sum_of_lengths<double>(forces) : sum_of_lengths<float>(forces);
}

void World::Impl::put_force(std::size_t vertex, const glm::dvec3& force)
{
    if (plan.precision == Precision::float64)
        put<double>(forces, place[vertex], force);
    else
        put<float>(forces, place[vertex], force);
    forces_changed = true;
}

void World::set_force(std::uint32_t vertex, const glm::dvec3& force)
{
    const Plan& plan = impl_->plan;
    require_effect(plan, "set_force");
    if (vertex >= plan.vertex_count)
        throw Error(ErrorCode::bad_input, "set_force: vertex " + std::to_string(vertex) + " of " +
                                              std::to_string(plan.vertex_count));
    require_finite(force, vertex, "set_force");
    impl_->put_force(vertex, force);
}

void World::set_forces(std::span<const glm::dvec3> forces)
{
    const Plan& plan = impl_->plan;
    require_effect(plan, "set_forces");
    if (forces.size() != plan.vertex_count)
        throw Error(ErrorCode::bad_input, "set_forces: " + std::to_string(forces.size()) +
                                              " forces for a world of " + std::to_string(plan.vertex_count) +
                                              " vertices; give one a vertex");
    for (std::size_t v = 0; v < forces.size(); ++v)
        require_finite(forces[v], v, "set_forces");
    for (std::size_t v = 0; v < forces.size(); ++v)
        impl_->put_force(v, forces[v]);
}

} // namespace taut
