#include "taut/kernels/face_sphere.hpp"

#include "support/faces.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::face_sphere::Params;

namespace {

template <typename Real>
using Sphere = layout::SphereCollider<Real>;

template <typename Real>
Sphere<Real> make_sphere(const glm::dvec3& start, const glm::dvec3& end, double radius, double friction)
{
    const auto r = [](double x) { return static_cast<Real>(x); };
    return {r(start.x), r(start.y), r(start.z), r(end.x), r(end.y), r(end.z), r(radius), r(friction)};
}

template <typename Real>
void check_spheres(const Faces<Real>& in, const std::vector<Sphere<Real>>& spheres)
{
    check_faces(
        in, kernels::face_sphere::info("", precision_of<Real>()),
        bytes_of(std::vector{in.template params<Params>()}), spheres,
        [&](RefFace& f, const std::array<glm::dvec3, 3>& x, std::array<glm::dvec3, 3>& d, std::uint32_t j) {
            const Sphere<Real>& c = spheres[j];
            const auto r = [](Real v) { return static_cast<double>(v); };
            const glm::dvec3 start(r(c.start_x), r(c.start_y), r(c.start_z));
            const glm::dvec3 end(r(c.end_x), r(c.end_y), r(c.end_z));
            const glm::dvec3 here = start + (end - start) * (double(in.substep) / in.substeps);
            const glm::dvec3 there = start + (end - start) * (double(in.substep + 1) / in.substeps);
            f.size += glm::length(here) + glm::length(there);
            for (std::size_t k = 0; k < 3; ++k)
            {
                f.p[k] = x[k] - here;
                f.e[k] = x[k] + d[k] - there;
                f.size += 2 * glm::length(x[k]) + glm::length(d[k]);
            }
            const auto before = f.e;
            f.friction = r(c.friction);
            const double radius = r(c.radius) + f.gap_kept;
            if (!ref_stuck(f, [&](const glm::dvec3& e) { return glm::length(e) - radius; }))
                ref_ball(f, glm::dvec3(0), radius);
            for (std::size_t k = 0; k < 3; ++k)
                d[k] += f.e[k] - before[k];
        });
}

/// One level triangle whose first corner is above (-1, 0, -1), at a height, going by `way`.
template <typename Real>
Faces<Real> level(double height, const glm::dvec3& way)
{
    Faces<Real> in;
    in.count = in.colliders = 1;
    const auto h = static_cast<Real>(height);
    in.position = {{-1, h, -1, 1}, {2, h, -1, 1}, {-1, h, 2, 1}};
    in.delta.assign(3, {glm::vec<3, Real>(way), Real(0)});
    in.slot.assign(4, glm::vec<4, Real>(7));
    in.corner = {0, 1, 2, 0};
    in.which = {0, 1}; // collider 0, and its bit
    in.state = {TAUT_FACE_FAR};
    return in;
}

} // namespace

TEMPLATE_TEST_CASE("triangles leave balls by their nearest point, and by where the balls went through them",
                   "[face]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 129u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const double speed = GENERATE(0.05, 1.0);
    const std::uint32_t sweep = GENERATE(0u, 1u, 2u, 3u);
    const std::uint64_t seed = 7100 + count;
    CAPTURE(count, colliders, speed, sweep, seed);
    Random random(seed);
    auto in = random_faces<Real>(random, count, colliders, 0.3, 0.4, speed);
    in.substeps = 4;
    in.substep = count % 4;
    in.set_sweep(sweep);
    std::vector<Sphere<Real>> spheres(1);
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        const glm::dvec3 start(random.vec4<double>(0.3, 0)), way(random.vec4<double>(0.2, 0));
        spheres.resize(j + 1);
        spheres[j] = make_sphere<Real>(start, start + way, random.uniform(0.1, 0.3), random.uniform(0, 1));
    }
    check_spheres(in, spheres);
}

TEMPLATE_TEST_CASE("a triangle that falls past the middle of a small ball in one substep ends on top of it",
                   "[face]", float, double)
{
    using Real = TestType;
    const std::vector spheres{make_sphere<Real>({}, {}, 0.1, 0)};
    const auto in = level<Real>(0.5, {0, -1, 0}); // to 0.5 below the middle; every corner far beside the ball
    const Launch launch = make_launch(kernels::face_sphere::info("", precision_of<Real>()),
                                      in.template params<Params>(), in.count);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, {launch},
                                {{"corner", bytes_of(in.corner)},
                                 {"position", bytes_of(in.position)},
                                 {"delta", bytes_of(in.delta)},
                                 {"collider", bytes_of(spheres)},
                                 {"which", bytes_of(in.which)},
                                 {"step_values", bytes_of(std::vector{in.step})},
                                 {"slot", bytes_of(in.slot)},
                                 {"state", bytes_of(in.state)}});
        CHECK(values_of<std::uint32_t>(out.at("state")).front() == TAUT_FACE_PUSHED);
        const auto slot = reals_of<Real>(out.at("slot"));
        double up = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
            CHECK(slot[4 * k + 3] == Approx(1.0 / 3)); // the middle of the ball is the middle of the triangle
            up += slot[4 * k + 1] / 3;
        }
        CHECK(up == Approx(0.6).epsilon(1e-6)); // from -0.5 to the top of the ball
    }
}
