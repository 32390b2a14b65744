// What takes more than one key of a scene, without reading any file.

#include "taut/scene/check_table.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/tables.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace taut {
namespace scene_file {
namespace {

constexpr double kMinSubstep = 1e-15;
constexpr double kMaxSteps = 1e9;
constexpr double kShortTimestep = 1e-6; ///< s: a shorter one is the mistake, where there are too many steps

void check_times(const Scene& scene, const Checker& out)
{
    if (!kSceneTable.find("timestep")->limits.contains(scene.timestep))
        return;
    if (const std::uint32_t n = std::max(scene.method.substeps, 1u); scene.timestep / n < kMinSubstep)
        out.error("timestep",
                  "is " + shown(scene.timestep) + " s" +
                      (n > 1 ? " in " + std::to_string(n) + " substeps; a substep"
                             : "; a substep, and so a time step,") +
                      " must be at least 1e-15 s",
                  ErrorCode::bad_timestep);
    if (scene.duration <= kMaxValue && scene.duration / scene.timestep > kMaxSteps)
        out.error(scene.timestep < kShortTimestep ? "timestep" : "duration",
                  "makes " + shown(scene.duration / scene.timestep, 6) + " time steps: a duration of " +
                      shown(scene.duration) + " s in steps of " + shown(scene.timestep) +
                      " s; at most 1e9 are run");
}

/// Names stand in reports; two of one name could not be told apart there.
template <class Named>
void check_names(const std::vector<Named>& things, std::string_view list, const Checker& out)
{
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < things.size(); ++i)
    {
        const auto [other, is_new] = first.emplace(things[i].name, i);
        if (!is_new && !things[i].name.empty())
            out.at(list, i).warning("name", "is \"" + things[i].name.substr(0, 60) + "\" like that of " +
                                                std::string(list) + '[' + std::to_string(other->second) +
                                                "]; reports cannot tell them apart");
    }
}

void warn_of_idle_wind(const Scene& scene, const Checker& out)
{
    const bool blows =
        scene.wind.density > 0 && (scene.wind.velocity != glm::dvec3(0) || !scene.wind.keys.empty());
    const bool moves = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return b.material.drag > 0 || b.material.friction_drag > 0;
    });
    if (blows && !moves)
        out.warning("wind", "moves nothing: no material has \"drag\" or \"friction_drag\"");
    if (scene.wind.density > 0)
        return;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (const Material& m = scene.bodies[b].material; m.drag > 0 || m.friction_drag > 0)
            out.at("bodies", b).at("material").warning(
                m.drag > 0 ? "drag" : "friction_drag",
                "does nothing without air: give the scene \"wind\", or \"wind\": {} for air that stands "
                "still");
}

void warn_of_odd_gravity(const Scene& scene, const Checker& out)
{
    constexpr double kMost = 300; // m/s^2; 981 is the Earth's in cm/s^2
    if (const double g = glm::length(scene.gravity); g > kMost && g < 1e6)
        out.warning("gravity", "is " + shown(g, 4) +
                                   " m/s^2, the Earth's is 9.81; are lengths of the scene in m?");
}

/// What a method or a limit keeps shorter does not come to the strain at which it tears.
void warn_of_whole_cloth(const Scene& scene, const Checker& out)
{
    const MethodSettings& method = scene.method;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
        const Material& m = scene.bodies[b].material;
        std::string why;
        if (!(m.tear_strain > 0))
            continue;
        if (m.strain_limit > 0 && m.strain_limit <= m.tear_strain)
            why = "strain_limit " + shown(m.strain_limit) + " keeps springs below it";
        else if (method.type == MethodKind::acad && method.activate_strain <= m.tear_strain)
            why = "method acad holds springs at activate_strain " + shown(method.activate_strain) +
                  "; give it more, or take another method";
        else if (method.type == MethodKind::pbd)
            why = "method pbd keeps springs as short as its iterations can, whatever pulls; another method "
                  "tears them by their load";
        if (!why.empty())
            out.at("bodies", b)
                .at("material")
                .warning("tear_strain",
                         "is " + shown(m.tear_strain) + ", which cloth may never come to: " + why);
    }
}

} // namespace

void check_scene(const Scene& scene, const Checker& out)
{
    if (scene.version != 1)
        out.error("taut", "is " + std::to_string(scene.version) + "; this library reads version 1");
    check_times(scene, out);
    if (scene.bodies.empty())
        out.warning("bodies", "has none; there is nothing to simulate");
    warn_of_odd_gravity(scene, out);
    warn_of_idle_wind(scene, out);
    warn_of_whole_cloth(scene, out);
    check_groups(scene, out);
    warn_of_idle_kinematic(scene, out);
    warn_of_idle_contact(scene, out);
    if (out.scope() == Scope::meshes)
        return;
    check_names(scene.bodies, "bodies", out);
    check_names(scene.colliders, "colliders", out);
}

} // namespace scene_file

namespace {

std::vector<SceneIssue> check_as(const Scene& scene, scene_file::Scope scope)
{
    std::vector<SceneIssue> issues;
    scene_file::check_table(scene_file::kSceneTable, &scene, scene_file::Checker(issues, scope));
    return issues;
}

} // namespace

std::vector<SceneIssue> check_resolved(const Scene& scene)
{
    return check_as(scene, scene_file::Scope::meshes);
}

std::vector<SceneIssue> check(const Scene& scene) { return check_as(scene, scene_file::Scope::scene); }

std::vector<SceneIssue> scene_file::check_keys(const Scene& scene) { return check_as(scene, Scope::keys); }

} // namespace taut
