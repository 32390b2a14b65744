#include "taut/kernels/pbd_average.hpp"
#include "taut/kernels/pbd_hinge.hpp"
#include "taut/kernels/pbd_node.hpp"
#include "taut/kernels/pbd_spring.hpp"
#include "taut/kernels/pbd_volume.hpp"

#include "support/pbd_jacobi.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_average::Params;

namespace {

/// Iteration by slots: kernels that write them, their lists and where the slots are read.
template <typename Real>
Buffers slots_then_average(Device& device, const PbdInput<Real>& in, const JacobiCase& of,
                           const Launch& average)
{
    const Precision precision = precision_of<Real>();
    Buffers all = jacobi_buffers(in);
    // The slots' kernels call their list `constraint` and their result `correction`: one after another.
    const auto write = [&](const Launch& launch, const auto& elements, std::size_t slots, const char* name) {
        all["constraint"] = bytes_of(elements);
        all["correction"] = bytes_of(std::vector<glm::vec<4, Real>>(slots * elements.size()));
        const Buffers out = run(device, {launch}, all);
        all[name] = out.at("correction");
        all["events"] = out.at("events");
    };
    const auto springs = static_cast<std::uint32_t>(in.spring.size()),
               hinges = static_cast<std::uint32_t>(in.hinge.size()),
               volumes = static_cast<std::uint32_t>(in.tetrahedron.size());
    write(make_launch(kernels::pbd_spring::info("slots", precision),
                      kernels::pbd_spring::Params{0, springs, of.stretch, 1}, springs),
          in.spring, 1, "spring_correction");
    if (of.hinges)
        write(make_launch(kernels::pbd_hinge::info("slots", precision),
                          kernels::pbd_hinge::Params{0, hinges, of.bend, 1}, hinges),
              in.hinge, 4, "hinge_correction");
    if (of.volumes)
        write(make_launch(kernels::pbd_volume::info("slots", precision),
                          kernels::pbd_volume::Params{0, volumes, of.volume, 1}, volumes),
              in.tetrahedron, 4, "volume_correction");
    all["next"] = run(device, {average}, all).at("next");
    return all;
}

} // namespace

TEMPLATE_TEST_CASE("slots are averaged at each vertex in fixed order", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const JacobiCase of = jacobi_case();
    CAPTURE(count, of.variant());
    const auto in = jacobi_input<Real>(count, 2500 + count);
    const AtVertices at = at_vertices(in);
    Random random(2600 + count);
    const float relaxation = 1.25f, omega = of.chebyshev ? 1.9f : 1.0f;
    const auto springs = random.vec4s<Real>(in.spring.size(), 1e-2, 0, 0);
    const auto bends = random.vec4s<Real>(4 * in.hinge.size(), 1e-2, 0, 0);
    const auto volumes = random.vec4s<Real>(4 * in.tetrahedron.size(), 1e-2, 0, 0);
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
    const auto add_four = [&](std::size_t k, std::array<std::uint32_t, 4> corner, const auto& slots) {
        for (std::size_t j = 0; j < 4; ++j)
            add(corner[j], glm::dvec3(slots[4 * k + j]));
    };
    for (std::size_t k = 0; k < in.hinge.size() && of.hinges; ++k)
        add_four(k, {in.hinge[k].edge0, in.hinge[k].edge1, in.hinge[k].wing0, in.hinge[k].wing1}, bends);
    for (std::size_t k = 0; k < in.tetrahedron.size() && of.volumes; ++k)
        add_four(k, {in.tetrahedron[k].a, in.tetrahedron[k].b, in.tetrahedron[k].c, in.tetrahedron[k].d},
                 volumes);
    Case c;
    c.precision = precision_of<Real>();
    c.in = jacobi_buffers(in);
    c.in["spring_correction"] = bytes_of(springs);
    c.in["hinge_correction"] = bytes_of(bends);
    c.in["volume_correction"] = bytes_of(volumes);
    c.launches = {make_launch(kernels::pbd_average::info(of.variant(), c.precision),
                              Params{vertices, relaxation, omega, at.hinges, at.volumes}, vertices)};
    Field next;
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        const double w = static_cast<double>(in.position[v].w), o = static_cast<double>(omega);
        const double factor = number[v] > 0 ? w * static_cast<double>(relaxation) / number[v] : 0;
        const glm::dvec3 here(in.delta[v]), before(in.before[v]);
        glm::dvec3 x = here + sum[v] * factor;
        double scale = factor > 0 ? glm::length(here) + factor * size[v] : 0;
        if (of.chebyshev && w > 0)
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
    const JacobiCase of = jacobi_case();
    auto in = jacobi_input<Real>(count, 2700 + count);
    plant_springs(in, 0, in.spring_colours[1]);
    const AtVertices at = at_vertices(in);
    const float relaxation = 1.5f, omega = of.chebyshev ? 1.7f : 1.0f;
    const auto vertices = static_cast<std::uint32_t>(in.position.size());
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, count, of.variant());
        const auto node = make_launch(kernels::pbd_node::info(of.variant(), precision_of<Real>()),
                                      kernels::pbd_node::Params{vertices, of.stretch, of.bend, of.volume,
                                                                relaxation, omega, 1, at.hinges, at.volumes},
                                      vertices);
        const auto average = make_launch(kernels::pbd_average::info(of.variant(), precision_of<Real>()),
                                         Params{vertices, relaxation, omega, at.hinges, at.volumes},
                                         vertices);
        const Buffers a = run(*device, {node}, jacobi_buffers(in));
        const Buffers b = slots_then_average(*device, in, of, average);
        CHECK((a.at("next") == b.at("next")));
        CHECK((a.at("events") == b.at("events")));
    }
}
