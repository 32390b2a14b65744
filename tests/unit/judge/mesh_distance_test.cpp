// Distances to closed meshes.

#include "support/box_distance.hpp"
#include "support/catch.hpp"

#include "taut/judge/distance.hpp"
#include "taut/judge/mesh_distance.hpp"
#include "taut/scene/mesh.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <random>

using namespace taut;
using namespace taut::judging;
using test::box_distance;

TEST_CASE("the distance to a box is exact on all sides, beside its edges and corners too")
{
    const Mesh box = make_box({2, 3, 4}, {0.4, 0.6, 1.0}, false);
    const MeshDistance distance(box.triangles, box.positions);
    std::mt19937_64 random(53);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int n = 0; n < 3000; ++n)
    {
        glm::dvec3 p(place(random), place(random), place(random));
        if (n % 3 == 0) // right beside an edge or a corner
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = std::clamp(3 * p[axis], -1.0, 1.0) *
                          (0.51 * std::array{0.4, 0.6, 1.0}[std::size_t(axis)]);
        CAPTURE(p.x, p.y, p.z);
        CHECK(distance.at(p) == Approx(box_distance(p, {0.2, 0.3, 0.5})).margin(1e-12));
    }
}

TEST_CASE("the sign is right beside a sharp dent, where faces alone would be wrong")
{
    // A tetrahedron with a narrow pit: its tip is nearest to much of the outside within the pit.
    const std::vector<glm::dvec3> x = {{1, 1, 0}, {-1, 1, 0}, {0, 1, 1}, {0, -1, 0}, {0, 0.2, 0.3}};
    const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4},
                                                                 {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    const MeshDistance distance(triangles, x);
    CHECK(distance.at({0, 0.3, 0.3}) > 0); // in the pit
    CHECK(distance.at({0, 0.1, 0.3}) < 0); // below its tip
    CHECK(distance.at({0, 0.19, 0.3}) < 0);
    CHECK(distance.at({0, 2, 0.3}) > 0);
    CHECK(distance.at({0, -1.01, 0}) > 0);
}

TEST_CASE("a grid of a mesh has its margin, and the same values however it is cut")
{
    const Mesh ball = make_ball(6, 0.5);
    const MeshDistance distance(ball.triangles, ball.positions);
    const DistanceField field = make_distance_field(distance, ball.positions, 0.1, 0.15);
    CHECK(fault_of(field).empty());
    for (int axis = 0; axis < 3; ++axis)
    {
        CHECK(field.low[axis] <= -0.65 + 1e-9);
        CHECK(field.low[axis] > -0.75);
    }
    CHECK(field.values[field.index(2, 3, 4)] == static_cast<float>(distance.at(field.place(2, 3, 4))));
    CHECK(field.depth() == Approx(0.5).margin(0.1));
    CHECK(make_distance_field(distance, ball.positions, 0.1, 0.15).values == field.values);
}
