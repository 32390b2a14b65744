#include "taut/kernels/vbd_share.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_share is the part of gravity that the acceleration showed, between 0 and 1", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool contact = GENERATE(false, true);
    const double pull = GENERATE(9.81, 0.0);
    CAPTURE(count, contact, pull);
    Random random(1230 + count);
    const std::uint32_t n = count + 7, bodies = 3;
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    step.gravity_x = Real(0.25 * pull);
    step.gravity_y = Real(-pull);
    const double h = double(step.substep);
    const glm::dvec3 fall = glm::dvec3(step.gravity_x, step.gravity_y, step.gravity_z) * h * h;
    const double whole = glm::dot(fall, fall);
    auto predicted = random.vec4s<Real>(n, 1e-4, 0, 0), delta = predicted, solved = predicted;
    std::vector<std::uint32_t> support;
    std::vector<double> touched(bodies, 0);
    Field field;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        support.push_back(random.below(2 * bodies));
        if (!random.chance(0.2)) // else free fall, whose share is 1 exactly
            delta[i] += random.vec4<Real>(2e-5, Real(0));
        solved[i] = delta[i];
        if (random.chance(0.3))
            solved[i].y += Real(1e-5);
        const bool moved = glm::vec<3, Real>(solved[i]) != glm::vec<3, Real>(delta[i]);
        touched[support[i] / 2] += i < count && moved ? 1 : 0;
        const glm::dvec3 off = glm::dvec3(delta[i]) - glm::dvec3(predicted[i]);
        const double shown = whole > 0 ? std::clamp(1 + glm::dot(off, fall) / whole, 0.0, 1.0) : 1;
        const double terms =
            (glm::length(glm::dvec3(delta[i])) + glm::length(glm::dvec3(predicted[i]))) * glm::length(fall);
        const bool held = support[i] % 2 == 1;
        if (i >= count)
            field.add(7, 0);
        else if (!contact && !held)
            field.add(1, 0);
        else
            field.add(shown, whole > 0 && off != glm::dvec3(0) ? 1 + terms / whole : 0);
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"predicted", bytes_of(predicted)},
            {"delta", bytes_of(delta)},
            {"support", bytes_of(support)},
            {"share", bytes_of(std::vector<Real>(n, Real(7)))},
            {"solved", bytes_of(solved)},
            {"touched", bytes_of(std::vector<std::uint32_t>(bodies, 0u))},
            {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::vbd_share::info(contact ? "contact" : "", c.precision),
                              kernels::vbd_share::Params{count}, count)};
    c.expected["share"] = field;
    if (contact)
        for (const std::string& selector : test_devices())
        {
            CAPTURE(selector);
            const auto device = test_device(selector);
            if (!can_run(*device, c.precision))
                continue;
            const auto have = values_of<std::uint32_t>(run(*device, c.launches, c.in).at("touched"));
            CHECK(std::vector<double>(have.begin(), have.end()) == touched);
        }
    check_on_every_device(c);
}
