#include "taut/report/picture.hpp"

#include "taut/report/field_surface.hpp"
#include "taut/report/image.hpp"
#include "taut/report/picture_frame.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/embedding.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace taut {
namespace {

struct Colours
{
    glm::vec3 front, back; ///< sRGB
};

/// One pair a body, in turn.
constexpr Colours kBodies[] = {
    {{0.23f, 0.47f, 0.67f}, {0.95f, 0.75f, 0.48f}}, // sea, sand
    {{0.76f, 0.29f, 0.25f}, {0.93f, 0.80f, 0.66f}}, // brick, cream
    {{0.30f, 0.52f, 0.34f}, {0.82f, 0.84f, 0.55f}}, // moss, straw
    {{0.46f, 0.33f, 0.58f}, {0.88f, 0.74f, 0.86f}}, // plum, mallow
    {{0.86f, 0.56f, 0.16f}, {0.44f, 0.40f, 0.38f}}, // amber, slate
};
constexpr glm::vec3 kSphere{0.80f, 0.79f, 0.77f};
constexpr glm::vec3 kLightCell{0.90f, 0.90f, 0.895f}, kDarkCell{0.83f, 0.835f, 0.845f};

/// A round number near `value`: 1, 2 or 5 times a power of ten.
double round_number(double value)
{
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    const double lead = value / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

/// A ball drawn out along the y axis of its frame by `half_length` to both sides; 0 for a sphere.
Surface capsule_surface(const ColliderFrame& frame, double half_length, double radius)
{
    constexpr std::uint32_t kRings = 48, kSegments = 96;
    Surface out;
    out.finish = Finish::solid;
    out.front = out.back = kSphere;
    for (std::uint32_t i = 0; i <= kRings; ++i)
        for (std::uint32_t k = 0; k < kSegments; ++k)
        {
            const double polar = glm::radians(180.0) * i / kRings;
            const double turn = glm::radians(360.0) * k / kSegments;
            const glm::dvec3 n{std::sin(polar) * std::cos(turn), std::cos(polar),
                               std::sin(polar) * std::sin(turn)};
            const double along = half_length == 0 ? 0 : 2 * i <= kRings ? half_length : -half_length;
            out.positions.emplace_back(glm::vec3(frame.outside(radius * n + glm::dvec3(0, along, 0))), 1.0f);
        }
    for (std::uint32_t i = 0; i < kRings; ++i)
        for (std::uint32_t k = 0; k < kSegments; ++k)
        {
            const std::uint32_t a = i * kSegments + k, b = i * kSegments + (k + 1) % kSegments;
            for (const std::uint32_t v : {a, b, a + kSegments, b, b + kSegments, a + kSegments})
                out.triangles.push_back(v);
        }
    return out;
}

Surface cuboid_surface(const ColliderFrame& frame, const glm::dvec3& half)
{
    Surface out;
    out.finish = Finish::solid;
    out.front = out.back = kSphere;
    // A face has its own corners, so that its edges stay sharp.
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
        {
            const auto first = static_cast<std::uint32_t>(out.positions.size());
            for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
            {
                glm::dvec3 corner(0);
                corner[axis] = side;
                corner[(axis + 1) % 3] = side * u;
                corner[(axis + 2) % 3] = v;
                out.positions.emplace_back(glm::vec3(frame.outside(half * corner)), 1.0f);
            }
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
                out.triangles.push_back(first + k);
        }
    return out;
}

Surface field_surface(const ColliderFrame& frame, const DistanceField& field, const FieldSurface& found)
{
    Surface out;
    out.finish = Finish::solid;
    out.front = out.back = kSphere;
    for (const glm::dvec3& p : found.positions)
        out.positions.emplace_back(glm::vec3(frame.outside(p - field.middle())), 1.0f);
    for (const auto& triangle : found.triangles)
        out.triangles.insert(out.triangles.end(), triangle.begin(), triangle.end());
    return out;
}

Surface plane_surface(const glm::dvec3& point, const glm::dvec3& normal, const Shot& shot)
{
    Surface out;
    out.finish = Finish::ground;
    out.front = kLightCell;
    out.back = kDarkCell;
    out.cell = static_cast<float>(round_number(shot.radius / 4));
    const glm::dvec3 focus = shot.focus;
    const glm::dvec3 centre = focus - glm::dot(focus - point, normal) * normal;
    const glm::dvec3 s = 6.0 * shot.radius * across(normal);
    const glm::dvec3 t = glm::cross(normal, s);
    for (const glm::dvec3& p : {centre - s - t, centre + s - t, centre + s + t, centre - s + t})
        out.positions.emplace_back(glm::vec3(p), 1.0f);
    out.triangles = {0, 1, 2, 0, 2, 3};
    return out;
}

/// Triangles and links of a body's mesh, its vertices renamed by `rename`.
template <typename Rename>
Surface body_surface(const Mesh& mesh, std::size_t number, const Rename& rename)
{
    Surface out;
    const Colours& colours = kBodies[number % std::size(kBodies)];
    out.front = colours.front;
    out.back = colours.back;
    out.line_radius = static_cast<float>(mesh.link_width / 2);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle)
            out.triangles.push_back(rename(v));
    for (const auto& link : mesh.links)
        for (const std::uint32_t v : link)
            out.lines.push_back(rename(v));
    if (mesh.triangles.empty() && mesh.links.empty()) // free particles: a dot each
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
            out.lines.insert(out.lines.end(), {rename(v), rename(v)});
    return out;
}

std::shared_ptr<Device> drawing(std::shared_ptr<Device> device)
{
    return device && can_draw(*device) ? device : open_drawing_device();
}

} // namespace

Pictures::Pictures(Scene resolved, std::shared_ptr<Device> device, const PictureOptions& options)
    : scene_(std::move(resolved)),
      options_(options),
      renderer_(drawing(std::move(device)))
{
    for (const Body& body : scene_.bodies)
        if (body.mesh.positions.empty())
            throw Error(ErrorCode::bad_input,
                        "body \"" + body.name +
                            "\" has no mesh to draw; give the scene that resolve() returns");
}

void Pictures::add(PictureMoment moment) { moments_.push_back(std::move(moment)); }

std::vector<Surface> Pictures::cloth(const PictureMoment& moment) const
{
    const std::vector<Body>& bodies = moment.scene ? moment.scene->bodies : scene_.bodies;
    std::vector<Surface> out;
    auto next = moment.positions.begin();
    for (std::size_t b = 0; b < bodies.size(); ++b)
    {
        const auto count = static_cast<std::ptrdiff_t>(bodies[b].mesh.positions.size());
        if (moment.positions.end() - next < count)
            throw Error(ErrorCode::bad_input, "the moment at " + std::to_string(moment.time) + " s has " +
                                                  std::to_string(moment.positions.size()) +
                                                  " positions, fewer than the scene has vertices");
        const std::span<const glm::dvec3> own(next, next + count);
        const Embedding& embedding = bodies[b].embedding;
        const bool carries = embedding.used();
        const Mesh& shown = carries ? embedding.surface : bodies[b].mesh;
        out.push_back(body_surface(shown, b, [](std::uint32_t v) { return v; }));
        const std::vector<glm::dvec3> carried =
            carries ? carry(embedding, bodies[b].mesh, own) : std::vector<glm::dvec3>();
        for (const glm::dvec3& x : carries ? std::span<const glm::dvec3>(carried) : own)
            out.back().positions.emplace_back(glm::vec3(x), 1.0f);
        next += count;
    }
    return out;
}

std::vector<Surface> Pictures::cloth_in_place(const World& world) const
{
    const Plan& plan = world.plan();
    std::vector<std::uint32_t> place_of(plan.original.size()); // of a scene-wide vertex, in the plan
    for (std::uint32_t i = 0; i < plan.original.size(); ++i)
        place_of[plan.original[i]] = i;
    std::vector<Surface> out;
    for (std::size_t b = 0; b < world.scene().bodies.size(); ++b)
    {
        const std::uint32_t first = plan.body_start[b];
        const auto rename = [&](std::uint32_t v) { return place_of[first + v]; };
        out.push_back(body_surface(world.scene().bodies[b].mesh, b, rename));
        out.back().buffer = world.position_buffer();
    }
    return out;
}

void Pictures::add_colliders(std::vector<Surface>& surfaces, const Scene& scene, double time,
                             const Shot& shot)
{
    for (const Collider& collider : scene.colliders)
    {
        ColliderFrame frame = frame_at(collider, time);
        const ColliderSolid solid = solid_of(collider);
        if (!solid.bounded)
        {
            // From behind it would hide everything: all that moves is in front of it.
            if (glm::dot(frame.y, glm::dvec3(shot.camera.eye) - frame.centre) > 0)
                surfaces.push_back(plane_surface(frame.centre, frame.y, shot));
        }
        else if (solid.field)
        {
            auto& known = field_surfaces_[collider.field];
            if (!known)
                known = std::make_shared<const FieldSurface>(surface_of(*collider.field));
            surfaces.push_back(field_surface(frame, *collider.field, *known));
        }
        else if (solid.is_box())
            surfaces.push_back(cuboid_surface(frame, solid.half));
        else
        {
            if (!solid.turns)
            {
                const ColliderFrame rest = rest_frame(collider);
                frame.x = rest.x;
                frame.y = rest.y;
                frame.z = rest.z;
            }
            surfaces.push_back(capsule_surface(frame, solid.half.y, solid.radius));
        }
    }
}

void Pictures::finish_strands(std::vector<Surface>& surfaces, const Shot& shot) const
{
    for (Surface& surface : surfaces) // a strand thinner than this is hard to see
        surface.line_radius = std::max(surface.line_radius, 0.004f * shot.radius);
}

Image Pictures::draw(const PictureMoment& moment, const Shot& shot)
{
    std::vector<Surface> surfaces = cloth(moment);
    add_colliders(surfaces, moment.scene ? *moment.scene : scene_, moment.time, shot);
    finish_strands(surfaces, shot);
    return renderer_.draw(shot, surfaces);
}

Image Pictures::draw(const World& world, const Shot& shot)
{
    const bool in_place = &world.device() == renderer_.device().get() && world.position_buffer() &&
                          world.plan().precision == Precision::float32 && !any_embedding(world.scene());
    if (!in_place)
        return draw(
            PictureMoment{world.time(), world.positions(), std::make_shared<const Scene>(world.scene())},
            shot);
    std::vector<Surface> surfaces = cloth_in_place(world);
    add_colliders(surfaces, world.scene(), world.time(), shot);
    finish_strands(surfaces, shot);
    return renderer_.draw(shot, surfaces);
}

Image Pictures::contact_sheet()
{
    if (moments_.empty())
        throw Error(ErrorCode::bad_input, "a contact sheet needs at least one moment; add or capture one");
    constexpr std::uint32_t kGap = 4;
    const auto count = static_cast<std::uint32_t>(moments_.size());
    const std::uint32_t columns = std::clamp(options_.columns, 1u, count);
    const std::uint32_t rows = (count + columns - 1) / columns;
    const std::uint32_t width = options_.cell_width, height = options_.cell_height;
    const Shot shot = frame_shot(scene_, moments_, width, height);
    Image sheet =
        make_image(columns * (width + kGap) - kGap, rows * (height + kGap) - kGap, glm::u8vec3(255));
    for (std::uint32_t i = 0; i < count; ++i)
    {
        Image cell = draw(moments_[i], shot);
        char text[40];
        std::snprintf(text, sizeof text, "t = %.2f s", moments_[i].time);
        label(cell, text, 14, 14, 2, {70, 76, 84});
        place(sheet, cell, i % columns * (width + kGap), i / columns * (height + kGap));
    }
    return sheet;
}

std::vector<std::string> Pictures::write(const std::filesystem::path& folder, const World* world)
{
    const Image sheet = contact_sheet(); // first: it refuses when there is nothing to draw
    const std::span<const PictureMoment> last(&moments_.back(), 1);
    const Shot shot = frame_shot(scene_, last, options_.width, options_.height, 1.35);
    write_png(folder / "picture.png", world != nullptr ? draw(*world, shot) : draw(moments_.back(), shot));
    write_png(folder / "contact_sheet.png", sheet);
    return {"picture.png", "contact_sheet.png"};
}

} // namespace taut
