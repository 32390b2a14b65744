#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/report/load_residual.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace taut;

namespace {

/// As if a solver did nothing: the whole weight is left.
Leftover weight_left(const PhysicalModel& model)
{
    Leftover out;
    for (const double mass : model.mass)
    {
        out.force.push_back(-mass * model.gravity);
        out.load.push_back(mass * glm::length(model.gravity));
        out.touches.push_back(false);
    }
    return out;
}

} // namespace

TEST_CASE("a solver that does nothing leaves all of the loads, one that solves none", "[residuals]")
{
    const PhysicalModel model = make_model(test::hanging(8));
    Leftover left = weight_left(model);
    CHECK(load_residual(model, model.start, left) == Approx(1));
    left.rounding = 6e-8; // of 1,000 N/m: far less than the weight
    CHECK(load_residual(model, model.start, left) == Approx(1));
    for (glm::dvec3& r : left.force)
        r *= 0.25;
    CHECK(load_residual(model, model.start, left) == Approx(0.25));
    for (glm::dvec3& r : left.force)
        r = glm::dvec3(0);
    CHECK(load_residual(model, model.start, left) == 0);
}

TEST_CASE("a couple without a force is a residual, forces within a body are none", "[residuals]")
{
    Scene scene = test::hanging(8);
    scene.bodies[0].pins.clear();
    const PhysicalModel model = make_model(scene);
    Leftover left = weight_left(model);
    glm::dvec3 centre(0);
    double mass = 0, arms = 0;
    for (std::size_t i = 0; i < model.mass.size(); ++i)
        centre += model.mass[i] * model.start[i], mass += model.mass[i];
    centre /= mass;
    for (std::size_t i = 0; i < model.mass.size(); ++i)
    {
        left.force[i] = glm::dvec3(0);
        arms += left.load[i] * glm::distance(model.start[i], centre);
    }
    const glm::dvec3 across = model.start[1] - model.start[0], out = {0, 0, 3};
    left.force[0] = out, left.force[1] = -out;
    CHECK(load_residual(model, model.start, left) ==
          Approx(glm::length(glm::cross(across, out)) / arms));
    left.force[0] = 1e6 * across, left.force[1] = -1e6 * across; // as a spring pulls at both ends
    CHECK(load_residual(model, model.start, left) < 1e-6);
}

TEST_CASE("roundings at held vertices are no residual, and bodies at colliders are not judged", "[residuals]")
{
    Scene scene = test::hanging(8);
    scene.bodies[0].material.stretch_stiffness = 1e9;
    const PhysicalModel model = make_model(scene);
    Leftover left = weight_left(model);
    left.rounding = 6e-8;
    CHECK(load_residual(model, model.start, left) == 0); // 60 N a spring against a weight of a few
    for (glm::dvec3& r : left.force)
        r *= 1e6;
    CHECK(load_residual(model, model.start, left) == Approx(1e6));
    left.touches[40] = true;
    CHECK(load_residual(model, model.start, left) == -1);
}

TEST_CASE("methods that sweep take the substeps that mesh and weight ask for, others ten", "[residuals]")
{
    Scene scene = test::hanging(32);
    const auto substeps = [&](const char* method) {
        scene.method.type = method;
        scene.method.substeps = 0;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t sweeps = substeps("xpbd");
    CHECK(sweeps > 40);
    CHECK(substeps("vbd") == sweeps);
    CHECK(substeps("pbd") == sweeps);
    CHECK(substeps("implicit_euler") == 10);
    CHECK(substeps("mass_spring") == 10);
    scene.method.iterations = 4;
    CHECK(substeps("vbd") <= sweeps / 2 + 1);
}
