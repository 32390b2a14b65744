#include "taut/kernels/contact_push.hpp"

#include "support/contact_net.hpp"

#include <array>
#include <bit>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_push gives pairs their share of the push, and friction within its cone", "",
                   float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    using Side = layout::ContactSide<Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool first = GENERATE(true, false);
    const float momentum = GENERATE(0.0f, 0.4f);
    CAPTURE(count, first, momentum);
    Random random(2900 + count);
    const auto net = contact_net<Real>(60, random, 0);
    const auto pairs = some_pairs(net, count + 2, random);
    std::vector<std::uint32_t> acting;
    for (std::size_t v = 0; v < net.position.size(); ++v)
        acting.push_back(1 + random.below(9));
    std::vector<Side> sides;
    std::vector<Vec> row, taken;
    for (std::uint32_t k = 0; k < count + 2; ++k)
    {
        const glm::dvec3 n = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
        Side side{};
        side.normal_x = static_cast<Real>(n.x);
        side.normal_y = static_cast<Real>(n.y);
        side.normal_z = static_cast<Real>(n.z);
        side.allowed = side.rest_gap = Real(0.01);
        side.friction = static_cast<Real>(random.chance(0.2) ? 0 : random.uniform(0, 1));
        side.slipped_x = random.uniform<Real>(0, 1);
        side.sticks = Real(3);
        sides.push_back(side);
        const Real u = random.uniform<Real>(0, 1);
        const bool idle = random.chance(0.2);
        const Real least = random.chance(0.2) ? Real(0.05) : Real(1); // as beside corners that are held
        row.push_back(idle ? Vec(0) : least * Vec(1, -u, u - 1, 0));
        row.push_back(random.vec4<Real>(0.01, random.uniform<Real>(-0.02, 0.005)));
        taken.push_back(random.vec4<Real>(0.001, random.uniform<Real>(0, 0.01)));
        const bool level = random.chance(0.2); // nothing was ahead
        taken.push_back(level ? taken.back() : random.vec4<Real>(0.001, random.uniform<Real>(0, 0.01)));
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pairs)},
            {"position", bytes_of(net.position)},
            {"control", bytes_of(control_of(count))},
            {"side", bytes_of(sides)},
            {"row", bytes_of(row)},
            {"acting", bytes_of(acting)},
            {"taken", bytes_of(taken)},
            {"impulse", bytes_of(std::vector<Vec>(count + 2, Vec(3)))}};
    c.launches = {make_launch(kernels::contact_push::info("", c.precision),
                              kernels::contact_push::Params{count + 2, first, momentum}, count + 2)};
    std::size_t slides = 0, sticks = 0, held_back = 0, restarts = 0, goes_on = 0, let_go = 0;
    for (std::uint32_t k = 0; k < count + 2; ++k)
    {
        Field &now = c.expected["taken"], &impulse = c.expected["impulse"], &rows = c.expected["row"],
              &side = c.expected["side"];
        auto told = std::bit_cast<std::array<Real, 16>>(sides[k]);
        for (int j = 0; j < 7; ++j)
            rows.add(static_cast<double>(row[2 * k + j / 4][j % 4]), 0);
        if (k >= count)
        {
            rows.add(static_cast<double>(row[2 * k + 1].w), 0);
            for (const Real v : told)
                side.add(static_cast<double>(v), 0);
            for (int j = 0; j < 8; ++j)
                now.add(static_cast<double>(taken[2 * k + j / 4][j % 4]), 0);
            for (int j = 0; j < 4; ++j)
                impulse.add(3, 0);
            continue;
        }
        const glm::dvec4 b(row[2 * k]), met(row[2 * k + 1]),
            before = first ? glm::dvec4(0) : glm::dvec4(taken[2 * k]),
            ahead = first ? glm::dvec4(0) : glm::dvec4(taken[2 * k + 1]);
        const std::uint32_t ids[] = {pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d};
        double weight = 0, most = 0;
        for (int j = 0; j < 4; ++j)
        {
            const double w = static_cast<double>(net.position[ids[j]].w);
            weight += acting[ids[j]] * w * b[j] * b[j];
            most = std::max(most, w * std::abs(b[j]));
        }
        held_back += weight > 0 && weight < most / 2 ? 1 : 0;
        weight = std::max(weight, most / 2);
        glm::dvec4 after = ahead, next = ahead;
        const glm::dvec3 n(sides[k].normal_x, sides[k].normal_y, sides[k].normal_z), slip(met);
        double size = glm::length(glm::dvec3(ahead)) + ahead.w + glm::length(glm::dvec3(before)) + before.w;
        bool clear = true; // no restart hangs by a rounding
        bool holds = false, surely = true;
        if (weight > 0)
        {
            after.w = std::max(0.0, ahead.w - met.w / weight);
            glm::dvec3 tangent = glm::dvec3(ahead) - (slip - n * glm::dot(n, slip)) / weight;
            size += (std::abs(met.w) + glm::length(slip)) / weight;
            const double limit = static_cast<double>(sides[k].friction) * after.w;
            const bool beyond = glm::length(tangent) > limit;
            clear = std::abs(glm::length(tangent) - limit) > 1e-5 * size;
            slides += beyond && limit > 0 ? 1 : 0;
            sticks += !beyond ? 1 : 0;
            holds = after.w > 0 && !beyond;
            surely = clear && std::abs(ahead.w - met.w / weight) > 1e-5 * size;
            if (beyond)
                tangent *= limit / glm::length(tangent);
            after = glm::dvec4(tangent, after.w);
            const glm::dvec3 turn = tangent - glm::dvec3(before);
            const double rise = after.w - before.w, back = (ahead.w - after.w) * rise,
                         aside = glm::dot(glm::dvec3(ahead) - tangent, turn);
            clear = clear &&
                    (first || (std::abs(back) > 1e-5 * size * size && std::abs(aside) > 1e-5 * size * size));
            const double along = back > 0 ? 0 : momentum, across = aside > 0 || beyond ? 0 : momentum;
            restarts += back > 0 ? 1 : 0;
            goes_on += along > 0 && across > 0 ? 1 : 0;
            const double reach = after.w + rise * along;
            clear = clear && (first || std::abs(reach) > 1e-5 * size);
            let_go += along > 0 && after.w > 0 && reach <= 0 ? 1 : 0;
            next = reach > 0 ? glm::dvec4(tangent + turn * across, reach) : glm::dvec4(0);
        }
        told[11] = holds ? Real(1) : Real(0);
        for (std::size_t j = 0; j < 16; ++j)
            side.add(static_cast<double>(told[j]), j == 11 && !surely ? kAnyFinite : 0);
        const double blur = clear || momentum == 0 ? size : kAnyFinite;
        for (int j = 0; j < 4; ++j)
            now.add(after[j], size);
        for (int j = 0; j < 4; ++j)
            now.add(next[j], blur);
        rows.add(next.w, blur);
        const glm::dvec3 push = n * (next.w - ahead.w) + glm::dvec3(next - ahead);
        for (int j = 0; j < 3; ++j)
            impulse.add(weight > 0 ? push[j] : 0, clear || momentum == 0 ? 2 * size : kAnyFinite);
        impulse.add(0, 0);
    }
    CHECK((count < 1000 || (slides > 50 && sticks > 50 && held_back > 20)));
    CHECK((count < 1000 || first || momentum == 0 || (restarts > 50 && goes_on > 20 && let_go > 2)));
    check_on_every_device(c);
}
