#include "taut/judge/exact.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace taut;
using namespace taut::judging;
using taut::conformance::Random;

namespace {

using Points = std::array<glm::dvec3, 3>;

/// Coordinates of small whole numbers: every product of three is exact in double.
glm::dvec3 whole(Random& random, std::uint32_t most)
{
    const auto one = [&] { return double(random.below(2 * most + 1)) - double(most); };
    const double x = one(), y = one(), z = one();
    return {x, y, z};
}

int plain_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
    const double value = glm::dot(glm::cross(b - a, c - a), d - a);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// By definition, in whole numbers: some p + (q - p) n / m with m = 5040 lies in the triangle, or none can.
bool meets_by_clipping(const glm::dvec3& p, const glm::dvec3& q, const Points& t)
{
    const int sp = plain_orientation(t[0], t[1], t[2], p), sq = plain_orientation(t[0], t[1], t[2], q);
    REQUIRE(sp * sq < 0); // the cases that this reference knows
    double volumes[3];
    for (std::size_t k = 0; k < 3; ++k)
        volumes[k] = glm::dot(glm::cross(t[k] - p, t[(k + 1) % 3] - p), q - p);
    const bool up = volumes[0] >= 0 && volumes[1] >= 0 && volumes[2] >= 0;
    const bool down = volumes[0] <= 0 && volumes[1] <= 0 && volumes[2] <= 0;
    return up || down;
}

} // namespace

TEST_CASE("orientation is that of whole numbers, with many points in one plane")
{
    Random random(1);
    int flat = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const glm::dvec3 a = whole(random, 4), b = whole(random, 4), c = whole(random, 4),
                         d = whole(random, 4);
        const int expected = plain_orientation(a, b, c, d);
        flat += expected == 0 ? 1 : 0;
        REQUIRE(orientation(a, b, c, d) == expected);
        // The same far away and small: whole numbers stay exact, the rounded determinant does not.
        const double unit = 0x1p-30;
        const glm::dvec3 far(1000, -2000, 3000);
        REQUIRE(orientation(far + a * unit, far + b * unit, far + c * unit, far + d * unit) == expected);
        REQUIRE(orientation(a * 0x1p-300, b * 0x1p-300, c * 0x1p-300, d * 0x1p-300) == expected);
    }
    CHECK(flat > 500);
}

TEST_CASE("a point that is one bit off a plane is on its side")
{
    Random random(2);
    for (int i = 0; i < 2000; ++i)
    {
        // z = x of whole numbers over 2^20: the plane through three such points is x = z.
        const auto on = [&] {
            const double x = double(random.below(1u << 20)) * 0x1p-20,
                         y = double(random.below(1u << 20)) * 0x1p-20;
            return glm::dvec3(x, y, x);
        };
        const glm::dvec3 a = on(), b = on(), c = on(), d = on();
        const int turn = plain_orientation(a, b, c, a + glm::dvec3(0, 0, 1));
        CHECK(orientation(a, b, c, d) == 0);
        glm::dvec3 above = d, below = d;
        above.z = std::nextafter(d.z, 2);
        below.z = std::nextafter(d.z, -1);
        CHECK(orientation(a, b, c, above) == turn);
        CHECK(orientation(a, b, c, below) == -turn);
    }
}

TEST_CASE("a segment through the plane meets a triangle where its volumes say so")
{
    Random random(3);
    int met = 0, tried = 0;
    while (tried < 5000)
    {
        const Points t{whole(random, 3), whole(random, 3), whole(random, 3)};
        const glm::dvec3 p = whole(random, 3), q = whole(random, 3);
        if (plain_orientation(t[0], t[1], t[2], p) * plain_orientation(t[0], t[1], t[2], q) >= 0)
            continue;
        ++tried;
        const bool expected = meets_by_clipping(p, q, t);
        met += expected ? 1 : 0;
        REQUIRE(segment_meets_triangle(p, q, t) == expected);
        REQUIRE(segment_meets_triangle(q, p, {t[1], t[2], t[0]}) == expected);
    }
    CHECK(met > 300);
}

TEST_CASE("segments in the plane of a triangle, and a last digit beside it, meet it where exact areas say so")
{
    Random random(5);
    // 2-D, with whole numbers: exact in double.
    const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    };
    const auto side = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const double v = area(a, b, c);
        return v > 0 ? 1 : v < 0 ? -1 : 0;
    };
    const auto within = [](double a, double b, double x) {
        return std::min(a, b) <= x && x <= std::max(a, b);
    };
    const auto segments = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a,
                              const glm::dvec3& b) {
        const auto on = [&](const glm::dvec3& s, const glm::dvec3& e, const glm::dvec3& x) {
            return side(s, e, x) == 0 && within(s.x, e.x, x.x) && within(s.y, e.y, x.y);
        };
        return (side(p, q, a) * side(p, q, b) < 0 && side(a, b, p) * side(a, b, q) < 0) || on(p, q, a) ||
               on(p, q, b) || on(a, b, p) || on(a, b, q);
    };
    int met = 0, apart = 0;
    for (int k = 0; k < 20000; ++k)
    {
        Points t{whole(random, 4), whole(random, 4), whole(random, 4)};
        glm::dvec3 p = whole(random, 4), q = whole(random, 4);
        for (glm::dvec3* x : {&t[0], &t[1], &t[2], &p, &q})
            x->z = 0;
        if (side(t[0], t[1], t[2]) == 0)
            continue;
        const int turn = side(t[0], t[1], t[2]);
        const bool inside =
            side(t[0], t[1], p) == turn && side(t[1], t[2], p) == turn && side(t[2], t[0], p) == turn;
        const bool expected =
            inside || segments(p, q, t[0], t[1]) || segments(p, q, t[1], t[2]) || segments(p, q, t[2], t[0]);
        ++(expected ? met : apart);
        REQUIRE(segment_meets_triangle(p, q, t) == expected);
        p.z = q.z = 0x1p-1000; // beside the plane, by less than any product of coordinates shows
        REQUIRE(!segment_meets_triangle(p, q, t));
    }
    CHECK(std::min(met, apart) > 1000);
}

TEST_CASE("what touches meets: corners, edges, planes, triangles without area")
{
    const Points t{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    const auto meets = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return segment_meets_triangle(p, q, t);
    };
    CHECK(meets({1, 1, -1}, {1, 1, 1}));
    CHECK(meets({1, 1, 0}, {1, 1, 1}));   // begins in it
    CHECK(meets({0, 0, 0}, {-1, -1, 1})); // begins at a corner
    CHECK(meets({2, 2, -1}, {2, 2, 1}));  // through the long edge
    CHECK(meets({-1, 1, 0}, {5, 1, 0}));  // in its plane, across
    CHECK(meets({1, 1, 0}, {1.5, 1, 0})); // in its plane, inside
    CHECK(meets({-1, 0, 0}, {0, 0, 0}));  // in its plane, end to corner
    CHECK(meets({-1, 0, 0}, {9, 0, 0}));  // along an edge
    CHECK_FALSE(meets({-1, 0, 0}, {-0.5, 0, 0}));
    CHECK_FALSE(meets({3, 3, -1}, {3, 3, 1}));
    CHECK_FALSE(meets({3, 3, 0}, {9, 3, 0}));
    CHECK_FALSE(meets({1, 1, 0.001}, {1, 1, 1}));
    CHECK_FALSE(meets({1, 1, 1e-300}, {2, 1, 1e-300}));
    const Points needle{glm::dvec3(0, 0, 0), {2, 2, 2}, {4, 4, 4}},
        point{glm::dvec3(1), glm::dvec3(1), glm::dvec3(1)};
    CHECK(segment_meets_triangle({1, 1, 0}, {1, 1, 2}, needle));
    CHECK(segment_meets_triangle({4, 4, 4}, {5, 5, 5}, needle));
    CHECK_FALSE(segment_meets_triangle({4.5, 4.5, 4.5}, {5, 5, 5}, needle));
    CHECK_FALSE(segment_meets_triangle({1, 0, 0}, {1, 0, 2}, needle));
    // Skew to the needle, though each of its projections meets it.
    const Points along{glm::dvec3(0, 0, 0), {1, 0, 0}, {3, 0, 0}};
    CHECK_FALSE(segment_meets_triangle({1, -1, 1}, {2, 1, -0.5}, along));
    CHECK(segment_meets_triangle({1, -1, 1}, {2, 1, -1}, along));
    CHECK(segment_meets_triangle({0, 0, 0}, {2, 2, 2}, point));
    CHECK_FALSE(segment_meets_triangle({0, 0, 0}, {2, 2, 3}, point));
}
