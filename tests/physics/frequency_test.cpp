// Materials against natural frequencies: a bar let go along the shape of its lowest mode swings at the
// frequency that the eigenpair of (K, M) of its tetrahedra has, as the step makes of it.
//
// Of a mode of angular frequency w, an implicit Euler step of h makes atan(w h) / h (its factor is
// 1 / (1 - i w h)); converged block descent takes the same steps.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/symmetric.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/static_energy.hpp"
#include "taut/world/world.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <cstdlib>
#include <string>

using namespace taut;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kAmplitude = 1e-4; ///< m, of a bar of 1 m: small, so that all is linear
constexpr double kSteps = 120;      ///< frames a period

/// A bar of 1 m along x, free or held at its left end. Nothing pulls and nothing damps. Its cross section
/// should be no square: of two equal frequencies the modes would mix.
Scene bar(const std::string& model, bool held, const glm::uvec3& cells, const glm::dvec3& size)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.damping = 0;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = cells;
    body.shape.box_size = size;
    body.shape.split = BoxSplit::six;
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.density = 1000;
    body.material.youngs_modulus = 1e6;
    body.material.poissons_ratio = 0.3;
    if (held)
    {
        body.pins = {Pin()};
        body.pins[0].faces = {"left"};
    }
    scene.bodies = {body};
    return resolve(scene);
}

struct Mode
{
    double rate = 0;               ///< 1/s
    std::vector<glm::dvec3> shape; ///< all vertices; the longest is 1
};

/// The lowest that is no rigid motion: K u = w^2 M u by Eigen, K the Hessian of the tetrahedra at rest.
Mode lowest_mode(const PhysicalModel& model, int rigid)
{
    const reference::StaticEnergy energy(model);
    reference::State rest;
    for (const glm::dvec3& x : model.start)
        rest.push_back({x.x, x.y, x.z});
    const Eigen::MatrixXd lower(energy.hessian(rest, reference::Curvature::exact, 0));
    const Eigen::MatrixXd k = lower.selfadjointView<Eigen::Lower>();
    Eigen::VectorXd root(energy.unknowns());
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (energy.unknown(v) >= 0)
            root.segment<3>(energy.unknown(v)).setConstant(std::sqrt(model.mass[v]));
    const Eigen::VectorXd inverse = root.cwiseInverse();
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * k * inverse.asDiagonal();
    const Spectrum spectrum = symmetric_spectrum(scaled);
    REQUIRE(spectrum.values[rigid] > 0);
    if (rigid > 0) // what is called rigid costs nothing
        CHECK(spectrum.values.head(rigid).cwiseAbs().maxCoeff() < 1e-6 * spectrum.values[rigid]);
    CHECK(spectrum.values[rigid + 1] > 1.02 * spectrum.values[rigid]);
    const Eigen::VectorXd u = inverse.cwiseProduct(spectrum.vectors.col(rigid));
    Mode out;
    out.rate = std::sqrt(spectrum.values[rigid]);
    double longest = 0;
    for (std::size_t v = 0; v < rest.size(); ++v)
    {
        const int at = energy.unknown(v);
        out.shape.push_back(at < 0 ? glm::dvec3(0) : glm::dvec3(u[at], u[at + 1], u[at + 2]));
        longest = std::max(longest, glm::length(out.shape.back()));
    }
    for (glm::dvec3& d : out.shape)
        d /= longest;
    return out;
}

/// How far the bar is along the mode, frame by frame.
std::vector<double> swing(Scene scene, const PhysicalModel& model, const Mode& mode, std::size_t steps)
{
    scene.timestep = 2 * kPi / mode.rate / kSteps;
    scene.bodies[0].start_positions = model.start;
    for (std::size_t v = 0; v < mode.shape.size(); ++v)
        scene.bodies[0].start_positions[v] += kAmplitude * mode.shape[v];
    World world(scene, test_device("cpu:serial"));
    double norm = 0;
    for (std::size_t v = 0; v < mode.shape.size(); ++v)
        norm += model.mass[v] * glm::dot(mode.shape[v], mode.shape[v]);
    std::vector<double> out;
    for (std::size_t s = 0; s <= steps; ++s)
    {
        if (s > 0)
            world.step();
        const auto x = world.positions();
        double along = 0;
        for (std::size_t v = 0; v < x.size(); ++v)
            along += model.mass[v] * glm::dot(mode.shape[v], x[v] - model.start[v]) / norm;
        out.push_back(along / kAmplitude);
    }
    return out;
}

} // namespace

TEST_CASE("a neo-Hookean bar swings at the frequency of its lowest mode, held or free", "[solid][frequency]")
{
    struct Way
    {
        const char* type;
        std::uint32_t substeps, iterations;
    };
    const Way way = GENERATE(Way{"implicit_euler", 1, 2}, Way{"vbd", 4, 30});
    const std::string material = GENERATE("neo_hookean", "neo_hookean_simple");
    const bool held = GENERATE(true, false);
    CAPTURE(way.type, material, held);
    Scene scene = bar(material, held, {6, 2, 2}, {1, 0.25, 0.2});
    scene.method.type = option_named<MethodKind>(way.type);
    scene.method.substeps = way.substeps;
    scene.method.iterations = way.iterations;
    scene.method.precision = Precision::float64;
    scene.method.linear_iterations = 500;
    scene.method.linear_tolerance = 1e-10;
    const PhysicalModel model = make_model(scene);
    const Mode mode = lowest_mode(model, held ? 0 : 6);
    const auto steps = static_cast<std::size_t>(8 * kSteps);
    const Oscillation found = oscillation(swing(scene, model, mode, steps), 2 * kPi / mode.rate / kSteps);
    REQUIRE(found.periods >= 6);
    const double exact = mode.rate / (2 * kPi), angle = 2 * kPi / kSteps / way.substeps;
    const double stepped = exact * std::atan(angle) / angle;
    const double decay = std::log1p(angle * angle) / 2 / std::atan(angle); // a radian
    if (std::getenv("TAUT_NOTES"))
        WARN(way.type << ", " << material << (held ? ", held" : ", free") << ": lowest mode " << exact
                      << " Hz; swings / mode - 1 = " << found.frequency / exact - 1
                      << ", / stepped - 1 = " << found.frequency / stepped - 1
                      << ", damping / step's - 1 = " << found.damping / decay - 1);
    CHECK(found.frequency == Approx(stepped).epsilon(1e-6));
    CHECK(found.frequency == Approx(exact).epsilon(2e-3)); // (w h)^2 / 3 = 0.09 %
    CHECK(found.damping == Approx(decay).epsilon(1e-3));
}

TEST_CASE("the lowest mode of a slender bar nears that of a beam", "[solid][frequency]")
{
    // Clamped, by Euler and Bernoulli: w = 1.8751^2 sqrt(E I / (rho A L^4)). Linear tetrahedra lock: they are
    // too stiff, the less so the more there are.
    double last = 1e300;
    const double beam = 1.875104068711961 * 1.875104068711961 * std::sqrt(1e6 / 1000 * 0.1 * 0.1 / 12);
    for (const std::uint32_t cells : {8u, 16u, 32u})
    {
        const Scene scene = bar("neo_hookean", true, {cells, 2, 2}, {1, 0.1, 0.12});
        const double ratio = lowest_mode(make_model(scene), 0).rate / beam;
        if (std::getenv("TAUT_NOTES"))
            WARN(cells << " cells: lowest mode / beam's = " << ratio);
        CHECK(ratio > 1);
        CHECK(ratio < last);
        last = ratio;
    }
    CHECK(last < 1.35);
}
