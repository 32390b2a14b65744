#include "taut/kernels/contact_refit.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// Of 26 directions, to the faces and corners of a cube and to its edges, those that a triangle faces.
struct Facing
{
    std::uint32_t corners = TAUT_CONTACT_CORNER_BITS, edges = TAUT_CONTACT_EDGE_BITS;

    void share(const Facing& other)
    {
        corners &= other.corners;
        edges &= other.edges;
    }
};

Facing facing(const glm::dvec3& normal)
{
    const auto faces = [&](double x, double y, double z) -> std::uint32_t {
        const glm::dvec3 to(x, y, z);
        return glm::dot(normal, to) >= 0.6 * glm::length(normal) * glm::length(to) ? 1 : 0;
    };
    const auto sign = [](std::uint32_t bits, std::uint32_t bit) {
        return (bits >> bit & 1) != 0 ? 1.0 : -1.0;
    };
    Facing out{0, 0};
    for (std::uint32_t k = 0; k < 6; ++k)
    {
        glm::dvec3 to(0);
        to[int(k / 2)] = k % 2 == 0 ? 1 : -1;
        out.corners |= faces(to.x, to.y, to.z) << k;
    }
    for (std::uint32_t k = 0; k < 8; ++k)
        out.corners |= faces(sign(k, 0), sign(k, 1), sign(k, 2)) << (6 + k);
    for (std::uint32_t k = 0; k < 4; ++k)
    {
        out.edges |= faces(sign(k, 0), sign(k, 1), 0) << k;
        out.edges |= faces(0, sign(k, 0), sign(k, 1)) << (4 + k);
        out.edges |= faces(sign(k, 0), 0, sign(k, 1)) << (8 + k);
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE(
    "contact_refit gives every node the box of its triangles where they are and will be, and what they face",
    "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 2u, 3u, 63u, 64u, 65u, 300u, 5000u);
    const bool guarded = GENERATE(false, true); // by the guarantee: corners may stray from their ways
    CAPTURE(count, guarded);
    Random random(2100 + count);
    const auto net = contact_net<Real>(count, random, 0.01);
    const std::uint32_t substeps = 7, leaves = net.leaves;
    using Vec = glm::vec<4, Real>;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"node", bytes_of(std::vector<Vec>(4 * leaves, Vec(9)))},
            {"triangle", bytes_of(net.triangle)},
            {"position", bytes_of(net.position)},
            {"delta", bytes_of(net.delta)}};
    const auto groups = [](std::uint32_t level) {
        return level / std::min<std::uint32_t>(level, TAUT_CONTACT_REFIT);
    };
    c.launches = {make_launch(kernels::contact_refit::info(guarded ? "guarded" : "leaves", c.precision),
                              kernels::contact_refit::Params{leaves, count, substeps}, groups(leaves))};
    for (std::uint32_t level = groups(leaves); level > 1; level = groups(level))
        c.launches.push_back(make_launch(kernels::contact_refit::info("", c.precision),
                                         kernels::contact_refit::Params{level, count, substeps},
                                         groups(level)));
    const double nowhere = static_cast<double>(static_cast<Real>(1e30));
    struct Box
    {
        glm::dvec3 low, high;
    };
    std::vector<Box> boxes(2 * leaves, Box{glm::dvec3(nowhere), glm::dvec3(-nowhere)});
    for (std::uint32_t t = 0; t < count; ++t)
        for (const std::uint32_t v : {net.triangle[t].a, net.triangle[t].b, net.triangle[t].c})
            for (const glm::dvec3& p : {net.x(v), net.x(v) + net.d(v) * double(substeps)})
            {
                const glm::dvec3 stray(guarded ? 0.1 * substeps * glm::length(net.d(v)) : 0);
                for (std::uint32_t k = leaves + t; k > 0; k /= 2)
                    boxes[k] = {glm::min(boxes[k].low, p - stray), glm::max(boxes[k].high, p + stray)};
            }
    std::vector<Facing> faced(2 * leaves);
    for (std::uint32_t t = 0; t < count; ++t)
        for (const double time : {0.0, double(substeps)})
        {
            const auto& tri = net.triangle[t];
            const auto x = [&](std::uint32_t v) { return net.x(v) + net.d(v) * time; };
            const Facing its = facing(glm::cross(x(tri.b) - x(tri.a), x(tri.c) - x(tri.a)));
            for (std::uint32_t k = leaves + t; k > 0; k /= 2)
                faced[k].share(its);
        }
    Field& field = c.expected["node"];
    for (std::uint32_t k = 0; k < 2 * leaves; ++k)
        for (const bool high : {false, true})
        {
            const glm::dvec3& corner = high ? boxes[k].high : boxes[k].low;
            const std::uint32_t bits = guarded ? 0 : high ? faced[k].edges : faced[k].corners;
            for (int axis = 0; axis < 3; ++axis)
            {
                const bool empty = std::abs(corner[axis]) == nowhere;
                field.add(k == 0 ? 9 : corner[axis],
                          k == 0 || empty ? 0 : (guarded ? 2 : 1) + std::abs(corner[axis]));
            }
            field.add(k == 0 ? 9 : double(bits), 0);
        }
    check_on_every_device(c);
}
