// Whole steps of hanging cloth against a plain coloured OpenMP program: 2 m x 2 m, n x n particles of
// 1 kg, axis and diagonal neighbours rigid, second neighbours 5e-5 m/N, two corners held, 10 substeps of 1
// iteration.

#include "bench.hpp"
#include "plain_cloth.hpp"

#include "taut/plan/topology.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>

namespace bench {
namespace {

constexpr int kSubsteps = 10;
constexpr double kTimestep = 1.0 / 60;
constexpr double kSoft = 5e-5; // m/N
constexpr int kTurns = 19, kWarmUp = 1; // of six: 120 steps of each, 2 s

taut::Scene hanging(std::uint32_t n)
{
    taut::Scene scene;
    taut::Body body;
    body.shape.cells = {n - 1, n - 1};
    body.shape.size = {2, 2};
    body.shape.network = {true, 1, 1, 1};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.vertex_masses.assign(std::size_t(n) * n, 1.0);
    taut::Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.timestep = kTimestep;
    scene.method.substeps = kSubsteps;
    scene = taut::resolve(scene);
    for (taut::Body::Spring& s : scene.bodies[0].springs)
        s.compliance = s.kind == taut::SpringKind::bend ? kSoft : 0;
    return scene;
}

/// The same springs in the same colours, in the memory of the rival.
plain::Cloth rival_of(const taut::Scene& scene, std::uint32_t n)
{
    const taut::Body& body = scene.bodies[0];
    std::vector<plain::Vec4> position;
    for (const glm::dvec3& x : body.mesh.positions)
        position.push_back({static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z), 1});
    for (const taut::Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            position[v].w = 0;
    const auto springs = taut::grid_springs(n, n, true, true);
    const taut::Colouring colouring = taut::colouring_of(springs);
    std::vector<plain::Constraint> constraints;
    for (const std::uint32_t k : colouring.order)
    {
        const auto [a, b, colour] = springs[k];
        const double length = glm::distance(body.mesh.positions[a], body.mesh.positions[b]);
        const double compliance = colour < 8 ? 0 : kSoft;
        constraints.push_back({a, b, static_cast<float>(length), static_cast<float>(compliance)});
    }
    return {std::move(position), std::move(constraints), colouring.colour_start};
}

/// The largest l - L over the springs along rows and columns, m.
template <typename Place>
double stretch(const taut::Scene& scene, const Place& place)
{
    double worst = 0;
    for (const taut::Body::Spring& s : scene.bodies[0].springs)
        if (s.kind == taut::SpringKind::structural)
            worst = std::max(worst, glm::distance(place(s.a), place(s.b)) - s.rest_length);
    return worst;
}

void add_rows(std::vector<Row>& rows, std::uint32_t n)
{
    const taut::Scene scene = hanging(n);
    plain::Cloth rival = rival_of(scene, n);
    taut::World serial(scene, taut::Device::open("cpu:serial")), parallel(scene, taut::Device::open("cpu"));
    const auto one_step = [](taut::World& world) {
        return [&world] {
            world.step();
            world.device().wait();
        };
    };
    std::vector<Rival> rivals = {
        {"plain OpenMP", [&] { rival.step(static_cast<float>(kTimestep), kSubsteps, -9.81f); }},
        {"native serial", one_step(serial)},
        {"native parallel", one_step(parallel)}};
    take_turns_rested(rivals, kTurns, kWarmUp);
    const auto of_rival = [&](std::uint32_t v) {
        const plain::Vec4& x = rival.position()[v];
        return glm::dvec3(x.x, x.y, x.z);
    };
    const auto places = parallel.positions();
    const double theirs = stretch(scene, of_rival);
    const double ours = stretch(scene, [&](std::uint32_t v) { return places[v]; });
    if (!(ours <= 1.1 * theirs))
        throw std::runtime_error("hanging cloth: " + taut::shown(ours, 3) +
                                 " m of stretch where the plain program has " + taut::shown(theirs, 3) +
                                 " m; a time that buys less is not compared");
    const std::string size = ", hanging cloth " + std::to_string(n) + " x " + std::to_string(n);
    for (std::size_t i = 0; i < rivals.size(); ++i)
        rows.push_back({rivals[i].name + size, rivals[i].median(), rivals[i].best(), i == 0 ? theirs : ours,
                        rivals[i].median() / rivals[0].median(), i == 0 ? "" : rivals[0].name + size,
                        i == 2 ? 0.6 : 0});
}

} // namespace

std::vector<Row> cloth_rows()
{
    std::vector<Row> rows;
    for (const std::uint32_t n : {64u, 128u, 256u})
        add_rows(rows, n);
    return rows;
}

} // namespace bench
