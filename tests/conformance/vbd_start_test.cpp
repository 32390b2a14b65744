#include "taut/kernels/vbd_start.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_start takes back the part of gravity that did not show, and weighs inertia", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::string variant = GENERATE("", "adaptive", "contact", "previous");
    CAPTURE(count, variant);
    Random random(1210 + count);
    const std::uint32_t n = count + 7, bodies = 5;
    auto position = random.vec4s<Real>(n, 1, 0, 0);
    const auto predicted = random.vec4s<Real>(n, 1e-2, 0, 1e-3), delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3),
               low = random.vec4s<Real>(n, 1e-8, 0, 1e-3);
    std::vector<Real> share;
    std::vector<std::uint32_t> support, touched, seen;
    for (std::uint32_t b = 0; b < bodies; ++b)
        touched.push_back(random.below(3));
    for (std::uint32_t i = 0; i < n; ++i)
    {
        position[i].w = random.inverse_mass<Real>();
        share.push_back(random.uniform<Real>(0, 1));
        support.push_back(random.below(2 * bodies));
        seen.insert(seen.end(), {random.below(3), random.below(2)});
    }
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    step.inverse_substep = Real(600);
    step.gravity_x = Real(0.5);
    step.gravity_y = Real(-9.81);
    step.gravity_z = Real(1);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},
            {"predicted", bytes_of(predicted)},
            {"delta", bytes_of(delta)},
            {"low", bytes_of(low)},
            {"share", bytes_of(share)},
            {"support", bytes_of(support)},
            {"touched", bytes_of(touched)},
            {"seen", bytes_of(seen)},
            {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::vbd_start::info(variant, c.precision),
                              kernels::vbd_start::Params{count}, count)};
    const double h = double(step.substep);
    const glm::dvec3 fall = glm::dvec3(step.gravity_x, step.gravity_y, step.gravity_z) * h * h;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const double w = double(position[i].w);
        const bool runs = i < count, moves = runs && w > 0;
        const std::uint32_t total = touched[support[i] / 2];
        const bool touches = total != seen[2 * i], held = support[i] % 2 == 1;
        double part = variant == "" || variant == "previous" ? 1 : double(share[i]);
        if (variant == "contact" && ((seen[2 * i + 1] == 1 && !touches) || (!held && !touches)))
            part = 1;
        for (int k = 0; k < 4; ++k)
        {
            const double y = double(predicted[i][k]);
            c.expected["predicted"].add(k < 3 || !runs ? y
                                        : w > 0        ? 600.0 * 600.0 / w
                                                       : 0,
                                        k < 3 || !moves ? 0 : 600.0 * 600.0 / w);
            const double back = k < 3 ? fall[k] * (1 - part) : 0;
            const double begin = variant == "previous" ? double(low[i][k]) : y - back;
            const bool exact = k == 3 || !moves || variant == "previous" || variant == "";
            c.expected["delta"].add(moves && k < 3 ? begin : double(delta[i][k]),
                                    exact ? 0 : std::abs(y) + std::abs(fall[k]));
        }
        if (variant != "contact")
            continue;
        c.expected["seen"].add(runs ? total : seen[2 * i], 0);
        c.expected["seen"].add(runs ? (touches ? 1 : 0) : seen[2 * i + 1], 0);
    }
    if (variant == "contact")
    {
        // `seen` holds words, which the comparison of reals cannot read.
        const Field wanted = c.expected["seen"];
        c.expected.erase("seen");
        const Buffers out = run(*test_device("cpu:serial"), c.launches, c.in);
        const auto have = values_of<std::uint32_t>(out.at("seen"));
        CHECK(std::vector<double>(have.begin(), have.end()) == wanted.value);
    }
    check_on_every_device(c);
}
