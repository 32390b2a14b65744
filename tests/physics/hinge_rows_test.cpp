// Claims about hinges as rows of implicit_constraints: the static shape of a bent strip, agreement of the
// two operators and of executors, and what a strip without bending would do.

#include "hard/cases.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/reference_static.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// A strip of 0.4 m held flat at one end (two columns), heavy enough to bend by half a right angle.
Scene strip(const char* method, double rigidity = 1e-3)
{
    Scene scene;
    Body body;
    body.shape.cells = {8, 2};
    body.shape.size = {0.4, 0.1};
    body.material.stretch_stiffness = 2000;
    body.material.bending_stiffness = rigidity;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.use_box = true;
    pin.box_min = {-0.21, -1, -1};
    pin.box_max = {-0.149, 1, 1};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 4;
    scene = resolve(scene);
    scene.method.type = option_named<MethodKind>(method);
    scene.method.precision = Precision::float64;
    scene.method.linear_operator = LinearOperator::matrix_free;
    scene.method.linear_iterations = 400;
    scene.method.linear_tolerance = 1e-8;
    return scene;
}

double error_of(const World& world, const std::vector<glm::dvec3>& reference)
{
    const PhysicalModel model = make_model(world.scene());
    const auto error = displacement_error(error_weights(model), world.positions(), reference, model.start);
    REQUIRE(error.has_value());
    return *error;
}

} // namespace

TEST_CASE("a strip of rows of hinges hangs as Newton's method on the same energy says, and as xpbd does",
          "[hinge_rows]")
{
    const auto device = test_device("cpu");
    const PhysicalModel model = make_model(strip("xpbd"));
    const StaticReference reference = solve_static(model, model.start);
    REQUIRE(reference.converged);
    for (const std::uint32_t solves : {1u, 2u})
        for (const char* linear_operator : {"assembled", "matrix_free"})
        {
            Scene scene = strip("implicit_constraints");
            scene.method.substeps = 2;
            scene.method.iterations = solves;
            scene.method.linear_operator = option_named<LinearOperator>(linear_operator);
            World world(scene, device);
            run(world, 1200);
            const double error = error_of(world, reference.positions);
            note("strip", *device, "e_disp against R2", error);
            CHECK(error < 1e-6);
            CHECK(world.positions()[8].y < -0.05); // it does hang
            check_sound(world);
        }
    Scene xpbd = strip("xpbd");
    xpbd.method.substeps = 40;
    World world(xpbd, device);
    run(world, 1200);
    const double apart = error_of(world, reference.positions);
    note("strip", *device, "e_disp of xpbd, 40 substeps", apart);
    CHECK(apart < 0.02); // of its own error
}

TEST_CASE("a stiffer plate hangs less, and none at all folds at its clamp", "[hinge_rows]")
{
    double before = 1;
    for (const double rigidity : {0.0, 1e-4, 1e-3, 1e-2, 1.0})
    {
        Scene scene = strip("implicit_constraints", rigidity);
        scene.method.substeps = 4;
        World world(scene, test_device("cpu:serial"));
        run(world, 600);
        const double drop = -world.positions()[8].y;
        note("strip", *test_device("cpu:serial"), "drop of the end, m", drop);
        CHECK(drop < before);
        before = drop;
        check_sound(world);
        if (rigidity < 1e-2)
            continue;
        const PhysicalModel model = make_model(scene);
        const StaticReference reference = solve_static(model, model.start);
        REQUIRE(reference.converged);
        CHECK(error_of(world, reference.positions) < 1e-6);
    }
}

TEST_CASE("executors and both operators agree on cloth with hinges", "[hinge_rows]")
{
    for (const char* linear_operator : {"assembled", "matrix_free"})
    {
        Scene scene = strip("implicit_constraints");
        scene.method.linear_operator = option_named<LinearOperator>(linear_operator);
        scene.method.iterations = 2;
        scene.method.substeps = 2;
        World reference(scene, test_device("cpu:serial"));
        run(reference, 10);
        scene.method.linear_operator =
            linear_operator[0] == 'a' ? LinearOperator::matrix_free : LinearOperator::assembled;
        World other(scene, test_device("cpu:serial"));
        run(other, 10);
        CHECK(largest_distance(reference.positions(), other.positions()) < 1e-7); // what the tolerance leaves
        scene.method.linear_operator = option_named<LinearOperator>(linear_operator);
        on_every_device([&](const auto& device) {
            World world(scene, device);
            run(world, 10);
            CHECK(largest_distance(world.positions(), reference.positions()) <
                  (device->info().hardware_gpu ? 1e-5 : 1e-12));
        });
    }
}
