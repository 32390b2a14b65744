#pragma once
// Short scenes of sheets that are thrown at each other, by a seed: what a guarantee against crossings is held
// to.

#include "support/random.hpp"

#include "taut/judge/crossings.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut::test {

/// How the sheets of one seed are thrown.
struct Throw
{
    std::uint32_t substeps = 1;
    double scale = 1;    ///< of all lengths, speeds and gravity
    double origin = 0;   ///< m, how far off the scene lies
    double speed = 5;    ///< m/s at most, before scaling
    bool pinned = false; ///< some sheets hang, and some pins move
};

inline glm::dvec3 random_unit(conformance::Random& random)
{
    return glm::normalize(glm::dvec3(random.vec4<double>(1, 0)) + glm::dvec3(1e-9));
}

/// A sheet of up to 4 x 4 cells of some 3 cm that turns anyhow and flies towards the middle.
inline Body thrown_sheet(conformance::Random& random, const Throw& how)
{
    Body body;
    body.shape.cells = {1 + random.below(4), 1 + random.below(4)};
    body.shape.size = 0.03 * how.scale * glm::dvec2(body.shape.cells) * random.uniform(0.6, 1.4);
    body.material.stretch_stiffness = std::pow(10.0, random.uniform(1, 4));
    body.material.bending_stiffness = random.chance(0.5) ? 0 : 1e-5;
    body.material.thickness = how.scale * random.uniform(0.0005, 0.003);
    body.contact.self = random.chance(0.8);
    const glm::dvec3 from = 0.06 * how.scale * random.uniform(0.2, 1.2) * random_unit(random);
    body.transform.rotate_axis = random_unit(random);
    body.transform.rotate_degrees = random.uniform(0, 360);
    body.transform.translate = from + glm::dvec3(how.origin, -0.6 * how.origin, 0.3 * how.origin);
    body.velocity = -glm::normalize(from + 1e-3 * how.scale * random_unit(random)) * how.scale *
                    random.uniform(0, how.speed);
    if (how.pinned && random.chance(0.5))
    {
        Pin pin;
        pin.corners = {"top_left"};
        if (random.chance(0.5))
            pin.motion = {{0, glm::dvec3(0)}, {0.3, 0.1 * how.scale * random_unit(random)}};
        body.pins = {pin};
    }
    return body;
}

/// Sheets that do not cross where they start. Resolved.
inline Scene thrown_sheets(std::uint64_t seed, const Throw& how)
{
    conformance::Random random(seed);
    Scene scene;
    scene.gravity = how.scale * glm::dvec3(0, -9.81, 0);
    scene.contact.between = true;
    scene.contact.friction = random.chance(0.5) ? 0 : 0.5;
    scene.contact.searches = how.substeps;
    scene.depenetration_speed = 0.5 * how.scale;
    scene.method.substeps = how.substeps;
    scene.method.iterations = 1 + random.below(3);
    const std::uint32_t sheets = 2 + random.below(4);
    for (std::uint32_t tries = 0; scene.bodies.size() < sheets && tries < 50; ++tries)
    {
        scene.bodies.push_back(thrown_sheet(random, how));
        const Scene tried = resolve(scene);
        std::vector<glm::dvec3> x;
        for (const Body& body : tried.bodies)
            x.insert(x.end(), body.mesh.positions.begin(), body.mesh.positions.end());
        const judging::SceneTriangles all = judging::scene_triangles(tried);
        if (!judging::intersecting_triangles(judging::make_surface(x.size(), all.triangles), x).empty())
            scene.bodies.pop_back();
    }
    return resolve(scene);
}

} // namespace taut::test
