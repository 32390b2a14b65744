// The cases of the robustness map (methods 2.A to 2.G, those of cloth).

#include "hard/map_parts.hpp"

namespace taut::hard {
namespace {

/// Free cloth whose vertices start elsewhere.
template <typename F>
Scene placed(F&& f)
{
    Scene scene = free_cloth(6);
    scene.damping = 0.5;
    Body& body = scene.bodies[0];
    body.start_positions = body.mesh.positions;
    conformance::Random random(7);
    for (glm::dvec3& x : body.start_positions)
        x = f(x, random);
    return scene;
}

Scene rope(double bob_over_link)
{
    Scene scene = test::chain(20, 1e5, 0.01);
    scene.bodies[0].vertex_masses.back() = 0.01 * bob_over_link;
    scene.damping = 0.5;
    return scene;
}

void add_stiffness(std::vector<MapCase>& out)
{
    out.push_back({"A04", "stiff cloth, 1e8 N/m, hung by one edge",
                   [] {
                       Scene s = with_stretch(hanging(8, 2), 1e8);
                       s.bodies[0].pins[0] = hold({0, 1, 2, 3, 4, 5, 6, 7, 8});
                       return s;
                   }(),
                   300, [](const Journey& j) { return above("stretch", j.last.max_stretch, 0.05); }});
    out.push_back({"A06", "rope, last link 1,800 times heavier", rope(1800), 300,
                   [](const Journey& j) { return above("stretch", j.last.max_stretch, 0.1); },
                   kPositionBased});
    out.push_back({"A08", "rope, bob 1e5 times heavier", rope(1e5), 120,
                   [](const Journey& j) { return above("stretch", j.last.max_stretch, 5, 100); },
                   kPositionBased});
    for (const double step : {0.002, 0.1, 1.0})
        out.push_back({"A09", "step of " + shown(step) + " s",
                       [&] {
                           Scene s = with_stretch(hanging(6, 1), 100);
                           s.timestep = step;
                           return s;
                       }(),
                       step < 0.01 ? 200 : 60,
                       [](const Journey& j) {
                           // Cloth of one kilogram that steps of a second throw about by some metres a
                           // substep.
                           return first_of(no_energy_gained(j, j.world.scene().timestep > 0.5 ? 1000 : 1),
                                           above("stretch", j.last.max_stretch, 0.5));
                       },
                       step > 0.01 ? kPositionBased | only(MethodKind::vbd) : 0});
    out.push_back({"A15", "masses of 1e12, 1 and 1e-12 kg in one body",
                   [] {
                       Scene s = free_cloth(2);
                       s.bodies[0].vertex_masses = {1e12, 1, 1e-12, 1, 1, 1e12, 1e-12, 1, 1};
                       return s;
                   }(),
                   60,
                   [](const Journey& j) {
                       return above("movement at rest", largest_distance(j.start, j.world.positions()), 1e-5);
                   }});
    out.push_back({"A13", "everything pinned",
                   [] {
                       Scene s = test::hanging(2);
                       s.bodies[0].pins = {hold({0, 1, 2, 3, 4, 5, 6, 7, 8})};
                       return s;
                   }(),
                   30,
                   [](const Journey& j) {
                       return above("movement", largest_distance(j.start, j.world.positions()), 0);
                   }});
}

/// The stable step is that of the flat cloth. Hinges of thin triangles are stiffer: explicit forces gain
/// energy there, and none with 1,000 substeps.
Missed crumpled(const Journey& j) { return no_energy_gained(j, 100); }

void add_geometry(std::vector<MapCase>& out)
{
    out.push_back({"B01", "spring of rest length 0",
                   [] {
                       Body body = particles({{0, 0, 0}, {0.1, 0, 0}});
                       body.springs = {{0, 1, 0, 0.01}};
                       Scene s = alone(body);
                       s.damping = 1;
                       return s;
                   }(),
                   120, gains_no_energy});
    for (const double apart : {0.0, 1e-20, 1e-30})
        out.push_back({apart == 0 ? "B02" : "B03", "spring of 0.1 m, ends " + shown(apart) + " m apart",
                       [&] {
                           Body body = particles({{0, 0, 0}, {apart, 0, 0}});
                           body.springs = {{0, 1, 0.1, 0.01}};
                           return alone(body);
                       }(),
                       30, sound});
    out.push_back({"B04", "every vertex twice, 1e-9 m apart, joined",
                   [] {
                       Scene s = hanging(4);
                       Body& body = s.bodies[0];
                       for (std::uint32_t v = 0; v < 25; ++v)
                       {
                           body.mesh.positions.push_back(body.mesh.positions[v] + glm::dvec3(1e-9, 0, 0));
                           body.springs.push_back({v, 25 + v, 1e-9, 1e-2});
                       }
                       body.mesh.grid_columns = body.mesh.grid_rows = 0;
                       return s;
                   }(),
                   60, gains_no_energy});
    out.push_back({"B10",
                   "cloth flattened onto its middle line",
                   placed([](const glm::dvec3& x, conformance::Random& r) {
                       return glm::dvec3(1e-4 * r.uniform(-1, 1), x.y, 1e-4 * r.uniform(-1, 1));
                   }),
                   300,
                   gains_no_energy,
                   0,
                   {},
                   100});
    out.push_back({"B12", "cloth in a point, 1e-6 m of noise",
                   placed([](const glm::dvec3&, conformance::Random& r) {
                       return 1e-6 * glm::dvec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1));
                   }),
                   300, gains_no_energy});
    out.push_back({"B13", "cloth scrambled in a cube of 1 m",
                   placed([](const glm::dvec3&, conformance::Random& r) {
                       return glm::dvec3(r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5));
                   }),
                   300, crumpled, only(MethodKind::mass_spring)});
    for (const double scale : {10.0, 0.01})
        out.push_back({"B14", "cloth scaled by " + shown(scale),
                       placed([&](const glm::dvec3& x, conformance::Random&) { return scale * x; }), 300,
                       crumpled, only(MethodKind::mass_spring)});
    out.push_back({"B16", "flat cloth at rest, no gravity", free_cloth(6), 300, [](const Journey& j) {
                       return above("movement", largest_distance(j.start, j.world.positions()), 1e-6);
                   }});
    out.push_back(
        {"B17", "hinges folded onto each other", placed([](const glm::dvec3& x, conformance::Random&) {
             return glm::dvec3(-std::abs(x.x), x.y, x.z);
         }),
         300, [](const Journey& j) { return no_energy_gained(j, 2e4); },
         only(MethodKind::pbd)}); // its hinges are as stiff as a sweep allows, whatever the material
    out.push_back({"B18", "hanging cloth 10 km from the origin",
                   [] {
                       Scene s = hanging(6);
                       for (glm::dvec3& x : s.bodies[0].mesh.positions)
                           x += glm::dvec3(1e4);
                       return s;
                   }(),
                   120,
                   [](const Journey& j) {
                       return first_of(gains_no_energy(j), above("stretch", j.last.max_stretch, 0.1));
                   }});
}

void add_topology(std::vector<MapCase>& out)
{
    const auto fan = [](std::uint32_t blades, bool manifold) {
        Body body;
        body.shape.kind = ShapeKind::mesh;
        body.mesh.positions = {{0, 0, 0}};
        for (std::uint32_t k = 0; k < blades; ++k)
        {
            const double angle = 6.283185307179586 * k / blades;
            body.mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
            if (manifold)
                body.mesh.triangles.push_back({0, k + 1, (k + 1) % blades + 1});
        }
        if (!manifold)
        {
            body.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-1, 0.5, 0.1}, {0, 0.5, 1}};
            body.mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
        }
        body.material.stretch_stiffness = 1000;
        body.material.bending_stiffness = 1e-4;
        body.pins = {hold({1})};
        Scene s;
        s.bodies = {body};
        s.damping = 0.5;
        return s;
    };
    out.push_back({"C01", "three triangles on one edge", fan(5, false), 120, gains_no_energy});
    out.push_back({"C02", "fan of 300 triangles at one vertex", fan(300, true), 60, calm});
    out.push_back({"C05", "one free particle",
                   [] {
                       Scene s = alone(particles({{0, 0, 0}}));
                       s.gravity = {0, -9.81, 0};
                       return s;
                   }(),
                   60,
                   [](const Journey& j) {
                       const double exact = -9.81 * j.world.time() * j.world.time() / 2;
                       return above("error of the fall", std::abs(j.world.positions()[0].y / exact - 1),
                                    1e-5);
                   }});
    out.push_back({"C06", "the same spring twice",
                   [] {
                       Body body = particles({{0, 0, 0}, {0, -1, 0}});
                       body.springs = {{0, 1, 1, 1e-2}, {0, 1, 1, 1e-2}};
                       body.pins = {hold({0})};
                       Scene s = alone(body);
                       s.gravity = {0, -9.81, 0};
                       s.damping = 5;
                       return s;
                   }(),
                   300,
                   [](const Journey& j) {
                       return above("error of the stretch", std::abs(j.last.max_stretch - 9.81 / 200), 2e-3);
                   },
                   only(MethodKind::pbd)});
    out.push_back({"C09", "chain of 2,000 links",
                   [] {
                       Scene s = test::chain(2000, 1e5, 0.001, 20);
                       s.damping = 0.5;
                       return s;
                   }(),
                   20, sound});
}

} // namespace

std::vector<MapCase> map_cases()
{
    std::vector<MapCase> out;
    add_stiffness(out);
    add_geometry(out);
    add_topology(out);
    add_contact_and_more(out);
    add_more(out);
    add_slides(out);
    add_repeats(out);
    add_solids(out);
    add_loaded_solids(out);
    return out;
}

} // namespace taut::hard
