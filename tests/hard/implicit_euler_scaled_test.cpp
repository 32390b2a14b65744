// Solids that start scaled along one axis find their shape under implicit Euler, however stiff they are
// (docs/decisions.md, 74). TAUT_NOTES=1 prints how each ends.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

struct Start
{
    double scale, modulus, ratio; ///< of the height, Pa, Poisson's
    std::string precision;
    std::string name() const
    {
        char text[100];
        std::snprintf(text, sizeof text, "%s, %g of its height, %.0e Pa, nu %g", precision.c_str(), scale,
                      modulus, ratio);
        return text;
    }
};

/// A cube of 0.1 m that nothing holds, without gravity.
Scene cube(const Start& s)
{
    Scene scene;
    Body body;
    body.material = solid_material();
    body.material.model = SolidModel::neo_hookean;
    body.material.youngs_modulus = s.modulus;
    body.material.poissons_ratio = s.ratio;
    body.material.density = 1100;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.shape.box_size = glm::dvec3(0.1);
    body.shape.split = BoxSplit::five;
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    scene.method.type = MethodKind::implicit_euler;
    scene.method.precision = option_named<Precision>(s.precision);
    scene = resolve(scene);
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
        scene.bodies[0].start_positions.push_back({x.x, s.scale * x.y, x.z});
    return scene;
}

struct End
{
    StepReport report;
    bool found() const { return report.volume.inverted == 0 && std::abs(report.volume.ratio - 1) < 1e-3; }
};

End end_of(const Start& s)
{
    World world(cube(s), test_device("cpu:serial"));
    run(world, 120);
    const End out{measure(world)};
    if (const char* wanted = std::getenv("TAUT_NOTES"); wanted && *wanted)
        std::printf("%s: volume %.4f, %d inverted, %.2g m/s\n", s.name().c_str(), out.report.volume.ratio,
                    int(out.report.volume.inverted), out.report.max_speed);
    return out;
}

std::vector<Start> starts(std::vector<double> scales)
{
    std::vector<Start> out;
    for (const char* precision : {"float", "double"})
        for (const double scale : scales)
            for (const double ratio : {0.3, 0.45, 0.499})
                for (const double modulus : {1e6, 1e8, 1e10})
                    if (!short_run() || (ratio > 0.3 && precision == std::string("float")))
                        out.push_back({scale, modulus, ratio, precision});
    return out;
}

} // namespace

TEST_CASE("implicit Euler: squeezed and drawn cubes find their shape from 1e6 to 1e10 Pa [hard]", "[solid]")
{
    for (const Start& s : starts({0.7, 0.3, 0.05, 0.001, 1.5, 3}))
    {
        INFO(s.name());
        const End end = end_of(s);
        CHECK(end.found());
        CHECK(end.report.max_speed < 1e-3);
        CHECK(end.report.status == Status::completed);
    }
}

TEST_CASE("implicit Euler: mirrored cubes end without motion, and are named where one is inverted [hard]",
          "[solid]")
{
    std::size_t found = 0;
    const std::vector<Start> all = starts({-1});
    for (const Start& s : all)
    {
        INFO(s.name());
        const End end = end_of(s);
        CHECK(end.report.kinetic_energy < 0.1); // J; at the start they have hundreds and more
        CHECK((end.report.volume.inverted == 0 || end.report.status == Status::unconverged));
        found += end.found() ? 1 : 0;
    }
    CHECK(3 * found >= all.size());
}
