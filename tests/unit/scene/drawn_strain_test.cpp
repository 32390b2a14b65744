#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/scene/drawn_strain.hpp"

using namespace taut;

namespace {

/// Cloth of 1 m between its left and its right edge, which goes through `motion`.
Body between(std::vector<Keyframe> motion)
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.cells = {4, 4};
    body.pins.resize(2);
    body.pins[0].edges = {"left"};
    body.pins[1].edges = {"right"};
    body.pins[1].motion = std::move(motion);
    return resolve(scene).bodies[0];
}

Keyframe turned(double time, double degrees)
{
    Keyframe key;
    key.time = time;
    key.rotate_axis = {1, 0, 0};
    key.rotate_degrees = degrees;
    return key;
}

} // namespace

TEST_CASE("pins draw a body by the most that the straight line between them becomes longer", "[substeps]")
{
    CHECK(drawn_strain(between({})) == 0);
    CHECK(drawn_strain(between({{0, {0, 0, 0}}, {1, {0.2, 0, 0}}})) == Approx(0.2));
    CHECK(drawn_strain(between({{0, {0, 0, 0}}, {1, {0.2, 0, 0}}, {2, {0, 0, 0}}})) ==
          Approx(0.2)); // and back
    CHECK(drawn_strain(between({{0, {0, 0, 0}}, {1, {-0.2, 0, 0}}})) < 1e-12);
    CHECK(drawn_strain(between({{0, {0, 0, 0}}, {1, {9, 0, 0}}})) == 0.5);
    Body both = between({{0, {0, 0, 0}}, {1, {3, 0, 0}}});
    both.pins[0].motion = both.pins[1].motion;
    CHECK(drawn_strain(both) < 1e-12);
}

TEST_CASE("pins that turn by whole turns between two keys draw a body", "[substeps]")
{
    // Half a turn leads a corner to the other side: over the length, 1 m, and the width.
    CHECK(drawn_strain(between({turned(0, 0), turned(1, 180)})) == Approx(std::sqrt(2.0) - 1));
    CHECK(drawn_strain(between({turned(0, 0), turned(1, 4 * 360)})) ==
          Approx(std::sqrt(2.0) - 1).epsilon(0.02));
}

TEST_CASE("what starts apart is drawn, and what tears is not drawn further", "[substeps]")
{
    Body body = between({});
    body.start_positions = body.mesh.positions;
    for (glm::dvec3& p : body.start_positions)
        p.x *= 1.1;
    CHECK(drawn_strain(body) == Approx(0.1));
    Body tears = between({{0, {0, 0, 0}}, {1, {0.4, 0, 0}}});
    tears.material.tear_strain = 0.25;
    CHECK(drawn_strain(tears) == 0.25);
}
