// The dynamic reference against closed forms, and its own judgement of itself.
#include "support/catch.hpp"

#include "samples.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"

#include <glm/geometric.hpp>

#include <limits>

using namespace taut;

namespace {

constexpr double kPi = 3.14159265358979323846;
using Scheme = DynamicOptions::Scheme;

Scene particle(glm::dvec3 at, glm::dvec3 velocity, double thickness = 0)
{
    Body body;
    body.mesh.positions = {at};
    body.vertex_masses = {0.5};
    body.velocity = velocity;
    body.material.thickness = thickness;
    Scene scene = samples::scene_of(std::move(body));
    scene.duration = 1;
    return scene;
}

/// m = 1, k = 1000, stretched by 0.1, along x, no gravity.
Scene oscillator()
{
    Body body;
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    body.start_positions = {{0, 0, 0}, {1.1, 0, 0}};
    body.springs = {{0, 1, 1, 1e-3}};
    body.vertex_masses = {1, 1};
    body.pins.emplace_back().vertices = {0};
    Scene scene = samples::scene_of(std::move(body), glm::dvec3(0));
    scene.duration = 1;
    return scene;
}

/// Length 1, let go at `degrees` from straight down; spring of 1e5 N/m under 9.81 N.
Scene pendulum(double degrees)
{
    Body body;
    const double t = degrees * kPi / 180;
    body.mesh.positions = {{0, 0, 0}, {std::sin(t), -std::cos(t), 0}};
    body.springs = {{0, 1, 1, 1e-5}};
    body.vertex_masses = {1, 1};
    body.pins.emplace_back().vertices = {0};
    Scene scene = samples::scene_of(std::move(body));
    scene.duration = 5;
    return scene;
}

Scene on_plane(double slope, double friction, glm::dvec3 velocity = glm::dvec3(0))
{
    Scene scene = particle({0, 0, 0}, velocity);
    Collider plane;
    plane.kind = ColliderKind::plane;
    plane.normal = {-slope, 1, 0};
    plane.friction = friction;
    scene.colliders.push_back(plane);
    return scene;
}

double slide(const Scene& scene)
{
    const DynamicReference out = solve_dynamic(make_model(scene));
    INFO(out.reason);
    REQUIRE_FALSE(out.frames.empty());
    return glm::distance(out.frames.back()[0], out.frames.front()[0]);
}

} // namespace

TEST_CASE("symplectic Euler falls along the parabola, for its first kick of gravity is half", "[dynamic]")
{
    DynamicOptions options;
    options.scheme = Scheme::symplectic_euler;
    const PhysicalModel model = make_model(particle({0, 0, 0}, {1, 2, 0}));
    const DynamicReference out = solve_dynamic(model, options);
    CHECK(out.verified);
    REQUIRE(out.frames.size() == 61);
    CHECK(out.frames[60][0].y == Approx(2 - 9.81 / 2).epsilon(1e-12));
    CHECK(out.frames[60][0].x == Approx(1).epsilon(1e-12));
    CHECK(out.error < 1e-12);
    CHECK(out.largest_error == 0); // a particle has no size to measure by
}

TEST_CASE("Verlet falls freely without error and says that only rounding is left", "[dynamic]")
{
    const DynamicReference out = solve_dynamic(make_model(particle({0, 0, 0}, {1, 2, 0})));
    CHECK(out.verified);
    CHECK(out.frames[60][0].y == Approx(2 - 9.81 / 2).epsilon(1e-12));
    CHECK(out.error < 1e-12);
}

TEST_CASE("a damped particle follows its closed form, in both schemes at their orders", "[dynamic]")
{
    Scene scene = particle({0, 0, 0}, {1, 0, 0});
    scene.damping = 2;
    for (const Scheme scheme : {Scheme::symplectic_euler, Scheme::verlet})
    {
        DynamicOptions options;
        options.scheme = scheme;
        const DynamicReference out = solve_dynamic(make_model(scene), options);
        CHECK(out.verified);
        CHECK(out.order == (scheme == Scheme::verlet ? 2 : 1));
        const double decay = 1 - std::exp(-2.0);
        const glm::dvec3 exact(decay / 2, -9.81 / 2 * (1 - decay / 2), 0);
        const double error = glm::distance(out.frames.back()[0], exact);
        CHECK(error < (scheme == Scheme::verlet ? 1e-6 : 2e-3));
        // The estimate is relative to the motion; within a factor of two of the truth.
        CHECK(out.error * glm::length(exact) > 0.3 * error);
        CHECK(out.error * glm::length(exact) < 3 * error);
    }
}

TEST_CASE("a spring swings as its closed form, and the error estimate is the error", "[dynamic]")
{
    const PhysicalModel model = make_model(oscillator());
    const DynamicReference out = solve_dynamic(model);
    REQUIRE(out.verified);
    CHECK(out.orders.back() == Approx(2).margin(0.05));
    Frames exact = out.frames;
    for (std::size_t f = 0; f < exact.size(); ++f)
        exact[f][1].x = 1 + 0.1 * std::cos(std::sqrt(1000.0) * static_cast<double>(f) / 60);
    CHECK(exact.back()[1].x - 1 == Approx(0.097868269655989229).epsilon(1e-12));
    const double truth = trajectory_error(error_weights(model), out.frames, exact).value();
    CHECK(truth < 1e-3);
    CHECK(out.error == Approx(truth).epsilon(0.05));
    CHECK(out.largest_error == Approx(largest_error(error_weights(model), out.frames, exact)).epsilon(0.05));
}

TEST_CASE("symplectic Euler swings with the frequency and amplitude of its own formula", "[dynamic]")
{
    // cos(theta) = 1 - (w h)^2 / 2; x_n = x_0 (cos(n theta) - tan(theta/2) sin(n theta)) from v_0 = 0.
    DynamicOptions options;
    options.scheme = Scheme::symplectic_euler;
    const DynamicReference out = solve_dynamic(make_model(oscillator()), options);
    CHECK(out.verified);
    const double wh = std::sqrt(1000.0) * out.step, theta = std::acos(1 - wh * wh / 2);
    for (std::size_t f = 1; f < out.frames.size(); ++f)
    {
        const double n = std::round(static_cast<double>(f) / 60 / out.step);
        const double x = 0.1 * (std::cos(n * theta) - std::tan(theta / 2) * std::sin(n * theta));
        CHECK(out.frames[f][1].x - 1 == Approx(x).margin(1e-11));
    }
}

TEST_CASE("a pendulum has the period of the elliptic integral", "[dynamic]")
{
    struct Golden { double degrees, period; };
    const auto golden = GENERATE(Golden{30, 2.040989889519130}, Golden{90, 2.367841947576237});
    const DynamicReference out = solve_dynamic(make_model(pendulum(golden.degrees)));
    REQUIRE_FALSE(out.frames.empty());
    // A quarter of the period is the way down; four crossings follow within 5 s. Cubic between frames is not
    // needed: crossings are interpolated in the angle, whose second derivative vanishes there.
    std::vector<double> crossing;
    for (std::size_t f = 1; f < out.frames.size(); ++f)
    {
        const double a = out.frames[f - 1][1].x, b = out.frames[f][1].x;
        if (a * b < 0)
            crossing.push_back((static_cast<double>(f) - b / (b - a)) / 60);
    }
    REQUIRE(crossing.size() >= 4);
    const double period = 2 * (crossing[3] - crossing[0]) / 3;
    // The spring stretches by up to 3 m g / k = 3e-4 and the crossings carry (h^2)-sized errors.
    CHECK(period == Approx(golden.period).epsilon(5e-4));
}

TEST_CASE("inner forces and Verlet keep momentum and the energy of a free sheet", "[dynamic]")
{
    Body body;
    body.mesh = samples::right_triangles(4, 4, 0.25, 0.25);
    body.material.stretch_stiffness = 50;
    body.material.bending_stiffness = 1e-3;
    body.velocity = {1, 2, 3};
    body.start_positions = body.mesh.positions;
    for (glm::dvec3& p : body.start_positions)
        p = {1.05 * p.x, p.y, 0.05 * p.x * p.y};
    Scene scene = samples::scene_of(std::move(body), glm::dvec3(0));
    scene.duration = 1;
    const PhysicalModel model = make_model(scene);
    const DynamicReference out = solve_dynamic(model);
    INFO(out.reason);
    CHECK(out.verified);
    glm::dvec3 centre0(0), centre1(0);
    double mass = 0;
    for (std::size_t i = 0; i < model.mass.size(); ++i)
    {
        centre0 += model.mass[i] * out.frames.front()[i];
        centre1 += model.mass[i] * out.frames.back()[i];
        mass += model.mass[i];
    }
    CHECK(glm::distance(centre1, centre0 + mass * glm::dvec3(1, 2, 3)) < 1e-12);
    CHECK(out.error < 1e-3);
}

TEST_CASE("a damped cloth settles where the static reference is", "[dynamic]")
{
    Scene scene = samples::stretched_net(9, 2);
    scene.damping = 5;
    scene.duration = 6;
    const PhysicalModel model = make_model(scene);
    const DynamicReference moving = solve_dynamic(model);
    const StaticReference at_rest = solve_static(model, model.start);
    INFO(moving.reason);
    CHECK(moving.verified);
    const ErrorWeights weights = error_weights(model);
    CHECK(displacement_error(weights, moving.frames.back(), at_rest.positions, model.start).value() < 1e-5);
}

TEST_CASE("a box sticks on a slope below its friction and slides with the known distance above", "[dynamic]")
{
    CHECK(slide(on_plane(0.5, 0.51)) < 1e-12);
    CHECK(slide(on_plane(0.5, 0.49)) == Approx(0.043871653719).epsilon(1e-9));
    CHECK(slide(on_plane(0.5, 0.3)) == Approx(0.5 * 1.754866148742).epsilon(1e-9));
    Scene flat = on_plane(0, 0.5, {5, 0, 0});
    flat.duration = 2;
    CHECK(slide(flat) == Approx(25 / (2 * 0.5 * 9.81)).epsilon(1e-3));
}

TEST_CASE("contact keeps the gap of the cloth, stops the fall and is first order", "[dynamic]")
{
    Scene scene = particle({0.3, 1, 0}, {0, 0, 0}, 0.01);
    Collider ball;
    ball.kind = ColliderKind::sphere;
    ball.radius = 0.5;
    scene.colliders.push_back(ball);
    const DynamicReference out = solve_dynamic(make_model(scene));
    REQUIRE(out.order == 1);
    bool touched = false;
    for (const std::vector<glm::dvec3>& frame : out.frames)
    {
        CHECK(glm::length(frame[0]) > 0.51 - 1e-12);
        touched = touched || glm::length(frame[0]) < 0.51 + 1e-6;
    }
    CHECK(touched);
}

TEST_CASE("a moving plane carries what lies on it, by push and by friction", "[dynamic]")
{
    Scene scene = on_plane(0, 1);
    scene.colliders[0].motion.resize(2);
    scene.colliders[0].motion[1].time = 1;
    scene.colliders[0].motion[1].translate = {0.2, 0.3, 0};
    const DynamicReference out = solve_dynamic(make_model(scene));
    REQUIRE_FALSE(out.frames.empty());
    // 0.2 m/s is reached within 0.02 s at 1 g of friction.
    CHECK(out.frames.back()[0].x == Approx(0.2).margin(0.2 * 0.2 / (2 * 9.81) + 1e-3));
    CHECK(out.frames.back()[0].y == Approx(0.3).epsilon(1e-9));
}

TEST_CASE("a moving pin is where its keys say at every frame", "[dynamic]")
{
    Scene scene = oscillator();
    Pin& pin = scene.bodies[0].pins[0];
    pin.motion.resize(2);
    pin.motion[1].time = 0.5;
    pin.motion[1].translate = {0, 1, 0};
    const DynamicReference out = solve_dynamic(make_model(scene));
    REQUIRE(out.frames.size() == 61);
    for (std::size_t f = 0; f <= 60; ++f)
        CHECK(out.frames[f][0].y == Approx(std::min(1.0, static_cast<double>(f) / 30)).margin(1e-12));
}

TEST_CASE("one thread or two give the same bits", "[dynamic]")
{
    const PhysicalModel model = make_model(samples::stretched_net(5, 2));
    DynamicOptions options;
    options.duration = 0.2;
    const Frames two = solve_dynamic(model, options).frames;
    options.two_threads = false;
    CHECK(solve_dynamic(model, options).frames == two);
}

TEST_CASE("what the dynamic reference cannot answer it refuses with a reason", "[dynamic]")
{
    const auto reason = [](const Scene& scene, DynamicOptions options = {})
    {
        const DynamicReference out = solve_dynamic(make_model(scene), options);
        CHECK_FALSE(out.verified);
        CHECK(out.frames.empty());
        return out.reason;
    };
    Scene rigid = oscillator();
    rigid.bodies[0].springs[0].compliance = 0;
    CHECK(reason(rigid).find("1 elements are rigid") == 0);
    Scene stiff = oscillator();
    stiff.bodies[0].springs[0].compliance = 1e-18;
    CHECK(reason(stiff).find("too stiff or too long") == 0);
    Scene inside = on_plane(0, 0);
    inside.bodies[0].mesh.positions[0].y = -0.1;
    CHECK(reason(inside).find("starts inside") != std::string::npos);
    DynamicOptions verlet;
    verlet.scheme = Scheme::verlet;
    CHECK(reason(on_plane(0, 0), verlet).find("first order") != std::string::npos);
}

TEST_CASE("a chaotic motion is not called verified, but its beginning is", "[dynamic]")
{
    Body body; // a double pendulum let go from high up is chaotic
    body.mesh.positions = {{0, 0, 0}, {0.5, 0.8, 0}, {1.2, 1.4, 0.2}};
    body.springs = {{0, 1, 0.9, 1e-3}, {1, 2, 0.9, 1e-3}};
    body.vertex_masses = {1, 1, 1};
    body.pins.emplace_back().vertices = {0};
    Scene scene = samples::scene_of(std::move(body));
    scene.duration = 60;
    const DynamicReference out = solve_dynamic(make_model(scene));
    CAPTURE(out.orders, out.error, out.reason);
    CHECK_FALSE(out.verified);
    // The orders told are of the frame that fails, not of the last one.
    CHECK(out.reason.find("up to frame " + std::to_string(out.verified_frames + 1) +
                          " the observed orders") != std::string::npos);
    // But its beginning is: the same as a run that stops there.
    CHECK(out.verified_frames > 30);
    CHECK(out.verified_frames < 3000);
    CHECK(out.error < 0.1);
    scene.duration = static_cast<double>(out.verified_frames) * scene.timestep;
    const DynamicReference beginning = solve_dynamic(make_model(scene));
    CHECK(beginning.verified);
    CHECK(beginning.error == Approx(out.error).epsilon(1e-9));
    CHECK(beginning.frames.back() == out.frames[out.verified_frames]);
}
