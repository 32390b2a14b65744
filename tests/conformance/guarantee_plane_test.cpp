#include "taut/kernels/guarantee_plane.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// What the kernel wrote of one pair, in fp64.
struct Plane
{
    glm::dvec3 normal{0};
    double margin = 0;
    std::array<double, 4> room{};
    bool stands() const { return *std::min_element(room.begin(), room.end()) < -1e29; }
};

template <typename Real>
Plane plane_of(const std::vector<Real>& row, std::uint32_t k)
{
    const auto at = [&](std::uint32_t j) { return static_cast<double>(row[8 * k + j]); };
    return {{at(0), at(1), at(2)}, std::abs(at(3)), {at(4), at(5), at(6), at(7)}};
}

/// Pairs from 1e-8 to 1e-2 m apart, of corners some 0.1 m from each other, that move by up to `motion`.
template <typename Real>
struct Near
{
    using Vec = glm::vec<4, Real>;
    std::vector<layout::ContactPair<Real>> pair;
    std::vector<Vec> position, low, delta;

    Near(std::uint32_t count, Random& random, double origin, double motion)
    {
        for (std::uint32_t k = 0; k < count; ++k)
        {
            const bool edges = random.chance(0.5);
            pair.push_back(
                {4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3, edges ? TAUT_CONTACT_EDGES : TAUT_CONTACT_VERTEX});
            std::array<glm::dvec3, 4> x;
            for (glm::dvec3& p : x)
                p = 0.05 * glm::dvec3(random.vec4<double>(1, 0));
            const test::Nearest n = edges ? test::nearest_of_segments(x[0], x[1], x[2], x[3])
                                          : test::nearest_in_triangle(x[0], x[1], x[2], x[3]);
            const double wanted = std::pow(10.0, random.uniform(-8, -2));
            const glm::dvec3 shift = n.way * (1 - wanted / n.distance()); // of the second, to that distance
            for (int c = 0; c < 4; ++c)
            {
                const bool second = c >= (edges ? 2 : 1);
                add(x[static_cast<std::size_t>(c)] + (second ? shift : glm::dvec3(0)) + glm::dvec3(origin),
                    random, motion);
            }
        }
    }

    glm::dvec3 x(std::uint32_t v) const { return glm::dvec3(position[v]) + glm::dvec3(low[v]); }
    glm::dvec3 d(std::uint32_t v) const { return glm::dvec3(delta[v]) - glm::dvec3(low[v]); }
    bool held(std::uint32_t v) const { return position[v].w == 0; }

private:
    void add(const glm::dvec3& p, Random& random, double motion)
    {
        const glm::vec<3, Real> high(p);
        position.emplace_back(high, random.inverse_mass<Real>());
        low.emplace_back(glm::vec<3, Real>(p - glm::dvec3(high)), Real(0));
        delta.push_back(random.vec4<Real>(motion, Real(0)));
        delta.back() += low.back();
    }
};

template <typename Real>
Case case_of(const Near<Real>& in, std::uint32_t listed)
{
    const auto count = static_cast<std::uint32_t>(in.pair.size());
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(in.pair)},
            {"position", bytes_of(in.position)},
            {"low", bytes_of(in.low)},
            {"delta", bytes_of(in.delta)},
            {"control", bytes_of(control_of(listed))},
            {"row", bytes_of(std::vector<Real>(8 * count, Real(7)))},
            {"lost", bytes_of(std::vector<std::uint32_t>(TAUT_CONTACT_GUARDED_LOST_WORDS, 0))},
            {"asked", bytes_of(std::vector<std::uint32_t>(4 * count + 1, 0))}};
    c.launches = {make_launch(kernels::guarantee_plane::info("", c.precision),
                              kernels::guarantee_plane::Params{count}, count)};
    return c;
}

/// By how much the corners of the first are above those of the second along n, all corners moved by `way`.
template <typename Real, typename Way>
double gap_along(const Near<Real>& in, std::uint32_t k, const glm::dvec3& n, Way way)
{
    const std::uint32_t firsts = in.pair[k].kind == TAUT_CONTACT_EDGES ? 2 : 1;
    double low = 1e9, high = -1e9;
    for (std::uint32_t c = 0; c < 4; ++c)
    {
        const std::uint32_t v = 4 * k + c;
        const double height = glm::dot(n, in.x(v) - in.x(4 * k)) + way(v, c);
        low = c < firsts ? std::min(low, height) : low;
        high = c < firsts ? high : std::max(high, height);
    }
    return low - high;
}

} // namespace

TEMPLATE_TEST_CASE("guarantee_plane parts both of a pair, and what uses up its room is still parted", "",
                   float, double)
{
    using Real = TestType;
    const double origin = GENERATE(0.0, 1.0, 100.0), motion = GENERATE(1e-6, 1e-3, 0.1);
    CAPTURE(origin, motion);
    Random random(3200);
    const std::uint32_t count = 1000;
    const Near<Real> in(count + 2, random, origin, motion);
    look_on_every_device(case_of(in, count), [&](const Buffers& out) {
        const auto row = values_of<Real>(out.at("row"));
        std::size_t stand = 0, parted = 0, joined = 0, shrunk = 0, negative = 0, far = 0, pinched = 0,
                    unasked = 0, wrong = 0, overrun = 0;
        for (std::uint32_t k = 0; k < count; ++k)
        {
            const Plane plane = plane_of(row, k);
            const bool edges = in.pair[k].kind == TAUT_CONTACT_EDGES;
            CHECK((row[8 * k + 3] < 0) == edges);
            const double apart = gap_along(in, k, plane.normal, [](auto, auto) { return 0.0; });
            const test::Nearest n = nearest_of(in.pair[k], [&](std::uint32_t v) { return in.x(v); });
            const bool asked = words_of(out, "asked")[4 * k] > 0;
            const double goes = gap_along(
                in, k, plane.normal, [&](std::uint32_t v, auto) { return glm::dot(plane.normal, in.d(v)); });
            unasked += asked ? 0 : 1;
            wrong += asked != (plane.stands() || goes < 2 * plane.margin) &&
                             std::abs(goes - 2 * plane.margin) > plane.margin
                         ? 1
                         : 0;
            stand += plane.stands() ? 1 : 0;
            far += plane.stands() && n.distance() > 100 * plane.margin ? 1 : 0;
            const double pins = gap_along(in, k, plane.normal, [&](std::uint32_t v, std::uint32_t c) {
                const double side = c == 0 || (c == 1 && edges) ? 1 : -1;
                return in.held(v) ? glm::dot(plane.normal, in.d(v)) : 1e3 * side;
            });
            pinched += pins < 2 * plane.margin ? 1 : 0;
            bool led = false;
            for (std::uint32_t c = 0; c < 4; ++c)
                led = led || (in.held(4 * k + c) && in.d(4 * k + c) != glm::dvec3(0));
            overrun += plane.stands() && led ? 1 : 0;
            if (plane.stands())
                continue;
            parted += apart > 0 ? 1 : 0;
            joined += apart > 0 ? 0 : 1;
            bool any_held = false;
            for (std::uint32_t c = 0; c < 4; ++c)
                any_held = any_held || in.held(4 * k + c);
            // Every corner at the end of its room, held ones where they go.
            const double left = gap_along(in, k, plane.normal, [&](std::uint32_t v, std::uint32_t c) {
                const double side = c == 0 || (c == 1 && edges) ? 1 : -1;
                return in.held(v) ? glm::dot(plane.normal, in.d(v)) : -side * plane.room[c];
            });
            shrunk += pins > 3 * plane.margin && left < 0.7 * plane.margin ? 1 : 0;
            for (std::uint32_t c = 0; c < 4 && !any_held; ++c)
                negative += plane.room[c] < -0.51 * plane.margin ? 1 : 0;
        }
        CAPTURE(stand, parted);
        CHECK(wrong == 0); // all corners are asked where the four would not end apart
        CHECK((motion > 0.01 || unasked > count / 10));
        CHECK(joined == 0);
        CHECK(shrunk == 0);
        CHECK(negative == 0);
        CHECK(far == 0);
        CHECK(parted > count / 5);
        const std::uint32_t counted = words_of(out, "lost")[TAUT_CONTACT_PINCHED];
        CHECK(counted <= pinched + overrun);
        CHECK(counted >= overrun);            // what nothing parts stands still, and held corners do not
        CHECK((motion < 0.1 || counted > 0)); // held corners of both that go through each other
        CHECK(row[8 * count] == Real(7));
    });
}
