// The longest stable step against what the integrators really do, and what a plan makes of it.

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "taut/plan/plan.hpp"
#include "taut/plan/stability.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace taut;

namespace {

/// Two particles, the first held: stiffness and damper of the spring between them by compliance and the
/// material's stretch_damping.
Scene oscillator(double stiffness, double damping, double mass = 1)
{
    Scene scene;
    scene.method.type = MethodKind::mass_spring;
    scene.gravity = {0, 0, 0};
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    body.material.stretch_stiffness = 0;
    body.material.stretch_damping = damping;
    body.vertex_masses = {mass, mass};
    body.springs = {{0, 1, 1, 1 / stiffness}};
    Pin pin;
    pin.vertices = {0};
    body.pins = {pin};
    scene.bodies = {body};
    return scene;
}

/// Largest |x| over many steps of x'' = -k x - c x' from x = 1 at rest, by the scheme.
double largest(double k, double c, double h, bool verlet)
{
    double x = 1, v = 0, worst = 0;
    for (int i = 0; i < 4000 && worst < 1e12; ++i)
    {
        const double kick = verlet ? h / 2 : h;
        v += kick * (-k * x - c * v);
        x += h * v;
        if (verlet)
            v += kick * (-k * x - c * v);
        worst = std::max(worst, std::abs(x));
    }
    return worst;
}

std::string refusal(const Scene& scene, std::string* text = nullptr)
{
    try
    {
        stable_substeps(scene);
    }
    catch (const Error& error)
    {
        if (text)
            *text = error.what();
        return std::string(to_string(error.code()));
    }
    return "none";
}

} // namespace

TEST_CASE("the bound of a spring between a free and a held vertex is twice its stiffness over the mass")
{
    const RateBounds rates = rate_bounds(oscillator(1000, 0.01, 2));
    CHECK(rates.stiffness == Approx(1000));
    CHECK(rates.damping == Approx(10));
    CHECK(stable_step({1000, 0}) == Approx(2 / std::sqrt(1000.0)));
    CHECK(std::isinf(stable_step({0, 0})));
    CHECK(stable_step({std::numeric_limits<double>::infinity(), 0}) == 0);
}

TEST_CASE("inside the stable step both schemes stay bounded, outside semi-implicit Euler does not")
{
    conformance::Random random(7);
    for (int draw = 0; draw < 200; ++draw)
    {
        const double k = std::pow(10.0, random.uniform(-2, 6));
        const double c = draw % 4 == 0 ? 0 : std::sqrt(k) * std::pow(10.0, random.uniform(-3, 2));
        const double h = stable_step({k, c});
        CAPTURE(draw, k, c, h);
        CHECK(largest(k, c, 0.99 * h, false) < 50);
        CHECK(largest(k, c, 0.99 * h, true) < 50);
        CHECK(largest(k, c, 1.01 * h, false) > 1e3);
    }
}

TEST_CASE("a step that is too long is refused with the numbers, or cut as often as it takes")
{
    Scene scene = oscillator(1000, 0);
    scene.timestep = 1.0 / 60;
    scene.method.substeps = 1;
    CHECK(stable_substeps(scene).count == 1);
    CHECK(stable_substeps(scene).largest == Approx(0.9 * 2 / std::sqrt(2000.0)));
    scene.timestep = 0.5;
    std::string text;
    CHECK(refusal(scene, &text) == "unstable_timestep");
    CHECK(text.find("0.5 s") != std::string::npos);
    CHECK(text.find("0.04025 s") != std::string::npos);
    CHECK(text.find("13 substeps") != std::string::npos);
    scene.method.substeps = 12;
    CHECK(refusal(scene) == "unstable_timestep");
    scene.method.substeps = 13;
    CHECK(refusal(scene) == "none");
    scene.method.substeps = 2;
    scene.method.stability = StabilityRule::substep;
    CHECK(stable_substeps(scene).count == 13);
    scene.method.stability = StabilityRule::ignore;
    CHECK(stable_substeps(scene).count == 2);
    CHECK(stable_substeps(scene).largest == 0);
}

TEST_CASE("damping shortens the stable step; more than 1000 substeps and rigid springs are refused")
{
    Scene scene = oscillator(1000, 0.1);
    CHECK(stable_substeps([&] {
              Scene s = scene;
              s.timestep = 1e-3;
              return s;
          }())
              .largest < 0.9 * 2 / std::sqrt(2000.0));
    scene = oscillator(1e12, 0);
    scene.method.stability = StabilityRule::substep;
    std::string text;
    CHECK(refusal(scene, &text) == "unstable_timestep");
    CHECK(text.find("1000") != std::string::npos);
}

TEST_CASE("hinges count by their gradients: the bound covers a vertex that swings across its edge")
{
    // Two right triangles of side 1: the wing's gradient is 1 / height, the edge's ends take the sums.
    Scene scene;
    Body body;
    body.shape.cells = {1, 1};
    body.material.stretch_stiffness = 0;
    body.material.bending_stiffness = 0.5;
    scene.bodies = {body};
    scene = resolve(scene);
    const Body& own = scene.bodies[0];
    const auto hinges = bend_elements(own);
    REQUIRE(hinges.size() == 1);
    const double height = std::sqrt(0.5), wing = 1 / height;
    // By symmetry each end of the edge has the two wings' halves: 2 * wing / 2.
    const double sum = 4 * wing, stiffest = wing * sum / hinges[0].compliance;
    const auto mass = vertex_masses(own);
    const double lightest = std::min({mass[hinges[0].edge0], mass[hinges[0].wing0]});
    CHECK(rate_bounds(scene).stiffness == Approx(stiffest / lightest));
}
