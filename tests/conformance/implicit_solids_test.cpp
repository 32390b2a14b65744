#include "taut/kernels/implicit_solids.hpp"

#include "support/solid_net.hpp"
#include "support/solid_stress.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("the reference's derivative of the stress is that of the energy's forces")
{
    Random random(11);
    for (const double log : {0.0, 1.0})
        for (int k = 0; k < 20; ++k)
        {
            Elastic m{random.uniform(1, 10), random.uniform(1, 50), 1.2, log};
            glm::dmat3 f(0.0);
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r)
                    f[c][r] = random.uniform(-2, 2);
            const Matrix9 exact = stress_derivative(m, f);
            CHECK((exact - exact.transpose()).norm() < 1e-12 * exact.norm());
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r)
                {
                    glm::dmat3 step(0.0);
                    step[c][r] = 1e-5;
                    const Eigen::Matrix<double, 9, 1> slope =
                        (flat(stress_of(m, f + step)) - flat(stress_of(m, f - step))) / 2e-5;
                    CHECK((slope - exact.col(3 * c + r)).norm() < 1e-7 * exact.norm());
                }
        }
}

TEMPLATE_TEST_CASE("implicit_solids keeps stress and a positive semidefinite derivative", "", float, double)
{
    using Real = TestType;
    const std::uint32_t shapes = GENERATE(1u, 63u, 64u, 65u, 127u, 129u, 1000u);
    const std::uint32_t report = GENERATE(0u, 1u);
    CAPTURE(shapes, report);
    SolidNet<Real> in = random_solids<Real>(shapes + 40, shapes, 990 + shapes);
    for (std::size_t k = 5; k < shapes; k += 24) // collapsed to a line
    {
        auto& t = in.solids[k];
        t.b01 = t.b11 = t.b21 = t.b02 = t.b12 = t.b22 = Real(0);
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = in.net.buffers();
    c.in["solid"] = bytes_of(in.solids);
    c.in["events"] = no_events();
    c.in["state"] = Bytes(shapes * TAUT_SOLID_STATE * sizeof(Real));
    c.launches = {make_launch(kernels::implicit_solids::info("", c.precision),
                              kernels::implicit_solids::Params{shapes, report, in.net.scale}, shapes)};
    Field& field = c.expected["state"];
    std::size_t negative = 0;
    for (std::size_t k = 0; k < shapes; ++k)
    {
        const auto& t = in.solids[k];
        const Elastic m{double(t.mu), double(t.lambda), double(t.rest), double(t.log_term)};
        const glm::dmat3 edges = edges_of(in, k), b = inverse_rest(t);
        const glm::dmat3 f = edges * b;
        const double units = double(t.volume) * in.net.h() * in.net.h() * double(in.net.scale);
        const glm::dmat3 cofactor = cofactor_of(f);
        const double size = flat(f).squaredNorm(), area = flat(cofactor).squaredNorm();
        c.events[TAUT_EVENT_DEGENERATE] += report != 0 && (size < 1e-6 || area < 1e-13 * size * size) ? 1 : 0;
        double grown = 0; // of the terms that make F
        const auto v = in.corners(k);
        for (int e = 0; e < 3; ++e)
            grown += glm::length(edges[e]) * in.net.reach(v[0], v[static_cast<std::size_t>(e) + 1]) *
                     glm::length(row_of(t, static_cast<std::size_t>(e) + 1));
        Matrix9 derivative = stress_derivative(m, f);
        if (m.mu == 0)
            derivative = m.lambda * flat(cofactor) * flat(cofactor).transpose();
        const Matrix9 kept = turned_positive(derivative);
        negative += (kept - derivative).norm() > 1e-3 * kept.norm() ? 1 : 0;
        const std::vector<double> state = state_of(stress_of(m, f) * units, kept * units);
        const double square = grown * grown;
        const double push = m.lambda * (square * grown + m.rest);
        for (std::size_t e = 0; e < state.size(); ++e)
            field.add(state[e],
                      units * (e < 9 ? m.mu * grown + push * square
                                     : m.mu * (1 + square) + m.lambda * square * square + push * grown));
    }
    if (shapes > 60)
    {
        CHECK(negative > shapes / 8);
        CHECK(c.events[TAUT_EVENT_DEGENERATE] >= (report != 0 ? shapes / 12 : 0u));
    }
    // Not to the last bit: drivers reassociate within the rotations, and what they take out is then a
    // rounding off (up to some units in the last place, within the tolerance everywhere). Demanded, it failed
    // on Mesa's Vulkan and OpenGL alike, from GLSL and from SPIR-V, in float and double.
    look_on_every_device(c, nullptr, false);
}
