// What a picture shows: bodies and colliders, and of torn cloth the parts that a viewer looks for.

#include "taut/report/picture_frame.hpp"

#include "taut/report/is_finite.hpp"
#include "taut/report/picture.hpp"
#include "taut/scene/collider.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut {
namespace {

glm::dvec3 up_of(const Scene& scene)
{
    return glm::length(scene.gravity) > 0 ? -glm::normalize(scene.gravity) : glm::dvec3(0, 1, 0);
}

void add_ball(std::vector<glm::dvec3>& points, const glm::dvec3& centre, double radius)
{
    constexpr int kSteps = 4;
    for (int x = -kSteps; x <= kSteps; ++x)
        for (int y = -kSteps; y <= kSteps; ++y)
            for (int z = -kSteps; z <= kSteps; ++z)
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == kSteps)
                    points.push_back(centre + radius * glm::normalize(glm::dvec3(x, y, z)));
}

/// What a picture should hold of a collider; a plane has no end, so nothing of it.
void add_collider(std::vector<glm::dvec3>& points, const Collider& collider, double time)
{
    const ColliderFrame frame = frame_at(collider, time);
    const ColliderSolid solid = solid_of(collider);
    if (solid.radius > 0)
        for (const double end : {-solid.half.y, solid.half.y})
            add_ball(points, frame.outside({0, end, 0}), solid.radius);
    else if (solid.bounded)
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                for (const double z : {-1.0, 1.0})
                    points.push_back(frame.outside(solid.half * glm::dvec3(x, y, z)));
}

/// The connected parts of a mesh: for every vertex the least vertex that it hangs together with.
std::vector<std::uint32_t> parts_of(const Mesh& mesh)
{
    std::vector<std::uint32_t> root(mesh.positions.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t v)
    {
        while (root[v] != v)
            v = root[v] = root[root[v]];
        return v;
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b)
    {
        a = find(a);
        b = find(b);
        root[std::max(a, b)] = std::min(a, b);
    };
    for (const auto& t : mesh.triangles)
    {
        join(t[0], t[1]);
        join(t[0], t[2]);
    }
    for (const auto& l : mesh.links)
        join(l[0], l[1]);
    for (std::uint32_t v = 0; v < root.size(); ++v)
        root[v] = find(v);
    return root;
}

/// The parts of a torn body that the picture is about, by their least vertices: those that hold a pin and at
/// least a tenth of the vertices, else the largest one.
std::vector<bool> main_parts(const Body& body, const std::vector<std::uint32_t>& part)
{
    constexpr double kShare = 0.1;
    std::vector<std::size_t> size(part.size(), 0);
    for (const std::uint32_t p : part)
        ++size[p];
    std::vector<bool> main(part.size(), false);
    bool any = false;
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            if (static_cast<double>(size[part[v]]) >= kShare * static_cast<double>(part.size()))
                any = main[part[v]] = true;
    if (!any)
        main[static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin())] = true;
    return main;
}

/// The vertices of a body that may tear: its main parts, and what lies no further from the middle of these
/// than 1.2 times half their diagonal. Scraps that fell further would make a speck of all else.
void add_torn(std::vector<glm::dvec3>& points, const Body& body, std::span<const glm::dvec3> x)
{
    const std::vector<std::uint32_t> part = parts_of(body.mesh);
    const std::vector<bool> main = main_parts(body, part);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(kInfinity), high(-kInfinity);
    for (std::size_t v = 0; v < part.size(); ++v)
        if (main[part[v]] && is_finite(x[v]))
        {
            low = glm::min(low, x[v]);
            high = glm::max(high, x[v]);
        }
    const double reach = 1.2 * 0.5 * glm::length(high - low);
    for (std::size_t v = 0; v < part.size(); ++v)
        if (is_finite(x[v]) && (main[part[v]] || glm::length(x[v] - (low + high) / 2.0) <= reach))
            points.push_back(x[v]);
}

/// What a picture should hold of the bodies at one moment.
void add_bodies(std::vector<glm::dvec3>& points, const Scene& scene, const std::vector<glm::dvec3>& x)
{
    std::size_t first = 0;
    for (const Body& body : scene.bodies)
    {
        const std::size_t count = body.mesh.positions.size();
        if (first + count > x.size())
            break; // positions of another scene: the drawing says so
        const std::span<const glm::dvec3> own(x.data() + first, count);
        if (body.material.tear_strain > 0)
            add_torn(points, body, own);
        else
            std::copy_if(own.begin(), own.end(), std::back_inserter(points), is_finite);
        first += count;
    }
}

/// Everything that a picture should hold.
std::vector<glm::dvec3> points_of(const Scene& scene, std::span<const PictureMoment> moments)
{
    std::vector<glm::dvec3> points;
    for (const PictureMoment& moment : moments)
    {
        add_bodies(points, moment.scene ? *moment.scene : scene, moment.positions);
        for (const Collider& collider : scene.colliders)
            add_collider(points, collider, moment.time);
    }
    if (points.empty())
        add_ball(points, glm::dvec3(0), 1);
    return points;
}

/// Camera position along one axis of the picture: where the extreme points touch both borders. `slope`:
/// half the opening; points given as (along the axis, towards the camera).
struct Fit
{
    double low = -std::numeric_limits<double>::infinity(), high = low;

    void hold(double along, double towards, double slope)
    {
        low = std::max(low, slope * towards - along);
        high = std::max(high, slope * towards + along);
    }
    double centre() const { return (high - low) / 2; }
    double distance(double slope) const { return (high + low) / (2 * slope); }
};

Camera frame_camera(const Scene& scene, const std::vector<glm::dvec3>& points, double aspect, double margin)
{
    constexpr double kTurn = 0.55, kRise = 0.40; // radians: to the right, upwards
    Camera camera;
    const glm::dvec3 upright = up_of(scene);
    const glm::dvec3 front = across(upright);
    const glm::dvec3 side = glm::cross(upright, front);
    const glm::dvec3 back = std::cos(kRise) * (std::cos(kTurn) * front + std::sin(kTurn) * side) +
                            std::sin(kRise) * upright; // from the scene to the camera
    const glm::dvec3 right = glm::normalize(glm::cross(upright, back));
    const glm::dvec3 up = glm::cross(back, right);
    const double slope_y = std::tan(camera.fov / 2) / margin;
    const double slope_x = slope_y * aspect;
    Fit x, y;
    for (const glm::dvec3& p : points)
    {
        x.hold(glm::dot(p, right), glm::dot(p, back), slope_x);
        y.hold(glm::dot(p, up), glm::dot(p, back), slope_y);
    }
    const double distance = std::max(x.distance(slope_x), y.distance(slope_y));
    const glm::dvec3 eye = x.centre() * right + y.centre() * up + distance * back;
    camera.eye = eye;
    camera.target = eye - back;
    camera.up = upright;
    return camera;
}

} // namespace

/// A unit vector across `axis`: world z for an upright y.
glm::dvec3 across(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

Shot frame_shot(const Scene& resolved, std::span<const PictureMoment> moments, std::uint32_t width,
                std::uint32_t height, double margin)
{
    const std::vector<glm::dvec3> points = points_of(resolved, moments);
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& p : points)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 focus = (low + high) / 2.0;
    double radius = 1e-6;
    for (const glm::dvec3& p : points)
        radius = std::max(radius, glm::length(p - focus));
    Shot shot;
    shot.width = width;
    shot.height = height;
    shot.camera = frame_camera(resolved, points, double(width) / height, margin);
    shot.focus = focus;
    shot.radius = static_cast<float>(1.02 * radius);
    return shot;
}

} // namespace taut
