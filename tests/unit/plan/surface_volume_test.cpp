#include "support/catch.hpp"
#include "support/sphere.hpp"

#include "taut/plan/plan.hpp"
#include "taut/plan/surface.hpp"
#include "taut/plan/surface_volume.hpp"
#include "taut/runtime/base/error.hpp"

#include <cmath>
#include <limits>

using namespace taut;

namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

Scene ball(double volume_stiffness = kRigid) { return test::ball_of_springs(3, 0.5, 100, volume_stiffness); }

const EffectCost* effect_of(const Plan& plan)
{
    for (const EffectCost& cost : plan.effects)
        if (cost.name == "surface_volume")
            return &cost;
    return nullptr;
}

} // namespace

TEST_CASE("the gradient of an enclosed volume is that of finite differences, wherever the surface lies")
{
    const Mesh mesh = test::sphere_mesh(3, 0.5);
    std::vector<glm::dvec3> x = mesh.positions;
    for (std::size_t v = 0; v < x.size(); ++v)
        x[v] += glm::dvec3(3, -2, 1) + 0.1 * glm::dvec3(std::sin(double(v)), std::cos(3.0 * double(v)), 0);
    std::vector<glm::dvec3> gradient(x.size(), glm::dvec3(0));
    add_volume_gradient(mesh.triangles, x, 1, gradient);
    glm::dvec3 sum(0);
    double moment = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        sum += gradient[v];
        moment += glm::dot(gradient[v], x[v]);
        for (int axis = 0; axis < 3; ++axis)
        {
            std::vector<glm::dvec3> more = x, less = x;
            more[v][axis] += 1e-4;
            less[v][axis] -= 1e-4;
            const double slope =
                (enclosed_volume(mesh.triangles, more) - enclosed_volume(mesh.triangles, less)) / 2e-4;
            CHECK(std::abs(gradient[v][axis] - slope) < 1e-9); // V is linear in each coordinate
        }
    }
    CHECK(glm::length(sum) < 1e-14);
    CHECK(moment == Approx(3 * enclosed_volume(mesh.triangles, x)).epsilon(1e-12));
}

TEST_CASE("a fine sphere encloses nearly what a sphere does")
{
    const Mesh mesh = test::sphere_mesh(64, 2);
    const double exact = 4.0 / 3 * 3.14159265358979 * 8;
    CHECK(enclosed_volume(mesh.triangles, mesh.positions) == Approx(exact).epsilon(2e-3));
}

TEST_CASE("surface_volume is in the plan where a body asks for it, and costs nothing elsewhere")
{
    const Plan held = make_plan(ball());
    const Plan free = make_plan(ball(0));
    REQUIRE(effect_of(held) != nullptr);
    CHECK(effect_of(free) == nullptr);
    CHECK(effect_of(held)->dispatches_per_step == 2);
    CHECK(held.passes.size() == free.passes.size() + 2);
    CHECK(held.buffers.size() == free.buffers.size() + 5);
    CHECK(held.bytes_allocated() == free.bytes_allocated() + effect_of(held)->bytes_allocated);
    Scene again = ball(1e4);
    again.method.iterations = 3;
    CHECK(effect_of(make_plan(again))->dispatches_per_step == 6);
    CHECK(make_plan(again).buffers.size() == free.buffers.size() + 6); // and what it pulled with
}

TEST_CASE("a surface that is open, turned inside out in part, or flat is refused by name (F15)")
{
    Scene open = ball();
    open.bodies[0].mesh.triangles.pop_back();
    CHECK_THROWS_WITH(make_plan(open), Contains("bodies[0].material.volume_stiffness") && Contains("open"));
    Scene turned = ball();
    std::swap(turned.bodies[0].mesh.triangles[5][0], turned.bodies[0].mesh.triangles[5][1]);
    CHECK_THROWS_WITH(make_plan(turned), Contains("bodies[0].") && Contains("different sides"));
    Scene flat = ball();
    flat.bodies[0].springs.clear();
    for (glm::dvec3& x : flat.bodies[0].mesh.positions)
        x.y = 0;
    CHECK_THROWS_WITH(make_plan(flat), Contains("encloses no volume"));
    Scene sheet = ball();
    sheet.bodies.push_back({});
    sheet.bodies[1].material.volume_stiffness = 1;
    sheet.bodies[1].mesh = make_grid(2, 2, 1, 1, true);
    CHECK_THROWS_WITH(make_plan(sheet), Contains("bodies[1].material.volume_stiffness") && Contains("open"));
    // All of it looking inwards is a surface as good as any.
    Scene inwards = ball();
    for (auto& t : inwards.bodies[0].mesh.triangles)
        std::swap(t[1], t[2]);
    CHECK(effect_of(make_plan(inwards)) != nullptr);
}

TEST_CASE("methods that do not hold volumes of surfaces say which do")
{
    for (const std::string method : {"implicit_euler", "implicit_constraints", "acad", "pbd", "xpbd", "vbd"})
    {
        Scene scene = ball();
        scene.method.type = option_named<MethodKind>(method);
        CHECK_THROWS_WITH(make_plan(scene), Contains("bodies[0].material.volume_stiffness is not 0") &&
                                                Contains("\"" + method + "\"") &&
                                                Contains("\"mass_spring\""));
    }
    Scene solid;
    solid.bodies.resize(1);
    solid.bodies[0].shape.kind = ShapeKind::ball;
    solid.bodies[0].material = solid_material();
    solid.bodies[0].material.model = SolidModel::springs;
    solid.bodies[0].material.volume = HeldVolume::surface;
    solid.method.type = MethodKind::xpbd;
    CHECK_THROWS_WITH(make_plan(resolve(solid)), Contains("bodies[0].material.volume is \"surface\""));
    solid.method.type = MethodKind::mass_spring;
    solid.method.stability = StabilityRule::substep;
    CHECK(effect_of(make_plan(resolve(solid))) != nullptr);
}

TEST_CASE("no surface is cut into more than a thousand groups")
{
    CHECK(surface_chunk(1) == 256);
    CHECK(surface_chunk(262144) == 256);
    CHECK(surface_chunk(10000000) % 128 == 0);
    CHECK(10000000 / surface_chunk(10000000) < 1024);
}
