// A body that hangs in the air because the solver carries its weight nowhere is not completed, however small
// what is left is beside the forces of its springs.

#include "hard/cases.hpp"

#include "taut/report/residuals.hpp"

namespace taut::hard {
namespace {

/// Cloth held by two corners, let go from the horizontal: its lower edge falls by its length and swings.
Scene falling(const std::string& method, std::uint32_t substeps, std::uint32_t iterations, double stiffness)
{
    Scene scene = test::hanging(16);
    Body& body = scene.bodies[0];
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.material.stretch_stiffness = stiffness;
    body.material.bending_stiffness = 1e-5;
    scene.damping = 0.5;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return resolve(scene);
}

struct End
{
    StepReport report;
    double lowest = 0; ///< m
};

End end_of(const Scene& scene)
{
    World world(scene, test_device("cpu:serial"));
    run(world, 120);
    End out{measure(world), 0};
    judge_residuals(world.scene(), residuals_ahead(world), out.report); // as `taut run` does
    for (const glm::dvec3& x : world.positions())
        out.lowest = std::min(out.lowest, x.y);
    return out;
}

} // namespace

TEST_CASE("a body that hangs in the air is not called completed [hard]")
{
    const End frozen = end_of(falling("vbd", 1, 1, 1e6));
    INFO("vbd: lowest " << frozen.lowest << " m, load residual " << frozen.report.load_residual
                        << ", imbalance " << frozen.report.imbalance);
    CHECK(frozen.lowest > -0.5);
    CHECK(frozen.report.load_residual > 0.5);
    CHECK(frozen.report.imbalance < 1);
    CHECK(frozen.report.status == Status::unconverged);
}

TEST_CASE("springs whose roundings outweigh the cloth do not hide that it hangs in the air [hard]")
{
    for (const char* method : {"vbd", "implicit_euler"})
        for (const double stiffness : {1e7, 1e9})
        {
            const End frozen = end_of(falling(method, 1, 1, stiffness));
            INFO(method << ", " << stiffness << " N/m: lowest " << frozen.lowest << " m, load residual "
                        << frozen.report.load_residual);
            CHECK(frozen.lowest > -0.5);
            CHECK(frozen.report.status == Status::unconverged);
        }
}

TEST_CASE("dampers, limits and a ball beside it do not hide that cloth hangs in the air [hard]")
{
    for (const char* method : {"vbd", "implicit_euler"})
    {
        Scene damped = falling(method, 1, 1, 1e9), limited = damped, beside = damped;
        damped.bodies[0].material.stretch_damping = 1e-6;
        limited.bodies[0].material.strain_limit = 0.05;
        Collider ball; // under a corner that hangs free
        ball.point = limited.bodies[0].mesh.positions.back() - glm::dvec3(0, 0.101, 0);
        ball.radius = 0.1;
        beside.colliders = {ball};
        for (const Scene& scene : {damped, limited, beside})
        {
            const End frozen = end_of(resolve(scene));
            INFO(method << ": lowest " << frozen.lowest << " m, load residual "
                        << frozen.report.load_residual);
            CHECK(frozen.lowest > -0.5);
            CHECK(frozen.report.status == Status::unconverged);
        }
    }
}

TEST_CASE("stiff cloth that stays in the air round a ball is not called completed, draped cloth is [hard]")
{
    const auto draped = [](const char* method, std::uint32_t substeps, double stiffness) {
        Scene scene = falling(method, substeps, 1, stiffness);
        scene.bodies[0].pins.clear();
        Collider ball;
        ball.point = {0, -0.301, 0};
        ball.radius = 0.3;
        ball.friction = 0.4;
        scene.colliders = {ball};
        const End end = end_of(resolve(scene));
        INFO(method << ", " << stiffness << " N/m: lowest " << end.lowest << " m, load residual "
                    << end.report.load_residual << ", " << end.report.reason);
        CHECK((end.lowest < -0.5) == (stiffness < 1e4));
        return end.report.status;
    };
    CHECK(draped("vbd", 10, 1e6) == Status::unconverged);
    CHECK(draped("vbd", 30, 1e3) == Status::completed);
    CHECK(draped("implicit_euler", 30, 1e3) == Status::completed);
}

TEST_CASE("cloth that is solved answers to its weight [hard]")
{
    for (const auto& scene : {falling("vbd", 100, 1, 1e4), falling("implicit_euler", 4, 2, 1e4)})
    {
        const End end = end_of(scene);
        INFO(scene.method.type << ": lowest " << end.lowest << " m, load residual "
                               << end.report.load_residual);
        CHECK(end.lowest < -0.75);
        CHECK(end.report.load_residual < 0.2);
        CHECK(end.report.status == Status::completed);
    }
}

TEST_CASE("what a scene accepts of its loads decides the status [hard]")
{
    Scene scene = falling("vbd", 1, 1, 1e6);
    const double left = end_of(scene).report.load_residual;
    scene.accept.residual = 4.1 * left;
    CHECK(end_of(scene).report.status == Status::completed);
    scene.accept.residual = 3.9 * left;
    CHECK(end_of(scene).report.status == Status::unconverged);
}

namespace {

/// A cantilever of 0.5 m, 10 x 2 x 2 cells, strongly damped.
Scene cantilever(const std::string& method, std::uint32_t substeps, double modulus)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {10, 2, 2};
    body.shape.box_size = {0.5, 0.1, 0.1};
    body.material.density = 1000;
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = 0;
    Pin pin;
    pin.faces = {"left"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 5;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    return resolve(scene);
}

} // namespace

TEST_CASE(
    "a stiff bar that xpbd lets sag is not called completed; where it answers to its weight it is [hard]")
{
    const double right = end_of(cantilever("vbd", 10, 1e6)).lowest;
    const End loose = end_of(cantilever("xpbd", 10, 1e9));
    INFO(loose.lowest << " m, " << loose.report.load_residual << " of its loads, " << loose.report.load_way
                      << " of its size: " << loose.report.reason);
    CHECK(loose.lowest < -0.05 - 0.02); // its own thickness, and 200 times what the modulus allows
    CHECK(loose.report.load_residual > 100);
    CHECK(loose.report.load_way > 0.01);
    CHECK(loose.report.status == Status::unconverged);
    const End held = end_of(cantilever("xpbd", 80, 1e6));
    INFO(held.lowest << " m against " << right << ", " << held.report.load_residual);
    CHECK(held.lowest == Approx(right).epsilon(0.05));
    CHECK(held.report.load_residual < 0.05);
    CHECK(held.report.status == Status::completed);
}

TEST_CASE("what nobody sees to sag too far is a warning [hard]")
{
    Scene scene = cantilever("xpbd", 10, 1e7);
    scene.bodies[0].shape.box_size = {0.2, 0.2, 0.2};
    scene.bodies[0].shape.box_cells = {4, 4, 4};
    const StepReport report = end_of(resolve(scene)).report;
    INFO(report.load_residual << " of its loads, " << report.load_way << " of its size");
    CHECK(report.load_residual > 0.25);
    CHECK(report.load_way < 0.01);
    CHECK(report.status == Status::completed);
    CHECK(report.warnings.count("soft") == 1);
}

namespace {

/// Cloth that flies level from one held edge, in a wind from below.
Scene blown(const std::string& method, std::uint32_t substeps, double stiffness)
{
    Scene scene = falling(method, substeps, 1, stiffness);
    scene.gravity = {0, 0, 0};
    scene.damping = 0;
    scene.bodies[0].shape.cells = {20, 20};
    scene.bodies[0].mesh = {};
    scene.bodies[0].material.drag = 1.2;
    Pin pin;
    pin.edges = {"left"};
    scene.bodies[0].pins = {pin};
    scene.wind = {1.2, {0, 10, 0}, {}};
    return resolve(scene);
}

/// A bar whose right end is led aside, without weight.
Scene bent(const std::string& method, std::uint32_t substeps, double modulus)
{
    Scene scene = cantilever(method, substeps, modulus);
    scene.gravity = {0, 0, 0};
    Pin led;
    led.faces = {"right"};
    led.motion = {{0, {}}, {0.5, {0, 0.15, 0}}};
    scene.bodies[0].pins.push_back(led);
    return resolve(scene);
}

} // namespace

TEST_CASE("without gravity too a cloth that the wind does not move is not called completed [hard]")
{
    const End frozen = end_of(blown("implicit_euler", 1, 1e5));
    INFO(frozen.report.kinetic_energy << " J, load residual " << frozen.report.load_residual);
    CHECK(frozen.report.kinetic_energy < 1e-6);
    CHECK(frozen.report.load_residual > 0.9);
    CHECK(frozen.report.status == Status::unconverged);
}

TEST_CASE(
    "without gravity too a bar that xpbd bends out of shape is named, and one that is right is not [hard]")
{
    const End right = end_of(bent("implicit_euler", 10, 1e6));
    INFO(right.report.potential_energy << " J, " << right.report.load_residual);
    CHECK(right.report.status == Status::completed);
    const End loose = end_of(bent("xpbd", 1, 1e6));
    INFO(loose.report.potential_energy << " J, " << loose.report.load_residual << ", "
                                       << loose.report.load_way);
    CHECK(loose.report.potential_energy > 2 * right.report.potential_energy);
    CHECK((loose.report.status == Status::unconverged || loose.report.warnings.count("soft") == 1));
}

TEST_CASE("without loads nothing is missed: bodies at rest and in flight are completed [hard]")
{
    for (const char* method : {"xpbd", "vbd", "implicit_euler"})
        for (const double modulus : {1e4, 1e9})
            for (const double speed : {0.0, 3.0})
            {
                Scene scene = cantilever(method, 10, modulus);
                scene.gravity = {0, 0, 0};
                scene.damping = 0;
                scene.bodies[0].pins.clear();
                scene.bodies[0].velocity = {speed, 0, 0};
                const End end = end_of(resolve(scene));
                INFO(method << ", " << modulus << " Pa, " << speed << " m/s: " << end.report.load_residual
                            << " " << end.report.reason);
                CHECK(end.report.status == Status::completed);
                CHECK(end.report.warnings.count("soft") == 0);
            }
}

namespace {

/// Cloth of 0.8 N m, by the bending model, that sticks out by 0.95 m from where it is held.
Scene overhang(std::uint32_t substeps, const char* bending_model)
{
    Scene scene;
    Body body;
    body.shape.cells = {20, 2};
    body.shape.size = {1, 0.1};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.material.density = 0.2;
    body.material.stretch_stiffness = 5000;
    body.material.bending_stiffness = 0.8;
    body.material.bending_model = option_named<BendingModel>(bending_model);
    Pin pin;
    pin.use_box = true;
    pin.box_min = {-1, -1, -1};
    pin.box_max = {-0.44, 1, 1};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 6;
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = substeps;
    return resolve(scene);
}

/// A fabric of 1 m that hangs by its upper edge.
Scene hung_fabric(std::uint32_t substeps)
{
    Scene scene = overhang(substeps, "hinge");
    Body& body = scene.bodies[0];
    body.shape.cells = {2, 20};
    body.shape.size = {0.1, 1};
    body.mesh = {};
    body.transform = {};
    body.material = {};
    body.material.stretch_stiffness = 0;
    body.material.density = 0.2;
    body.material.fabric.used = true;
    body.material.fabric.warp = body.material.fabric.weft = 5000;
    body.material.fabric.shear = 100;
    Pin pin;
    pin.edges = {"top"};
    body.pins = {pin};
    return resolve(scene);
}

} // namespace

TEST_CASE("cloth that sweeps let sag is not called completed, nor is a fabric that they let stretch [hard]")
{
    const auto check = [](const Scene& few, const Scene& many) {
        const End loose = end_of(few), right = end_of(many);
        INFO(loose.lowest << " m for " << right.lowest << ": " << loose.report.load_residual
                          << " of its loads, " << loose.report.load_way << " of its size; solved "
                          << right.report.load_residual << ", " << right.report.load_way);
        CHECK(loose.lowest < right.lowest - 0.01);
        CHECK(loose.report.load_residual > 0.5);
        CHECK(loose.report.status == Status::unconverged);
        CHECK(right.report.load_residual < 0.1);
        CHECK(right.report.status == Status::completed);
        CHECK(right.report.warnings.count("soft") == 0);
    };
    check(overhang(34, "plate"), overhang(400, "plate"));
    check(overhang(20, "hinge"), overhang(400, "hinge"));
    check(hung_fabric(4), hung_fabric(200));
}

TEST_CASE("what everybody sees to sag too far, but little beside what it has to, is a warning [hard]")
{
    const End end = end_of(overhang(80, "hinge"));
    INFO(end.lowest << " m, " << end.report.load_residual << " of its loads, " << end.report.load_way
                    << " of its size: " << end.report.reason);
    CHECK(end.report.load_residual < 0.25);
    CHECK(end.report.load_way > 0.01);
    CHECK(end.report.status == Status::completed);
    CHECK(end.report.warnings.count("soft") == 1);
}

} // namespace taut::hard
