// Hinges of a plate: the matrix of compliances, the bound on its energy, and the turns that go down to it.

#include "support/catch.hpp"
#include "support/random.hpp"
#include "unit/scene/temporary.hpp"

#include "taut/plan/plate_hinges.hpp"
#include "taut/report/model.hpp"
#include "taut/report/plate_energy.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

#include <cmath>

using namespace taut;

namespace {

/// A sheet whose inner vertices are moved in its plane.
Body sheet(std::uint32_t cells, double nu, const FabricBending& bending = {}, double width = 1)
{
    Mesh mesh = make_grid(cells, cells, width, 1, true);
    conformance::Random random(3);
    for (std::uint32_t row = 1; row < cells; ++row)
        for (std::uint32_t column = 1; column < cells; ++column)
        {
            glm::dvec3& x = mesh.positions[row * (cells + 1) + column];
            x += glm::dvec3(random.uniform(-0.25, 0.25) * width, random.uniform(-0.25, 0.25), 0) /
                 double(cells);
        }
    const Temporary folder;
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.shape.file = folder.path / "sheet.obj";
    write_obj(body.shape.file, mesh);
    body.material.bending_model = BendingModel::plate;
    body.material.bending_poissons_ratio = nu;
    if (bending.used)
    {
        body.material.stretch_stiffness = 0;
        body.material.fabric.used = true;
        body.material.fabric.warp = body.material.fabric.weft = 1000;
        body.material.fabric.shear = 100;
        body.material.fabric.grain_degrees = 30;
        body.material.fabric.bending = bending;
    }
    else
        body.material.bending_stiffness = 2;
    scene.bodies.push_back(body);
    return resolve(scene).bodies[0];
}

/// What kernels/plate do: turns b of both sides of each hinge, at angles that stay.
struct Turns
{
    const std::vector<PlateHinge>& hinges;
    std::vector<double> angle, b, p;

    double pulled(std::size_t k, std::size_t side) const
    {
        const PlateHinge& h = hinges[k];
        return h.pull[side][0] * b[2 * k + side] + h.pull[side][1] * b[h.neighbour[2 * side]] +
               h.pull[side][2] * b[h.neighbour[2 * side + 1]];
    }
    double softness(std::size_t k, std::size_t side) const
    {
        return hinges[k].element.compliance * (side == 0 ? hinges[k].share : 1 - hinges[k].share);
    }
    /// J radian^-1 at one side: (K b) there.
    double moment(std::size_t k, std::size_t side) const
    {
        return (b[2 * k + side] - pulled(k, side)) / softness(k, side);
    }
    double energy() const
    {
        double sum = 0;
        for (std::size_t k = 0; k < hinges.size(); ++k)
            for (std::size_t side = 0; side < 2; ++side)
                sum += 0.5 * b[2 * k + side] * moment(k, side);
        return sum;
    }
    void step()
    {
        for (std::size_t k = 0; k < hinges.size(); ++k)
            for (std::size_t side = 0; side < 2; ++side)
                p[2 * k + side] = pulled(k, side);
        for (std::size_t k = 0; k < hinges.size(); ++k)
        {
            const double bent = angle[k] - p[2 * k] - p[2 * k + 1];
            b[2 * k] = p[2 * k] + hinges[k].share * bent;
            b[2 * k + 1] = p[2 * k + 1] + (1 - hinges[k].share) * bent;
        }
    }
};

/// A bent sheet.
std::vector<glm::dvec3> bent(const Body& body)
{
    std::vector<glm::dvec3> x = body.mesh.positions;
    for (glm::dvec3& p : x)
        p.z += 0.1 * std::sin(3 * p.x) * std::cos(2 * p.y + 1);
    return x;
}

void check_descent(const Body& body)
{
    const std::vector<PlateHinge> hinges = plate_hinges(body);
    const std::vector<glm::dvec3> x = bent(body);
    const std::vector<double> moments = plate_moments(hinges, x);
    Turns turns{hinges, {}, std::vector<double>(2 * hinges.size()), std::vector<double>(2 * hinges.size())};
    conformance::Random random(5);
    for (std::size_t k = 0; k < hinges.size(); ++k)
    {
        turns.angle.push_back(bend_angle(hinges[k].element, x));
        turns.b[2 * k] = random.uniform(-0.3, 0.3);
        turns.b[2 * k + 1] = turns.angle[k] - turns.b[2 * k];
    }
    const double least = plate_energy(hinges, x);
    double before = turns.energy();
    CHECK(before > 2 * least);
    for (int i = 0; i < 4000; ++i)
    {
        turns.step();
        const double now = turns.energy();
        REQUIRE(now <= before + 1e-12 * least);
        REQUIRE(now >= least * (1 - 1e-9));
        before = now;
    }
    CHECK(before == Approx(least).epsilon(1e-6));
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < hinges.size(); ++k)
    {
        worst = std::max(worst, std::abs(turns.moment(k, 0) - moments[k]));
        worst = std::max(worst, std::abs(turns.moment(k, 1) - moments[k]));
        largest = std::max(largest, std::abs(moments[k]));
    }
    CHECK(worst < 1e-3 * largest);
}

} // namespace

TEST_CASE("turns within triangles go down to the energy of the plate, from anywhere and never up")
{
    check_descent(sheet(6, 0));
    check_descent(sheet(6, 0.45));
    check_descent(sheet(6, -0.6));
    check_descent(sheet(6, 0.2, {true, 40, 1, 15, BiasSpecimen::sheet}));
    check_descent(sheet(6, 0, {true, 1, 100, 0, BiasSpecimen::strip}));
}

TEST_CASE("thin triangles keep stiffnesses above 0, and compliances")
{
    for (const double width : {1e-2, 1e-3, 1e-4, 1e-6})
        for (const double nu : {0.0, 0.9, -0.9})
        {
            CAPTURE(width, nu);
            for (const PlateHinge& h : plate_hinges(sheet(4, nu, {}, width)))
            {
                REQUIRE((h.element.compliance > 0 && std::isfinite(h.element.compliance)));
                REQUIRE((h.softness > 0 && std::isfinite(h.softness)));
                REQUIRE((h.share >= 0 && h.share <= 1));
            }
        }
}

TEST_CASE("the energy of a plate does not depend on how triangles are wound")
{
    Body body = sheet(5, 0.3);
    const std::vector<glm::dvec3> x = bent(body);
    const double energy = plate_energy(plate_hinges(body), x);
    for (std::size_t t = 0; t < body.mesh.triangles.size(); t += 3)
        std::swap(body.mesh.triangles[t][1], body.mesh.triangles[t][2]);
    CHECK(plate_energy(plate_hinges(body), x) == Approx(energy).epsilon(1e-9));
}

TEST_CASE("a triangle whose corners are all held has no compliance, and hinges between two such are none")
{
    Body body = sheet(2, 0);
    const std::size_t all = plate_hinges(body).size();
    double soft = 0;
    for (const PlateHinge& h : plate_hinges(body))
        soft += h.softness;
    Pin pin;
    for (std::uint32_t v = 0; v < 6; ++v) // the upper of two rows of cells
        pin.vertices.push_back(v);
    body.pins.push_back(pin);
    const std::vector<PlateHinge> rest = plate_hinges(body);
    CHECK(rest.size() == all - 3);
    double softer = 0;
    std::size_t stiff = 0;
    for (const PlateHinge& h : rest)
    {
        softer += h.softness;
        stiff += h.share == 0 || h.share == 1;
    }
    CHECK(stiff == 2);
    CHECK(softer < soft);
    body.mesh.triangles.push_back({0, 4, 8});
    body.mesh.triangles.push_back({0, 4, 7});
    try
    {
        plate_hinges(body);
        FAIL_CHECK("an edge of three triangles is accepted");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(std::string(error.what()).find("has more than two triangles") != std::string::npos);
    }
}
