// Rows of four corners: their records, their diagonals, and the passes that form them.
//
// Based on:
//   Va, Choi, Hong. Real-time Volume Preserving Constraints for Volumetric Model on GPU. CMC 73(1), 2022: a
//   row a tetrahedron beside those of its edges.
//   Bridson, Marino, Fedkiw. Simulation of Clothing with Folds and Wrinkles. SCA 2003: the angle of a hinge.
// Departures: the angle is a row like a volume, with the compliance of the plate on the diagonal. It is
//   multiplied by one length for all hinges, so that angles do not drown lengths in the norm of the residual.

#include "taut/plan/corner_rows.hpp"

#include "taut/kernels/hinge_rows.hpp"
#include "taut/kernels/volume_rows.hpp"
#include "taut/plan/implicit_constraints.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/plan/stability.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

double substep_of(const PlanBuilder& b) { return b.plan.timestep / b.plan.substeps; }

/// Places at rest by plan vertex.
std::vector<glm::dvec3> rest_places(const PlanBuilder& b)
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

/// Of a hinge, rad^2/(m^2 kg).
double weight_of(const PlanBuilder& b, const BendElement& e, std::span<const glm::dvec3> x)
{
    const std::array<double, 4> size = hinge_gradient_sizes(e, x);
    const std::array<std::uint32_t, 4> vertex = corners_of(e);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += b.inverse_mass[vertex[k]] * size[k] * size[k];
    return sum;
}

double inverse_of(double weight, double compliance, double h)
{
    return std::clamp(1 / (weight + std::min(compliance / (h * h), 1e30)), 1e-30, 1e30);
}

/// The length at which a hinge's diagonal is what a rigid spring between such vertices has, compliance
/// included: the geometric mean over the hinges, one end in four corners weighing as two of a spring.
float hinge_scale(const PlanBuilder& b, const std::vector<BendElement>& hinges,
                  const std::vector<double>& weights)
{
    const double h = substep_of(b);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < hinges.size(); ++k)
    {
        double ends = 0;
        for (const std::uint32_t v : corners_of(hinges[k]))
            ends += b.inverse_mass[v] / 2;
        const double square = ends * inverse_of(weights[k], hinges[k].compliance, h);
        if (!(square > 0) || !std::isfinite(square))
            continue;
        sum += std::log(square) / 2;
        ++count;
    }
    return static_cast<float>(std::clamp(count > 0 ? std::exp(sum / double(count)) : 1, 1e-9, 1e9));
}

void add_hinges(PlanBuilder& b, CornerSet& set, std::span<const glm::dvec3> rest)
{
    const double h = substep_of(b);
    set.hinges = all_hinges(b);
    std::vector<double> weights;
    for (BendElement& e : set.hinges)
    {
        weights.push_back(weight_of(b, e, rest));
        e.compliance = std::max(e.compliance, kRegularisation * h * h * weights.back());
    }
    set.scale = hinge_scale(b, set.hinges, weights);
    const double square = double(set.scale) * double(set.scale);
    for (std::size_t k = 0; k < set.hinges.size(); ++k)
    {
        set.hinges[k].compliance *= square;
        set.inverse.push_back(inverse_of(weights[k] * square, set.hinges[k].compliance, h));
    }
}

} // namespace

std::vector<std::uint32_t> CornerSet::corners() const
{
    std::vector<std::uint32_t> out = corners_of(volumes);
    const std::vector<std::uint32_t> more = corners_of(hinges);
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

CornerSet corner_set(PlanBuilder& b)
{
    const double h = substep_of(b);
    const std::vector<glm::dvec3> rest = rest_places(b);
    CornerSet out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (VolumeElement e : acting_volumes(b, body))
        {
            const double weight = weight_of(b, e, rest);
            e.compliance = std::max(e.compliance, kRegularisation * h * h * weight);
            out.volumes.push_back(e);
            out.inverse.push_back(inverse_of(weight, e.compliance, h));
        }
    add_hinges(b, out, rest);
    return out;
}

CornerRows add_corner_buffers(PlanBuilder& b, std::string_view effect, const CornerSet& set,
                              std::uint32_t groups)
{
    CornerRows out;
    out.count = static_cast<std::uint32_t>(set.size());
    if (out.count == 0)
        return out;
    const Incidence at = incidence_of(b.plan.vertex_count, set.corners(), 4);
    check_row_trips(b, at, linear::make_grid(b.plan.vertex_count, groups).chunk);
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        using Volume = layout::VolumeConstraint<Real>;
        using Hinge = layout::BendingConstraint<Real>;
        static_assert(sizeof(Volume) == sizeof(Hinge) && offsetof(Volume, d) == offsetof(Hinge, wing1));
        std::vector<std::byte> records = to_bytes<Volume>(records_of(set.volumes, volume_record<Real>));
        const std::vector<std::byte> more = to_bytes<Hinge>(records_of(set.hinges, bending_record<Real>));
        records.insert(records.end(), more.begin(), more.end());
        out.records = b.add_buffer<std::byte>(effect, "rows of four corners", records);
    });
    out.start = b.add_buffer<std::uint32_t>(effect, "rows of four corners at a vertex, start", at.start);
    out.incident = b.add_buffer<std::uint32_t>(effect, "rows of four corners at a vertex", at.entries);
    out.gradient =
        b.add_buffer(effect, "gradients of four corners", std::uint64_t(out.count) * 12 * b.real_size());
    return out;
}

void record_corner_rows(PlanBuilder& b, std::string_view effect, const CornerSet& set,
                        const ConstraintRows& rows, const PlanSolve& solve, std::uint32_t multiplier,
                        std::uint32_t groups, const Moment& moment)
{
    const CornerRows& own = rows.corners;
    const std::uint32_t further = moment.iteration > 0;
    const std::string_view variant = multiplier != kNoBuffer ? "kept" : "";
    const auto volumes = static_cast<std::uint32_t>(set.volumes.size());
    const auto hinges = static_cast<std::uint32_t>(set.hinges.size());
    const auto with_rest = [&](auto uses) {
        uses.position = {b.plan.position, 4};
        uses.delta = {b.plan.delta, 4};
        uses.step_values = {b.plan.step_values, 0};
        uses.events = {b.plan.events, 0};
        uses.gradient = {own.gradient, 3};
        uses.b = {solve.b()};
        uses.multiplier = {multiplier};
        return uses;
    };
    if (volumes > 0)
        b.dispatch(effect, variant,
                   with_rest(kernels::volume_rows::Bindings<Use>{.tetrahedron = {own.records}}),
                   {volumes, linear::make_grid(volumes, groups).chunk, rows.count, further, moment.last},
                   groups, volumes);
    if (hinges > 0)
        b.dispatch(effect, variant, with_rest(kernels::hinge_rows::Bindings<Use>{.hinge = {own.records}}),
                   {hinges, linear::make_grid(hinges, groups).chunk, volumes, rows.count + volumes, further,
                    moment.last, set.scale},
                   groups, hinges);
}

} // namespace taut
