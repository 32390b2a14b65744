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
    scene.damping = 4;
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
                   300, [](const Journey& j) { return above("stretch", j.last.max_stretch, 0.05); },
                   kSweeps});
    for (const double ratio : {1800.0, 1e5})
        out.push_back({ratio > 1e4 ? "A08" : "A06",
                       ratio > 1e4 ? "rope, bob 1e5 times heavier" : "rope, last link 1,800 times heavier",
                       rope(ratio), 300, [](const Journey& j) { return length_error(j, 1e5); },
                       ratio > 1e4 ? kPositionBased | kHoldsThreshold : kPositionBased});
    for (const double step : {0.002, 0.1, 1.0})
        out.push_back({"A09", "step of " + shown(step) + " s",
                       [&] {
                           Scene s = with_stretch(hanging(6, 5), 100);
                           s.timestep = step;
                           return s;
                       }(),
                       step < 0.01 ? 1500 : 60, [](const Journey& j) { return hangs(j, kSoftHang); },
                       step > 0.01 ? kPositionBased | only(MethodKind::vbd) : kOwnStiffness});
    out.push_back({"A15", "masses of 1e12, 1 and 1e-12 kg in one body",
                   [] {
                       Scene s = free_cloth(2);
                       Body& body = s.bodies[0];
                       body.vertex_masses = {1e12, 1, 1e-12, 1, 1, 1e12, 1e-12, 1, 1};
                       body.start_positions = body.mesh.positions;
                       body.start_positions[2] += glm::dvec3(0.1, 0, 0);
                       body.start_positions[6] += glm::dvec3(0, -0.1, 0);
                       s.damping = 5;
                       return s;
                   }(),
                   120,
                   [](const Journey& j) {
                       const auto x = j.world.positions();
                       const double heavy =
                           std::max(glm::distance(j.start[0], x[0]), glm::distance(j.start[5], x[5]));
                       return each_of(back_in_shape(j, 0.01), above("movement of 1e12 kg, m", heavy, 1e-5));
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

/// What opens to its length, or says that it has no direction and stays.
Findings opened_or_counted(const Journey& j)
{
    const auto x = j.world.positions();
    const bool counted = j.last.warnings.count("degenerate") > 0;
    const double apart = glm::distance(x[0], x[1]);
    return above("error of the length / length, or movement of what is counted",
                 counted ? glm::distance(x[0], j.start[0]) : std::abs(apart / 0.1 - 1), 0.01);
}

/// The stable step is that of the flat cloth. Hinges of thin triangles are stiffer: explicit forces gain
/// energy there, and none with 1,000 substeps.
Findings uncrumpled(const Journey& j) { return back_in_shape(j, 0.05); }

void add_geometry(std::vector<MapCase>& out)
{
    out.push_back({"B01", "spring of rest length 0",
                   [] {
                       Body body = particles({{0, 0, 0}, {0.1, 0, 0}});
                       body.springs = {{0, 1, 0, 0.01}};
                       Scene s = alone(body);
                       s.damping = 10;
                       return s;
                   }(),
                   120,
                   [](const Journey& j) {
                       const auto x = j.world.positions();
                       return above("distance left / that of the start", glm::distance(x[0], x[1]) / 0.1,
                                    0.01);
                   }});
    for (const double apart : {0.0, 1e-20, 1e-30})
        out.push_back({apart == 0 ? "B02" : "B03", "spring of 0.1 m, ends " + shown(apart) + " m apart",
                       [&] {
                           Body body = particles({{0, 0, 0}, {apart, 0, 0}});
                           body.springs = {{0, 1, 0.1, 0.01}};
                           Scene s = alone(body);
                           s.damping = 10;
                           return s;
                       }(),
                       120, opened_or_counted});
    out.push_back({"B04", "every vertex twice, 1e-9 m apart, joined",
                   [] {
                       Scene s = hanging(4, 5);
                       Body& body = s.bodies[0];
                       for (std::uint32_t v = 0; v < 25; ++v)
                       {
                           body.mesh.positions.push_back(body.mesh.positions[v] + glm::dvec3(1e-9, 0, 0));
                           body.springs.push_back({v, 25 + v, 1e-9, 1e-2});
                       }
                       body.mesh.grid_columns = body.mesh.grid_rows = 0;
                       return s;
                   }(),
                   180,
                   [](const Journey& j) {
                       const auto x = j.world.positions();
                       double apart = 0;
                       for (std::size_t v = 0; v < 25; ++v)
                           apart = std::max(apart, glm::distance(x[v], x[25 + v]));
                       return each_of(above("distance of copies, m", apart, 0.01), hangs(j, kHang4Twice));
                   },
                   kOwnStiffness});
    out.push_back({"B10",
                   "cloth flattened onto its middle line",
                   placed([](const glm::dvec3& x, conformance::Random& r) {
                       return glm::dvec3(1e-4 * r.uniform(-1, 1), x.y, 1e-4 * r.uniform(-1, 1));
                   }),
                   300,
                   uncrumpled,
                   only(MethodKind::mass_spring),
                   {},
                   100});
    out.push_back({"B12", "cloth in a point, 1e-6 m of noise",
                   placed([](const glm::dvec3&, conformance::Random& r) {
                       return 1e-6 * glm::dvec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1));
                   }),
                   300, uncrumpled});
    out.push_back({"B13", "cloth scrambled in a cube of 1 m",
                   placed([](const glm::dvec3&, conformance::Random& r) {
                       return glm::dvec3(r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5));
                   }),
                   300, uncrumpled, only(MethodKind::mass_spring)});
    for (const double scale : {10.0, 0.01})
        out.push_back({"B14", "cloth scaled by " + shown(scale),
                       placed([&](const glm::dvec3& x, conformance::Random&) { return scale * x; }), 300,
                       uncrumpled, only(MethodKind::mass_spring)});
    out.push_back({"B16", "flat cloth at rest, no gravity", free_cloth(6), 300, [](const Journey& j) {
                       return above("movement", largest_distance(j.start, j.world.positions()), 1e-6);
                   }});
    Scene folded = placed([](const glm::dvec3& x, conformance::Random& r) {
        return glm::dvec3(-std::abs(x.x), x.y, 1e-4 * r.uniform(-1, 1));
    });
    folded.bodies[0].material.bending_stiffness = 0.05;
    folded.damping = 2;
    out.push_back({"B17", "hinges folded onto each other", folded, 300,
                   [](const Journey& j) {
                       const auto x = j.world.positions(); // the halves of the upper edge
                       const double width = glm::distance(x.front(), x[6]);
                       return each_of(above("missing of the width", 1 - width, 0.1), back_in_shape(j, 0.02));
                   },
                   // Its hinges are as stiff as a sweep allows, whatever the material.
                   only(MethodKind::pbd)});
    out.push_back({"B18", "hanging cloth 10 km from the origin",
                   [] {
                       Scene s = hanging(6, 5);
                       for (glm::dvec3& x : s.bodies[0].mesh.positions)
                           x += glm::dvec3(1e4);
                       return s;
                   }(),
                   180, [](const Journey& j) { return hangs(j, kHang6); }, kOwnStiffness});
}

/// Links of 1 cm, 10 kg in all, that start where they hang at rest.
Scene hung_chain(std::uint32_t links)
{
    const double mass = 10.0 / links;
    Scene s = test::chain(links, 1e5, mass, 0.01 * links);
    Body& body = s.bodies[0];
    body.start_positions = body.mesh.positions;
    double way = 0;
    for (std::uint32_t v = 1; v <= links; ++v)
    {
        way += mass * (links + 1 - v) * 9.81 / 1e5;
        body.start_positions[v].y -= way;
    }
    s.damping = 0.5;
    return s;
}

/// Of a chain that starts at rest under its weight: its length, and the tension that bears all of it.
Findings bears_itself(const Journey& j)
{
    const Scene& scene = j.world.scene();
    const std::vector<glm::dvec3>&rest = scene.bodies[0].mesh.positions, x = j.world.positions();
    double weight = 0; // N
    for (std::size_t v = 1; v < rest.size(); ++v)
        weight += scene.bodies[0].vertex_masses[v] * glm::length(scene.gravity);
    const double tension = 1e5 * (glm::distance(x[0], x[1]) - glm::distance(rest[0], rest[1])); // N
    return each_of(length_error(j, 1e5),
                   above("error of the tension at the pin", std::abs(tension / weight - 1), 0.05));
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
        s.damping = 3;
        return s;
    };
    const auto below_its_pin = [](const Journey& j) {
        const glm::dvec3 d = centre(j.world) - j.world.positions()[1];
        return above("distance of the centre from the pin's vertical, m", std::hypot(d.x, d.z), 0.02);
    };
    out.push_back({"C01", "three triangles on one edge", fan(5, false), 300, below_its_pin});
    out.push_back({"C02", "fan of 120 triangles at one vertex, in full 1,000", fan(120, true), 300,
                   below_its_pin,
                   // 1,000 springs at the hub: few sweeps neither swing it nor keep its rim's short springs.
                   kForces | kSweeps | only(MethodKind::implicit_euler)});
    out.back().full_size = [=] { return fan(1000, true); };
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
    out.push_back({"C09", "chain of 2,000 links at rest under its weight, in full 100,000", hung_chain(2000),
                   20, bears_itself, kSweeps | kHoldsThreshold});
    out.back().full_size = [] { return hung_chain(100000); };
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
    put_efforts(out);
    return out;
}

} // namespace taut::hard
