#include "taut/judge/judge.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "taut/judge/crossings.hpp"
#include "taut/judge/exact.hpp"
#include "taut/judge/linking.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace taut;
using namespace taut::judging;
using taut::conformance::Random;

namespace {

struct Shape
{
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;

    void add(const Shape& more)
    {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), more.positions.begin(), more.positions.end());
        for (const Triangle& t : more.triangles)
            triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
};

/// n x n cells over the unit square; `at` gives the place of (x, y).
template <typename At>
Shape sheet(std::uint32_t n, const At& at)
{
    Shape s;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            s.positions.push_back(at(double(i) / n, double(j) / n));
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
        {
            const std::uint32_t v = j * (n + 1) + i;
            s.triangles.push_back({v, v + 1, v + n + 2});
            s.triangles.push_back({v, v + n + 2, v + n + 1});
        }
    return s;
}

/// A ring of `n` cells about the z axis, with `turns` half turns of the strip: a band or a Moebius strip's
/// kin.
Shape band(std::uint32_t n, double radius, double width, int half_turns)
{
    Shape s;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const double a = 2 * std::numbers::pi * i / n, tilt = half_turns * a / 2;
        const glm::dvec3 out(std::cos(a), std::sin(a), 0), up(0, 0, 1);
        const glm::dvec3 across = std::cos(tilt) * up + std::sin(tilt) * out;
        s.positions.push_back(radius * out - width / 2 * across);
        s.positions.push_back(radius * out + width / 2 * across);
    }
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        s.triangles.push_back({a, b, b + 1});
        s.triangles.push_back({a, b + 1, a + 1});
    }
    return s;
}

Shape tetrahedron(const glm::dvec3& corner, double size)
{
    return {{corner, corner + glm::dvec3(size, 0, 0), corner + glm::dvec3(0, size, 0),
             corner + glm::dvec3(0, 0, size)},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

std::string refusal(const auto& act)
{
    try
    {
        act();
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("crossings of two sheets are those of every pair of triangles")
{
    Random random(5);
    for (int round = 0; round < 6; ++round)
    {
        // A wavy sheet, and one that stands in it: all pairs tried against the tree.
        const double shift = random.uniform(-0.4, 0.4), tilt = random.uniform(0.2, 1.5);
        Shape s =
            sheet(7, [](double x, double y) { return glm::dvec3(x, y, 0.1 * std::sin(9 * x + 5 * y)); });
        s.add(sheet(
            5, [&](double x, double y) { return glm::dvec3(x + 0.3 * y, 0.5 + shift, tilt * (y - 0.5)); }));
        const Surface surface = make_surface(s.positions.size(), s.triangles);
        std::set<std::array<std::uint32_t, 2>> expected;
        for (std::uint32_t a = 0; a < s.triangles.size(); ++a)
            for (std::uint32_t b = 0; b < s.triangles.size(); ++b)
                for (std::size_t k = 0; k < 3 && a != b; ++k)
                {
                    const std::uint32_t p = s.triangles[a][k], q = s.triangles[a][(k + 1) % 3];
                    const Triangle& t = s.triangles[b];
                    if (!has(t, p) && !has(t, q) &&
                        segment_meets_triangle(s.positions[p], s.positions[q],
                                               {s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]}))
                        expected.insert({std::min(a, b), std::max(a, b)});
                }
        const auto found = intersecting_triangles(surface, s.positions);
        CHECK(!expected.empty());
        CHECK(found == std::vector<std::array<std::uint32_t, 2>>(expected.begin(), expected.end()));
    }
}

TEST_CASE("a flat sheet crosses nothing, and one that a corner pierces does")
{
    Shape s = sheet(6, [](double x, double y) { return glm::dvec3(x, y, 0); });
    s.add(tetrahedron({0.41, 0.43, 0.05}, 0.2));
    const Judge judge(s.triangles, s.positions);
    const FrameVerdict apart = judge.look(s.positions);
    CHECK(apart.intersecting == 0);
    CHECK(apart.nearest_parts.distance == Approx(0.05));
    CHECK(apart.stretch == 0);
    CHECK(apart.volume_change == Approx(0).margin(1e-12));
    std::vector<glm::dvec3> moved = s.positions;
    for (std::size_t v = 49; v < moved.size(); ++v)
        moved[v].z -= 0.06;
    const FrameVerdict through = judge.look(moved);
    CHECK(through.intersecting > 0);
    for (const auto& [a, b] : through.first_pairs)
        CHECK((a < 72 && b >= 72));
    moved[52].z += 0.2; // the top: 0.2 of a height becomes 0.4
    CHECK(judge.look(moved).volume_change == Approx(1));
}

TEST_CASE("the nearest pair is that of every pair")
{
    Random random(6);
    for (int round = 0; round < 10; ++round)
    {
        Shape s;
        for (int k = 0; k < 12; ++k)
            s.add(tetrahedron({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, 0.15));
        const Surface surface = make_surface(s.positions.size(), s.triangles);
        double least = 1e9;
        for (std::uint32_t v = 0; v < s.positions.size(); ++v)
            for (const Triangle& t : s.triangles)
                if (surface.part[v] != surface.part[t[0]])
                    least = std::min(
                        least, distance_to_triangle(s.positions[v], {s.positions[t[0]], s.positions[t[1]],
                                                                     s.positions[t[2]]}));
        for (const Edge& e : surface.edges)
            for (const Edge& f : surface.edges)
                if (surface.part[e[0]] != surface.part[f[0]])
                    least = std::min(least, distance_of_segments(s.positions[e[0]], s.positions[e[1]],
                                                                 s.positions[f[0]], s.positions[f[1]]));
        CHECK(nearest_pair(surface, s.positions, true).distance == least);
    }
}

TEST_CASE("distances of features by plain cases")
{
    const std::array<glm::dvec3, 3> t{glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}};
    CHECK(distance_to_triangle({0.2, 0.2, -3}, t) == Approx(3));
    CHECK(distance_to_triangle({2, 0, 0}, t) == Approx(1));
    CHECK(distance_to_triangle({1, 1, 0}, t) == Approx(std::sqrt(0.5)));
    CHECK(distance_to_triangle({-3, -4, 0}, t) == Approx(5));
    CHECK(distance_of_segments({-1, 0, 0}, {1, 0, 0}, {0, -1, 2}, {0, 1, 2}) == Approx(2));
    CHECK(distance_of_segments({0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}) == Approx(2));
    CHECK(distance_of_segments({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}) == Approx(1)); // parallel
}

TEST_CASE("borders are linked as often as a band is turned")
{
    for (const int turns : {0, 1, 2, -3})
    {
        const Shape s = band(200, 1, 0.2, 2 * turns);
        const Surface surface = make_surface(s.positions.size(), s.triangles);
        REQUIRE(surface.borders.size() == 2);
        std::vector<glm::dvec3> curves[2];
        for (std::size_t k = 0; k < 2; ++k)
            for (const std::uint32_t v : surface.borders[k])
                curves[k].push_back(s.positions[v]);
        const auto number = linking_number(curves[0], curves[1]);
        REQUIRE(number);
        CHECK(std::abs(*number) == std::abs(turns));
    }
    // A band through which a sheet passes between two frames that both look clean.
    Shape s = band(40, 1, 0.2, 0);
    s.add(band(40, 0.3, 0.05, 0));
    std::vector<glm::dvec3> beside = s.positions, through = s.positions;
    for (std::size_t v = 80; v < s.positions.size(); ++v)
    {
        const glm::dvec3 x = s.positions[v];
        beside[v] = glm::dvec3(x.x + 2, x.z, x.y);  // stands outside the large band
        through[v] = glm::dvec3(x.x + 1, x.z, x.y); // its band runs round the rim
    }
    const Judge judge(s.triangles, beside);
    const FrameVerdict before = judge.look(beside), after = judge.look(through);
    CHECK(before.intersecting == 0);
    CHECK(after.intersecting == 0);
    REQUIRE(before.linking.size() == 6);
    CHECK(before.linking != after.linking);
    // Of two bodies that pass through each other only the borders of each are compared.
    PassingBodies passing{std::vector<std::uint32_t>(s.positions.size(), 0), {0, 0}, {{true}}};
    std::fill(passing.body.begin() + 80, passing.body.end(), 1u);
    const Judge lenient(s.triangles, beside, {}, passing);
    const FrameVerdict meanwhile = lenient.look(through);
    CHECK(meanwhile.linking == lenient.look(beside).linking);
    CHECK(meanwhile.linking.front() == after.linking.front());
    CHECK(std::count(meanwhile.linking.begin(), meanwhile.linking.end(), std::nullopt) == 4);
}

TEST_CASE("what passes between two clean frames is seen, and what slides or turns along is not")
{
    Shape s = sheet(4, [](double x, double y) { return glm::dvec3(x, y, 0); });
    s.add(sheet(3, [](double x, double y) { return glm::dvec3(0.1 + 0.8 * x, 0.1 + 0.8 * y, 0.1); }));
    const Judge judge(s.triangles, s.positions);
    const auto moved = [&](const glm::dvec3& by) {
        std::vector<glm::dvec3> out = s.positions;
        for (std::size_t v = 25; v < out.size(); ++v)
            out[v] += by;
        return out;
    };
    const auto below = moved({0.03, 0.02, -0.2});
    REQUIRE(judge.look(below).intersecting == 0);
    const std::vector<Passing> through = judge.between(s.positions, below);
    CHECK(std::count_if(through.begin(), through.end(), [](const Passing& p) { return !p.edges; }) >= 16);
    CHECK(std::any_of(through.begin(), through.end(), [](const Passing& p) { return p.edges; }));
    for (const Passing& p : through)
        CHECK(p.time == Approx(0.5).epsilon(1e-6));
    CHECK(judge.between(below, s.positions).size() == through.size());
    CHECK(judge.between(s.positions, moved({0.3, 0.2, -0.099})).empty());
    CHECK(judge.between(s.positions, moved({0, 0, 0})).empty());
    CHECK(judge.between(s.positions, moved({1.5, 0, 0})).empty());
    // Down and up again within the frame is more than straight ways can show.
    std::vector<glm::dvec3> turned = s.positions;
    for (glm::dvec3& x : turned)
        x = {0.8 * x.x - 0.6 * x.z, x.y, 0.6 * x.x + 0.8 * x.z};
    CHECK(judge.between(s.positions, turned).empty());
}

TEST_CASE("a point that passes through a common edge is never missed")
{
    Random random(8);
    const Shape s = sheet(1, [](double x, double y) { return glm::dvec3(x, y, 0.1 * x - 0.3 * y); });
    Shape both = s;
    both.add(tetrahedron({0, 0, 0}, 0.01));
    const Judge judge(both.triangles, both.positions);
    for (int i = 0; i < 300; ++i)
    {
        const double along = random.uniform(0.05, 0.95);
        const glm::dvec3 on = along * s.positions[3]; // of the diagonal
        std::vector<glm::dvec3> before = both.positions, after = both.positions;
        for (std::size_t v = 4; v < 8; ++v)
        {
            before[v] = on + glm::dvec3(0.01 * double(v - 4), 0, random.uniform(0.1, 1));
            after[v] = before[v] - glm::dvec3(0, 0, 2);
        }
        const auto passed = judge.between(before, after);
        CHECK(
            std::any_of(passed.begin(), passed.end(), [](const Passing& p) { return !p.edges && p.a == 4; }));
    }
}

TEST_CASE("stretch is that of the first frame, and wrong input is refused by name")
{
    const Shape s = sheet(4, [](double x, double y) { return glm::dvec3(x, y, 0); });
    const Judge judge(s.triangles, s.positions);
    std::vector<glm::dvec3> drawn = s.positions;
    for (glm::dvec3& x : drawn)
        x.x *= 1.25;
    CHECK(judge.look(drawn).stretch == Approx(0.25));
    drawn[3].y = std::nan("");
    CHECK(refusal([&] { judge.look(drawn); }) ==
          "vertex 3 has a coordinate that is not finite or beyond 1e30 m");
    drawn.pop_back();
    CHECK_THAT(refusal([&] { judge.look(drawn); }), Contains("24 vertices; the first frame has 25"));
    CHECK_THAT(refusal([&] { Judge({{0, 1, 25}}, s.positions); }), Contains("triangle 0 names vertex 25"));
    CHECK_THAT(refusal([&] { Judge({}, s.positions); }), Contains("no triangle"));
}

TEST_CASE("parts are what hangs together by triangles; a vertex of none is of no part")
{
    Shape s = sheet(2, [](double x, double y) { return glm::dvec3(x, y, 0); });
    s.add(sheet(2, [](double x, double y) { return glm::dvec3(x, y, 1); }));
    s.positions.insert(s.positions.begin() + 9, glm::dvec3(0, 0, 0.5));
    for (Triangle& t : s.triangles)
        for (std::uint32_t& v : t)
            v += v > 8;
    const Surface surface = make_surface(s.positions.size(), s.triangles);
    CHECK(surface.parts == 2);
    CHECK(surface.part[0] == 0);
    CHECK(surface.part[9] == Surface::kNoPart);
    CHECK(surface.part[10] == 1);
    CHECK(Judge(s.triangles, s.positions).look(s.positions).nearest_parts.distance == Approx(1));
}

TEST_CASE("what is led is judged against what is not, and not among its like")
{
    Shape s = sheet(3, [](double x, double y) { return glm::dvec3(x, y, 0); });
    s.add(sheet(3, [](double x, double y) { return glm::dvec3(x, 0.4, y - 0.5); }));
    std::vector<glm::dvec3> after = s.positions;
    for (std::size_t v = 0; v < 16; ++v) // the first sheet goes up and grows
        after[v] = 1.5 * after[v] + glm::dvec3(0, 0, 2);
    const auto judged = [&](bool first, bool second) {
        std::vector<bool> led(32, first);
        std::fill(led.begin() + 16, led.end(), second);
        return Judge(s.triangles, s.positions, led);
    };
    const Judge none(s.triangles, s.positions);
    const std::size_t pairs = none.look(s.positions).intersecting;
    REQUIRE(pairs > 0);
    CHECK(judged(true, false).look(s.positions).intersecting == pairs);
    CHECK(judged(false, true).look(s.positions).intersecting == pairs);
    CHECK(judged(true, true).look(s.positions).intersecting == 0);
    CHECK(judged(true, true).look(s.positions).nearest.distance < 0);
    CHECK(judged(true, false).between(s.positions, after).size() == none.between(s.positions, after).size());
    CHECK(!none.between(s.positions, after).empty());
    CHECK(judged(true, true).between(s.positions, after).empty());
    CHECK(judged(false, false).look(after).stretch == Approx(0.5));
    CHECK(judged(true, false).look(after).stretch == 0);
}

TEST_CASE("bodies that pass through each other are not judged against each other, each still is by itself")
{
    Shape s = sheet(3, [](double x, double y) { return glm::dvec3(x, y, 0); });
    s.add(sheet(3, [](double x, double y) { return glm::dvec3(x, 0.4, y - 0.5); }));
    s.add(sheet(3, [](double x, double y) { return glm::dvec3(x, 0.6, y - 0.5); }));
    const auto judged = [&](const std::vector<std::vector<bool>>& passes) {
        PassingBodies passing{std::vector<std::uint32_t>(48, 0), {0, 1, 1}, passes};
        std::fill(passing.body.begin() + 16, passing.body.end(), 1);
        std::fill(passing.body.begin() + 32, passing.body.end(), 2);
        return Judge(s.triangles, s.positions, {}, passing);
    };
    const Judge none(s.triangles, s.positions);
    const std::size_t pairs = none.look(s.positions).intersecting;
    REQUIRE(pairs > 0);
    CHECK(judged({{false, false}, {false, false}}).look(s.positions).intersecting == pairs);
    const Judge through = judged({{false, true}, {true, false}});
    CHECK(through.look(s.positions).intersecting == 0);
    CHECK(through.look(s.positions).nearest.distance == Approx(0.2)); // of the second and the third
    CHECK(judged({{false, true}, {true, true}}).look(s.positions).nearest.distance > 0.2);
    std::vector<glm::dvec3> after = s.positions;
    for (std::size_t v = 16; v < 32; ++v) // the second goes beyond the third
        after[v].y += 0.5;
    CHECK(!through.between(s.positions, after).empty());
    CHECK(judged({{false, true}, {true, true}}).between(s.positions, after).empty());
    after = s.positions; // and folds onto itself
    for (std::size_t v = 16; v < 32; ++v)
        if (after[v].x > 0.5)
            after[v] = {1.1 - after[v].x, after[v].y + 0.01 * (after[v].z - 0.2), after[v].z};
    CHECK(judged({{false, true}, {true, true}}).look(after).intersecting > 0);
}
