#include "taut/plan/methods.hpp"

#include "taut/plan/acad.hpp"
#include "taut/plan/implicit_constraints.hpp"
#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/solid.hpp"
#include "taut/plan/stability.hpp"
#include "taut/plan/surface.hpp"
#include "taut/plan/vbd.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"

#include <vector>

namespace taut {
namespace {

constexpr Method kMethods[] = {
    {.kind = MethodKind::mass_spring,
     .check = check_mass_spring,
     .surface_volume = true,
     .substeps = stable_substeps},
    {.kind = MethodKind::implicit_euler,
     .keeps_guess = true,
     .check = check_implicit_euler,
     .volumes = true,
     .elastic = true},
    {.kind = MethodKind::implicit_constraints,
     .check = check_implicit_constraints,
     .volumes = true,
     .substeps = stable_substeps},
    {.kind = MethodKind::acad, .check = check_acad, .substeps = stable_substeps},
    {.kind = MethodKind::pbd, .contact_each_iteration = true, .check = check_pbd, .volumes = true},
    {.kind = MethodKind::xpbd,
     .contact_each_iteration = true,
     .volumes = true,
     .elastic = true},
    {.kind = MethodKind::vbd, .keeps_guess = true, .check = check_vbd, .volumes = true, .elastic = true},
};

} // namespace

const Method& find_method(MethodKind kind)
{
    for (const Method& method : kMethods)
        if (method.kind == kind)
            return method;
    throw Error(ErrorCode::unsupported, "method.type is value " +
                                            std::to_string(static_cast<unsigned>(kind)) + "; it must be " +
                                            scene_file::listing(words_of<MethodKind>()));
}

std::string methods_with(bool Method::*can)
{
    std::vector<std::string_view> names;
    for (const Method& method : kMethods)
        if (method.*can)
            names.push_back(to_string(method.kind));
    return scene_file::listing(names);
}

void check_solids(const Scene& scene, Refusals& out)
{
    const Method& method = find_method(scene.method.type);
    const std::string name = quoted(method.kind);
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        const std::string where = "bodies[" + std::to_string(k) + "].material.";
        if (is_elastic(body) && !method.elastic)
            throw Error(ErrorCode::unsupported,
                        where + "model is " + quoted(body.material.model) + ", which method " + name +
                            " does not have; take model \"springs\", or a method of " +
                            methods_with(&Method::elastic));
        if (holds_volumes(body) && !method.volumes)
            throw Error(ErrorCode::unsupported,
                        where + "volume_stiffness is not 0, but method " + name +
                            " does not hold the volume of tetrahedra; set it to 0, or take a method of " +
                            methods_with(&Method::volumes));
        if (!holds_surface_volume(body))
            return;
        const std::string what =
            body.mesh.tetrahedra.empty() ? "volume_stiffness is not 0" : "volume is \"surface\"";
        if (!method.surface_volume)
            throw Error(ErrorCode::unsupported,
                        where + what + ", but method " + name +
                            " does not hold the volume within a surface; set volume_stiffness to 0, or "
                            "take a method of " +
                            methods_with(&Method::surface_volume));
        check_surface(body, where + what);
    });
}

} // namespace taut
