// Cloth between pins that draw it apart: what that puts in is known, and with the substeps that nobody named
// it is solved.

#include "hard/cases.hpp"

namespace taut::hard {
namespace {

/// Square cloth of 1 m without weight, whose right edge is led away by `strain` of it in a second.
Scene drawn(const char* method, double strain, std::uint32_t cells)
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.cells = {cells, cells};
    body.material.density = 0.2;
    body.material.stretch_stiffness = 1e4;
    body.material.bending_stiffness = 1e-4;
    body.pins.resize(2);
    body.pins[0].edges = {"left"};
    body.pins[1].edges = {"right"};
    body.pins[1].motion = {{0, {0, 0, 0}}, {1, {strain, 0, 0}}};
    scene.gravity = {0, 0, 0};
    scene.damping = 2;
    scene.method.type = option_named<MethodKind>(method);
    return scene;
}

Scene woven(const char* method, double strain)
{
    Scene scene = drawn(method, strain, 8);
    Material& m = scene.bodies[0].material;
    m.stretch_stiffness = 0;
    m.fabric.used = true;
    m.fabric.warp = 1e4;
    m.fabric.weft = 3e3;
    m.fabric.shear = 500;
    return scene;
}

StepReport end_of(const Scene& scene) { return judged_run(resolve(scene), 120, test_device("cpu:serial")); }

} // namespace

TEST_CASE("cloth that pins draw apart is solved by the substeps that nobody named [hard]")
{
    for (const double strain : {0.05, 0.2, 0.4})
        for (const std::uint32_t cells : {5u, 12u})
        {
            const Scene scene = drawn("xpbd", strain, cells);
            const StepReport report = end_of(scene);
            INFO(strain << ", " << cells << " cells, " << resolve(scene).method.substeps
                        << " substeps: " << report.stretch_residual << " " << report.reason);
            CHECK(report.status == Status::completed);
            CHECK(report.stretch_residual < 0.06); // 0.05 is aimed at
        }
    Scene chain = drawn("xpbd", 0.2, 12);
    chain.bodies[0].shape.kind = ShapeKind::chain;
    chain.bodies[0].pins[0] = {};
    chain.bodies[0].pins[0].corners = {"first"};
    chain.bodies[0].pins[1].edges.clear();
    chain.bodies[0].pins[1].corners = {"last"};
    chain.bodies[0].pins[1].motion[1].translate = {0, -0.2 * chain.bodies[0].shape.length, 0};
    const StepReport drawn_chain = end_of(chain);
    INFO("chain: " << drawn_chain.stretch_residual << " " << drawn_chain.reason);
    CHECK(drawn_chain.status == Status::completed);
    CHECK(drawn_chain.stretch_residual < 0.06);
    Scene few = drawn("xpbd", 0.2, 12);
    few.method.substeps = 10;
    const StepReport report = end_of(few);
    CHECK(report.stretch_residual > 0.3);
    CHECK(report.status == Status::unconverged);
}

TEST_CASE("a fabric that pins draw apart has the energy that they put in, and not more [hard]")
{
    for (const char* method : {"xpbd", "vbd", "implicit_euler"})
        for (const double strain : {0.05, 0.15, 0.3})
        {
            const Scene scene = woven(method, strain);
            const double weft = scene.bodies[0].material.fabric.weft;
            const StepReport report = end_of(scene);
            INFO(method << ", " << strain << ": " << report.potential_energy << " J, at most "
                        << report.energy_most << " " << report.reason);
            CHECK(report.status == Status::completed);
            CHECK(report.potential_energy == Approx(0.5 * weft * strain * strain).epsilon(0.05));
            CHECK(report.energy_most < 25 * report.potential_energy);
        }
}

} // namespace taut::hard
