#include "taut/plan/contact_scene.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/pose.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Times the rounding unit of float, of the largest coordinate: a thinner surface has no gap to speak of.
constexpr double kThinnest = 64 * 0x1p-24;

bool has_surface(const Body& body) { return !body.mesh.triangles.empty(); }

std::string at_body(std::size_t k) { return "bodies[" + std::to_string(k) + "]"; }

void check_guarantee(const Scene& scene)
{
    if (scene.contact.guarantee == "none")
        return;
    const std::string asked = "contact.guarantee is \"" + scene.contact.guarantee + "\"";
    if (!wants_contact(scene))
        throw Error(ErrorCode::bad_input,
                    asked + ", but no surfaces meet: set bodies[].contact.self, or contact.between and two "
                            "bodies with surfaces; or leave it out");
    for (std::size_t k = 0; k < scene.bodies.size(); ++k)
        if (scene.bodies[k].material.tear_strain > 0)
            throw Error(ErrorCode::unsupported,
                        asked + ", but " + at_body(k) + ".material.tear_strain is " +
                            shown(scene.bodies[k].material.tear_strain) +
                            ": cloth that comes apart begins in the same place twice; leave one of them out");
}

void check_radius(const Scene& scene, std::size_t k)
{
    const Body& body = scene.bodies[k];
    double far = 0;
    for (const glm::dvec3& x : start_of(body))
        far = std::max({far, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    const double radius = radius_of(scene, body), least = kThinnest * far;
    if (!(radius > 0))
        throw Error(ErrorCode::bad_input, at_body(k) + ".contact.thickness is " + shown(radius) +
                                              " m; surfaces that meet need a radius above 0");
    if (scene.method.precision == "float" && radius < least)
        throw Error(ErrorCode::bad_input,
                    at_body(k) + ".contact.thickness is " + shown(radius) + " m; " + shown(far, 3) +
                        " m from the origin float needs at least " + shown(least, 3) +
                        " m: take more, method.precision \"double\", or places nearer the origin");
}

} // namespace

double radius_of(const Scene& scene, const Body& body)
{
    if (body.contact.thickness >= 0)
        return body.contact.thickness;
    return scene.contact.thickness >= 0 ? scene.contact.thickness : body.material.thickness;
}

double friction_of(const Scene& scene, const Body& body)
{
    return body.contact.friction >= 0 ? body.contact.friction : scene.contact.friction;
}

bool bodies_meet(const Scene& scene)
{
    return scene.contact.between && std::count_if(scene.bodies.begin(), scene.bodies.end(), has_surface) > 1;
}

bool takes_part(const Scene& scene, const Body& body)
{
    return has_surface(body) && (body.contact.self || bodies_meet(scene));
}

bool surfaces_meet(const Scene& scene, std::size_t a, std::size_t b)
{
    if (a == b)
        return scene.bodies[a].contact.self;
    return bodies_meet(scene) && has_surface(scene.bodies[a]) && has_surface(scene.bodies[b]);
}

bool wants_contact(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return takes_part(scene, body); });
}

bool wants_guarantee(const Scene& scene)
{
    return scene.contact.guarantee == "no_crossing" && wants_contact(scene);
}

void check_contact(const Scene& scene)
{
    check_guarantee(scene);
    for (std::size_t k = 0; k < scene.bodies.size(); ++k)
        if (takes_part(scene, scene.bodies[k]))
            check_radius(scene, k);
}

} // namespace taut
