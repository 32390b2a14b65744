#include "taut/report/cost_contact.hpp"

#include "taut/report/contact_depth.hpp"

#include <algorithm>
#include <cmath>

namespace taut::cost {

void ContactTrace::add(const World& world, std::span<const glm::dvec3> x)
{
    const double time = world.plan().timestep;
    for (const BodyContactForce& force : world.contact_forces())
    {
        impulse += force.push * time;
        friction += force.friction * time;
    }
    depth = std::max(depth, contact_depth(world, x));
}

std::optional<ContactError> contact_error(const ContactTrace& found, const ContactTrace& reference)
{
    if (!(reference.impulse > 0))
        return std::nullopt;
    return ContactError{std::abs(found.impulse - reference.impulse) / reference.impulse,
                        std::abs(found.friction - reference.friction) / reference.impulse, found.depth};
}

} // namespace taut::cost
