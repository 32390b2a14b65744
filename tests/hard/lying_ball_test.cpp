// A ball that lies on the floor on a few vertices, about which it may roll: what is missing of its way is
// told apart from rolling.

#include "hard/cases.hpp"

#include "taut/report/load_residual.hpp"
#include "taut/report/residuals.hpp"

namespace taut::hard {
namespace {

struct Ball
{
    double radius; // m
    std::uint32_t cells;
    double youngs_modulus; // Pa
    double poissons_ratio;
};

Scene lying(const Ball& ball, std::uint32_t substeps)
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.kind = ShapeKind::ball;
    body.shape.ball_cells = ball.cells;
    body.shape.radius = ball.radius;
    body.material = solid_material();
    body.material.density = 1100;
    body.material.youngs_modulus = ball.youngs_modulus;
    body.material.poissons_ratio = ball.poissons_ratio;
    body.transform.translate = {0, ball.radius + 0.001, 0};
    scene.colliders.emplace_back().kind = ColliderKind::plane;
    scene.method.substeps = substeps;
    scene.damping = 3;
    return scene;
}

struct End
{
    StepReport report;
    double height; ///< m, mean of the vertices
};

End end_of(const Ball& ball, std::uint32_t substeps)
{
    World world(resolve(lying(ball, substeps)), test_device("cpu:serial"));
    const double second = 1 / world.scene().timestep;
    run(world, static_cast<int>(second + 0.5));
    End out{measure(world), 0};
    judge_residuals(world.scene(), residuals_ahead(world), out.report);
    const std::vector<glm::dvec3> x = world.positions();
    for (const glm::dvec3& p : x)
        out.height += p.y / static_cast<double>(x.size());
    return out;
}

/// Of the diagonal of the ball's box.
double sunk(const Ball& ball, const End& end, const End& right)
{
    return (right.height - end.height) / (2 * std::sqrt(3) * ball.radius);
}

} // namespace

TEST_CASE("a ball that lies on a few vertices is where it should be, and is not told to roll [hard]",
          "[solid]")
{
    std::vector<Ball> balls{
        {0.05, 6, 1e7, 0.49}, {0.3, 6, 1e8, 0.3}, {0.1, 4, 2e6, 0.45}, {0.5, 6, 1e10, 0.3}};
    if (!short_run())
        balls.insert(balls.end(), {{0.1, 8, 1e10, 0.49}, {0.5, 8, 1e7, 0.49}, {0.05, 10, 1e8, 0.49}});
    for (const Ball& ball : balls)
    {
        const End end = end_of(ball, 0), right = end_of(ball, 500);
        INFO(ball.radius << " m, " << ball.cells << " cells, " << ball.youngs_modulus << " Pa, nu "
                         << ball.poissons_ratio << ": " << sunk(ball, end, right)
                         << " of its size too low, share " << end.report.load_residual << ", way "
                         << end.report.load_way << ", " << end.report.reason);
        CHECK(right.report.load_way < 0.001);
        CHECK(std::abs(sunk(ball, end, right)) < 0.006);
        CHECK(end.report.load_way < kSeenWay);
        CHECK(end.report.status == Status::completed);
    }
}

TEST_CASE("a ball that sweeps leave too soft sinks, and says so [hard]", "[solid]")
{
    for (const Ball& ball : {Ball{0.05, 8, 1e6, 0.3}, Ball{0.1, 8, 1e6, 0.45}})
    {
        const End end = end_of(ball, 4), right = end_of(ball, 500);
        INFO(sunk(ball, end, right) << " of its size too low, way " << end.report.load_way);
        CHECK(sunk(ball, end, right) > 0.03);
        CHECK(end.report.load_way > kSeenWay);
        CHECK(end.report.status == Status::unconverged);
    }
}

} // namespace taut::hard
