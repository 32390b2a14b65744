#include "support/catch.hpp"

#include "taut/plan/plan.hpp"
#include "taut/plan/solid.hpp"
#include "taut/runtime/base/error.hpp"

#include <cmath>

using namespace taut;

namespace {

/// One tetrahedron with unit legs.
Body corner(const std::string& model, double modulus, double ratio)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = ratio;
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    body.mesh.tetrahedra = {{0, 1, 2, 3}};
    body.mesh.triangles = surface_of(body.mesh.tetrahedra);
    return body;
}

/// Nominal stress P of F = diag(l, s, s), from the forces on the corners: f_k = -V P e_k.
glm::dvec2 stress(const SolidElement& e, double l, double s)
{
    const std::vector<glm::dvec3> x = {{0, 0, 0}, {l, 0, 0}, {0, s, 0}, {0, 0, s}};
    const auto f = solid_forces(e, x);
    return {-6 * f[1].x, -6 * f[2].y};
}

} // namespace

TEST_CASE("the simple model pulls and thins as the golden uniaxial curves say")
{
    struct Point
    {
        double ratio, stretch, side, stress;
    };
    const Point points[] = {
        {0.3, 0.7, 1.087967586552, -3.811392689e4}, {0.3, 0.9, 1.030402055055, -1.075762372e4},
        {0.3, 1.1, 0.970643477457, 9.365427960e3},  {0.3, 1.5, 0.869226987360, 3.831908832e4},
        {0.3, 2, 0.774596669241, 6.538461538e4},    {0.45, 2, 0.724568837309, 5.991379310e4},
        {0.49, 2, 0.710633520178, 5.864093960e4}};
    for (const Point& p : points)
    {
        CAPTURE(p.ratio, p.stretch);
        const SolidElement e = solid_elements(corner("neo_hookean_simple", 1e5, p.ratio))[0];
        const glm::dvec2 at = stress(e, p.stretch, p.side);
        CHECK(at.x == Approx(p.stress).epsilon(1e-9));
        CHECK(std::abs(at.y) < 1e-6 * 1e5);
    }
}

TEST_CASE("small strains have the Young's modulus and Poisson's ratio of the material")
{
    for (const std::string model : {"neo_hookean", "neo_hookean_simple"})
        for (const double ratio : {-0.3, 0.0, 0.3, 0.45})
        {
            CAPTURE(model, ratio);
            const SolidElement e = solid_elements(corner(model, 1e5, ratio))[0];
            const double strain = 1e-6;
            const glm::dvec2 at = stress(e, 1 + strain, 1 - ratio * strain);
            CHECK(at.x == Approx(1e5 * strain).epsilon(1e-4));
            CHECK(std::abs(at.y) < 1e-4 * 1e5 * strain);
            CHECK(std::abs(stress(e, 1, 1).x) < 1e-9);
        }
}

TEST_CASE("forces of tetrahedra are the negative gradient of their energy, inverted ones too")
{
    const std::vector<glm::dvec3> x = {{0.1, -0.2, 0}, {0.9, 0.3, -0.1}, {0.2, 1.4, 0.3}, {0.3, 0.2, -0.7}};
    for (const std::string model : {"neo_hookean", "neo_hookean_simple"})
    {
        const SolidElement e = solid_elements(corner(model, 1e3, 0.3))[0];
        const auto force = solid_forces(e, x);
        for (std::size_t k = 0; k < 4; ++k)
            for (int axis = 0; axis < 3; ++axis)
            {
                std::vector<glm::dvec3> more = x, less = x;
                more[k][axis] += 1e-5;
                less[k][axis] -= 1e-5;
                const double slope = (solid_energy(e, more) - solid_energy(e, less)) / 2e-5;
                CHECK(force[k][axis] == Approx(-slope).epsilon(1e-6).margin(1e-5));
            }
    }
    Body springs = corner("springs", 1e3, 0.3);
    const VolumeElement v = volume_elements(springs)[0];
    CHECK(v.rest_volume == Approx(1.0 / 6));
    CHECK(v.compliance == Approx(1.0 / 6 / (1e3 / (3 * 0.4))));
    const auto gradient = volume_gradient(v.vertex, x);
    for (std::size_t k = 0; k < 4; ++k)
        for (int axis = 0; axis < 3; ++axis)
        {
            std::vector<glm::dvec3> more = x, less = x;
            more[k][axis] += 1e-5;
            less[k][axis] -= 1e-5;
            CHECK(gradient[k][axis] == Approx((volume_of(v.vertex, more) - volume_of(v.vertex, less)) / 2e-5)
                                           .epsilon(1e-6)
                                           .margin(1e-9));
        }
}

TEST_CASE("a material that the method does not have is refused, with the methods that have it")
{
    Scene scene;
    scene.bodies = {corner("neo_hookean", 1e5, 0.3)};
    scene.method.type = MethodKind::mass_spring;
    CHECK_THROWS_WITH(make_plan(scene), Contains("bodies[0].material.model is \"neo_hookean\"") &&
                                            Contains("\"xpbd\""));
    scene.method.type = MethodKind::xpbd;
    const Plan plan = make_plan(scene);
    REQUIRE(plan.constraints.size() == 1);
    CHECK(plan.constraints[0].kind == "neo_hookean");
    scene.bodies[0].material.model = SolidModel::springs;
    CHECK(make_plan(scene).constraints.size() == 2); // distance and volume
    scene.bodies[0].material.volume_stiffness = 0;
    CHECK(make_plan(scene).constraints.size() == 1);
}

TEST_CASE("tetrahedra that are left-handed or flat are refused by number")
{
    Scene scene;
    scene.bodies = {corner("neo_hookean", 1e5, 0.3)};
    std::swap(scene.bodies[0].mesh.tetrahedra[0][0], scene.bodies[0].mesh.tetrahedra[0][1]);
    CHECK_THROWS_WITH(make_plan(scene),
                      Contains("bodies[0].box has 1 of 1 tetrahedra") && Contains("left-handed"));
}
