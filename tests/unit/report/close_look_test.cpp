#include "taut/report/close_look.hpp"

#include "support/catch.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace {

using namespace taut;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kCells = 20, kFirst = 7; // the body's first vertex in the scene

glm::dvec3 anywhere(std::mt19937& random, double reach)
{
    std::uniform_real_distribution<double> spread(-reach, reach);
    const double x = spread(random), y = spread(random);
    return {x, y, spread(random)};
}

std::vector<glm::dvec3> sheet()
{
    std::vector<glm::dvec3> out;
    for (std::uint32_t i = 0; i <= kCells; ++i)
        for (std::uint32_t j = 0; j <= kCells; ++j)
            out.push_back(glm::dvec3(i, 0, j) / double(kCells) - glm::dvec3(0.5, 0, 0.5));
    return out;
}

/// Two triangles a cell, and a link along each row's first cell.
std::vector<ElementCorners> elements()
{
    std::vector<ElementCorners> out;
    for (std::uint32_t i = 0; i < kCells; ++i)
        for (std::uint32_t j = 0; j < kCells; ++j)
        {
            const std::uint32_t v = kFirst + i * (kCells + 1) + j, right = v + kCells + 1;
            out.push_back({v, right, v + 1});
            out.push_back({right, right + 1, v + 1});
            if (j == 0)
                out.push_back({v, right, right});
        }
    return out;
}

/// A sheet that is wavy, moved and torn about, at two moments, with what is before it in the scene.
struct Sheet
{
    WatchedBody body;
    std::vector<glm::dvec3> last, x, v;
    LookMoment now;

    explicit Sheet(std::mt19937& random)
    {
        const std::vector<glm::dvec3> rest = sheet();
        body.first = kFirst;
        body.count = rest.size();
        body.edge = std::sqrt(2.0) / kCells;
        body.led_speed = 0.2;
        body.groups = ElementGroups(elements(), rest, kFirst);
        last.assign(kFirst, glm::dvec3(0)); // all of it in a collider: another body's
        x = v = last;
        const glm::dvec3 shift = anywhere(random, 0.4), way = anywhere(random, 0.4);
        for (const glm::dvec3& p : rest)
        {
            last.push_back(p + shift + anywhere(random, 0.03));
            x.push_back(last.back() + way + anywhere(random, 0.03));
            v.push_back(way * (1 + p.x) + anywhere(random, 0.3));
        }
        now = {3, 0.5, 1e-3, {x, v, last}, 0.4};
    }
    std::vector<GroupMotion> motions() const
    {
        std::vector<GroupMotion> out;
        for (const ElementGroup& group : body.groups.groups())
            out.push_back(body.groups.motion(group, now.motion));
        return out;
    }
    TriangleCorners corners(const ElementCorners& e, const std::vector<glm::dvec3>& at,
                            const ColliderFrame& frame) const
    {
        return {frame.inside(at[e[0]]), frame.inside(at[e[1]]), frame.inside(at[e[2]])};
    }
};

WatchedCollider collider_of(int kind, bool moves, std::mt19937& random)
{
    WatchedCollider out;
    Collider& collider = out.collider;
    collider.kind = kind == 0   ? ColliderKind::sphere
                    : kind == 1 ? ColliderKind::capsule
                                : ColliderKind::cuboid;
    collider.radius = kind == 0 ? 0.15 : 0.02;
    collider.point = anywhere(random, 0.2);
    collider.end = collider.point + anywhere(random, 0.3);
    collider.half_size = {0.2, 0.02, 0.1};
    collider.rotate_axis = glm::normalize(anywhere(random, 1));
    collider.rotate_degrees = 40;
    if (moves)
        collider.motion = {{0, {}}, {1, anywhere(random, 1)}};
    out.shape = solid_shape(collider);
    out.led_speed = moves ? 1 : 0;
    return out;
}

/// m, from the collider's point or axis, or the inner part of its box, to a box round the element; and the
/// unit vector of that way.
struct Apart
{
    double distance;
    glm::dvec3 away;
};
Apart apart(const TriangleCorners& at, const glm::dvec3& half)
{
    glm::dvec3 away(0);
    for (int k = 0; k < 3; ++k)
    {
        const double low = std::min({at[0][k], at[1][k], at[2][k]}) - half[k];
        const double high = std::max({at[0][k], at[1][k], at[2][k]}) + half[k];
        away[k] = low > 0 ? low : std::min(high, 0.0);
    }
    const double distance = glm::length(away);
    return {distance, distance > 0 ? away / distance : away};
}

/// The first moment at which a point that goes on with `v`, and as fast again in any direction, and falls
/// half as much again, may be in the box; found by small steps up to a second.
double may_arrive(const glm::dvec3& p, const glm::dvec3& v, double own, const glm::dvec3& half,
                  double gravity)
{
    for (double t = 0; t < 1; t += 1e-3)
    {
        const glm::dvec3 then = p + v * t;
        if (glm::length(then - glm::clamp(then, -half, half)) <= own * t + 0.75 * gravity * t * t)
            return t;
    }
    return kInfinite;
}

/// Everything a close look tells, by each element for itself.
struct Plain
{
    LookFound found;
    double latest = kInfinite; ///< s, that clear may be
    bool through = false;

    Plain(const Sheet& sheet, const WatchedCollider& c, const LookBounds& bounds)
    {
        const ColliderFrame frame = frame_at(c.collider, sheet.now.time);
        const ColliderFrame then = frame_at(c.collider, *sheet.now.last_time);
        const std::vector<glm::dvec3> middle = middle_points(c.shape, sheet.body.edge);
        found.clear = kInfinite;
        for (const ElementCorners& e : elements())
        {
            const TriangleCorners at = sheet.corners(e, sheet.x, frame);
            look(sheet, c, bounds, e, at);
            const TriangleCorners before = sheet.corners(e, sheet.last, then);
            const auto passes = [&](const glm::dvec3& p) { return goes_through(p, before, at); };
            through = through || std::any_of(middle.begin(), middle.end(), passes) ||
                      (e[1] == e[2] && link_goes_through(c.shape, sheet.body.edge, before, at));
        }
    }
    void look(const Sheet& sheet, const WatchedCollider& c, const LookBounds& bounds, const ElementCorners& e,
              const TriangleCorners& at)
    {
        const glm::dvec3 velocity = c.velocity(sheet.now.time, sheet.now.substep);
        const ColliderFrame frame = frame_at(c.collider, sheet.now.time);
        const glm::dvec3 half = c.shape.radius > 0 ? c.shape.half : c.shape.half - c.shape.size;
        const Apart gap = apart(at, half);
        const double led = c.led_speed + sheet.body.led_speed;
        double own = 0.25 * bounds.speed, towards = -kInfinite;
        for (const std::uint32_t k : e)
            own = std::max(own, glm::length(sheet.v[k] - velocity));
        for (std::size_t j = 0; j < 3; ++j)
        {
            const glm::dvec3 v = frame.inside(frame.centre + sheet.v[e[j]] - velocity);
            towards = std::max(towards, -glm::dot(v, gap.away));
            latest = std::min(latest, may_arrive(at[j], v, own + 2 * led, half, bounds.gravity));
        }
        const double both = 0.5 * (own + led + std::max(towards + led, -own - led));
        found.clear = std::min(found.clear, time_over(gap.distance, both, bounds.gravity));
        if (apart(at, c.shape.half).distance <= c.shape.radius + bounds.speed * bounds.timestep)
            found.fits = found.fits || hole_of(at) > bounds.width;
        if (lies_deep(c.shape, at, sheet.body.edge))
        {
            ++found.deep;
            found.depth = std::max(found.depth, depth_of(c.shape, at));
        }
    }
};

TEST_CASE("groups hold each element once, those near each other together, with their vertices")
{
    const std::vector<glm::dvec3> rest = sheet();
    std::vector<glm::dvec3> with_more = rest;
    with_more.push_back({9, 9, 9}); // of no element
    const ElementGroups groups(elements(), with_more, kFirst);
    std::multiset<ElementCorners> seen;
    std::set<std::uint32_t> vertices;
    for (const ElementGroup& group : groups.groups())
    {
        const auto its = groups.vertices(group);
        CHECK(std::is_sorted(its.begin(), its.end()));
        vertices.insert(its.begin(), its.end());
        std::set<std::uint32_t> corners;
        for (const ElementCorners& e : groups.elements(group))
        {
            seen.insert(e);
            corners.insert(e.begin(), e.end());
        }
        if (group.elements > 0)
            CHECK(corners == std::set<std::uint32_t>(its.begin(), its.end()));
        if (group.elements > 0)
            CHECK(10 * its.size() < 12 * group.elements); // neighbours share them
    }
    const std::vector<ElementCorners> all = elements();
    CHECK(seen == std::multiset<ElementCorners>(all.begin(), all.end()));
    CHECK(vertices.size() == with_more.size());
    CHECK(groups.groups().back().elements == 0);
    CHECK(groups.groups().back().vertices == 1);
}

TEST_CASE("a group's motion bounds those of its vertices, and tells what is not finite")
{
    std::mt19937 random(5);
    Sheet sheet(random);
    for (const ElementGroup& group : sheet.body.groups.groups())
    {
        const GroupMotion motion = sheet.body.groups.motion(group, sheet.now.motion);
        double speed = 0, way = 0, radius = 0;
        for (const std::uint32_t i : sheet.body.groups.vertices(group))
        {
            speed = std::max(speed, glm::length(sheet.v[i]));
            way = std::max(way, glm::length(sheet.x[i] - sheet.last[i]));
            radius = std::max(radius, glm::length(sheet.x[i] - motion.centre()));
        }
        CHECK(motion.speed == Approx(speed));
        CHECK(motion.way == Approx(way));
        CHECK(motion.radius() >= radius);
        CHECK(motion.finite);
    }
    const ElementGroup& first = sheet.body.groups.groups().front();
    sheet.x[sheet.body.groups.vertices(first).front()].z = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(sheet.body.groups.motion(first, sheet.now.motion).finite);
}

TEST_CASE("a close look by groups finds what one at each element finds")
{
    std::mt19937 random(1);
    CloseLook close; // what it keeps from look to look must not show
    std::size_t deep = 0, fits = 0, through = 0;
    constexpr std::size_t kLooks = 400;
    for (std::size_t k = 0; k < kLooks; ++k)
    {
        const Sheet sheet(random);
        const WatchedCollider collider = collider_of(int(k % 3), k % 2 == 1, random);
        const LookBounds bounds{1, k % 5 == 0 ? 0.045 : 0.3, 1.0 / 60, 9.81, true};
        const Plain plain(sheet, collider, bounds);
        const LookFound found = close.look(sheet.body, collider, sheet.motions(), sheet.now, bounds);
        INFO(k);
        CHECK(found.deep == plain.found.deep);
        CHECK(found.depth == plain.found.depth);
        CHECK(found.clear >= plain.found.clear * (1 - 1e-12));
        CHECK(found.clear <= plain.latest + 1e-9);
        CHECK((!found.fits || plain.found.fits)); // a ball of a group may be further than boxes of elements
        CHECK(close.went_through(sheet.body, collider, sheet.motions(), sheet.now) == plain.through);
        deep += found.deep > 0;
        fits += plain.found.fits && found.fits;
        through += plain.through;
    }
    CHECK(deep > kLooks / 10); // and enough of either kind was there to find
    CHECK(deep < kLooks * 9 / 10);
    CHECK(fits > kLooks / 20);
    CHECK(through > kLooks / 10);
    CHECK(through < kLooks * 9 / 10);
}

} // namespace
