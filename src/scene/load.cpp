// The scene file. Defaults are those of the C++ types: a key that is missing leaves them alone.

#include "taut/scene/field.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/json_text.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/load_material.hpp"
#include "taut/scene/load_method.hpp"
#include "taut/scene/settings.hpp"
#include "taut/scene/set_value.hpp"

#include <array>
#include <limits>

namespace taut {

namespace {

using scene_file::Field;
using scene_file::read_accept;
using scene_file::read_material;
using scene_file::read_method;

constexpr int kVersion = 1;

/// The one of the keys that the object has; none or two are an error.
template <std::size_t N>
std::string_view exactly_one(const Field& object, const std::array<std::string_view, N>& keys)
{
    std::string_view chosen;
    for (const std::string_view key : keys)
    {
        if (!object.find(key))
            continue;
        if (!chosen.empty())
            object.fail("has both \"" + std::string(chosen) + "\" and \"" + std::string(key) +
                        "\"; keep one");
        chosen = key;
    }
    if (chosen.empty())
        object.fail("needs one of " + scene_file::listing(keys));
    return chosen;
}

std::vector<Keyframe> read_motion(const Field& list)
{
    std::vector<Keyframe> motion;
    list.each([&](Field entry) {
        entry.object("keyframe");
        Keyframe key;
        key.time = entry.need("time").number();
        entry.read("translate", key.translate);
        if (auto rotate = entry.find("rotate"))
        {
            rotate->object("keyframe rotate");
            rotate->read("axis", key.rotate_axis);
            rotate->read("degrees", key.rotate_degrees);
            rotate->read("centre", key.rotate_centre);
        }
        motion.push_back(key);
    });
    return motion;
}

/// "corner": "x" and "corners": ["x", "y"] mean the same.
void read_names(const Field& pin, std::string_view one, std::string_view many, std::vector<std::string>& out)
{
    if (const auto name = pin.find(one))
        out.push_back(name->text());
    if (const auto names = pin.find(many))
        for (const Field& name : names->elements())
            out.push_back(name.text());
}

Pin read_pin(Field field)
{
    field.object("pin");
    Pin pin;
    if (const auto list = field.find("vertices"))
        list->each([&](const Field& vertex) { pin.vertices.push_back(vertex.count()); });
    if (auto box = field.find("box"))
    {
        box->object("box");
        pin.use_box = true;
        pin.box_min = box->need("min").vector();
        pin.box_max = box->need("max").vector();
    }
    read_names(field, "corner", "corners", pin.corners);
    read_names(field, "edge", "edges", pin.edges);
    read_names(field, "face", "faces", pin.faces);
    if (const auto motion = field.find("motion"))
        pin.motion = read_motion(*motion);
    return pin;
}

void read_grid(Field field, Shape& shape)
{
    shape.kind = ShapeKind::grid;
    field.object("grid");
    if (const auto cells = field.find("cells"))
    {
        const auto parts = cells->elements();
        if (parts.size() != 2)
            cells->refuse("it must be two whole numbers [columns, rows]");
        shape.cells = {parts[0].count(), parts[1].count()};
    }
    if (const auto size = field.find("size"))
    {
        const auto parts = size->elements();
        if (parts.size() != 2)
            size->refuse("it must be two numbers [width, height] in m");
        shape.size = {parts[0].number(), parts[1].number()};
    }
    field.read("diagonals", shape.diagonals);
    if (auto network = field.find("network"))
    {
        network->object("network");
        shape.network.used = true;
        network->read("structural", shape.network.structural);
        network->read("shear", shape.network.shear);
        network->read("bend", shape.network.bend);
    }
}

void read_box(Field field, Shape& shape)
{
    shape.kind = ShapeKind::box;
    field.object("solid box");
    if (const auto cells = field.find("cells"))
    {
        const auto parts = cells->elements();
        if (parts.size() != 3)
            cells->refuse("it must be three whole numbers [x, y, z]");
        shape.box_cells = {parts[0].count(), parts[1].count(), parts[2].count()};
    }
    field.read("size", shape.box_size);
    field.read("split", shape.split);
}

void read_ball(Field field, Shape& shape)
{
    shape.kind = ShapeKind::ball;
    field.object("ball");
    field.read("cells", shape.ball_cells);
    field.read("radius", shape.radius);
}

void read_chain(Field field, Shape& shape)
{
    shape.kind = ShapeKind::chain;
    field.object("chain");
    field.read("links", shape.links);
    field.read("length", shape.length);
    field.read("width", shape.width);
}

void read_kind(std::string_view kind, const Field& field, Shape& shape)
{
    if (kind == "grid")
        return read_grid(field, shape);
    if (kind == "chain")
        return read_chain(field, shape);
    if (kind == "box")
        return read_box(field, shape);
    if (kind == "ball")
        return read_ball(field, shape);
    shape.kind = kind == "mesh" ? ShapeKind::mesh : ShapeKind::tetrahedra;
    shape.file = field.text();
}

void read_shape(const Field& body, Shape& shape)
{
    constexpr std::array<std::string_view, 6> kinds = {"grid", "chain", "mesh", "box", "ball", "tetrahedra"};
    const std::string_view kind = exactly_one(body, kinds);
    Field::attempt([&] { read_kind(kind, body.need(kind), shape); });
    const auto weld = body.find("weld_distance");
    if (weld && shape.kind != ShapeKind::mesh)
        weld->fail("stands beside \"" + std::string(kind) + "\"; it belongs to \"mesh\" only");
    if (weld)
        shape.weld_distance = weld->number();
}

void read_transform(Field field, Transform& transform)
{
    field.object("transform");
    field.read("translate", transform.translate);
    if (auto rotate = field.find("rotate"))
    {
        rotate->object("rotate");
        rotate->read("axis", transform.rotate_axis);
        rotate->read("degrees", transform.rotate_degrees);
    }
    field.read("scale", transform.scale);
}

Body::Spring read_spring(Field field)
{
    field.object("spring");
    Body::Spring spring{field.need("a").count(), field.need("b").count(), field.need("rest_length").number(),
                        0};
    field.read("compliance", spring.compliance);
    return spring;
}

Body read_body(Field field)
{
    field.object("body");
    Body body;
    field.read("name", body.name);
    read_shape(field, body.shape);
    const bool solid = is_solid(body.shape.kind);
    if (solid)
        body.material = solid_material();
    if (const auto material = field.find("material"))
        Field::attempt([&] { read_material(*material, solid, body.material); });
    if (const auto transform = field.find("transform"))
        Field::attempt([&] { read_transform(*transform, body.transform); });
    field.read("velocity", body.velocity);
    if (const auto pins = field.find("pins"))
        pins->each([&](const Field& pin) { body.pins.push_back(read_pin(pin)); });
    if (const auto springs = field.find("springs"))
        springs->each([&](const Field& spring) { body.springs.push_back(read_spring(spring)); });
    if (const auto masses = field.find("vertex_masses"))
        masses->each([&](const Field& mass) { body.vertex_masses.push_back(mass.number()); });
    if (const auto positions = field.find("start_positions"))
        positions->each([&](const Field& position) { body.start_positions.push_back(position.vector()); });
    if (const auto embedded = field.find("embedded"))
    {
        body.embedded_file = embedded->text();
        if (body.embedded_file.empty())
            embedded->refuse("it must name an OBJ, PLY, OFF or STL file, or be left out");
    }
    return body;
}

Collider read_collider(Field field)
{
    field.object("collider");
    Collider collider;
    field.read("name", collider.name);
    constexpr std::array<std::string_view, 4> kinds = {"plane", "sphere", "capsule", "cuboid"};
    const std::string_view kind = exactly_one(field, kinds);
    Field shape = field.need(kind);
    shape.object(kind);
    if (kind == "plane")
    {
        collider.kind = ColliderKind::plane;
        shape.read("point", collider.point);
        shape.read("normal", collider.normal);
    }
    else if (kind == "sphere")
    {
        collider.kind = ColliderKind::sphere;
        shape.read("centre", collider.point);
        shape.read("radius", collider.radius);
    }
    else if (kind == "capsule")
    {
        collider.kind = ColliderKind::capsule;
        shape.read("from", collider.point);
        shape.read("to", collider.end);
        shape.read("radius", collider.radius);
    }
    else
    {
        collider.kind = ColliderKind::cuboid;
        shape.read("centre", collider.point);
        shape.read("half_size", collider.half_size);
        if (auto rotate = shape.find("rotate"))
        {
            rotate->object("rotate");
            rotate->read("axis", collider.rotate_axis);
            rotate->read("degrees", collider.rotate_degrees);
        }
    }
    field.read("friction", collider.friction);
    if (const auto motion = field.find("motion"))
        collider.motion = read_motion(*motion);
    return collider;
}

Wind read_wind(Field field)
{
    field.object("wind");
    Wind wind;
    wind.density = 1.2;
    field.read("density", wind.density);
    field.read("velocity", wind.velocity);
    if (const auto keys = field.find("keys"))
        keys->each([&](Field entry) {
            entry.object("wind key");
            wind.keys.push_back({entry.need("time").number(), entry.need("velocity").vector()});
        });
    return wind;
}

Scene read_scene(Field field)
{
    field.object("scene");
    Scene scene;
    const auto version = field.find("taut");
    if (!version)
        field.fail("lacks the key \"taut\"; write \"taut\": 1, the version of the format");
    if (version->count() != kVersion)
        version->refuse("this library reads version 1");
    field.read("name", scene.name);
    field.read("timestep", scene.timestep);
    field.read("duration", scene.duration);
    field.read("gravity", scene.gravity);
    field.read("damping", scene.damping);
    field.read("max_speed", scene.max_speed);
    field.read("depenetration_speed", scene.depenetration_speed);
    field.read("external_forces", scene.external_forces);
    const auto part = [&](std::string_view key, const auto& read) {
        if (const auto member = field.find(key))
            Field::attempt([&] { read(*member); });
    };
    part("method", [&](const Field& method) { read_method(method, scene.method); });
    part("accept", [&](const Field& accept) { scene.accept = read_accept(accept); });
    part("wind", [&](const Field& wind) { scene.wind = read_wind(wind); });
    part("bodies", [&](const Field& list) {
        list.each([&](const Field& body) { scene.bodies.push_back(read_body(body)); });
    });
    part("colliders", [&](const Field& list) {
        list.each([&](const Field& collider) { scene.colliders.push_back(read_collider(collider)); });
    });
    return scene;
}

/// What a scene has of its file's place.
void place(Scene& scene, const std::filesystem::path& file)
{
    scene.directory = file.parent_path();
    if (scene.name.empty())
        scene.name = file.stem().string();
}

} // namespace

std::vector<SceneIssue> check_file(const std::filesystem::path& file, Scene* scene,
                                   std::vector<std::string>* method_keys)
{
    const std::string name = file.string();
    const std::string text = scene_file::read_file(file, scene_file::kMaxSceneBytes);
    std::vector<SceneIssue> issues;
    const nlohmann::json tree = scene_file::parse_json(text, name);
    Scene found;
    Field::attempt([&] { found = read_scene(Field(tree, name, {}, &issues)); });
    if (issues.empty())
        issues = check(found);
    if (method_keys)
        *method_keys = scene_file::keys_of(tree, "method");
    if (scene)
    {
        *scene = std::move(found);
        place(*scene, file);
    }
    return issues;
}

Scene parse_scene(std::string_view json, const std::filesystem::path& directory, std::string_view name,
                  std::span<const std::string> settings)
{
    const std::string file(name);
    nlohmann::json tree = scene_file::parse_json(json, file);
    for (const std::string& setting : settings)
        scene_file::set_value(tree, setting, file);
    Scene scene = read_scene(Field(tree, file, {}));
    scene.directory = directory;
    return scene;
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> settings)
{
    Scene scene = parse_scene(scene_file::read_file(file, scene_file::kMaxSceneBytes), file.parent_path(),
                              file.string(), settings);
    place(scene, file);
    return scene;
}

Scene parse_scene(std::string_view json, const std::filesystem::path& directory, std::string_view name)
{
    return parse_scene(json, directory, name, {});
}

Scene load_scene(const std::filesystem::path& file) { return load_scene(file, {}); }

} // namespace taut
