// A descent makes no energy: what hangs or slides has never more than it began with, at settings that a few
// sweeps do not solve.

#include "hard/vbd_cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// Cloth of 1 m that lies flat and hangs by two corners.
Scene hung_flat(double stretch, double bending, double damping)
{
    Scene scene;
    Body body;
    body.shape.cells = {8, 8};
    body.material.stretch_stiffness = stretch;
    body.material.bending_stiffness = bending;
    body.material.stretch_damping = damping;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.pins = {hold({0, 8})};
    scene.bodies = {body};
    return resolve(scene);
}

/// Rubber of half a metre, held by its upper face or loose.
Scene block(double modulus, double ratio, bool held)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 3, 3};
    body.shape.box_size = {0.5, 0.5, 0.5};
    body.material.density = 1000;
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = ratio;
    std::vector<std::uint32_t> top;
    for (std::uint32_t k = 0; k < 16; ++k)
        top.push_back(k % 4 + 12 + 16 * (k / 4));
    if (held)
        body.pins = {hold(top)};
    scene.bodies = {body};
    return resolve(scene);
}

/// The most that the energy with gravity rose above that of the start, over the weight times a metre.
double risen(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World world(scene, device);
    const double start = energy(world);
    double highest = start, mass = 0;
    for (const double m : make_model(world.scene()).mass)
        mass += m;
    for (int i = 0; i < steps; ++i)
    {
        world.step();
        highest = std::max(highest, energy(world));
    }
    CHECK(finite(world.positions()));
    return (highest - start) / (9.81 * mass);
}

} // namespace

TEST_CASE("vbd makes no energy, however stiff, however few sweeps [hard]")
{
    struct Setting
    {
        const char* name;
        Scene scene;
    };
    const Setting settings[] = {{"bending 100 N m", hung_flat(1e4, 100, 0)},
                                {"bending 1000 N m", hung_flat(1e4, 1000, 0)},
                                {"stretch 1e5 N/m", hung_flat(1e5, 0, 0)},
                                {"stretch 1e7 N/m", hung_flat(1e7, 0, 0)},
                                {"damping 1 s", hung_flat(1e4, 0, 1)},
                                {"nu 0.4999", block(1e5, 0.4999, true)}};
    on_every_device([&](const auto& device) {
        for (const Setting& s : settings)
            for (const char* precision : {"float", "double"})
                for (const std::uint32_t sweeps : {1u, 4u, 20u})
                {
                    if (sweeps == 20 && steps_for(*device, 1, 0) == 0)
                        continue;
                    CAPTURE(s.name, precision, sweeps);
                    Scene scene = by_vbd(s.scene, 10, sweeps);
                    scene.method.precision = option_named<Precision>(precision);
                    const double rise = risen(scene, device, steps_for(*device, 60, 3));
                    note(s.name, *device, "rise over weight, m", rise);
                    CHECK(rise < 1e-5);
                }
    });
}

TEST_CASE("a box of few sweeps that slides without friction keeps its momentum [hard]")
{
    on_every_device([](const auto& device) {
        for (const double modulus : {1e4, 1e6, 1e8})
            for (const std::uint32_t sweeps : {1u, 2u})
            {
                CAPTURE(modulus, sweeps);
                Scene scene = by_vbd(block(modulus, 0.3, false), 4, sweeps);
                scene.bodies[0].velocity = {2, 0, 0.5};
                Collider floor;
                floor.kind = ColliderKind::plane;
                floor.point = {0, -0.251, 0};
                scene.colliders = {floor};
                World world(scene, device);
                run(world, steps_for(*device, 60, 5));
                const PhysicalModel model = make_model(world.scene());
                glm::dvec3 momentum(0);
                double mass = 0;
                const auto v = world.velocities();
                for (std::size_t i = 0; i < v.size(); ++i)
                {
                    momentum += model.mass[i] * v[i];
                    mass += model.mass[i];
                }
                note("slide", *device, "momentum kept", momentum.x / (2 * mass));
                CHECK(std::abs(momentum.x / mass - 2) < 2e-4);
                CHECK(std::abs(momentum.z / mass - 0.5) < 2e-4);
            }
    });
}

TEST_CASE("what flows takes energy, and no report says that it makes some [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* method : {"mass_spring", "vbd", "implicit_euler", "xpbd"})
        {
            CAPTURE(method);
            Scene scene = hung_flat(1000, 0, 0);
            scene.bodies[0].pins.clear();
            scene.bodies[0].velocity = {0, -10, 0};
            scene.bodies[0].material.plastic_yield = 0.01;
            scene.bodies[0].material.plastic_creep = kInfinity;
            Collider ball;
            ball.kind = ColliderKind::sphere;
            ball.point = {0, -0.5, 0};
            ball.radius = 0.3;
            scene.colliders = {ball};
            scene.method.type = option_named<MethodKind>(method);
            scene.method.substeps = 40;
            scene.method.stability = StabilityRule::substep;
            const double rise = risen(resolve(scene), device, steps_for(*device, 60, 4));
            note(method, *device, "rise over weight, m", rise);
            CHECK(rise < 0.1);
        }
    });
}

TEST_CASE("cloth of a tenth of a millimetre leaves a collider without being torn by it [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene;
        Body body;
        body.shape.cells = {8, 8};
        body.shape.size = {1e-4, 1e-4};
        body.transform.rotate_axis = {1, 0, 0};
        body.transform.rotate_degrees = -90;
        scene.bodies = {body}; // its thickness is 1 mm: all of it starts too near
        scene.gravity = {0, 0, 0};
        Collider ball;
        ball.kind = ColliderKind::sphere;
        ball.point = {0, -2e-4, 0};
        ball.radius = 1e-4;
        scene.colliders = {ball};
        World world(by_vbd(resolve(scene), 10, 4), device);
        double worst = 0;
        for (int i = 0; i < steps_for(*device, 60, 10); ++i)
        {
            world.step();
            worst = std::max(worst, largest_strain(world));
        }
        note("0.1 mm", *device, "largest strain", worst);
        CHECK(worst < 0.5);
    });
}
