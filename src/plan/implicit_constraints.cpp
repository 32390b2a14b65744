// Springs as implicit constraints: one linear system a substep, or more, each at the places that the one
// before led to.
//
// Based on:
//   Hong, Choi, Jung, Welch, Trapp. Effective Constrained Dynamic Simulation Using Implicit Constraint
//   Enforcement. ICRA 2005: C + J dx = 0 at the end of the step, (J W J^T) lambda = C / h^2 + ...
//   Goldenthal, Harmon, Fattal, Bercovier, Grinspun. Efficient Simulation of Inextensible Cloth. SIGGRAPH
//   2007: the further solves (fast projection).
//   Va, Choi, Hong. Real-time Volume Preserving Constraints for Volumetric Model on GPU. CMC 73(1), 2022: a
//   row a tetrahedron beside those of its edges.
// Departures: it corrects the displacement that the frame of a substep has guessed, which is the same
//   (L = h^2 lambda); compliance and damper of a spring stay on the diagonal; the first solve starts from the
//   multipliers of the last substep.

#include "taut/plan/implicit_constraints.hpp"

#include "taut/kernels/constraint_rows.hpp"
#include "taut/kernels/constraint_spread.hpp"
#include "taut/kernels/constraint_total.hpp"
#include "taut/kernels/volume_rows.hpp"
#include "taut/kernels/volume_spread.hpp"
#include "taut/plan/methods.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/plan/stability.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

constexpr const char* kEffect = "implicit_constraints";

/// 1/x as a Real, 0 where it is infinite: too little compliance for the precision is none.
template <typename Real>
Real stiffness_of(double compliance)
{
    const Real value = compliance > 0 ? static_cast<Real>(1 / compliance) : Real(0);
    return std::isfinite(value) ? value : Real(0);
}

std::uint32_t groups_of(const PlanBuilder& b, const ImplicitConstraints& c)
{
    return linear::group_count_for(c.rows.all(), b.paper()->info());
}

/// Places at rest by plan vertex.
std::vector<glm::dvec3> rest_of(const PlanBuilder& b)
{
    std::vector<glm::dvec3> out(b.plan.vertex_count);
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (std::uint32_t v = 0; v < b.scene.bodies[body].mesh.positions.size(); ++v)
            out[b.vertex(body, v)] = b.scene.bodies[body].mesh.positions[v];
    return out;
}

/// Sum of w |g|^2 of a tetrahedron, m^4/kg: its diagonal without compliance.
double weight_of(const PlanBuilder& b, const VolumeElement& e, std::span<const glm::dvec3> x)
{
    const auto gradient = volume_gradient(e.vertex, x);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += b.inverse_mass[e.vertex[k]] * glm::dot(gradient[k], gradient[k]);
    return sum;
}

/// Every tetrahedron of a body has some compliance: with the rows of its edges it has more rows than freedom.
std::vector<VolumeElement> volumes_of_all(const PlanBuilder& b)
{
    const double h = b.plan.timestep / b.plan.substeps;
    const std::vector<glm::dvec3> rest = rest_of(b);
    std::vector<VolumeElement> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (VolumeElement e : acting_volumes(b, body))
        {
            e.compliance = std::max(e.compliance, kRegularisation * h * h * weight_of(b, e, rest));
            out.push_back(e);
        }
    return out;
}

void add_volume_buffers(PlanBuilder& b, ImplicitConstraints& c)
{
    VolumeRows& v = c.rows.volumes;
    const Incidence at = incidence_of(b.plan.vertex_count, c.volumes);
    check_row_trips(b, at, linear::make_grid(b.plan.vertex_count, groups_of(b, c)).chunk);
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        v.records = b.add_buffer<layout::VolumeConstraint<Real>>(kEffect, "rows of tetrahedra",
                                                                 records_of(c.volumes, volume_record<Real>));
    });
    v.start = b.add_buffer<std::uint32_t>(kEffect, "tetrahedra at a vertex, start", at.start);
    v.incident = b.add_buffer<std::uint32_t>(kEffect, "tetrahedra at a vertex", at.entries);
    v.gradient =
        b.add_buffer(kEffect, "gradients of tetrahedra", std::uint64_t(v.count) * 12 * b.real_size());
}

void add_row_buffers(PlanBuilder& b, ImplicitConstraints& c)
{
    c.at = incidence_of(b.plan.vertex_count, c.elements);
    c.rows.count = static_cast<std::uint32_t>(c.elements.size());
    c.volumes = volumes_of_all(b);
    c.rows.volumes.count = static_cast<std::uint32_t>(c.volumes.size());
    if (!c.volumes.empty())
        add_volume_buffers(b, c);
    check_row_trips(b, c.at, linear::make_grid(b.plan.vertex_count, groups_of(b, c)).chunk);
    const std::uint64_t vec = 4 * b.real_size();
    c.compliances = row_compliances(b, c.elements);
    c.rows.records = add_row_records(b, kEffect, c.elements, c.compliances);
    c.rows.start = b.add_buffer<std::uint32_t>(kEffect, "rows at a vertex, start", c.at.start);
    c.rows.incident = b.add_buffer<std::uint32_t>(kEffect, "rows at a vertex", c.at.entries);
    c.rows.direction = b.add_buffer(kEffect, "row directions", c.rows.count * vec);
    c.rows.spread = b.add_buffer(kEffect, "moves of vertices", b.plan.vertex_count * vec);
    if (b.plan.iterations > 1)
        c.multiplier = b.add_buffer(kEffect, "multipliers of the substep", c.rows.all() * b.real_size());
}

BufferPtr diagonal_inverse(PlanBuilder& b, const ImplicitConstraints& c)
{
    return with_real(b.plan.precision, [&](auto zero) {
        std::vector<decltype(zero)> values;
        for (std::size_t k = 0; k < c.elements.size(); ++k)
            values.push_back(
                static_cast<decltype(zero)>(inverse_diagonal(b, c.elements[k], c.compliances[k])));
        const double h = b.plan.timestep / b.plan.substeps;
        const std::vector<glm::dvec3> rest = rest_of(b);
        for (const VolumeElement& e : c.volumes)
            values.push_back(static_cast<decltype(zero)>(std::clamp(
                1 / (weight_of(b, e, rest) + std::min(e.compliance / (h * h), 1e30)), 1e-30, 1e30)));
        const BufferPtr buffer =
            b.paper()->make_buffer(values.size() * sizeof(zero), "constraint inverse", BufferUse::device);
        b.paper()->write(buffer, 0, std::as_bytes(std::span(values)));
        return buffer;
    });
}

} // namespace

bool may_be_constrained(const Scene& scene, const StretchElement& spring)
{
    return scene.method.constrained == "all" || spring.kind == SpringKind::structural;
}

void check_constrained_lengths(const Scene& scene)
{
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        for (const StretchElement& e : stretch_elements(scene.bodies[body]))
            if (may_be_constrained(scene, e) && !(e.rest_length > 0))
                throw Error(
                    ErrorCode::degenerate_rest,
                    "bodies[" + std::to_string(body) + "]: the spring between the vertices " +
                        std::to_string(e.a) + " and " + std::to_string(e.b) +
                        " has no length at rest, and as a constraint no direction there; give it one, "
                        "or take method.type \"xpbd\"");
}

void check_implicit_constraints(const Scene& scene, const DeviceTraits&)
{
    check_constrained_lengths(scene);
    bool forces = false;
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    {
        const std::string where = "bodies[" + std::to_string(body) + "]";
        for (const StretchElement& e : stretch_elements(scene.bodies[body]))
        {
            forces = forces || acts_as_force(scene, e);
            if (acts_as_force(scene, e) && !(e.compliance > 0))
                throw Error(ErrorCode::unsupported,
                            where + ": the spring between the vertices " + std::to_string(e.a) + " and " +
                                std::to_string(e.b) +
                                " is rigid, but method.constrained leaves it a spring; give it a finite "
                                "stiffness, or take method.constrained \"all\"");
        }
        if (holds_volumes(scene.bodies[body]) && scene.method.linear_operator != "matrix_free")
            throw Error(ErrorCode::unsupported,
                        where + ".material holds volumes of tetrahedra, but method.linear_operator is \"" +
                            scene.method.linear_operator +
                            "\", and only \"matrix_free\" has rows of tetrahedra; take that, or set "
                            "volume_stiffness to 0");
        // With stiff constraints hinges gain energy (hard case F17).
        if (scene.bodies[body].material.bending_stiffness > 0 && !scene.bodies[body].mesh.triangles.empty())
            throw Error(ErrorCode::unsupported,
                        where + ".material.bending_stiffness is " +
                            shown(scene.bodies[body].material.bending_stiffness) +
                            ", but method.type \"implicit_constraints\" has no hinges "
                            "yet; set it to 0");
    }
    if (forces && scene.method.integrator != "semi_implicit")
        throw Error(ErrorCode::unsupported, "method.integrator is \"" + scene.method.integrator +
                                                "\", but forces beside constraints are stepped by "
                                                "\"semi_implicit\" only");
}

std::vector<double> row_compliances(const PlanBuilder& b, std::span<const StretchElement> springs)
{
    const double given = b.scene.method.constraint_compliance, h = b.plan.timestep / b.plan.substeps;
    const bool rigid = method_of(b.scene) == MethodKind::acad;
    std::vector<double> out;
    std::size_t first = 0;
    for (std::size_t body = 0; body + 1 < b.plan.body_start.size(); ++body)
    {
        std::size_t free = 0, last = first;
        for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
            free += b.inverse_mass[v] > 0;
        // The same spring twice is twice the same equation, which conjugate gradients do not mind.
        std::set<std::pair<std::uint32_t, std::uint32_t>> different;
        for (; last < springs.size() && springs[last].a < b.plan.body_start[body + 1]; ++last)
            different.insert(std::minmax(springs[last].a, springs[last].b));
        const double floor = different.size() > 3 * free ? kRegularisation * h * h : 0;
        for (; first < last; ++first)
        {
            const StretchElement& e = springs[first];
            const double own = given >= 0 ? given : rigid ? 0 : e.compliance;
            out.push_back(std::max(own, floor * (b.inverse_mass[e.a] + b.inverse_mass[e.b])));
        }
    }
    return out;
}

double inverse_diagonal(const PlanBuilder& b, const StretchElement& e, double compliance)
{
    const double h = b.plan.timestep / b.plan.substeps;
    const double soft = std::min(compliance / (h * h), 1e30) / (1 + e.damping * compliance / h);
    return std::clamp(1 / (b.inverse_mass[e.a] + b.inverse_mass[e.b] + soft), 1e-30, 1e30);
}

std::uint32_t add_row_records(PlanBuilder& b, std::string_view effect,
                              const std::vector<StretchElement>& springs, std::span<const double> compliances)
{
    return with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::Spring<Real>> records = records_of(springs, spring_record<Real>);
        for (std::size_t k = 0; k < springs.size(); ++k)
            records[k].stiffness = stiffness_of<Real>(compliances[k]);
        return b.add_buffer<layout::Spring<Real>>(effect, "rows", records);
    });
}

void check_row_trips(const PlanBuilder& b, const Incidence& at, std::uint32_t chunk)
{
    const std::uint32_t lanes = TAUT_LINEAR_GROUP;
    for (std::uint32_t first = 0; first < b.plan.vertex_count; first += chunk)
        for (std::uint32_t lane = 0; lane < std::min(lanes, chunk); ++lane)
        {
            std::uint64_t trips = 0;
            for (std::uint32_t v = first + lane; v < std::min(first + chunk, b.plan.vertex_count); v += lanes)
                trips += at.start[v + 1] - at.start[v] + 1;
            if (trips > kMaxLoopTrips)
                throw Error(ErrorCode::limit,
                            std::to_string(trips) +
                                " constraints meet at one vertex, or at the few that one "
                                "invocation gathers, and " +
                                std::to_string(kMaxLoopTrips) +
                                " are the most; take method.type \"xpbd\", which splits hubs");
        }
}

void prepare_implicit_constraints(PlanBuilder& b)
{
    auto c = std::make_shared<ImplicitConstraints>();
    c->elements = all_springs(b);
    std::erase_if(c->elements, [&](const StretchElement& e) { return !may_be_constrained(b.scene, e); });
    if (c->elements.empty())
        return;
    add_row_buffers(b, *c);
    std::shared_ptr<const linear::Operator> system;
    if (b.scene.method.linear_operator == "assembled")
    {
        c->matrix.emplace(b, kEffect, constraint_pattern(c->elements, c->at, b.inverse_mass),
                          c->rows.direction);
        system = c->matrix->matrix();
    }
    else
        system = std::make_shared<ConstraintOperator>(b, c->rows);
    c->solve.emplace(
        b, kEffect, system,
        linear::Preconditioning{linear::Preconditioner::jacobi, diagonal_inverse(b, *c), nullptr});
    b.plan.kept.push_back(c->solve->x());
    if (c->multiplier != kNoBuffer)
        b.plan.kept.push_back(c->multiplier);
    b.implicit_constraints = std::move(c);
}

namespace {

void record_volume_rows(PlanBuilder& b, const ImplicitConstraints& c, const Moment& moment)
{
    const VolumeRows& v = c.rows.volumes;
    const linear::Grid grid = linear::make_grid(v.count, groups_of(b, c));
    std::vector<Use> uses = {
        {v.records},        {b.plan.position, 4}, {b.plan.delta, 4}, {b.plan.step_values, 0},
        {b.plan.events, 0}, {v.gradient, 3},      {c.solve->b()}};
    const bool kept = c.multiplier != kNoBuffer;
    if (kept)
        uses.push_back({c.multiplier});
    b.dispatch(
        kEffect, "volume_rows", kept ? "kept" : "", uses,
        kernels::volume_rows::Params{v.count, grid.chunk, c.rows.count, moment.iteration > 0, moment.last},
        groups_of(b, c), v.count);
}

} // namespace

void record_implicit_constraints(PlanBuilder& b, const Moment& moment)
{
    if (!b.implicit_constraints)
        return;
    ImplicitConstraints& c = *b.implicit_constraints;
    const std::uint32_t groups = groups_of(b, c), count = c.rows.count, all = c.rows.all();
    if (c.multiplier != kNoBuffer)
    {
        const Use uses[] = {{c.solve->x()}, {c.multiplier}, {c.solve->state(), 0}};
        b.dispatch(kEffect, "constraint_total", "", uses,
                   kernels::constraint_total::Params{all, moment.iteration == 0}, all);
    }
    std::vector<Use> uses = {{c.rows.records},        {b.plan.position, 2}, {b.plan.delta, 2},
                             {b.plan.step_values, 0}, {b.plan.events, 0},   {c.rows.direction},
                             {c.solve->b()}};
    if (c.multiplier != kNoBuffer)
        uses.push_back({c.multiplier});
    const std::uint32_t chunk = linear::make_grid(count, groups).chunk;
    b.dispatch(kEffect, "constraint_rows", c.multiplier != kNoBuffer ? "kept" : "", uses,
               kernels::constraint_rows::Params{count, chunk, moment.iteration > 0, moment.last}, groups,
               count);
    if (!c.volumes.empty())
        record_volume_rows(b, c, moment);
    if (c.matrix)
        c.matrix->record(b);
    c.solve->record(b);
    const linear::Grid grid = linear::make_grid(b.plan.vertex_count, groups);
    const Use moved[] = {{c.rows.start},    {c.rows.incident, 12}, {c.rows.direction, 12}, {c.solve->x(), 12},
                         {b.plan.position}, {b.plan.delta},        {c.solve->state(), 0}};
    b.dispatch(kEffect, "constraint_spread", "apply", moved,
               kernels::constraint_spread::Params{grid.count, grid.chunk}, groups, grid.count);
    if (c.volumes.empty())
        return;
    const VolumeRows& v = c.rows.volumes;
    const Use also[] = {{v.start},         {v.incident, 24}, {v.gradient, 24},     {c.solve->x(), 24},
                        {b.plan.position}, {b.plan.delta},   {c.solve->state(), 0}};
    b.dispatch(kEffect, "volume_spread", "apply", also,
               kernels::volume_spread::Params{grid.count, grid.chunk, count}, groups, grid.count);
}

} // namespace taut
