// The cases of the robustness map that are about solids under loads, of poor meshes, over-constrained, and at
// rest for long (methods 2.A, 2.B, 2.C, 2.E, 2.F).

#include "hard/map_parts.hpp"
#include "support/data.hpp"

#include <set>

namespace taut::hard {
namespace {

void add_heavy(std::vector<MapCase>& out)
{
    const auto add = [&](const char* id, const char* what, double ratio) {
        // A bar 0.2 x 1 x 0.2 m of vertices of 0.5 kg, as stiff as to be 5 % longer by its weight.
        const double load = 9 * 0.5 * ratio * 9.81;
        Body body = solid_box({2, 8, 2}, {0.2, 1, 0.2}, load / 0.04 / 0.05);
        body.pins = {hold_face("top")};
        Scene s = scene_of(body, 1, {0, -9.81, 0});
        std::vector<double>& mass = s.bodies[0].vertex_masses;
        mass.assign(s.bodies[0].mesh.positions.size(), 0.5);
        for (const std::uint32_t v : lowest(s.bodies[0].mesh))
            mass[v] *= ratio;
        out.push_back({id,
                       what,
                       s,
                       300,
                       [](const Journey& j) {
                           return above("error of the lower end / height", std::abs(-lifted(j) - 0.05), 0.02);
                       },
                       // The stiffness of pbd is none of the material's: another length.
                       ratio > 1e4 ? kPositionBased : kOwnStiffness,
                       {},
                       -1});
    };
    add("A06", "solid bar, end 1,800 times heavier", 1800);
    add("A07", "solid bar, end 200 times heavier", 200);
    add("A08", "solid bar, end 1e5 times heavier", 1e5);
}

void add_steps(std::vector<MapCase>& out)
{
    for (const double step : {0.002, 0.1, 1.0})
    {
        Body body = solid_box({6, 2, 2}, {3, 1, 1}, 1e4);
        body.pins = {hold_face("left")};
        Scene s = scene_of(body, 1.8); // about critical: it is still after 8 s
        s.timestep = step;
        for (const glm::dvec3& x : s.bodies[0].mesh.positions)
        {
            const double angle = 6.283185307179586 * (x.x + 1.5) / 3;
            s.bodies[0].start_positions.emplace_back(x.x, std::cos(angle) * x.y - std::sin(angle) * x.z,
                                                     std::sin(angle) * x.y + std::cos(angle) * x.z);
        }
        out.push_back({"A09",
                       "solid bar twisted by 360 degrees, step of " + shown(step) + " s",
                       s,
                       step < 0.01 ? 4000 : 120,
                       [](const Journey& j) {
                           const auto& rest = j.world.scene().bodies[0].mesh.positions;
                           const double away = largest_distance(j.world.positions(), rest) / std::sqrt(11.0);
                           return above("distance from rest / D", away, 0.05);
                       },
                       step > 0.5 ? kForces : kForces | only(MethodKind::pbd),
                       {},
                       -1});
    }
}

/// A16: hung in peace for 2 s, then without its pins; the fall of a second.
Findings let_go(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    Scene held = scene, free = scene;
    held.damping = 1;
    World rest(held, device);
    const double high = centre(rest).y;
    run(rest, 2 * steps);
    const double sunk = high - centre(rest).y; // what holds nothing falls by 11 m
    free.bodies[0].pins.clear();
    free.bodies[0].start_positions = rest.positions();
    World world(free, device);
    const double before = centre(world).y;
    run(world, steps);
    const double right = 9.81 * world.time() * world.time() / 2;
    return each_of(above("error of the fall", std::abs((before - centre(world).y) / right - 1), 1e-3),
                   above("fall while it was held, m", sunk, 0.1));
}

void add_releases(std::vector<MapCase>& out)
{
    out.push_back(
        {"A16", "cloth let go after 2 s", with_stretch(hanging(4, 0), 500), 60, {}, 0, {}, 0, let_go});
    for (const double modulus : {1e6, 1e8})
    {
        Body body = block(3, modulus);
        body.pins = {hold_face("top")};
        out.push_back({"A16",
                       "solid of " + shown(modulus) + " Pa let go after 2 s",
                       scene_of(body, 0, {0, -9.81, 0}),
                       60,
                       {},
                       0,
                       {},
                       modulus > 1e7 ? -1 : 0,
                       let_go});
    }
}

void add_meshes(std::vector<MapCase>& out)
{
    const auto refused = [](const Journey&) { return never("it was not refused", true); };
    Scene flat = scene_of(block(1)), turned = flat;
    flat.bodies[0].mesh.positions[flat.bodies[0].mesh.tetrahedra[0][3]] =
        flat.bodies[0].mesh.positions[flat.bodies[0].mesh.tetrahedra[0][2]];
    std::swap(turned.bodies[0].mesh.tetrahedra[0][0], turned.bodies[0].mesh.tetrahedra[0][1]);
    out.push_back({"B06", "a tetrahedron without volume", flat, 3, refused});
    out.push_back({"B07", "a left-handed tetrahedron given by hand", turned, 3, refused});
    Body rope = solid_box({400, 1, 1}, {40, 0.1, 0.1}, 1e6);
    rope.pins = {hold_face("left")};
    out.push_back({"C09", "solid bar of 400 cells in a row", scene_of(rope, 0, {0, -9.81, 0}), 20,
                   [](const Journey& j) {
                       // Bending reaches some cells from where it is held: the other end falls.
                       const double t = j.world.time();
                       const auto x = j.world.positions();
                       const double fall = j.start.back().y - x.back().y;
                       return each_of(above("error of the free end's fall",
                                            std::abs(fall / (9.81 * t * t / 2) - 1), 0.05),
                                      back_in_shape(j, 0.05));
                   }});
    const auto path = find_data("tets/bunny_slivers.vtk");
    if (!path)
        return;
    Body bunny = block(1);
    bunny.shape.kind = ShapeKind::tetrahedra;
    bunny.shape.file = *path;
    Scene s = scene_of(bunny, 0.5, {0, -9.81, 0});
    std::vector<glm::dvec3>& x = s.bodies[0].mesh.positions;
    double low = kInfinity, high = -kInfinity;
    for (const glm::dvec3& p : x)
    {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    for (glm::dvec3& p : x) // a metre tall, 1 cm above the floor
        p = (p - glm::dvec3(0, low, 0)) / (high - low) + glm::dvec3(0, 0.01, 0);
    s.colliders = {flat_floor(0)};
    s.method.line_search = 8; // implicit_euler alone reads it
    out.push_back({kDataCase,
                   "bunny_slivers.vtk dropped",
                   s,
                   30,
                   [](const Journey& j) {
                       // It falls by the centimetre to the floor, and sinks in by its weight.
                       return each_of(calm(j), above("missing of half the fall, m", 0.005 - fallen(j), 0),
                                      above("fall of the centre, m", fallen(j), 0.2));
                   },
                   kForces,
                   {},
                   -1});
}

void add_standing(std::vector<MapCase>& out)
{
    // One body of layers, so that each method's solver has to carry the weights, not its contacts.
    Body tower = solid_box({1, 6, 1}, {1, 6, 1}, 1e8);
    Scene s = scene_of(tower, 1, {0, -9.81, 0});
    std::vector<double>& mass = s.bodies[0].vertex_masses;
    for (const glm::dvec3& x : s.bodies[0].mesh.positions)
        mass.push_back(100 * std::pow(2.0, std::round(x.y + 3)));
    const auto stood = [](double height, double most) {
        return [=](const Journey& j) {
            double top = -kInfinity;
            for (const glm::dvec3& x : j.world.positions())
                top = std::max(top, x.y);
            double bottom = kInfinity;
            for (const glm::dvec3& x : j.world.positions())
                bottom = std::min(bottom, x.y);
            return each_of(above("loss of height", 1 - (top - bottom) / height, most),
                           above("gain of height", (top - bottom) / height - 1, most),
                           above("depth, m", j.deepest, 0.01));
        };
    };
    s.colliders = {flat_floor(-3.001)};
    out.push_back({"E08",
                   "solid of seven layers, each twice as heavy as the one below",
                   s,
                   300,
                   stood(6, 0.02),
                   0,
                   {},
                   -1});
    s = scene_of(solid_box({2, 4, 2}, {1, 1, 1}, 1e10), 1, {0, -9.81, 0});
    s.bodies[0].vertex_masses.assign(s.bodies[0].mesh.positions.size(), 20);
    for (std::size_t v = 0; v < s.bodies[0].vertex_masses.size(); ++v)
        if (s.bodies[0].mesh.positions[v].y > 0.1)
            s.bodies[0].vertex_masses[v] = 2e5;
    s.colliders = {flat_floor(-0.501)};
    out.push_back({"E12",
                   "solid whose upper half is 1e4 times heavier",
                   s,
                   300,
                   stood(1, 0.05),
                   kPositionBased | only(MethodKind::implicit_constraints),
                   {},
                   -1});
}

/// F04: the edges of a rigid tetrahedron say all about it; its volume says it again.
Findings redundant(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    Scene edges = scene;
    edges.bodies[0].material.volume_stiffness = 0;
    World both(scene, device), one(edges, device);
    run(both, steps);
    run(one, steps);
    // Sweeps that have not converged turn a stiff tetrahedron about its pin too slowly, each of the two by
    // its own much: map_effort.cpp says how many do.
    return each_of(above("difference", largest_distance(both.positions(), one.positions()), 1e-4),
                   above("volume", std::abs(measure(both).volume.ratio - 1), 1e-3),
                   above("distortion", distortion(scene, both.positions()), 1e-3));
}

void add_constrained(std::vector<MapCase>& out)
{
    Body tetrahedron = block(1, 1e9);
    tetrahedron.material.model = SolidModel::springs;
    Scene s = scene_of(tetrahedron, 0, {0, -9.81, 0});
    Body& body = s.bodies[0];
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    body.mesh.tetrahedra = {{0, 1, 2, 3}};
    body.mesh.triangles = surface_of(body.mesh.tetrahedra);
    body.pins = {hold({0})};
    s.method.constraint_compliance = 0; // rigid where a method can be
    out.push_back({"F04",
                   "tetrahedron of six stiff edges with its volume, and without",
                   s,
                   100,
                   {},
                   0,
                   {},
                   0,
                   redundant});
    Body lattice = block(2);
    lattice.material.model = SolidModel::springs;
    lattice.transform.translate = {0, 0.6, 0};
    s = scene_of(lattice, 0.5, {0, -9.81, 0});
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : s.bodies[0].mesh.tetrahedra)
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b)
                edges.insert(std::minmax(t[a], t[b]));
    const std::vector<glm::dvec3>& x = s.bodies[0].mesh.positions;
    for (const auto& [a, b] : edges)
        s.bodies[0].springs.push_back({a, b, glm::distance(x[a], x[b]), 0});
    s.colliders = {flat_floor(0)};
    out.push_back({"F05", "solid with all edges rigid, dropped", s, 120, [](const Journey& j) {
                       return each_of(above("stretch", j.stretch, 0.05),
                                      above("volume lost or gained", j.volume, 0.05));
                   }});
}

/// Total momentum over the sum of its sizes.
double drift(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    const std::vector<glm::dvec3> v = world.velocities();
    glm::dvec3 total(0);
    double size = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
    {
        total += model.mass[k] * v[k];
        size += model.mass[k] * glm::length(v[k]);
    }
    return glm::length(total) / size;
}

void add_surfaces(std::vector<MapCase>& out)
{
    Body cube = block(4, 1e4);
    cube.material.model = SolidModel::springs;
    cube.material.volume = HeldVolume::surface;
    cube.material.volume_stiffness = kInfinity;
    Scene s = scene_of(cube, 0);
    s.timestep = 1e-3;
    s.bodies[0].start_positions = s.bodies[0].mesh.positions;
    for (glm::dvec3& x : s.bodies[0].start_positions)
        x *= glm::dvec3(std::sqrt(2.0), 0.5, std::sqrt(2.0));
    out.push_back(
        {"F14", "volume of a surface, cube squeezed to half its height", s, 300, [](const Journey& j) {
             return each_of(above("volume lost or gained", j.volume, 0.01),
                            above("momentum", drift(j.world), 1e-5));
         }});
    s.bodies[0].start_positions.clear();
    s.bodies[0].mesh.triangles.pop_back();
    out.push_back({"F15", "volume of an open surface", s, 3,
                   [](const Journey&) { return never("it was not refused", true); }});
}

void add_rest(std::vector<MapCase>& out)
{
    Body body = block(2);
    body.transform.translate = {0, 0.501, 0};
    Scene s = scene_of(body, 1, {0, -9.81, 0});
    s.colliders = {flat_floor(0)};
    s.method.linear_iterations = 20;
    out.push_back({"E05",
                   "solid on a floor for 100,000 steps",
                   s,
                   100000,
                   [](const Journey& j) {
                       const glm::dvec3 moved = mean(j.world.positions()) - mean(j.start);
                       const double d = std::sqrt(3.0);
                       return each_of(
                           above("speed / sqrt(g D)", j.last.max_speed / std::sqrt(9.81 * d), 1e-3),
                           above("drift along the floor / D", std::hypot(moved.x, moved.z) / d, 1e-3),
                           above("sinking / D", std::abs(moved.y) / d, 0.05));
                   },
                   0,
                   {},
                   1000});
}

} // namespace

void add_loaded_solids(std::vector<MapCase>& out)
{
    add_heavy(out);
    add_steps(out);
    add_releases(out);
    add_meshes(out);
    add_standing(out);
    add_constrained(out);
    add_surfaces(out);
    add_rest(out);
}

} // namespace taut::hard
