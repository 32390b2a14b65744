// Errors of measure on numbers that a reader can check by hand.
#include "support/catch.hpp"

#include "samples.hpp"
#include "taut/report/errors.hpp"

#include <limits>

using namespace taut;

namespace {

using Points = std::vector<glm::dvec3>;

const ErrorWeights kWeights{{1, 4, 0}, 2}; // the third vertex is pinned

} // namespace

TEST_CASE("the displacement error weighs by mass and leaves pins out", "[errors]")
{
    const Points start = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const Points reference = {{0, 3, 0}, {1, 2, 0}, {2, 0, 0}};  // moved: 1*9 + 4*4 = 25
    const Points x = {{0, 3, 2}, {1, 2.75, 0}, {9, 9, 9}};       // off: 1*4 + 4*0.5625 = 6.25
    CHECK(displacement_error(kWeights, x, reference, start).value() == Approx(0.5).epsilon(1e-15));
    CHECK(largest_error(kWeights, x, reference) == Approx(1).epsilon(1e-15));
    CHECK(distance_by_mass(kWeights, x, reference) == Approx(2.5).epsilon(1e-15));
    CHECK_FALSE(displacement_error(kWeights, x, start, start).has_value());
}

TEST_CASE("the trajectory error adds all frames before it divides", "[errors]")
{
    const Points a = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const auto at = [&](double y) { return Points{{0, y, 0}, {0, 0, 0}, {5, 5, 5}}; };
    const Frames reference = {a, at(3), at(4)};          // 9 + 16
    const Frames x = {a, at(3.5), at(4.5)};              // 0.25 + 0.25
    CHECK(trajectory_error(kWeights, x, reference).value() == Approx(std::sqrt(0.5 / 25)).epsilon(1e-15));
    CHECK(largest_error(kWeights, x, reference) == Approx(0.25).epsilon(1e-15));
    CHECK_FALSE(trajectory_error(kWeights, x, Frames{a, a, a}).has_value());
}

TEST_CASE("an error that is not a number is never small", "[errors]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Points a = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, b = {{1, 0, 0}, {nan, 0, 0}, {0, 0, 0}};
    CHECK_FALSE(largest_error(kWeights, b, a) < 1e300);
    const Frames reference = {a, {{1, 1, 1}, {1, 1, 1}, {0, 0, 0}}};
    CHECK_FALSE(trajectory_error(kWeights, Frames{a, b}, reference).value() < 1e300);
}

TEST_CASE("smoothing keeps straight lines and removes what has the period of its window", "[errors]")
{
    Frames line, wave;
    for (int f = 0; f < 25; ++f)
    {
        line.push_back({glm::dvec3(f, 2 * f, 0)});
        wave.push_back({glm::dvec3(std::sin(2 * 3.14159265358979323846 * f / 6), 0, 0)});
    }
    const Frames smooth = smoothed(line), flat = smoothed(wave);
    REQUIRE(smooth.size() == 20);
    CHECK(smooth[0][0] == line[0][0]);
    CHECK(smooth[3][0].y == Approx(2 * (3 + 2.5)).epsilon(1e-14));
    for (std::size_t f = 1; f < flat.size(); ++f)
        CHECK(std::abs(flat[f][0].x) < 1e-14);
}

TEST_CASE("stretch is signed, and its mean square keeps tension apart", "[errors]")
{
    Body body;
    body.mesh.positions = {{0, 0, 0}, {1.2, 0, 0}, {1.2, 0.6, 0}, {1.2, 0.6, 0}};
    body.springs = {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 3, 0, 1}};
    body.vertex_masses = {1, 1, 1, 1};
    const StretchErrors found = stretch_errors(make_model(samples::scene_of(body)), body.mesh.positions);
    CHECK(found.largest == Approx(0.2));
    CHECK(found.rms == Approx(std::sqrt((0.04 + 0.16) / 2)));
    CHECK(found.rms_tension == Approx(std::sqrt(0.04 / 2)));
    CHECK(found.percentile_99 == Approx(-0.4)); // of two, the lower one
}

TEST_CASE("drift is the least-squares slope per period, over the reference energy", "[errors]")
{
    std::vector<double> energy;
    for (int i = 0; i < 1000; ++i)
        energy.push_back(5 + 0.002 * i + 0.1 * std::sin(2 * 3.14159265358979323846 * i / 100));
    const EnergyDrift drift = energy_drift(energy, 100, 4);
    CHECK(drift.per_period == Approx(0.002 * 100 / 4).epsilon(0.02));
    CHECK(drift.largest == Approx((0.002 * 925 + 0.1) / 4).epsilon(0.05));
}

TEST_CASE("the energy gap is 1 at the start, 0 at the minimum and undefined between equal ones", "[errors]")
{
    CHECK(energy_gap(3, 3, 1).value() == 1);
    CHECK(energy_gap(1, 3, 1).value() == 0);
    CHECK_FALSE(energy_gap(1, 1, 1).has_value());
}

TEST_CASE("momentum counts only what the impulse does not explain", "[errors]")
{
    const Points before = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, after = {{0, -10, 0}, {0, -10, 0}, {7, 7, 7}};
    CHECK(momentum_error(kWeights, after, before, {0, -50, 0}, 0) == 0);
    CHECK(momentum_error(kWeights, after, before, {0, -49, 0}, 0) == Approx(1.0 / (5 * 10)).epsilon(1e-14));
    CHECK(momentum_error(kWeights, before, before, {1, 0, 0}, 8) == Approx(1.0 / (5 * 4)).epsilon(1e-14));
}

TEST_CASE("a damped sine gives back its frequency and damping", "[errors]")
{
    const double f = 1.7, zeta = 0.01, h = 1.0 / 240, omega = 2 * 3.14159265358979323846 * f;
    std::vector<double> signal;
    for (int i = 0; i < 240 * 20; ++i)
        signal.push_back(std::exp(-zeta * omega * i * h) * std::sin(omega * i * h + 0.3));
    const Oscillation found = oscillation(signal, h);
    CHECK(found.periods >= 30);
    CHECK(found.frequency == Approx(f).epsilon(1e-5));
    CHECK(found.damping == Approx(zeta).epsilon(0.01));
    CHECK(oscillation(std::vector<double>(10, 1.0), h).periods == 0);
}

TEST_CASE("the acceleration residual is 1 in free fall and 0 where springs carry the weight", "[errors]")
{
    Body body;
    body.mesh.positions = {{0, 0, 0}, {0, -1 - 2 * 9.81 / 100, 0}};
    body.springs = {{0, 1, 1, 0.01}};
    body.vertex_masses = {1, 2};
    body.pins.emplace_back().vertices = {0};
    const PhysicalModel model = make_model(samples::scene_of(body));
    CHECK(acceleration_residual(model, body.mesh.positions).value() < 1e-13);
    CHECK(acceleration_residual(model, Points{{0, 0, 0}, {0, -1, 0}}).value() == Approx(1).epsilon(1e-14));
}

TEST_CASE("penetration is the depth of the deepest moving vertex under a moving collider", "[errors]")
{
    Body body;
    body.mesh.positions = {{0, 0.5, 0}, {3, 0.9, 0}, {0, -7, 0}};
    body.vertex_masses = {1, 1, 1};
    body.material.thickness = 0.1;
    body.pins.emplace_back().vertices = {2};
    Scene scene = samples::scene_of(body);
    Collider plane;
    plane.kind = ColliderKind::plane;
    plane.motion.resize(2);
    plane.motion[1].time = 1;
    plane.motion[1].translate = {0, 1, 0};
    scene.colliders.push_back(plane);
    const PhysicalModel model = make_model(scene);
    const ErrorWeights weights{error_weights(model).mass, 10};
    CHECK(penetration(model, weights, body.mesh.positions, 0) == 0);
    CHECK(penetration(model, weights, body.mesh.positions, 1) == Approx(0.06).epsilon(1e-13)); // .5 - 1 - .1
}
