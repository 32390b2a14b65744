#include "taut/kernels/pbd_average.hpp"
#include "taut/kernels/pbd_bend.hpp"
#include "taut/kernels/pbd_node.hpp"
#include "taut/kernels/pbd_stretch.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_average::Params;

namespace {

/// Constraints write slots, vertices average them.
template <typename Real>
std::vector<Launch> slots_then_average(const PbdInput<Real>& in, bool hinges, bool chebyshev, float stretch,
                                       float bend, float relaxation, float omega)
{
    const Precision precision = precision_of<Real>();
    const auto springs = static_cast<std::uint32_t>(in.spring.size()),
               bends = static_cast<std::uint32_t>(in.hinge.size()),
               vertices = static_cast<std::uint32_t>(in.position.size());
    std::vector<Launch> out = {make_launch(kernels::pbd_stretch::info("slots", precision),
                                           kernels::pbd_stretch::Params{0, springs, stretch, 1}, springs)};
    if (hinges)
        out.push_back(make_launch(kernels::pbd_bend::info("slots", precision),
                                  kernels::pbd_bend::Params{0, bends, bend, 1}, bends));
    out.push_back(make_launch(kernels::pbd_average::info(jacobi_variant(hinges, chebyshev), precision),
                              Params{vertices, relaxation, omega}, vertices));
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("slots are averaged at each vertex in fixed order", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const bool hinges = GENERATE(false, true), chebyshev = GENERATE(false, true);
    CAPTURE(count, hinges, chebyshev);
    auto in = jacobi_input<Real>(count, 2500 + count);
    Random random(2600 + count);
    const float relaxation = 1.25f, omega = chebyshev ? 1.9f : 1.0f;
    const auto springs = random.vec4s<Real>(std::max<std::size_t>(in.spring.size(), 1), 1e-2, 0, 0);
    const auto bends = random.vec4s<Real>(4 * in.hinge.size(), 1e-2, 0, 0);
    const auto vertices = static_cast<std::uint32_t>(in.position.size());
    std::vector<glm::dvec3> sum(vertices);
    std::vector<double> size(vertices), number(vertices);
    const auto add = [&](std::uint32_t v, const glm::dvec3& by) {
        sum[v] += by;
        size[v] += glm::length(by);
        number[v] += 1;
    };
    for (std::size_t k = 0; k < in.spring.size(); ++k)
    {
        add(in.spring[k].a, glm::dvec3(springs[k]));
        add(in.spring[k].b, -glm::dvec3(springs[k]));
    }
    for (std::size_t k = 0; k < in.hinge.size() && hinges; ++k)
    {
        const std::uint32_t corner[] = {in.hinge[k].edge0, in.hinge[k].edge1, in.hinge[k].wing0,
                                        in.hinge[k].wing1};
        for (std::size_t j = 0; j < 4; ++j)
            add(corner[j], glm::dvec3(bends[4 * k + j]));
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = jacobi_buffers(in);
    c.in["spring_correction"] = bytes_of(springs);
    c.in["hinge_correction"] = bytes_of(bends);
    c.launches = {make_launch(kernels::pbd_average::info(jacobi_variant(hinges, chebyshev), c.precision),
                              Params{vertices, relaxation, omega}, vertices)};
    Field next;
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        const double w = static_cast<double>(in.position[v].w), o = static_cast<double>(omega);
        const double factor = number[v] > 0 ? w * static_cast<double>(relaxation) / number[v] : 0;
        const glm::dvec3 here(in.delta[v]), before(in.before[v]);
        glm::dvec3 x = here + sum[v] * factor;
        double scale = factor > 0 ? glm::length(here) + factor * size[v] : 0;
        if (chebyshev && w > 0)
        {
            scale = o * (scale + glm::length(x) + glm::length(before));
            x = before + (x - before) * o;
        }
        for (int axis = 0; axis < 4; ++axis)
            next.add(axis < 3 ? x[axis] : static_cast<double>(in.delta[v].w), axis < 3 ? scale : 0);
    }
    c.expected["next"] = next;
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("node-centric and constraint-centric Jacobi agree bit for bit", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(65u, 1000u);
    const bool hinges = GENERATE(false, true), chebyshev = GENERATE(false, true);
    auto in = jacobi_input<Real>(count, 2700 + count);
    plant_springs(in, 0, in.spring_colours[1]);
    const float stretch = 0.75f, bend = 0.3f, relaxation = 1.5f, omega = chebyshev ? 1.7f : 1.0f;
    const auto vertices = static_cast<std::uint32_t>(in.position.size());
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, count, hinges, chebyshev);
        const auto node = make_launch(
            kernels::pbd_node::info(jacobi_variant(hinges, chebyshev), precision_of<Real>()),
            kernels::pbd_node::Params{vertices, stretch, bend, relaxation, omega, 1}, vertices);
        const Buffers a = run(*device, {node}, jacobi_buffers(in));

        // The slots' kernels call their list `constraint` and their result `correction`: one after another.
        Buffers all = jacobi_buffers(in);
        const auto launches =
            slots_then_average(in, hinges, chebyshev, stretch, bend, relaxation, omega);
        all["constraint"] = bytes_of(in.spring);
        all["correction"] = bytes_of(std::vector<glm::vec<4, Real>>(in.spring.size()));
        Buffers out = run(*device, {launches[0]}, all);
        all["spring_correction"] = out.at("correction");
        all["events"] = out.at("events");
        if (hinges)
        {
            all["constraint"] = bytes_of(in.hinge);
            all["correction"] = bytes_of(std::vector<glm::vec<4, Real>>(4 * in.hinge.size()));
            out = run(*device, {launches[1]}, all);
            all["hinge_correction"] = out.at("correction");
            all["events"] = out.at("events");
        }
        const Buffers b = run(*device, {launches.back()}, all);
        CHECK((a.at("next") == b.at("next")));
        CHECK((a.at("events") == all.at("events")));
    }
}
