// Materials, masses, energies and forces of the discrete model.
#include "support/catch.hpp"

#include "samples.hpp"
#include "taut/plan/material.hpp"
#include "taut/report/hinge.hpp"
#include "taut/report/model.hpp"

#include <glm/geometric.hpp>

#include <limits>
#include <numeric>
#include <random>

using namespace taut;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Body sheet(std::uint32_t cells, double size, double stretch, double bending)
{
    Body body;
    body.mesh = samples::right_triangles(cells, cells, size / cells, size / cells);
    body.material.stretch_stiffness = stretch;
    body.material.bending_stiffness = bending;
    return body;
}

std::vector<glm::dvec3> shaken(std::vector<glm::dvec3> x, double size, unsigned seed)
{
    std::mt19937 random(seed);
    for (glm::dvec3& p : x)
        for (int k = 0; k < 3; ++k)
            p[k] += size * (static_cast<double>(random()) / 2147483648.0 - 1);
    return x;
}

} // namespace

TEST_CASE("the masses of a sheet add up to density times area", "[model]")
{
    const std::vector<double> mass = vertex_masses(sheet(7, 1.4, 1, 0));
    CHECK(std::accumulate(mass.begin(), mass.end(), 0.0) == Approx(0.2 * 1.4 * 1.4).epsilon(1e-14));
    // A corner cut by a diagonal has two triangles, one that is not has one, of 0.02 m^2.
    CHECK(mass.front() == Approx(0.2 * 0.02 / 3).epsilon(1e-14));
    CHECK(mass[7] == Approx(0.2 * 0.04 / 3).epsilon(1e-14));
}

TEST_CASE("a chain weighs its strips and a free particle the strip that its shape names", "[model]")
{
    Body chain;
    chain.mesh.positions = {{0, 0, 0}, {0, -0.5, 0}, {0, -2, 0}};
    chain.mesh.links = {{0, 1}, {1, 2}};
    chain.mesh.link_width = 0.1;
    CHECK(vertex_masses(chain)[0] == Approx(0.2 * 0.5 * 0.1 / 2));
    CHECK(vertex_masses(chain)[1] == Approx(0.2 * 2.0 * 0.1 / 2));
    const std::vector<StretchElement> links = stretch_elements(chain);
    REQUIRE(links.size() == 2);
    CHECK(links[1].compliance == Approx(1.5 / (1e4 * 0.1))); // L/(Y w)
    Body particle;
    particle.shape.length = 2;
    particle.shape.width = 0.03;
    particle.mesh.positions = {{1, 2, 3}};
    CHECK(vertex_masses(particle)[0] == Approx(0.2 * 2 * 0.03));
    particle.vertex_masses = {7};
    CHECK(vertex_masses(particle)[0] == 7);
}

TEST_CASE("a vertex without area has the mean mass and every mass is positive", "[model]")
{
    Body body = sheet(1, 1, 1, 0);
    body.mesh.positions.emplace_back(5, 5, 5);
    const std::vector<double> mass = vertex_masses(body);
    CHECK(mass[4] == Approx(0.2 / 4));
}

TEST_CASE("an equilateral lattice has springs of sqrt(3)/2 of the membrane modulus", "[model]")
{
    Body body;
    body.mesh = samples::equilateral_triangles(6, 6, 0.1);
    body.material.stretch_stiffness = 500;
    std::size_t inner = 0;
    for (const StretchElement& s : stretch_elements(body))
    {
        CHECK(s.rest_length == Approx(0.1).epsilon(1e-13));
        const double modulus = 1 / s.compliance / (std::sqrt(3.0) / 2);
        inner += std::abs(modulus / 500 - 1) < 1e-12;
        CHECK((std::abs(modulus / 500 - 1) < 1e-12 || std::abs(modulus / 250 - 1) < 1e-12)); // boundary: half
    }
    CHECK(inner == 3 * 36 + 12 - 24);
}

TEST_CASE("an equilateral lattice stores the energy of the membrane with Poisson ratio 1/3", "[model]")
{
    // Per area, small uniform strain: E = Y/(2(1-nu^2)) (exx^2 + eyy^2 + 2 nu exx eyy + (1-nu)/2 gamma^2).
    Body body;
    const double side = 0.1, modulus = 500;
    body.mesh = samples::equilateral_triangles(8, 8, side);
    body.material.stretch_stiffness = modulus;
    Scene scene = samples::scene_of(body, glm::dvec3(0));
    const PhysicalModel model = make_model(scene);
    const double area = 128 * std::sqrt(3.0) / 4 * side * side;
    const glm::dvec3 strain = GENERATE(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1),
                                       glm::dvec3(1, -1, 0.5), glm::dvec3(1, 1, 0));
    const double e = 1e-7, nu = 1.0 / 3;
    std::vector<glm::dvec3> x = model.start;
    for (glm::dvec3& p : x)
        p += e * glm::dvec3(strain.x * p.x + strain.z * p.y, strain.y * p.y, 0);
    const double expected = modulus / (2 * (1 - nu * nu)) * e * e *
                            (strain.x * strain.x + strain.y * strain.y + 2 * nu * strain.x * strain.y +
                             (1 - nu) / 2 * strain.z * strain.z);
    CHECK(elastic_energy(model, x) / area == Approx(expected).epsilon(1e-6));
}

TEST_CASE("stiffness 0 has no springs, inf has rigid ones, and added springs stay as given", "[model]")
{
    Body body = sheet(2, 1, 0, 0);
    body.springs.push_back({0, 8, 1.25, 0.5});
    REQUIRE(stretch_elements(body).size() == 1);
    CHECK(stretch_elements(body)[0].rest_length == 1.25);
    CHECK(stretch_elements(body)[0].compliance == 0.5);
    body.material.stretch_stiffness = kInf;
    const std::vector<StretchElement> rigid = stretch_elements(body);
    REQUIRE(rigid.size() == 17);
    for (std::size_t i = 0; i + 1 < rigid.size(); ++i)
        CHECK(rigid[i].compliance == 0);
    CHECK(bend_elements(body).empty());
    body.material.bending_stiffness = kInf;
    REQUIRE(bend_elements(body).size() == 8);
    CHECK(bend_elements(body)[0].compliance == 0);
}

TEST_CASE("an edge of zero length stays as a rigid spring and its hinges are counted out", "[model]")
{
    Body body = sheet(2, 1, 100, 1);
    body.mesh.positions[4] = body.mesh.positions[1]; // the middle onto the top
    std::size_t zero = 0, dropped = 0;
    for (const StretchElement& s : stretch_elements(body))
    {
        CHECK(std::isfinite(s.compliance));
        zero += s.rest_length == 0 && s.compliance == 0;
    }
    CHECK(zero == 1);
    const std::vector<BendElement> hinges = bend_elements(body, &dropped);
    CHECK(hinges.size() + dropped == 8);
    CHECK(dropped >= 1);
    for (const BendElement& h : hinges)
        CHECK((std::isfinite(h.rest_angle) && std::isfinite(h.compliance)));
}

TEST_CASE("the angle of a hinge is 0 flat and signed by the side of the fold", "[model]")
{
    const glm::dvec3 a(0, 0, 0), b(0, 2, 0), left(-1, 1, 0);
    CHECK(dihedral_angle(a, b, left, {1, 1, 0}) == 0);
    for (double degrees : {-170.0, -90.0, -1e-6, 1e-6, 30.0, 90.0, 179.0})
    {
        const double t = degrees * 3.14159265358979323846 / 180;
        const double angle = dihedral_angle(a, b, left, {std::cos(t), 1, std::sin(t)});
        const double other = dihedral_angle(b, a, {std::cos(t), 1, std::sin(t)}, left);
        CHECK(std::abs(angle) == Approx(std::abs(t)).epsilon(1e-12));
        CHECK(angle * t * dihedral_angle(a, b, left, {0, 1, 1}) > 0); // one sign a side
        CHECK(other == Approx(angle).epsilon(1e-12)); // the same fold seen from the other end
    }
    CHECK(dihedral_angle(a, a, left, {1, 1, 0}) == 0);
}

TEST_CASE("a cylinder along a grid of right triangles holds B kappa^2/2 (1 - 1/n) per area", "[model]")
{
    // Unit square, radius 1, rolled about y: only the n - 1 inner columns of upright edges are bent.
    const std::uint32_t n = GENERATE(4u, 8u, 32u);
    const double rigidity = 0.3;
    const PhysicalModel model = make_model(samples::scene_of(sheet(n, 1, 0, rigidity)));
    std::vector<glm::dvec3> x = model.start;
    for (glm::dvec3& p : x)
        p = {std::sin(p.x), p.y, 1 - std::cos(p.x)};
    CHECK(elastic_energy(model, x) == Approx(0.5 * rigidity * (1 - 1.0 / n)).epsilon(1e-12));
}

TEST_CASE("an equilateral lattice rolled along or across its rows holds B kappa^2/2 per area", "[model]")
{
    Body body;
    const std::uint32_t n = 64;
    const double side = 1.0 / n;
    body.mesh = samples::equilateral_triangles(n, n, side);
    body.material.stretch_stiffness = 0;
    body.material.bending_stiffness = 0.3;
    const PhysicalModel model = make_model(samples::scene_of(body));
    const double area = 2.0 * n * n * std::sqrt(3.0) / 4 * side * side;
    double energy[2];
    for (int direction = 0; direction < 2; ++direction)
    {
        std::vector<glm::dvec3> x = model.start;
        for (glm::dvec3& p : x)
            p = direction == 0 ? glm::dvec3(std::sin(p.x), p.y, 1 - std::cos(p.x))
                               : glm::dvec3(p.x, std::sin(p.y), 1 - std::cos(p.y));
        energy[direction] = elastic_energy(model, x) / area / (0.5 * 0.3);
    }
    CAPTURE(energy[0], energy[1]);
    CHECK(energy[0] == Approx(1).epsilon(0.02)); // less the edges at the boundary, which do not bend
    CHECK(energy[1] == Approx(1).epsilon(0.02));
}

TEST_CASE("at rest nothing but gravity pulls", "[model]")
{
    Scene scene = samples::scene_of(sheet(5, 1, 1e4, 1e-2), glm::dvec3(0));
    for (glm::dvec3& p : scene.bodies[0].mesh.positions) // a curved rest shape
        p.z = 0.3 * p.x * p.x - 0.1 * p.y;
    const PhysicalModel model = make_model(scene);
    std::vector<glm::dvec3> force(model.mass.size(), glm::dvec3(0));
    add_forces(model, model.start, force);
    for (const glm::dvec3& f : force)
        CHECK(glm::length(f) < 1e-11);
    CHECK(elastic_energy(model, model.start) < 1e-24);
}

TEST_CASE("inner forces have no sum and no moment, and are minus the slope of the energy", "[model]")
{
    const unsigned seed = GENERATE(1u, 2u, 3u);
    Scene scene = samples::scene_of(sheet(3, 1, 100, 0.5), glm::dvec3(0));
    const PhysicalModel model = make_model(scene);
    std::vector<glm::dvec3> x = shaken(model.start, 0.12, seed);
    std::vector<glm::dvec3> force(x.size(), glm::dvec3(0));
    add_forces(model, x, force);
    glm::dvec3 sum(0), moment(0);
    double size = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        sum += force[i];
        moment += glm::cross(x[i], force[i]);
        size += glm::length(force[i]);
    }
    CHECK(glm::length(sum) < 1e-13 * size);
    CHECK(glm::length(moment) < 1e-13 * size);
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int k = 0; k < 3; ++k)
        {
            const double h = 1e-5;
            double e[4];
            const double at[4] = {h, -h, 2 * h, -2 * h};
            for (int j = 0; j < 4; ++j)
            {
                std::vector<glm::dvec3> y = x;
                y[i][k] += at[j];
                e[j] = elastic_energy(model, y);
            }
            const double slope = (8 * (e[0] - e[1]) - (e[2] - e[3])) / (12 * h);
            worst = std::max(worst, std::abs(slope + force[i][k]));
        }
    CHECK(worst < 1e-9 * size);
}

TEST_CASE("the first pin that names a vertex holds it, and pins have no speed", "[model]")
{
    Scene scene = samples::scene_of(sheet(2, 1, 100, 0));
    Body& body = scene.bodies[0];
    body.velocity = {1, 2, 3};
    body.pins.resize(2);
    body.pins[0].vertices = {2, 0};
    body.pins[1].vertices = {2, 3};
    body.pins[1].motion.resize(1);
    scene.bodies.push_back(scene.bodies[0]);
    const PhysicalModel model = make_model(scene);
    REQUIRE(model.pins.size() == 6);
    CHECK(model.pins[1].vertex == 2);
    CHECK(model.pins[1].motion.empty());
    CHECK(model.pins[2].motion.size() == 1);
    CHECK(model.pins[3].vertex == 9);
    CHECK(model.body_start == std::vector<std::uint32_t>{0, 9, 18});
    CHECK(model.velocity[2] == glm::dvec3(0));
    CHECK(model.velocity[1] == glm::dvec3(1, 2, 3));
    CHECK(model.diameter == Approx(std::sqrt(2.0)));
    const double held = 2 * (model.mass[0] + model.mass[2] + model.mass[3]);
    CHECK(total_weight(model) == Approx(9.81 * (2 * 0.2 - held)));
}

TEST_CASE("the frequency bound is above the fastest mode and near it for a spring", "[model]")
{
    Body body;
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    body.springs.push_back({0, 1, 1, 1.0 / 50});
    body.vertex_masses = {2, 3};
    const PhysicalModel free = make_model(samples::scene_of(body));
    const double exact = std::sqrt(50 * (1.0 / 2 + 1.0 / 3));
    CHECK(frequency_bound(free, free.start) >= exact);
    CHECK(frequency_bound(free, free.start) < 1.3 * exact);
}
