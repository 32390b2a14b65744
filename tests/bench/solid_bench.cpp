// Whole steps of a hanging box of 16^3 cells of five tetrahedra, springs and volumes, 10 substeps of one
// iteration, against a plain coloured OpenMP program.

#include "bench.hpp"
#include "plain_solid.hpp"

#include "taut/plan/plan.hpp"
#include "taut/report/report.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace bench {
namespace {

constexpr int kSubsteps = 10;
constexpr double kTimestep = 1.0 / 60;
constexpr int kTurns = 9, kWarmUp = 1; // of six: 60 steps of each, 1 s

taut::Scene hanging()
{
    taut::Scene scene;
    taut::Body body;
    body.shape.kind = taut::ShapeKind::box;
    body.shape.box_cells = {16, 16, 16};
    body.material = taut::solid_material();
    body.material.model = taut::SolidModel::springs;
    body.material.youngs_modulus = 1e6;
    taut::Pin pin;
    pin.faces = {"top"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.timestep = kTimestep;
    scene.method.substeps = kSubsteps;
    return taut::resolve(scene);
}

template <typename T>
std::vector<T> contents(const taut::Plan& plan, std::uint32_t buffer)
{
    const std::vector<std::byte>& bytes = plan.buffers[buffer].initial;
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
}

const taut::ConstraintSet& set_of(const taut::Plan& plan, const std::string& kind)
{
    for (const taut::ConstraintSet& set : plan.constraints)
        if (set.kind == kind)
            return set;
    throw std::runtime_error("the plan has no " + kind);
}

/// The plan's own records in its own colours, in the memory of the rival.
plain::Solid rival_of(const taut::Plan& plan)
{
    std::vector<plain::Vec4> position;
    for (const glm::vec4& x : contents<glm::vec4>(plan, plan.position))
        position.push_back({x.x, x.y, x.z, x.w});
    const taut::ConstraintSet &length = set_of(plan, "distance"), &volume = set_of(plan, "volume");
    std::vector<plain::Constraint> springs;
    for (const auto& c : contents<taut::layout::DistanceConstraint<float>>(plan, length.buffer))
        springs.push_back({c.a, c.b, c.rest_length, c.compliance});
    std::vector<plain::Tetrahedron> tetrahedra;
    for (const auto& c : contents<taut::layout::VolumeConstraint<float>>(plan, volume.buffer))
        tetrahedra.push_back({c.a, c.b, c.c, c.d, c.rest_volume, c.compliance});
    return {std::move(position), std::move(springs), length.colour_start, std::move(tetrahedra),
            volume.colour_start};
}

} // namespace

std::vector<Row> solid_rows()
{
    const taut::Scene scene = hanging();
    taut::World serial(scene, taut::Device::open("cpu:serial")), parallel(scene, taut::Device::open("cpu"));
    const taut::Plan& plan = parallel.plan();
    plain::Solid rival = rival_of(plan);
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
    const std::vector<glm::dvec3> ours = parallel.positions();
    double apart = 0;
    for (std::size_t v = 0; v < ours.size(); ++v)
    {
        const plain::Vec4& x = rival.position()[v];
        apart = std::max(apart, glm::length(ours[plan.original[v]] - glm::dvec3(x.x, x.y, x.z)));
    }
    if (!(apart < 1e-3))
        throw std::runtime_error("hanging box: vertices are " + taut::shown(apart, 3) +
                                 " m from the plain program's; what computes something else is not timed");
    const double kept = taut::measure(parallel).volume.ratio;
    const double projections =
        kSubsteps * static_cast<double>(set_of(plan, "distance").count + set_of(plan, "volume").count);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < rivals.size(); ++i)
    {
        const double each = 1e6 * rivals[i].median() / projections;
        rows.push_back({rivals[i].name + ", hanging box of 20,480 tetrahedra, " + taut::shown(each, 3) +
                            " ns a projection, volume at " + taut::shown(100 * kept, 5) + " %",
                        rivals[i].median(), rivals[i].best(), i == 0 ? 0 : apart,
                        rivals[i].median() / rivals[0].median(), i == 0 ? "" : "plain OpenMP",
                        i == 2 ? 0.6 : 0});
    }
    return rows;
}

} // namespace bench
