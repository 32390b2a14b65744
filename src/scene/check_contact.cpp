// What the bodies of a scene say of each other: which of them pass through which, and what contact takes by
// itself where they meet.

#include "taut/scene/body_measures.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool meets_another(const Scene& scene, const Body& body)
{
    return scene.contact.between &&
           std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& other) {
               return &other != &body && !pass_through(body.contact, other.contact);
           });
}

bool is_cloth(const Body& body)
{
    return body.mesh.tetrahedra.empty() && !body.mesh.triangles.empty() && !body.kinematic.used;
}

} // namespace

std::uint32_t automatic_sweeps(const Scene& scene)
{
    constexpr double kOfCloth = 2, kOfSolids = 8, kMost = 100;
    constexpr double kRounding = 1e-6; // of a sum over a mesh: no sweep more for it
    double sweeps = kOfCloth;
    for (const Body& body : scene.bodies)
    {
        if (body.mesh.tetrahedra.empty() || body.kinematic.used ||
            !(body.contact.self || meets_another(scene, body)))
            continue;
        sweeps = std::max(sweeps, kOfSolids);
        const double lies = mass_of(body) / std::pow(volume_of(body), 2.0 / 3); // kg/m^2
        for (const Body& cloth : scene.bodies)
            if (is_cloth(cloth) && scene.contact.between && !pass_through(body.contact, cloth.contact))
                sweeps = std::max(
                    sweeps, std::ceil(2 * std::sqrt(lies * area_of(cloth) / mass_of(cloth)) - kRounding));
    }
    return static_cast<std::uint32_t>(std::min(sweeps, kMost));
}

bool pass_through(const BodyContact& a, const BodyContact& b)
{
    return has(a.passes, b.group) || has(b.passes, a.group);
}

std::vector<std::string> contact_groups(const Scene& scene)
{
    std::vector<std::string> out;
    for (const Body& body : scene.bodies)
        if (!has(out, body.contact.group))
            out.push_back(body.contact.group);
    return out;
}

namespace scene_file {

void check_groups(const Scene& scene, const Checker& out)
{
    const std::vector<std::string> names = contact_groups(scene);
    if (names.size() > kMostContactGroups)
        out.error("bodies", "have " + std::to_string(names.size()) + " different contact.group; at most " +
                                std::to_string(kMostContactGroups) + " are told apart");
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
        const std::vector<std::string>& passes = scene.bodies[b].contact.passes;
        for (std::size_t k = 0; k < passes.size(); ++k)
            out.at("bodies", b).at("contact").at("passes", k).word("", passes[k], known);
    }
}

void warn_of_idle_kinematic(const Scene& scene, const Checker& out)
{
    const std::string why = scene.contact.between
                                ? "it passes through all other bodies (contact.group)"
                                : "the scene has no \"contact\"; write \"contact\": {}, and "
                                  "bodies meet each other";
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (scene.bodies[b].kinematic.used && !meets_another(scene, scene.bodies[b]) &&
            (scene.bodies.size() > 1 || !scene.contact.between))
            out.at("bodies", b).warning("kinematic", "meets nothing: " + why);
}

void warn_of_idle_contact(const Scene& scene, const Checker& out)
{
    const auto meets = [&](const Body& body) { // of kinematic bodies the warning above speaks
        return body.contact.self || body.kinematic.used || meets_another(scene, body);
    };
    if (!scene.contact.between || scene.bodies.empty() ||
        std::any_of(scene.bodies.begin(), scene.bodies.end(), meets))
        return;
    const std::string why = scene.bodies.size() == 1
                                ? "bodies meet each other, there is one, and it does not meet itself; "
                                  "\"contact\": {\"self\": true} in the body lets it"
                                : "all bodies pass through each other (contact.group)";
    out.warning("contact", "does nothing: " + why);
}

} // namespace scene_file
} // namespace taut
