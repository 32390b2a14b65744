#include "taut/kernels/wind_pressure.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::conformance;
using kernels::wind_pressure::Params;

namespace {

template <typename Real>
struct Input
{
    std::vector<glm::vec<4, Real>> position, velocity;
    std::vector<layout::WindTriangle<Real>> triangle;
    layout::StepValues<Real> step{};
    layout::WindValues<Real> wind{};
    std::uint32_t count = 0, substep = 0, substeps = 1;
};

/// Vertices, triangles between any three of them, a wind that turns.
template <typename Real>
Input<Real> make_input(Random& random, std::uint32_t count)
{
    Input<Real> in;
    in.count = count;
    in.substeps = 4;
    in.substep = count % 4;
    in.position = random.vec4s<Real>(count + 9, 1, 0, 2);
    in.velocity = random.vec4s<Real>(count + 9, 5, 0, 0);
    static constexpr double kMasses[] = {1e-5, 1e-3, 1, 100};
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const std::uint32_t a = random.below(count + 9), b = (a + 1 + random.below(4)) % (count + 9);
        in.triangle.push_back({a, b, (b + 1 + random.below(3)) % (count + 9), 0,
                               static_cast<Real>(kMasses[random.below(4)]), random.uniform<Real>(0, 2),
                               random.uniform<Real>(0, 0.5)});
    }
    in.step.substep = Real(0.002);
    in.wind = {Real(3), Real(-1), Real(0.5), Real(-2), Real(4), Real(50), Real(1.2)};
    if (count > 2)
    {
        in.triangle[0].c = in.triangle[0].b; // no area, so no normal
        in.triangle[1].drag = in.triangle[1].friction_drag = Real(0);
        in.triangle[2].mass = Real(1e-30); // as good as weightless: the air takes it along
    }
    return in;
}

/// f = -rho/2 A |v| (c_n v_n + c_t v_t), over h by the exact solution of v' = -k |v| v of each part.
template <typename Real>
void expect(const Input<Real>& in, std::uint32_t i, Field& field)
{
    const auto& t = in.triangle[i];
    const auto at = [](const auto& list, std::uint32_t v) { return glm::dvec3(list[v]); };
    const double part = (in.substep + 0.5) / in.substeps;
    const glm::dvec3 from(in.wind.start_x, in.wind.start_y, in.wind.start_z);
    const glm::dvec3 to(in.wind.end_x, in.wind.end_y, in.wind.end_z);
    const glm::dvec3 air = from * (1 - part) + to * part;
    const glm::dvec3 mean =
        (at(in.velocity, t.a) + at(in.velocity, t.b) + at(in.velocity, t.c)) / 3.0;
    const glm::dvec3 v = mean - air;
    const glm::dvec3 e1 = at(in.position, t.b) - at(in.position, t.a);
    const glm::dvec3 e2 = at(in.position, t.c) - at(in.position, t.a);
    const glm::dvec3 cross = glm::cross(e1, e2);
    const double area = glm::length(cross) / 2, mass = static_cast<double>(t.mass);
    const double k = static_cast<double>(in.wind.density) / 2 * area * glm::length(v) / mass;
    const double h = static_cast<double>(in.step.substep);
    const glm::dvec3 n = area > 0 ? cross / (2 * area) : glm::dvec3(0);
    const glm::dvec3 along = n * glm::dot(n, v), across = v - along;
    const double kn = k * static_cast<double>(t.drag), kt = k * static_cast<double>(t.friction_drag);
    const glm::dvec3 impulse =
        -mass / 3 * (along * (kn * h / (1 + kn * h)) + across * (kt * h / (1 + kt * h)));
    // A thin triangle turns its normal by the rounding of its edges.
    const double turn = area > 0 ? (glm::length(e1) * glm::length(e2)) / area : 0;
    const double share = std::min(std::max(kn, kt) * h, 1.0);
    const double speed = glm::length(mean) + glm::length(air) + 5;
    const double scale = area > 0 ? mass / 3 * share * speed * (2 + turn) : 0;
    for (int c = 0; c < 3; ++c)
        field.add(area > 0 ? impulse[c] : 0.0, scale);
    field.add(0, 0);
}

} // namespace

TEMPLATE_TEST_CASE("the air pushes a triangle by its relative velocity and never turns it round",
                   "[wind_pressure]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint64_t seed = 1600 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const auto in = make_input<Real>(random, count);
    Case c;
    c.precision = precision_of<Real>();
    const std::vector<glm::vec<4, Real>> impulse(count + 2, glm::vec<4, Real>(Real(7)));
    c.in = {{"triangle", bytes_of(in.triangle)},
            {"position", bytes_of(in.position)},
            {"velocity", bytes_of(in.velocity)},
            {"step_values", bytes_of(std::vector{in.step})},
            {"wind", bytes_of(std::vector{in.wind})},
            {"impulse", bytes_of(impulse)}};
    c.launches = {make_launch(kernels::wind_pressure::info("", c.precision),
                              Params{count, in.substep, in.substeps}, count)};
    Field& field = c.expected["impulse"];
    for (std::uint32_t i = 0; i < count; ++i)
        expect(in, i, field);
    for (int k = 0; k < 8; ++k)
        field.add(7, 0);
    check_on_every_device(c);
}
