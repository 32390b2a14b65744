#pragma once
// Cubes that start far from rest (B09 to B15 of docs/hard-cases.md): what the methods that move neo-Hookean
// tetrahedra share.

#include "hard/cases.hpp"

namespace taut::hard {

/// A cube of a metre, free, in no gravity.
inline Scene cube(double modulus, double ratio = 0.3, const std::string& model = "neo_hookean")
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = ratio;
    scene.bodies = {body};
    return resolve(scene);
}

using Place = glm::dvec3 (*)(const glm::dvec3&, conformance::Random&);

inline glm::dvec3 hair(conformance::Random& random, double size)
{
    const double x = random.uniform(-size, size), y = random.uniform(-size, size);
    return {x, y, random.uniform(-size, size)};
}

struct Start
{
    const char* name;
    Place place;
};

inline constexpr Start kStarts[] = {
    {"rest", [](const glm::dvec3& x, conformance::Random&) { return x; }},
    {"B09 mirrored", [](const glm::dvec3& x, conformance::Random&) { return glm::dvec3(x.x, x.y, -x.z); }},
    {"B10 plane", [](const glm::dvec3& x, conformance::Random&) { return glm::dvec3(x.x, x.y, 0); }},
    {"B11 line + 1e-6",
     [](const glm::dvec3& x, conformance::Random& r) { return glm::dvec3(x.x, 0, 0) + hair(r, 1e-6); }},
    {"B12 point + 1e-6", [](const glm::dvec3&, conformance::Random& r) { return hair(r, 1e-6); }},
    {"B13 random", [](const glm::dvec3&, conformance::Random& r) { return hair(r, 0.5); }},
    {"B14 x10", [](const glm::dvec3& x, conformance::Random&) { return 10.0 * x; }},
    {"B14 x0.01", [](const glm::dvec3& x, conformance::Random&) { return 0.01 * x; }},
    {"B15 twist 360",
     [](const glm::dvec3& x, conformance::Random&) {
         const double a = 6.283185307179586 * (x.z + 0.5);
         return glm::dvec3(std::cos(a) * x.x - std::sin(a) * x.y, std::sin(a) * x.x + std::cos(a) * x.y, x.z);
     }},
};

/// Strain over all elements by their energy, whichever way the cube has turned, E = 1e5 Pa, 1 m^3.
inline double strain_of(const StepReport& report)
{
    return std::sqrt(2 * std::abs(report.potential_energy) / 1e5);
}

struct Outcome
{
    StepReport report;
    double highest = 1; ///< energy over that at the start
    double kinetic = 0; ///< highest kinetic energy over the energy at the start
    bool reads = true;  ///< all numbers
};

inline Outcome settle(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World world(scene, device);
    const double start = energy(world), floor = 1; // J: at rest there is nothing to compare with
    Outcome out;
    for (int i = 0; i < steps; ++i)
    {
        world.step();
        const StepReport r = measure(world);
        out.highest = std::max(out.highest, energy(r) / std::max(start, floor));
        out.kinetic = std::max(out.kinetic, r.kinetic_energy / std::max(start, floor));
    }
    out.report = measure(world);
    out.reads = finite(world.positions()) && finite(world.velocities());
    return out;
}

/// Where no direction is left; what moves from here does so by rounding.
inline constexpr Start kExactStarts[] = {
    {"B11 line", [](const glm::dvec3& x, conformance::Random&) { return glm::dvec3(x.x, 0, 0); }},
    {"B12 point", [](const glm::dvec3&, conformance::Random&) { return glm::dvec3(0); }},
};

/// The cube of E = 1e5 Pa where a start puts it.
inline Scene started(const Start& start, double ratio)
{
    Scene scene = cube(1e5, ratio);
    conformance::Random random(17);
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
        scene.bodies[0].start_positions.push_back(start.place(x, random));
    return scene;
}

inline bool named(const Start& start, const char* name) { return std::string(start.name) == name; }

} // namespace taut::hard
