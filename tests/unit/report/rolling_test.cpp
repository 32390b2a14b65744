#include "support/catch.hpp"

#include "taut/report/rolling.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>

using namespace taut;

namespace {

using Places = std::vector<glm::dvec3>;

/// 1 m wide, its lowest corners at the origin's height, of 4^3 vertices.
Places lattice()
{
    Places out;
    for (int i = 0; i < 64; ++i)
        out.push_back(glm::dvec3(i % 4, i / 4 % 4, i / 16) / 3.0);
    return out;
}

/// Ways of a turn about the axis through `middle`.
Places turned(const Places& x, const glm::dvec3& middle, const glm::dvec3& axis, double angle)
{
    Places out;
    const glm::dquat turn = glm::angleAxis(angle, glm::normalize(axis));
    for (const glm::dvec3& p : x)
        out.push_back(middle + turn * (p - middle) - p);
    return out;
}

double longest(const Places& ways)
{
    double out = 0;
    for (const glm::dvec3& w : ways)
        out = std::max(out, glm::length(w));
    return out;
}

Places rest_of(const Places& x, const Places& ways, const std::vector<std::size_t>& held)
{
    std::vector<double> mass(x.size(), 0.5);
    mass[7] = 3;
    BodyWay body{x, ways, mass, std::vector<bool>(x.size(), false)};
    for (const std::size_t i : held)
        body.held[i] = true;
    return without_rolling(body);
}

} // namespace

TEST_CASE("a turn about the one vertex that touches is rolling, however far", "[residuals]")
{
    const Places x = lattice();
    for (const double angle : {1e-6, 0.1, 2.0})
        CHECK(longest(rest_of(x, turned(x, x[5], {1, 2, 3}, angle), {5})) < 1e-12);
}

TEST_CASE("a turn about the line that touches is rolling, one across it is not", "[residuals]")
{
    const Places x = lattice();
    const std::vector<std::size_t> edge{0, 1, 2, 3}; // along x
    CHECK(longest(rest_of(x, turned(x, x[0], {1, 0, 0}, 0.7), edge)) < 1e-12);
    const Places across = turned(x, (x[0] + x[3]) / 2.0, {0, 1, 0}, 0.1);
    CHECK(longest(rest_of(x, across, edge)) > 0.9 * longest(across));
}

TEST_CASE("what sinks about the vertex that touches has sunk, whatever turn comes closest", "[residuals]")
{
    const Places x = lattice();
    Places sunk(x.size(), glm::dvec3(0, -0.01, 0));
    sunk[5] = glm::dvec3(0);
    const Places ways = rest_of(x, sunk, {5});
    double mean = 0, turned = 0;
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
        mean += glm::length(ways[i]) / static_cast<double>(ways.size());
        turned = std::max(turned, glm::distance(ways[i], sunk[i]));
    }
    CHECK(mean > 0.006);
    CHECK(turned > 0.001); // vertex 5 is not the middle: some of it is a turn
}

TEST_CASE("a patch of a third of the body's size lets nothing roll, a narrower one does", "[residuals]")
{
    Places x = lattice();
    const glm::dvec3 middle(0.5, 0, 0.5);
    const auto rolls = [&](double half) {
        const std::vector<std::size_t> held{0, 3, 48, 51}; // corners of the lowest face
        for (const std::size_t i : held)
            x[i] = middle + half * glm::dvec3(i % 4 == 0 ? -1 : 1, 0, i < 16 ? -1 : 1);
        const Places ways = turned(x, middle, {0, 0, 1}, 0.1);
        return longest(rest_of(x, ways, held)) < 1e-9;
    };
    CHECK(rolls(0.2));
    CHECK_FALSE(rolls(0.33)); // the body's size about it is 0.87
}

TEST_CASE("what stands on a broad foot, or on nothing, does not roll", "[residuals]")
{
    const Places x = lattice(), ways = turned(x, x[0], {1, 2, 3}, 0.1);
    for (const std::vector<std::size_t>& held :
         {std::vector<std::size_t>{}, std::vector<std::size_t>{0, 3, 48, 51}})
        CHECK(rest_of(x, ways, held) == ways);
}
