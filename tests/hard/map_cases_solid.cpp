// The cases of the robustness map that are about solids. Methods without neo-Hookean tetrahedra move the same
// bodies as springs with volumes (set_method in map_test.cpp).

#include "hard/map_parts.hpp"

namespace taut::hard {
namespace {

/// A free cube of 4 x 4 x 4 cells whose vertices start elsewhere.
template <typename F>
Scene placed(F&& f, double ratio = 0.3)
{
    Scene scene = scene_of(block(4, 1e5, ratio));
    Body& body = scene.bodies[0];
    body.start_positions = body.mesh.positions;
    conformance::Random random(11);
    for (glm::dvec3& x : body.start_positions)
        x = f(x, random);
    return scene;
}

glm::dvec3 noise(conformance::Random& r, double size)
{
    return size * glm::dvec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1));
}

Findings recovered(const Journey& j) { return back_in_shape(j, 0.05); }

glm::dvec3 twisted(const glm::dvec3& x, double degrees)
{
    const double angle = degrees * 3.14159265358979323846 / 180 * (x.x + 0.5);
    return {x.x, std::cos(angle) * x.y - std::sin(angle) * x.z,
            std::sin(angle) * x.y + std::cos(angle) * x.z};
}

void add_starts(std::vector<MapCase>& out)
{
    using Random = conformance::Random;
    const auto add = [&](const char* id, const char* what, auto place, MethodSet may, double ratio = 0.3) {
        out.push_back({id, what, placed(place, ratio), 300, recovered, may});
    };
    add(
        "B08", "solid, one vertex pushed through its neighbours",
        [](const glm::dvec3& x, Random&) { return glm::length(x) < 1e-9 ? glm::dvec3(0.45, 0.1, 0) : x; }, 0);
    add(
        "B09", "solid mirrored", [](const glm::dvec3& x, Random&) { return glm::dvec3(x.x, x.y, -x.z); },
        kForces);
    add(
        "B10", "solid flattened to a plane",
        [](const glm::dvec3& x, Random&) { return glm::dvec3(x.x, x.y, 0.5); }, kForces);
    add(
        "B11", "solid in a line, 1e-6 m of noise",
        [](const glm::dvec3& x, Random& r) { return glm::dvec3(x.x, 0, 0) + noise(r, 1e-6); },
        kForces | only(MethodKind::pbd));
    add(
        "B12", "solid in a point", [](const glm::dvec3&, Random&) { return glm::dvec3(0); }, kAllMethods);
    add(
        "B13", "solid scrambled", [](const glm::dvec3&, Random& r) { return noise(r, 0.5); },
        kForces | only(MethodKind::pbd));
    add(
        "B14", "solid ten times too large", [](const glm::dvec3& x, Random&) { return 10.0 * x; },
        // A linear step of xpbd from so far overshoots before it comes back.
        only(MethodKind::mass_spring) | only(MethodKind::xpbd));
    add(
        "B14", "solid a hundred times too small", [](const glm::dvec3& x, Random&) { return 0.01 * x; },
        kForces | only(MethodKind::pbd));
    add(
        "B15", "solid twisted by 360 degrees", [](const glm::dvec3& x, Random&) { return twisted(x, 360); },
        kForces | only(MethodKind::pbd));
    add(
        "B15", "solid twisted by 720 degrees, nu 0.45",
        [](const glm::dvec3& x, Random&) { return twisted(x, 720); },
        kForces | only(MethodKind::pbd) | only(MethodKind::implicit_euler) |
            only(MethodKind::implicit_constraints),
        0.45);
    add(
        "", "solid stretched to ten times its length and let go",
        [](const glm::dvec3& x, Random&) { return glm::dvec3(10 * x.x, x.y, x.z); },
        only(MethodKind::mass_spring));
}

/// Distortion of the tetrahedra that the sliver's vertex has no part in.
double sliver_left_out(const Journey& j)
{
    Scene scene = j.world.scene();
    std::erase_if(scene.bodies[0].mesh.tetrahedra,
                  [](const auto& t) { return std::find(t.begin(), t.end(), 3u) != t.end(); });
    return distortion(scene, j.world.positions());
}

/// The first 25 vertices are the cloth's.
Scene tetrahedra_and_cloth(int count)
{
    Scene scene = test::hanging(4);
    for (int k = 0; k < count; ++k)
    {
        Body body = block(1);
        body.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        body.mesh.tetrahedra = {{0, 1, 2, 3}};
        body.mesh.triangles = surface_of(body.mesh.tetrahedra);
        for (glm::dvec3& x : body.mesh.positions)
            x += glm::dvec3(3 + 2 * (k % 20), 0, 2 * (k / 20));
        scene.bodies.push_back(body);
    }
    return scene;
}

void add_materials(std::vector<MapCase>& out)
{
    out.push_back({"B16", "solid at rest, 1,000 steps", scene_of(block(3), 0), 1000,
                   [](const Journey& j) {
                       return each_of(above("movement", largest_distance(j.start, j.world.positions()), 1e-4),
                                      above("volume", std::abs(j.last.volume.ratio - 1), 1e-4));
                   },
                   only(MethodKind::vbd)}); // it rounds at every vertex, and keeps the sum
    out.push_back({"A14", "solid with nu 0.4999, hung by a face",
                   [] {
                       Body body = block(3, 1e5, 0.4999);
                       Pin pin;
                       pin.faces = {"top"};
                       body.pins = {pin};
                       return scene_of(body, 1, {0, -9.81, 0});
                   }(),
                   300,
                   [](const Journey& j) {
                       return each_of(hangs(j, kHungRubber),
                                      above("volume", std::abs(j.last.volume.ratio - 1), 0.01));
                   },
                   // What is made of springs there is stiffer or softer than rubber.
                   kForces | kOwnStiffness | only(MethodKind::implicit_constraints)});
    out.push_back({"", "Young's modulus of 1e2, 1e5, 1e8, 1e11 Pa in one scene, dropped",
                   [] {
                       Scene scene;
                       for (int k = 2; k <= 11; k += 3)
                       {
                           Body body = block(2, std::pow(10.0, k));
                           body.transform.translate = {2.0 * k, 1, 0};
                           if (k == 2)
                               body.material.density = 1; // a foam: rubber would press itself flat
                           scene.bodies.push_back(body);
                       }
                       scene.colliders = {flat_floor(0)};
                       scene.damping = 2;
                       return resolve(scene);
                   }(),
                   300,
                   [](const Journey& j) {
                       return each_of(back_in_shape(j), above("speed at the end", j.last.max_speed, 0.2),
                                      above("depth", j.last.penetration, 0.01));
                   },
                   // Contacts follow the solve: what they push in 1e11 Pa is more energy than the fall's.
                   only(MethodKind::implicit_euler) | only(MethodKind::implicit_constraints) |
                       only(MethodKind::xpbd)});
    // By its weight the foam is 5 % shorter, and what drops is shorter for a moment.
    out.back().most_volume = 0.1;
    out.push_back({"C04", "200 single tetrahedra and a cloth, in full 1,000", tetrahedra_and_cloth(200),
                   30,
                   [](const Journey& j) {
                       const double t = j.world.time();
                       const auto x = j.world.positions();
                       double wrong = 0; // the cloth has the first 25 vertices and hangs
                       for (std::size_t v = 25; v < x.size(); ++v)
                           wrong =
                               std::max(wrong, std::abs((x[v].y - j.start[v].y) / (-9.81 * t * t / 2) - 1));
                       return each_of(above("error of the fall", wrong, 0.01),
                                      above("stretch", j.last.max_stretch, 0.1));
                   }});
    out.back().full_size = [] { return tetrahedra_and_cloth(1000); };
    out.push_back({"B05", "a sliver of a millionth of its edge in a block",
                   [] {
                       Scene scene = scene_of(block(3), 1, {0, -9.81, 0});
                       Mesh& mesh = scene.bodies[0].mesh;
                       // The corner of the block belongs to one tetrahedron; it is pushed near the face
                       // opposite.
                       for (auto& t : mesh.tetrahedra)
                           for (std::size_t c = 0; c < 4; ++c)
                               if (t[c] == 3)
                               {
                                   const glm::dvec3 face =
                                       (mesh.positions[t[(c + 1) % 4]] + mesh.positions[t[(c + 2) % 4]] +
                                        mesh.positions[t[(c + 3) % 4]]) /
                                       3.0;
                                   mesh.positions[3] = face + 1e-6 * (mesh.positions[3] - face);
                               }
                       scene.bodies[0].pins = {hold({60, 61, 62, 63})};
                       return scene;
                   }(),
                   600,
                   [](const Journey& j) {
                       return each_of(above("distortion of the others", sliver_left_out(j), 0.1), calm(j));
                   }});
    out.back().short_steps = 120;
}

Collider plane(double y, bool up)
{
    Collider out;
    out.kind = ColliderKind::plane;
    out.point = {0, y, 0};
    out.normal = {0, up ? 1.0 : -1.0, 0};
    out.friction = 0.5;
    return out;
}

void add_contacts(std::vector<MapCase>& out)
{
    out.push_back({"", "solid falls 100 m onto a plane",
                   [] {
                       Body body = block(3);
                       body.transform.translate = {0, 100.5, 0};
                       Scene scene = scene_of(body, 0, {0, -9.81, 0});
                       scene.colliders = {plane(0, true)};
                       return scene;
                   }(),
                   600,
                   [](const Journey& j) {
                       return each_of(above("depth", j.last.penetration, 0.01), back_in_shape(j, 0.1));
                   },
                   kForces});
    out.push_back({"E05", "solid lies on a plane",
                   [] {
                       Body body = block(3);
                       body.transform.translate = {0, 0.501, 0};
                       Scene scene = scene_of(body, 1, {0, -9.81, 0});
                       scene.colliders = {plane(0, true)};
                       return scene;
                   }(),
                   600,
                   [](const Journey& j) {
                       return each_of(above("speed", j.last.max_speed, 0.05),
                                      above("depth", j.last.penetration, 0.01));
                   }});
    out.push_back({"E04", "solid starts a tenth inside a ball",
                   [] {
                       Scene scene = scene_of(block(3), 0.5);
                       Collider ball;
                       ball.point = {0, -0.9, 0};
                       ball.radius = 0.5;
                       scene.colliders = {ball};
                       return scene;
                   }(),
                   120, [](const Journey& j) { return above("depth", j.last.penetration, 0.01); }});
    // What is pressed by a tenth of its metre and let go.
    out.back().work = [](const Journey&) { return 0.5 * 1e5 * 0.01; };
    out.push_back(
        {"E09", "solid squeezed between two plates to 5 % of its height",
         [] {
             Scene scene = scene_of(block(3), 1);
             Collider low = plane(-0.5, true), high = plane(0.5, false);
             high.motion = {{0, {0, 0, 0}}, {1, {0, -0.95, 0}}, {1.5, {0, -0.95, 0}}, {2, {0, 0, 0}}};
             scene.colliders = {low, high};
             return scene;
         }(),
         240,
         [](const Journey& j) {
             return each_of(above("depth", j.deepest, 0.01),
                            above("least height on the way, m", j.thinnest, 0.06), back_in_shape(j));
         },
         kForces});
    // Pressed to a twentieth: E/2 of a cubic metre times the log of that squared, and the speed of the plate.
    out.back().work = [](const Journey& j) { return 0.5 * 1e5 * 9 * 3 + pushed_by(1)(j); };
    out.push_back({"", "bar twisted by ten turns and back",
                   [] {
                       Body body = block(2);
                       body.shape.box_cells = {6, 2, 2};
                       body.shape.box_size = {3, 1, 1};
                       Pin left, right;
                       left.faces = {"left"};
                       right.faces = {"right"};
                       right.motion = {{0, {0, 0, 0}, {1, 0, 0}, 0},
                                       {4, {0, 0, 0}, {1, 0, 0}, 3600},
                                       {8, {0, 0, 0}, {1, 0, 0}, 0}};
                       body.pins = {left, right};
                       return scene_of(body, 1);
                   }(),
                   600,
                   [](const Journey& j) {
                       return each_of(
                           back_in_shape(j, 0.1),
                           above("missing of half a metre's way of what is free", 0.5 - j.farthest, 0));
                   },
                   kForces});
    // Edges at a radius of 0.7 m wind 44 m over 3 m: fifteen times their length, 3 m^3 of 1e5 Pa.
    out.back().work = [](const Journey& j) { return 0.5 * 1e5 * 3 * 15 * 15 + pushed_by(11)(j); };
}

} // namespace

void add_solids(std::vector<MapCase>& out)
{
    add_starts(out);
    add_materials(out);
    add_contacts(out);
}

} // namespace taut::hard
