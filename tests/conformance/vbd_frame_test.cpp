#include "taut/kernels/vbd_frame.hpp"

#include "support/rigid_sums.hpp"

using namespace taut;
using namespace taut::conformance;

// Contacts of surfaces that move as one rigid thing: the frame is its motion.
TEMPLATE_TEST_CASE("vbd_frame finds the rigid motion of what carries a body", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    CAPTURE(count);
    Random random(1520 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t carry = 5, frame = carry + TAUT_VBD_DRIFT * parts.groups;
    const std::vector<std::uint32_t> row = parts.plain_rows(4, 3);
    std::vector<Real> sums(carry, Real(7));
    struct Motion
    {
        glm::dvec3 way{0}, turn{0}, place{0};
        double weight = 0;
        std::uint32_t points = 0;
    };
    std::vector<Motion> of(parts.groups); // by the first group of a body
    for (std::uint32_t g = 0; g < parts.groups; ++g)
    {
        Motion& m = of[parts.parts[g].from];
        if (parts.parts[g].from == g)
        {
            m.way = glm::dvec3(random.vec4<double>(0.1, 0));
            m.turn = glm::dvec3(random.vec4<double>(0.1, 0));
        }
        std::array<double, TAUT_VBD_DRIFT> value{};
        const std::uint32_t points = parts.parts[g].from % 3 == 2 ? 0 : 6; // some bodies touch nothing
        for (std::uint32_t k = 0; k < points; ++k)
        {
            const double w = random.uniform(0.1, 1);
            const glm::dvec3 r(random.vec4<double>(1, 0)), way = m.way + glm::cross(m.turn, r);
            const glm::dvec3 turn = glm::cross(r, way);
            value[0] += w;
            for (int axis = 0; axis < 3; ++axis)
            {
                const auto i = static_cast<std::size_t>(axis);
                value[1 + i] += w * way[axis];
                value[4 + i] += w * r[axis];
                value[7 + i] += w * turn[axis];
                value[10 + i] += w * r[axis] * r[axis];
                value[13 + i] += w * r[(axis + 1) % 3] * r[(axis + 2) % 3];
            }
            m.weight += w;
            m.place += w * r;
        }
        m.points += points;
        for (const double v : value)
            sums.push_back(static_cast<Real>(v));
    }
    for (std::uint32_t k = 0; k < TAUT_VBD_FRAME * parts.groups + 3; ++k)
        sums.push_back(Real(7));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))}, {"sums", bytes_of(sums)}};
    const kernels::vbd_frame::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), carry};
    c.launches = {make_launch(kernels::vbd_frame::info("", c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    for (std::size_t k = 0; k < sums.size(); ++k)
        field.add(double(sums[k]), 0);
    for (std::uint32_t g = 0; g < parts.groups; ++g)
    {
        const Motion& m = of[parts.parts[g].from];
        const bool carried = m.weight > 0;
        const glm::dvec3 place = carried ? m.place / m.weight : glm::dvec3(0);
        const glm::dvec3 way = carried ? m.way + glm::cross(m.turn, place) : glm::dvec3(0);
        const glm::dvec3 turn = carried ? m.turn : glm::dvec3(0);
        const std::size_t at = frame + TAUT_VBD_FRAME * std::size_t{g};
        field.value[at] = carried ? 1 : 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto i = static_cast<std::size_t>(axis);
            field.value[at + 1 + i] = way[axis];
            field.value[at + 4 + i] = place[axis];
            field.value[at + 7 + i] = turn[axis];
            field.scale[at + 1 + i] = field.scale[at + 4 + i] = 4;
            field.scale[at + 7 + i] = 200; // the tensor of six places is inverted
        }
    }
    check_on_every_device(c);
}
