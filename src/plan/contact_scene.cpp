#include "taut/plan/contact_scene.hpp"

#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut {
namespace {

/// Times the rounding unit of float, of the largest coordinate: a thinner surface has no gap to speak of.
constexpr double kThinnest = 64 * 0x1p-24;

bool has_surface(const Body& body) { return !body.mesh.triangles.empty(); }

/// Two different ones.
bool bodies_meet(const Scene& scene, const Body& a, const Body& b)
{
    return scene.contact.between && has_surface(a) && has_surface(b) && !pass_through(a.contact, b.contact);
}

bool meets_another(const Scene& scene, const Body& body)
{
    return body.contact.meets_absent ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& other) { return &other != &body && bodies_meet(scene, body, other); });
}

std::string at_body(std::size_t k) { return "bodies[" + std::to_string(k) + "]"; }

void check_guarantee(const Scene& scene)
{
    if (scene.contact.guarantee == Guarantee::none)
        return;
    const std::string asked = "contact.guarantee is " + quoted(scene.contact.guarantee);
    if (!wants_contact(scene))
        throw Error(ErrorCode::bad_input,
                    asked + ", but no surfaces meet: set bodies[].contact.self, or contact.between and two "
                            "bodies with surfaces that do not pass through each other; or leave it out");
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
    if (scene.method.precision == Precision::float32 && radius < least)
        throw Error(ErrorCode::bad_input,
                    at_body(k) + ".contact.thickness is " + shown(radius) + " m; " + shown(far, 3) +
                        " m from the origin float needs at least " + shown(least, 3) +
                        " m: take more, method.precision \"double\", or places nearer the origin");
}

} // namespace

double radius_of(const Scene& scene, const Body& body)
{
    return body.contact.thickness.value_or(scene.contact.thickness.value_or(body.material.thickness));
}

double friction_of(const Scene& scene, const Body& body)
{
    return body.contact.friction.value_or(scene.contact.friction);
}

std::uint32_t friction_mix_of(const Scene& scene)
{
    static_assert(static_cast<unsigned>(FrictionMix::geometric_mean) == TAUT_CONTACT_MIX_GEOMETRIC_MEAN);
    return static_cast<std::uint32_t>(scene.contact.friction_mix);
}

GroupBits group_bits(const Scene& scene, const Body& body)
{
    const std::vector<std::string> names = contact_groups(scene);
    const auto bit_of = [&](const std::string& name) {
        return 1u << (std::find(names.begin(), names.end(), name) - names.begin());
    };
    GroupBits out{bit_of(body.contact.group), scene.contact.between ? ~0u : 0u};
    for (const std::string& name : body.contact.passes)
        out.meets &= ~bit_of(name);
    return out;
}

bool takes_part(const Scene& scene, const Body& body)
{
    return has_surface(body) && (body.contact.self || meets_another(scene, body));
}

bool surfaces_meet(const Scene& scene, std::size_t a, std::size_t b)
{
    if (a == b)
        return scene.bodies[a].contact.self;
    return bodies_meet(scene, scene.bodies[a], scene.bodies[b]);
}

std::vector<std::size_t> meeting_parts(const Scene& scene)
{
    std::vector<std::size_t> part(scene.bodies.size());
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t a = 0; a < part.size(); ++a)
        for (std::size_t b = a + 1; b < part.size(); ++b)
            if (part[a] != part[b] && surfaces_meet(scene, a, b))
                std::replace(part.begin(), part.end(), part[b], part[a]);
    return part;
}

std::uint32_t touching_height(const Scene& scene, std::size_t b)
{
    const Body& body = scene.bodies[b];
    std::vector<bool> held(body.mesh.positions.size(), body.kinematic.used);
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            held[v] = true;
    const bool moves = std::find(held.begin(), held.end(), false) != held.end();
    return moves ? static_cast<std::uint32_t>(b) + 1 : 0;
}

glm::dvec3 upwards(const Scene& scene)
{
    const double size = glm::length(scene.gravity);
    return size > 0 ? -scene.gravity / size : glm::dvec3(0, 1, 0);
}

bool wants_contact(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return takes_part(scene, body); });
}

bool wants_guarantee(const Scene& scene)
{
    return scene.contact.guarantee == Guarantee::no_crossing && wants_contact(scene);
}

void check_contact(const Scene& scene, Refusals& out)
{
    out.attempt([&] { check_guarantee(scene); });
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        if (takes_part(scene, body))
            check_radius(scene, k);
    });
}

} // namespace taut
