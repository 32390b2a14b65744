// Position-based dynamics: its stiffness, its order, its schemes against each other, what it keeps.

#include "hard/cases.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <cstring>

using namespace taut;
using namespace taut::hard;

namespace {

Scene as_pbd(Scene scene, const char* scheme, std::uint32_t iterations, double stretch = 1, double bend = 1)
{
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = option_named<ElementScheme>(scheme);
    scene.method.substeps = 1;
    scene.method.iterations = iterations;
    scene.method.stretch = stretch;
    scene.method.bend = bend;
    scene.accept.stretch = 2; // tests of what sweeps do, not of what they solve
    return scene;
}

/// Where the last vertex of a chain with links of 1 / `links` m comes to hang below 1 m, m.
double extension(const std::shared_ptr<Device>& device, std::uint32_t links, const char* scheme, double k,
                 std::uint32_t iterations, int steps, const char* precision = "double")
{
    Scene scene = as_pbd(test::chain(links, 1000, 0.1), scheme, iterations, k);
    scene.damping = links > 1 ? 10 : 0;
    scene.method.precision = option_named<Precision>(precision);
    World world(scene, device);
    run(world, steps);
    return -world.positions()[links].y - 1;
}

constexpr double kStepFall = 9.81 / 3600; ///< h^2 g, m

} // namespace

TEST_CASE("a spring of stiffness k is one of k_eff h^2 / m = k / (1 - k), whatever the iterations (A9)")
{
    on_every_device([](const auto& device) {
        for (const char* scheme : kPbdSchemes)
            for (const std::uint32_t iterations : {1u, 4u, 8u})
            {
                CAPTURE(scheme, iterations);
                // Four iterations at 0.5 each are 0.9375, at 0.9 each 0.9999: 15 and 9999.
                const double soft = kStepFall / extension(device, 1, scheme, 0.9375, iterations, 120);
                const double hard = kStepFall / extension(device, 1, scheme, 0.9999, iterations, 120);
                const double single =
                    kStepFall / extension(device, 1, scheme, 0.9375, iterations, 120, "float");
                if (iterations == 4)
                {
                    note("A9", *device, "k_eff h^2 / m, S = 0.9375", soft);
                    note("A9", *device, "k_eff h^2 / m, S = 0.9999", hard);
                    note("A9", *device, "k_eff h^2 / m, S = 0.9375, float", single);
                }
                CHECK(soft == Approx(15).epsilon(1e-5));
                CHECK(hard == Approx(9999).epsilon(1e-3)); // the share is a float: 6e-8 of 0.1, four times
                CHECK(single == Approx(15).epsilon(1e-3)); // half a unit of 1 m against 2e-4 m
            }
    });
}

TEST_CASE("a soft hanging chain has one length at 1 and at 8 iterations, that of its springs")
{
    // A link between two free vertices moves each by half: k_eff = m / (2 h^2) S / (1 - S) to first order in
    // S; the upper one, held at one end, twice that.
    constexpr std::uint32_t links = 5;
    const auto device = test_device("cpu:serial");
    double before = 1;
    for (const double k : {0.1, 0.05, 0.025})
    {
        double exact = links * kStepFall * (1 - k) / k;
        for (std::uint32_t below = 1; below < links; ++below)
            exact += 2 * below * kStepFall * (1 - k) / k;
        const double one = extension(device, links, "coloured", k, 1, 2400);
        const double eight = extension(device, links, "coloured", k, 8, 2400);
        const double jacobi = extension(device, links, "node_centric", k, 8, 2400);
        note("pbd", *device, "chain: length at 8 iterations / at 1", eight / one);
        note("pbd", *device, "chain: length at 1 iteration / formula", one / exact);
        note("pbd", *device, "chain: averaged Jacobi at 8 / coloured at 8", jacobi / eight);
        const double apart = std::abs(eight / one - 1);
        CHECK(apart < 1.5 * k);
        CHECK(std::abs(one / exact - 1) < 2 * k);
        CHECK(apart < 0.7 * before); // first order in k
        before = apart;
    }
}

TEST_CASE("rest stays at rest under every scheme of PBD (B16)")
{
    on_every_device([](const auto& device) {
        for (const char* scheme : kPbdSchemes)
        {
            Scene scene = as_pbd(free_cloth(6), scheme, 4);
            World world(scene, device);
            run(world, steps_for(*device, 1000, 100));
            const StepReport report = check_sound(world);
            CHECK(largest_distance(world.positions(), scene.bodies[0].mesh.positions) < 1e-6);
            CHECK(report.kinetic_energy < 1e-10);
        }
    });
}

TEST_CASE("free fall under PBD is the parabola")
{
    on_every_device([](const auto& device) {
        for (const char* scheme : kPbdSchemes)
        {
            Scene scene = as_pbd(free_cloth(3), scheme, 4);
            scene.gravity = {0, -9.81, 0};
            World world(scene, device);
            const auto start = world.positions();
            run(world, 60);
            const double fall = 9.81 / 2;
            CHECK(fall == Approx(4.905));
            double worst = 0;
            const auto end = world.positions();
            for (std::size_t v = 0; v < start.size(); ++v)
                worst = std::max(worst, glm::length(start[v] - glm::dvec3(0, fall, 0) - end[v]) / fall);
            note("pbd", *device, "free fall", worst);
            CHECK(worst < 1e-5);
        }
    });
}

namespace {

/// A sheet pulled and sheared, which flies.
Scene pulled_sheet(const char* scheme, std::uint32_t iterations)
{
    Scene scene = as_pbd(free_cloth(6), scheme, iterations, 0.8, 0.5);
    Body& body = scene.bodies[0];
    body.velocity = {1, 0.5, 0};
    conformance::Random random(5);
    for (const glm::dvec3& x : body.mesh.positions)
        body.start_positions.push_back(glm::dvec3(1.3 * x.x, x.y + 0.3 * x.x, random.uniform(-0.05, 0.05)));
    return scene;
}

double momentum_error(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World world(scene, device);
    run(world, steps);
    return check_sound(world).momentum_error;
}

/// Equal particles in a circle, one spring to either neighbour: every vertex has two constraints.
Scene ring(const char* scheme)
{
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 12; ++i)
        places.emplace_back(std::cos(0.5236 * i) * 1.3, std::sin(0.5236 * i), 0.1 * (i % 3));
    Body body = particles(places, 0.1);
    for (std::uint32_t i = 0; i < 12; ++i)
        body.springs.push_back({i, (i + 1) % 12, 0.5, 1e-3});
    body.velocity = {1, 0, 0};
    return as_pbd(alone(body), scheme, 4, 0.8);
}

} // namespace

TEST_CASE("coloured PBD keeps momentum; averaging does where all vertices have as many constraints")
{
    on_every_device([](const auto& device) {
        const double coloured = momentum_error(pulled_sheet("coloured", 4), device, 60);
        note("pbd", *device, "momentum error, sheet, coloured", coloured);
        CHECK(coloured < 1e-5);
        for (const char* scheme : {"node_centric", "constraint_centric"})
        {
            const double even = momentum_error(ring(scheme), device, 60);
            const double uneven = momentum_error(pulled_sheet(scheme, 4), device, 60);
            note("pbd", *device, "momentum error, ring, Jacobi", even);
            note("pbd", *device, "momentum error, sheet, Jacobi", uneven);
            CHECK(even < 1e-5);
            // The ends of a spring divide its correction by different numbers (docs/methods/pbd.md).
            CHECK(uneven > 1e-4);
            CHECK(uneven < 0.2);
        }
    });
}

TEST_CASE("pins keep their bits under every scheme, and the two Jacobi schemes give one state")
{
    on_every_device([](const auto& device) {
        std::vector<WorldState> states;
        for (const char* scheme : kPbdSchemes)
        {
            Scene scene = as_pbd(test::hanging(7), scheme, 5, 0.9, 0.5);
            scene.bodies[0].material.bending_stiffness = 1e-4;
            scene.method.relaxation = std::string(scheme) == "coloured" ? 1 : 1.5;
            World world(scene, device);
            const auto start = world.positions();
            run(world, 60);
            const auto end = world.positions();
            for (const std::uint32_t pin : {0u, 7u})
                CHECK(end[pin] == start[pin]);
            check_lasting(world);
            states.push_back(world.state());
        }
        CHECK_FALSE(same_state(states[0], states[1]));
        CHECK(same_state(states[1], states[2]));
    });
}

namespace {

/// The largest |l - L| / L after one step from a pulled shape without gravity.
double strain_left(const std::shared_ptr<Device>& device, const char* scheme, std::uint32_t iterations,
                   double relaxation, double spectral_radius = 0)
{
    Scene scene = as_pbd(test::hanging(3), scheme, iterations);
    scene.gravity = {0, 0, 0};
    scene.method.relaxation = relaxation;
    scene.method.spectral_radius = spectral_radius;
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
        scene.bodies[0].start_positions.push_back({x.x, 1.05 * (x.y - 0.5) + 0.5, 0.1 * x.y});
    World world(scene, device);
    world.step();
    const auto places = world.positions();
    double worst = 0;
    for (const StretchElement& e : make_model(world.scene()).springs)
        worst = std::max(worst, std::abs(glm::distance(places[e.a], places[e.b]) / e.rest_length - 1));
    return worst;
}

} // namespace

TEST_CASE("coloured and Jacobi iterations come to rest at the same: every length as it should be")
{
    on_every_device([](const auto& device) {
        const std::uint32_t many = device->info().executor.starts_with("cpu") ? 1000 : 400;
        for (const char* scheme : kPbdSchemes)
        {
            const double few = strain_left(device, scheme, 50, 1);
            const double left = strain_left(device, scheme, many, 1);
            note("pbd", *device, "strain after 50 iterations", few);
            note("pbd", *device, "strain after many iterations", left);
            CHECK(left < 0.5 * few);
            CHECK(left < (many == 1000 ? 1e-4 : 2e-3));
        }
    });
}

TEST_CASE("over-relaxation and Chebyshev's weights bring averaged Jacobi nearer in as many iterations")
{
    on_every_device([](const auto& device) {
        const double plain = strain_left(device, "node_centric", 100, 1);
        const double over = strain_left(device, "node_centric", 100, 1.5);
        const double chebyshev = strain_left(device, "node_centric", 100, 1, 0.97);
        const double coloured = strain_left(device, "coloured", 100, 1);
        note("pbd", *device, "strain after 100 iterations: Jacobi", plain);
        note("pbd", *device, "Jacobi, relaxation 1.5", over);
        note("pbd", *device, "Jacobi, Chebyshev 0.97", chebyshev);
        note("pbd", *device, "coloured", coloured);
        CHECK(over < 0.8 * plain);
        CHECK(chebyshev < 0.5 * plain);
        CHECK(coloured < over);
    });
}

TEST_CASE("corrections exaggerated until they feed on themselves end as diverged, and never as NaN")
{
    on_every_device([](const auto& device) {
        Scene scene = as_pbd(test::hanging(16), "node_centric", 8);
        scene.bodies[0].material.bending_stiffness = 1e-3;
        World calm(scene, device);
        run(calm, 120);
        check_lasting(calm);
        scene.method.relaxation = 1.9;
        scene.method.spectral_radius = 0.999;
        World world(scene, device);
        double before = 0;
        int steps = 0;
        for (; steps < 120 && measure(world).status != Status::diverged; steps += 10)
        {
            before = measure(world).max_stretch;
            run(world, 10);
        }
        note("pbd", *device, "steps until an exaggerated Jacobi counts as diverged", steps);
        note("pbd", *device, "largest strain ten steps before", before);
        CHECK(steps < 120);
        CHECK(finite(world.positions()));
        CHECK(finite(world.velocities()));
        run(world, 60);
        CHECK(finite(world.positions()));
        CHECK(to_string(measure(world).status) == "diverged");
    });
}

namespace {

/// Coloured PBD as one would write it down: a loop over the plan's constraints in their order, in float.
class PlainPbd
{
public:
    PlainPbd(const World& world, std::uint32_t iterations, double k)
        : plan_(world.plan()),
          iterations_(iterations),
          share_(static_cast<float>(1 - std::pow(1 - k, 1.0 / iterations)))
    {
        const auto& bytes = plan_.buffers[plan_.constraints.front().buffer].initial;
        springs_.resize(bytes.size() / sizeof(springs_[0]));
        std::memcpy(springs_.data(), bytes.data(), bytes.size());
        const WorldState state = world.state();
        x_.resize(plan_.vertex_count);
        std::memcpy(x_.data(), state.position.data(), state.position.size());
        v_.assign(plan_.vertex_count, {0, 0.5f * 9.81f / 60, 0}); // gravity's first kick is half
    }

    void step(float h)
    {
        std::vector<glm::vec3> moved(x_.size(), glm::vec3(0));
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (x_[i].w > 0)
                moved[i] = (v_[i] + glm::vec3(0, -9.81f, 0) * h) * h;
        for (std::uint32_t n = 0; n < iterations_; ++n)
            for (const auto& c : springs_)
            {
                const glm::vec3 d = glm::vec3(x_[c.a] - x_[c.b]) + (moved[c.a] - moved[c.b]);
                const float length = glm::length(d), w = x_[c.a].w + x_[c.b].w;
                const glm::vec3 push = d * ((c.rest_length - length) * share_ / (w * length));
                moved[c.a] += push * x_[c.a].w;
                moved[c.b] -= push * x_[c.b].w;
            }
        for (std::size_t i = 0; i < x_.size(); ++i)
        {
            x_[i] += glm::vec4(moved[i], 0);
            v_[i] = moved[i] / h;
        }
    }

    double distance_to(const World& world) const
    {
        const auto places = world.positions();
        double worst = 0;
        for (std::size_t i = 0; i < x_.size(); ++i)
            worst = std::max(worst, glm::distance(glm::dvec3(x_[i]), places[plan_.original[i]]));
        return worst;
    }

private:
    const Plan& plan_;
    std::uint32_t iterations_;
    float share_;
    std::vector<layout::DistanceConstraint<float>> springs_;
    std::vector<glm::vec4> x_;
    std::vector<glm::vec3> v_;
};

} // namespace

TEST_CASE("coloured PBD is a plain loop over its constraints in their order")
{
    on_every_device([](const auto& device) {
        Scene scene = as_pbd(test::hanging(10), "coloured", 3, 0.9);
        World world(scene, device);
        PlainPbd plain(world, 3, 0.9);
        for (int i = 0; i < 20; ++i)
        {
            world.step();
            plain.step(1.0f / 60);
        }
        note("pbd", *device, "distance to the plain loop after 20 steps, m", plain.distance_to(world));
        CHECK(plain.distance_to(world) < 1e-6);
        CHECK(glm::distance(world.positions()[60], scene.bodies[0].mesh.positions[60]) > 0.01);
    });
}
