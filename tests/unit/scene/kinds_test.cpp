// Methods, shapes and colliders of one kind each carry everything that their kind reads, and nothing else.

#include "taut/scene/kinds.hpp"

#include "support/catch.hpp"
#include "taut/scene/distance_field.hpp"
#include "taut/scene/key_text.hpp"
#include "taut/scene/tables.hpp"

#include <nlohmann/json.hpp>

#include <set>

using namespace taut;

namespace {

using Names = std::set<std::string>;

/// Keys of methods whose value is another than by default.
Names changed(const MethodSettings& settings)
{
    const MethodSettings usual;
    Names out;
    for (const scene_file::Key& key : scene_file::kMethodTable.keys)
        if (key.name != "type" && scene_file::value_of(key, &settings) != scene_file::value_of(key, &usual))
            out.emplace(key.name);
    return out;
}

/// What the table says that a method reads.
Names read(MethodKind kind)
{
    Names out{"substeps", "precision"};
    for (const scene_file::Key& key : scene_file::kMethodTable.keys)
        if (key.readers & only(kind))
            out.emplace(key.name);
    return out;
}

void check_complete(const MethodSettings& settings, MethodKind kind)
{
    INFO(to_string(kind));
    CHECK(settings.type == kind);
    CHECK(changed(settings) == read(kind));
}

constexpr Precision kDouble = Precision::float64;

} // namespace

TEST_CASE("a method's own settings are those that the table says it reads")
{
    check_complete(methods::Xpbd{.substeps = 3, .iterations = 2, .precision = kDouble}, MethodKind::xpbd);
    check_complete(methods::Vbd{.substeps = 3,
                                .iterations = 2,
                                .precision = kDouble,
                                .relaxation = 0.5,
                                .start = SweepStart::inertial,
                                .spectral_radius = 0.5},
                   MethodKind::vbd);
    check_complete(methods::Pbd{.substeps = 3,
                                .iterations = 2,
                                .precision = kDouble,
                                .scheme = ElementScheme::node_centric,
                                .stretch = 0.5,
                                .bend = 0.5,
                                .volume = 0.5,
                                .relaxation = 0.5,
                                .spectral_radius = 0.5},
                   MethodKind::pbd);
    check_complete(methods::MassSpring{.substeps = 3,
                                       .iterations = 2,
                                       .precision = kDouble,
                                       .integrator = Integrator::verlet,
                                       .stability = StabilityRule::substep,
                                       .scheme = ElementScheme::node_centric},
                   MethodKind::mass_spring);
    check_complete(methods::ImplicitEuler{.substeps = 3,
                                          .iterations = 2,
                                          .precision = kDouble,
                                          .linear_iterations = 7,
                                          .linear_tolerance = 0.1,
                                          .linear_operator = LinearOperator::matrix_free,
                                          .preconditioner = NewtonPreconditioner::two_level,
                                          .line_search = 3},
                   MethodKind::implicit_euler);
    check_complete(methods::ImplicitConstraints{.substeps = 3,
                                                .iterations = 2,
                                                .precision = kDouble,
                                                .integrator = Integrator::verlet,
                                                .stability = StabilityRule::substep,
                                                .linear_iterations = 7,
                                                .linear_tolerance = 0.1,
                                                .linear_operator = LinearOperator::matrix_free,
                                                .constrained = ConstrainedSprings::structural,
                                                .constraint_compliance = 1e-6},
                   MethodKind::implicit_constraints);
    check_complete(methods::Acad{.substeps = 3,
                                 .iterations = 2,
                                 .precision = kDouble,
                                 .integrator = Integrator::verlet,
                                 .stability = StabilityRule::substep,
                                 .linear_iterations = 7,
                                 .linear_tolerance = 0.1,
                                 .constrained = ConstrainedSprings::structural,
                                 .constraint_compliance = 1e-6,
                                 .activate_strain = 0.2,
                                 .release_strain = 0.1,
                                 .release = ReleaseRule::strain,
                                 .target = ConstraintTarget::rest,
                                 .compress = true},
                   MethodKind::acad);
    const MethodSettings acad = methods::Acad{.activate_strain = 0.02};
    CHECK(acad.release_strain == 0.02); // as in a scene file that names one
}

TEST_CASE("a scene of one kind each is that of the file")
{
    Scene made;
    Body& cloth = made.bodies.emplace_back();
    cloth.shape = shapes::Grid{.cells = {3, 5}, .size = {1, 2}, .diagonals = Diagonals::uniform};
    made.bodies.emplace_back().shape = shapes::Chain{.links = 4, .length = 2, .width = 0.02};
    made.bodies.emplace_back().shape =
        shapes::Box{.cells = {1, 2, 3}, .size = {3, 2, 1}, .split = BoxSplit::six};
    made.bodies.emplace_back().shape = shapes::Ball{.cells = 4, .radius = 0.2};
    for (Body& body : made.bodies)
        if (is_solid(body.shape.kind))
            body.material = solid_material();
    made.method = methods::Vbd{.substeps = 7, .relaxation = 0.9};
    made.colliders = {colliders::Plane{.point = {0, -3, 0}, .normal = {0, 0, 1}, .friction = 0.1},
                      colliders::Sphere{.centre = {1, 2, 3}, .radius = 0.25, .name = "ball"},
                      colliders::Capsule{.from = {1, 0, 0}, .to = {2, 0, 0}, .radius = 0.125},
                      colliders::Cuboid{.centre = {4, 4, 4},
                                        .half_size = {1, 2, 3},
                                        .rotate_axis = {1, 0, 0},
                                        .rotate_degrees = 30,
                                        .meets = ColliderMeets::vertices}};
    const Scene file = parse_scene(R"({"taut": 1, "method": {"type": "vbd", "substeps": 7, "relaxation": 0.9},
        "bodies": [{"grid": {"cells": [3, 5], "size": [1, 2], "diagonals": "uniform"}},
                   {"chain": {"links": 4, "length": 2, "width": 0.02}},
                   {"box": {"cells": [1, 2, 3], "size": [3, 2, 1], "split": "six"}},
                   {"ball": {"cells": 4, "radius": 0.2}}],
        "colliders": [{"plane": {"point": [0, -3, 0], "normal": [0, 0, 1]}, "friction": 0.1},
                      {"name": "ball", "sphere": {"centre": [1, 2, 3], "radius": 0.25}},
                      {"capsule": {"from": [1, 0, 0], "to": [2, 0, 0], "radius": 0.125}},
                      {"cuboid": {"centre": [4, 4, 4], "half_size": [1, 2, 3],
                               "rotate": {"axis": [1, 0, 0], "degrees": 30}}, "meets": "vertices"}]})");
    CHECK(changed(made.method) == changed(file.method));
    REQUIRE(file.bodies.size() == made.bodies.size());
    for (std::size_t b = 0; b < made.bodies.size(); ++b)
    {
        INFO(b);
        Scene one, other;
        one.bodies = {made.bodies[b]};
        other.bodies = {file.bodies[b]};
        CHECK(resolve(one).bodies[0].mesh.positions == resolve(other).bodies[0].mesh.positions);
        CHECK(resolve(one).bodies[0].mesh.tetrahedra == resolve(other).bodies[0].mesh.tetrahedra);
        CHECK(resolve(one).bodies[0].mesh.triangles == resolve(other).bodies[0].mesh.triangles);
        CHECK(made.bodies[b].shape.width == file.bodies[b].shape.width);
    }
    REQUIRE(file.colliders.size() == made.colliders.size());
    for (std::size_t c = 0; c < made.colliders.size(); ++c)
    {
        INFO(c);
        const Collider &a = made.colliders[c], &b = file.colliders[c];
        CHECK(
            std::tie(a.kind, a.name, a.point, a.normal, a.radius, a.end, a.half_size, a.friction, a.meets) ==
            std::tie(b.kind, b.name, b.point, b.normal, b.radius, b.end, b.half_size, b.friction, b.meets));
        CHECK(std::tie(a.rotate_axis, a.rotate_degrees) == std::tie(b.rotate_axis, b.rotate_degrees));
    }
}

TEST_CASE("files and fields are carried as they are")
{
    const Shape cloth = shapes::Mesh{.file = "a.obj", .weld_distance = -1};
    CHECK(std::tie(cloth.kind, cloth.file, cloth.weld_distance) ==
          std::make_tuple(ShapeKind::mesh, std::filesystem::path("a.obj"), -1.0));
    const Shape solid = shapes::Tetrahedra{.file = "a.msh"};
    CHECK(std::tie(solid.kind, solid.file) ==
          std::make_tuple(ShapeKind::tetrahedra, std::filesystem::path("a.msh")));
    const auto grid = std::make_shared<const DistanceField>();
    const Collider field = colliders::Field{.file = "a.sdf",
                                            .field = grid,
                                            .scale = 2,
                                            .origin = {1, 2, 3},
                                            .rotate_degrees = 4,
                                            .motion = {{1}}};
    CHECK(field.kind == ColliderKind::distance_field);
    CHECK(std::tie(field.field_file, field.field, field.field_scale, field.point, field.rotate_degrees) ==
          std::make_tuple(std::filesystem::path("a.sdf"), grid, 2.0, glm::dvec3(1, 2, 3), 4.0));
    CHECK(field.motion.size() == 1);
}
