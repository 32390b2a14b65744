#include "taut/kernels/face_cuboid.hpp"

#include "support/faces.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::face_cuboid::Params;

namespace {

template <typename Real>
using Cuboid = layout::CuboidCollider<Real>;

/// The least way along an axis of the box by which all the points would be out of it.
template <std::size_t N>
double way_out(const std::array<glm::dvec3, N>& points, const glm::dvec3& extent)
{
    double least = 1e300;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0})
        {
            double deepest = 1e300;
            for (const glm::dvec3& x : points)
                deepest = std::min(deepest, side * x[axis]);
            least = std::min(least, extent[axis] - deepest);
        }
    return least;
}

/// Whether a plane between the triangle and the box is that of a face or of the triangle; flat ones count.
bool apart(RefFace& f, const glm::dvec3& extent)
{
    const double least = 2e-5 * std::min({extent.x, extent.y, extent.z});
    const double out = way_out(f.e, extent) - least;
    const glm::dvec3 n = normal_of(f.e);
    const double reach = glm::dot(glm::abs(n), extent) - least - std::abs(glm::dot(n, f.e[0]));
    f.doubt(out);
    f.doubt(reach);
    return out <= 0 || reach <= 0;
}

void ref_corner(RefFace& f, const glm::dvec3& extent, const glm::dvec3& o, const glm::dvec3& before,
                double side)
{
    const glm::dvec3 normal = normal_of(f.e) * side;
    const double height = glm::dot(normal, f.e[0] - o), most = 1.0625 * way_out(f.e, extent);
    f.doubt(height);
    f.doubt(height + most);
    if (!(height < 0) || -height > most)
        return;
    const Nearest near = nearest_on({f.e[0] - o, f.e[1] - o, f.e[2] - o});
    const glm::dvec3 room = extent * 1.001 - glm::abs(f.at_end(near.b));
    f.doubt(near.margin);
    f.doubt(std::min({room.x, room.y, room.z}));
    if (near.inside && std::min({room.x, room.y, room.z}) >= 0)
        ref_press(f, normal, glm::dot(before, f.at_start(near.b) - o), height, near.b);
}

/// Of the twelve edges of the box those that reach furthest across an edge of the triangle: of each axis one.
void ref_edge(RefFace& f, const glm::dvec3& extent, std::size_t i, std::size_t j)
{
    const glm::dvec3 a = f.e[i], u = f.e[j] - a, pa = f.p[i], pu = f.p[j] - pa;
    double best = -1e300, second = -1e300;
    glm::dvec3 normal(0), middle(0);
    int along = 0;
    for (int k = 0; k < 3; ++k)
    {
        glm::dvec3 axis(0);
        axis[k] = 1;
        const double side = glm::dot(glm::cross(pu, axis), pa) < 0 ? -1 : 1;
        f.doubt(glm::dot(glm::cross(pu, axis), pa));
        const glm::dvec3 n = glm::normalize(glm::cross(u, axis)) * side;
        glm::dvec3 o = glm::dvec3(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1, n.z < 0 ? -1 : 1) * extent;
        o[k] = 0;
        const double height = glm::dot(n, a - o);
        f.size *= 1 + 0.1 * glm::length(u) / glm::length(glm::cross(u, axis));
        second = std::max(second, std::min(best, height));
        if (height > best)
        {
            best = height;
            normal = n;
            middle = o;
            along = k;
        }
    }
    const double least = 1.0625 * way_out(std::array{f.e[i], f.e[j]}, extent);
    f.doubt(best - second);
    f.doubt(best);
    f.doubt(best + least);
    if (!(best < 0) || -best > least)
        return;
    // a + t u = middle + s axis + best normal
    glm::dvec3 axis(0);
    axis[along] = 1;
    const glm::dvec3 solved = glm::inverse(glm::dmat3(u, -axis, -normal)) * (middle - a);
    const double t = solved.x, s = solved.y / extent[along];
    f.doubt(std::min(std::abs(t), std::abs(1 - t)));
    f.doubt(std::abs(s) - 1);
    if (!(t > 0 && t < 1 && std::abs(s) < 1))
        return;
    glm::dvec3 b(0);
    b[static_cast<int>(i)] = 1 - t;
    b[static_cast<int>(j)] = t;
    ref_press(f, normal, glm::dot(normal, f.at_start(b) - middle), best, b);
}

template <typename Real>
void ref_cuboid(RefFace& f, const Cuboid<Real>& c)
{
    const glm::dvec3 extent = glm::dvec3(c.half_x, c.half_y, c.half_z) + f.gap_kept;
    const auto height = [&](const glm::dvec3& e) {
        const glm::dvec3 over = glm::abs(e) - extent;
        return std::max({over.x, over.y, over.z});
    };
    if (apart(f, extent) || ref_stuck(f, height))
        return;
    const double side = glm::dot(normal_of(f.p), f.p[0]) < 0 ? -1 : 1;
    f.doubt(glm::dot(normal_of(f.p), f.p[0]));
    const glm::dvec3 before = normal_of(f.p) * side;
    f.size *= 1 + turn_of(f.e) + turn_of(f.p);
    for (int k = 0; k < 8; ++k)
        ref_corner(f, extent, extent * glm::dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), before,
                   side);
    ref_edge(f, extent, 0, 1);
    ref_edge(f, extent, 1, 2);
    ref_edge(f, extent, 2, 0);
}

} // namespace

TEMPLATE_TEST_CASE("triangles leave boxes by the corners and edges that stand out of them", "[face]", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 64u, 65u, 129u);
    const std::uint32_t colliders = GENERATE(1u, 2u);
    const double speed = GENERATE(0.02, 0.3);
    const std::uint32_t sweep = GENERATE(0u, 1u, 2u, 3u);
    const std::uint64_t seed = 7300 + count;
    CAPTURE(count, colliders, speed, sweep, seed);
    Random random(seed);
    auto in = random_faces<Real>(random, count, colliders, 0.3, 0.5, speed);
    in.substeps = 4;
    in.substep = count % 4;
    in.set_sweep(sweep);
    std::vector<Cuboid<Real>> poses(std::max((in.substeps + 1) * colliders, 1u));
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        Drift drift = random_drift(random);
        drift.centre *= 0.3;
        const glm::dvec3 half(random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), random.uniform(0.1, 0.4));
        const double friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= in.substeps; ++s)
        {
            Cuboid<Real>& c = poses[s * colliders + j];
            put_frame<Real>(c, drift.at(s));
            c.half_x = static_cast<Real>(half.x);
            c.half_y = static_cast<Real>(half.y);
            c.half_z = static_cast<Real>(half.z);
            c.friction = static_cast<Real>(friction);
        }
    }
    const auto params = in.template params<Params>();
    check_turned_faces(in, kernels::face_cuboid::info("", precision_of<Real>()),
                       bytes_of(std::vector{params}), poses, ref_cuboid<Real>);
}

TEMPLATE_TEST_CASE("a post under one corner of a triangle lifts it to its top, and no higher", "[face]",
                   float, double)
{
    using Real = TestType;
    const int under = GENERATE(0, 1, 2);
    const double deep = 0.01, half = 0.02;
    Faces<Real> in;
    in.count = in.colliders = 1;
    const glm::dvec3 corner[] = {{-1, 0, -1}, {2, 0, -1}, {-1, 0, 2}};
    glm::dvec3 post(0); // 0.8 of the corner that it is under
    for (int k = 0; k < 3; ++k)
        post += corner[k] * (k == under ? 0.8 : 0.1);
    for (const glm::dvec3& x : corner)
        in.position.emplace_back(glm::vec<3, Real>(x + glm::dvec3(0, half, 0)), Real(1)); // at its top
    in.delta.assign(3, {Real(0), static_cast<Real>(-deep), Real(0), Real(0)});
    in.slot.assign(4, glm::vec<4, Real>(0));
    in.corner = {0, 1, 2, 0};
    in.which = {0, 1}; // collider 0, and its bit
    in.state = {TAUT_FACE_FAR};
    std::vector<Cuboid<Real>> poses(2);
    for (Cuboid<Real>& c : poses)
    {
        put_frame<Real>(c, Frame{post});
        c.half_x = c.half_y = c.half_z = static_cast<Real>(half);
    }
    const Launch launch =
        make_launch(kernels::face_cuboid::info("", precision_of<Real>()), in.template params<Params>(), 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, under);
        const auto slot = reals_of<Real>(run(*device, {launch}, inputs_of(in, poses)).at("slot"));
        double height = -deep; // of the triangle over the middle of the post
        for (int k = 0; k < 3; ++k)
            height += slot[4 * static_cast<std::size_t>(k) + 1] * (k == under ? 0.8 : 0.1);
        CHECK(height > -0.01 * deep);
        CHECK(height < 0.1 * deep);
    }
}
