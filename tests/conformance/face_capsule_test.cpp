#include "taut/kernels/face_capsule.hpp"

#include "support/faces.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::face_capsule::Params;

namespace {

template <typename Real>
using Capsule = layout::CapsuleCollider<Real>;

/// Where two lines are nearest, by their shares of 1 between the ends given; the axis is the second.
struct Crossing
{
    double edge = 0, axis = 0;
    bool inside = false;
    double margin = 0;
};

Crossing crossing_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up)
{
    const glm::dvec3 u = b - a, v = up * 2.0, from = a + up; // the axis begins at -up
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), d = uu * vv - uv * uv;
    const double ru = -glm::dot(u, from), rv = glm::dot(v, from);
    Crossing out;
    out.edge = (ru * vv + rv * uv) / d;
    out.axis = (rv * uu + ru * uv) / d;
    out.inside = out.edge > 0 && out.edge < 1 && out.axis > 0 && out.axis < 1;
    out.margin =
        std::min({std::abs(out.edge), std::abs(out.axis), std::abs(1 - out.edge), std::abs(1 - out.axis)});
    if (std::max(std::abs(out.edge - 0.5), std::abs(out.axis - 0.5)) > 0.6)
        out.margin = 1; // far beyond an end
    return out;
}

/// Across both, or 0 where they are next to parallel; within a hundredth of that a rounding decides.
glm::dvec3 across(RefFace& f, const glm::dvec3& u, const glm::dvec3& v)
{
    const glm::dvec3 out = glm::cross(u, v);
    const double least = 1e-3 * glm::length(u) * glm::length(v), size = glm::length(out);
    f.open = f.open || std::abs(size - least) < 1e-2 * least;
    return size > least ? out / size : glm::dvec3(0);
}

/// The axis against the edge of the corners i and j.
void ref_axis(RefFace& f, const glm::dvec3& up, double r, std::size_t i, std::size_t j)
{
    const glm::dvec3 pa = f.p[i], pb = f.p[j], ea = f.e[i], eb = f.e[j];
    const Crossing after = crossing_of(ea, eb, up);
    const glm::dvec3 across_before = across(f, up, pb - pa), across_after = across(f, up, eb - ea);
    const double height_before = glm::dot(across_before, pa), height_after = glm::dot(across_after, ea);
    double share = after.edge;
    bool meets = after.inside && across_after != glm::dvec3(0);
    glm::dvec3 normal = glm::normalize(ea + (eb - ea) * share - (up * (2 * after.axis - 1)));
    f.doubt(height_before);
    f.doubt(height_after);
    f.doubt(after.margin);
    if (height_before * height_after < 0)
    {
        const double t = height_before / (height_before - height_after);
        const Crossing met = crossing_of(pa + (ea - pa) * t, pb + (eb - pb) * t, up);
        f.doubt(met.margin);
        if (met.inside)
        {
            meets = true;
            share = met.edge;
            normal = across_after * (height_before < 0 ? -1.0 : 1.0);
        }
    }
    if (!meets)
        return;
    glm::dvec3 b(0);
    b[static_cast<int>(i)] = 1 - share;
    b[static_cast<int>(j)] = share;
    const double height = glm::dot(normal, f.at_end(b)) - r;
    f.doubt(height);
    f.size *= 1 + glm::length(up) * glm::length(eb - ea) / glm::length(glm::cross(up, eb - ea));
    if (!(height < 0))
        return;
    const glm::dvec3 start = f.at_start(b);
    const glm::dvec3 off = start - glm::dvec3(0, std::clamp(start.y, -up.y, up.y), 0);
    ref_press(f, normal, glm::length(off) - r, height, b);
}

template <typename Real>
void ref_capsule(RefFace& f, const Capsule<Real>& c)
{
    const glm::dvec3 up(0, static_cast<double>(c.half_length), 0);
    const double r = static_cast<double>(c.radius) + f.gap_kept;
    const auto height = [&](const glm::dvec3& e) {
        return glm::length(e - glm::dvec3(0, std::clamp(e.y, -up.y, up.y), 0)) - r;
    };
    if (ref_stuck(f, height))
        return;
    ref_axis(f, up, r, 0, 1);
    ref_axis(f, up, r, 1, 2);
    ref_axis(f, up, r, 2, 0);
    ref_ball(f, up, r);
    ref_ball(f, -up, r);
}

} // namespace

TEMPLATE_TEST_CASE("triangles leave capsules by their edges across the axis, and by its ends", "[face]",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 64u, 65u, 129u);
    const std::uint32_t colliders = GENERATE(1u, 2u);
    const double speed = GENERATE(0.05, 0.5);
    const std::uint32_t sweep = GENERATE(0u, 1u, 2u, 3u);
    const std::uint64_t seed = 7200 + count;
    CAPTURE(count, colliders, speed, sweep, seed);
    Random random(seed);
    auto in = random_faces<Real>(random, count, colliders, 0.35, 0.4, speed);
    in.substeps = 4;
    in.substep = count % 4;
    in.set_sweep(sweep);
    std::vector<Capsule<Real>> poses(std::max((in.substeps + 1) * colliders, 1u));
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        Drift drift = random_drift(random);
        drift.centre *= 0.3;
        const double half = random.uniform(0.2, 0.5), radius = random.uniform(0.05, 0.15);
        const double friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= in.substeps; ++s)
        {
            Capsule<Real>& c = poses[s * colliders + j];
            put_frame<Real>(c, drift.at(s));
            c.half_length = static_cast<Real>(half);
            c.radius = static_cast<Real>(radius);
            c.friction = static_cast<Real>(friction);
        }
    }
    const auto params = in.template params<Params>();
    check_turned_faces(in, kernels::face_capsule::info("", precision_of<Real>()),
                       bytes_of(std::vector{params}), poses, ref_capsule<Real>);
}
