// Implicit Euler: each substep minimises 1/2 |delta - guess|_M^2 + h^2 (energy + damping), by Newton steps of
// which the first is the linearly implicit Euler of the textbook.
//
// Based on:
//   Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998.
//   Choi, Ko. Stable but Responsive Cloth. SIGGRAPH 2002.
//   Smith, de Goes, Kim. Stable Neo-Hookean Flesh Simulation. ACM TOG 37(2), 2018.
//   Martin, Thomaszewski, Grinspun, Gross. Example-Based Elastic Materials. SIGGRAPH 2011, eq. 2.
// Departures: unknowns are displacements; the solver starts at the best share of the inertial guess, so that
//   free fall is exact with any number of iterations; what nothing holds keeps its momentum; vertices without
//   elements are left out of the system; light vertices that colliders push after a Newton step stand where
//   they are put in the further ones of the substep; matrix and right-hand side are scaled by powers of two,
//   against underflow in float.

#include "taut/plan/implicit_euler.hpp"

#include "taut/linear/partition.hpp"
#include "taut/plan/added_elements.hpp"
#include "taut/plan/implicit_product.hpp"
#include "taut/plan/implicit_system.hpp"
#include "taut/plan/implicit_table.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/plan/springs.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/kernels/shared/line_search.h"
#include "taut/kernels/shared/solid_state.h"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {


struct Elements
{
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<AddedSet> added;
    std::vector<SolidElement> solids;
    AllCorners corners; ///< springs, hinges if there are any, added ones, tetrahedra
};

Elements acting_elements(PlanBuilder& b)
{
    Elements out{all_springs(b), all_hinges(b), added_sets(b), all_solids(b), {}};
    out.corners.push_back({2, corners_of(out.springs), false});
    if (!out.hinges.empty())
        out.corners.push_back({4, corners_of(out.hinges)});
    for (const AddedSet& set : out.added)
        out.corners.push_back({set.kind->corners, set.vertices});
    out.corners.push_back({4, corners_of(out.solids)});
    return out;
}

/// 2^-k with k the exponent of a positive finite value, within what a float parameter may carry twice.
float power_below(double value)
{
    return static_cast<float>(std::ldexp(1.0, std::clamp(-std::ilogb(value), -60, 60)));
}

template <typename Real>
void add_records(PlanBuilder& b, ImplicitEuler& m, const Elements& elements)
{
    auto springs = records_of(elements.springs, spring_record<Real>);
    if (springs.empty())
        springs.push_back({}); // a binding has bytes; no entry of the table leads here
    m.springs = b.add_buffer<layout::Spring<Real>>(kImplicitEuler, "springs", springs);
    if (!elements.hinges.empty())
        m.kinds.push_back({std::string(kImplicitEuler), "hinge",
                           b.add_buffer<layout::BendingConstraint<Real>>(
                               kImplicitEuler, "hinges", records_of(elements.hinges, bending_record<Real>)),
                           kNoBuffer, static_cast<std::uint32_t>(elements.hinges.size()), 4});
    for (const AddedSet& set : elements.added)
    {
        const std::string& name = set.kind->name;
        m.kinds.push_back({name, name, b.add_buffer<std::byte>(name, name + " constraints", set.records),
                           kNoBuffer, set.count(), set.kind->corners});
    }
    if (elements.solids.empty())
        return;
    m.solids = b.add_buffer<layout::SolidTetrahedron<Real>>(kImplicitEuler, "tetrahedra",
                                                            records_of(elements.solids, solid_record<Real>));
    m.solid_state = b.add_buffer(kImplicitEuler, "state of tetrahedra",
                                 elements.solids.size() * TAUT_SOLID_STATE * sizeof(Real));
}

void check_trips(const PlanBuilder& b, std::span<const std::uint32_t> table, std::uint32_t words,
                 std::string_view what)
{
    if (b.traits.executor.starts_with("cpu"))
        return;
    const std::uint32_t n = b.plan.vertex_count;
    const std::uint32_t groups = linear::group_count_for(3 * n, b.paper()->info());
    const std::uint64_t trips = implicit_trips(table, n, words, linear::make_grid(n, groups).chunk);
    if (trips > kMaxLoopTrips)
        throw Error(ErrorCode::limit, "method.type is \"implicit_euler\", but the " + std::string(what) +
                                          " at one vertex and those that share its lane make " +
                                          std::to_string(trips) + " loop trips, and " +
                                          std::to_string(kMaxLoopTrips) +
                                          " are safe on this device; use the device cpu");
}

/// Those of less than a fiftieth of what a vertex of their body weighs in the mean. (A lattice's corner, of
/// one tetrahedron where others have 24, is heavier than that.)
std::vector<std::uint32_t> light_vertices(const PlanBuilder& b)
{
    std::vector<std::uint32_t> out(b.inverse_mass.size(), 0u);
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const auto count = static_cast<std::uint32_t>(b.scene.bodies[body].mesh.positions.size());
        double sum = 0, moving = 0;
        for (std::uint32_t v = 0; v < count; ++v)
            if (const double w = b.inverse_mass[b.vertex(body, v)]; w > 0)
                sum += 1 / w, moving += 1;
        for (std::uint32_t v = 0; v < count; ++v)
            if (const double w = b.inverse_mass[b.vertex(body, v)]; w * sum > 50 * moving)
                out[b.vertex(body, v)] = 1;
    }
    return out;
}

/// Rows not solved for: held vertices; in further Newton steps light ones that a collider pushed, too.
void add_marks(PlanBuilder& b, ImplicitEuler& m, const std::vector<bool>& solved)
{
    std::vector<std::uint32_t> marks;
    for (const bool moves : solved)
        marks.insert(marks.end(), 3, moves ? 0u : 1u);
    m.held = b.add_buffer<std::uint32_t>(kImplicitEuler, "not solved for", marks);
    m.marks = m.held;
    if (b.scene.colliders.empty() || b.plan.iterations <= 1)
        return;
    const std::vector<std::uint32_t> light = light_vertices(b);
    if (std::find(light.begin(), light.end(), 1u) == light.end())
        return;
    m.light = b.add_buffer<std::uint32_t>(kImplicitEuler, "light vertices", light);
    m.marks = b.add_buffer<std::uint32_t>(kImplicitEuler, "stays in this Newton step", marks);
    m.before = b.add_buffer(kImplicitEuler, "displacement before colliders",
                            std::uint64_t{b.plan.vertex_count} * 4 * b.real_size());
}

/// What the product without a matrix reads, of those kinds of elements that there are.
ImplicitBuffers product_buffers(PlanBuilder& b, const ImplicitEuler& m)
{
    ImplicitBuffers at{b.plan.vertex_count,
                       b.plan.precision,
                       m.scale,
                       b.on_paper(b.plan.position),
                       b.on_paper(b.plan.delta),
                       b.on_paper(b.plan.step_values),
                       b.on_paper(m.springs),
                       b.on_paper(m.spring_table),
                       {},
                       nullptr,
                       nullptr,
                       nullptr};
    for (const ImplicitKind& kind : m.kinds)
        at.kinds.push_back({"implicit_euler_product_" + kind.stem, b.on_paper(kind.records),
                            b.on_paper(kind.table)});
    if (m.solid_count > 0)
    {
        at.solids = b.on_paper(m.solids);
        at.solid_state = b.on_paper(m.solid_state);
        at.solid_table = b.on_paper(m.solid_table);
    }
    return at;
}

/// `tables` as implicit_tables() makes them of `corners`: springs first, tetrahedra last.
void add_tables(PlanBuilder& b, ImplicitEuler& m, const AllCorners& corners,
                const std::vector<std::vector<std::uint32_t>>& tables)
{
    const auto add = [&](std::size_t k, std::string_view effect, const std::string& what) {
        check_trips(b, tables[k], corners[k].words(), what);
        return b.add_buffer<std::uint32_t>(effect, what + " at a vertex", tables[k]);
    };
    m.spring_table = add(0, kImplicitEuler, "springs");
    for (std::size_t k = 0; k < m.kinds.size(); ++k)
        m.kinds[k].table =
            add(1 + k, m.kinds[k].effect, m.kinds[k].effect == kImplicitEuler ? "hinges" : m.kinds[k].stem);
    if (m.solid_count > 0)
        m.solid_table = add(tables.size() - 1, kImplicitEuler, "tetrahedra");
}

/// Twenty vertices each, as long as the coarse system stays small beside a product with the matrix.
std::vector<std::uint32_t> aggregates_of(const linear::SparseMatrix& pattern, const std::vector<bool>& solved)
{
    const auto count = static_cast<std::uint32_t>(std::count(solved.begin(), solved.end(), true));
    std::vector<bool> left_out(solved.size());
    for (std::size_t v = 0; v < solved.size(); ++v)
        left_out[v] = !solved[v];
    const std::uint32_t parts = std::clamp(count / 20, 1u, linear::TwoLevel::kMostAggregates);
    return linear::partition(pattern, parts, left_out);
}

/// Matrix (stored, or of its diagonal blocks alone), tables, preconditioner, solver.
void add_system(PlanBuilder& b, ImplicitEuler& m, const Elements& elements, const std::vector<bool>& solved)
{
    const bool assembled = b.scene.method.linear_operator == LinearOperator::assembled;
    const linear::SparseMatrix pattern = implicit_pattern(solved, elements.corners, assembled);
    const linear::UploadOptions options{linear::Format::bcsr3, b.plan.precision, false, 0, false, true};
    const auto matrix = linear::DeviceMatrix::upload(b.paper(), pattern, options);
    const std::vector<std::uint32_t> slots = matrix->slots(pattern);
    add_tables(b, m, elements.corners, implicit_tables(solved, elements.corners, pattern, slots));
    m.values = b.adopt(kImplicitEuler, matrix->values());
    add_marks(b, m, solved);
    const auto inverse = std::make_shared<linear::DeviceInverse>(
        b.paper(), matrix, pattern, linear::Preconditioner::block_jacobi, b.on_paper(m.marks));
    std::shared_ptr<const linear::Operator> system = matrix;
    if (!assembled)
        system = std::make_shared<ImplicitProduct>(product_buffers(b, m));
    if (b.scene.method.preconditioner != NewtonPreconditioner::two_level)
    {
        m.solve.emplace(b, kImplicitEuler, system,
                        linear::Preconditioning{inverse->kind(), inverse->inverse(), nullptr},
                        PlanSolve::Inverses{inverse});
        return;
    }
    m.coarse = std::make_shared<linear::TwoLevel>(b.paper(), matrix, pattern, inverse->inverse(),
                                                  aggregates_of(pattern, solved));
    const auto mask = std::make_shared<linear::DeviceInverse>(
        b.paper(), matrix, pattern, linear::Preconditioner::jacobi, b.on_paper(m.marks));
    // "multigrid" is what conjugate gradients call any preconditioner whose result is stored.
    m.solve.emplace(b, kImplicitEuler, system,
                    linear::Preconditioning{linear::Preconditioner::multigrid, mask->inverse(), m.coarse},
                    PlanSolve::Inverses{inverse, mask});
}

void add_vectors(PlanBuilder& b, ImplicitEuler& m)
{
    const std::uint64_t real = b.real_size(), groups = m.solve->groups();
    const auto make = [&](std::string_view name, std::uint64_t reals) {
        const std::uint32_t id = b.add_buffer(kImplicitEuler, name, reals * real);
        return b.on_paper(id);
    };
    m.product = make("product of the guess", 3ull * b.plan.vertex_count);
    m.products = make("partials of the guess", groups);
    m.curvatures = make("curvatures of the guess", groups);
    m.trial_count = line_search_of(b.scene) + 1;
    if (m.trial_count > 1)
        m.trials = make("trials", std::uint64_t{m.trial_count} * m.parts() * groups);
}

} // namespace

std::uint32_t line_search_of(const Scene& resolved)
{
    constexpr std::uint32_t kOfCloth = 2, kOfSolids = TAUT_TRIALS - 1;
    if (resolved.method.line_search)
        return *resolved.method.line_search;
    const bool solid = std::ranges::any_of(
        resolved.bodies, [](const Body& body) { return !body.mesh.tetrahedra.empty(); });
    return solid ? kOfSolids : kOfCloth;
}

void check_implicit_euler(const Scene& resolved, Refusals& out)
{
    out.attempt_bodies(resolved, [](const Body& body, std::size_t k) {
        const auto refuse = [k](const std::string& what, const char* setting) {
            throw Error(ErrorCode::unsupported, "bodies[" + std::to_string(k) + "]" + what +
                                                    ", which have no force under method.type "
                                                    "\"implicit_euler\"; give " +
                                                    setting +
                                                    " a finite value or take implicit_constraints or xpbd");
        };
        const auto is_rigid = [](const auto& e) { return !(e.compliance > 0); };
        if (std::ranges::any_of(stretch_elements(body), is_rigid))
            refuse(std::isinf(body.material.stretch_stiffness)
                       ? ".material.stretch_stiffness is infinite: rigid springs"
                       : " has rigid springs",
                   "material.stretch_stiffness or the springs' compliance");
        if (std::ranges::any_of(bend_elements(body), is_rigid))
            refuse(".material.bending_stiffness is infinite: rigid hinges", "it");
        if (holds_volumes(body) && std::isinf(bulk_modulus(body.material)))
            refuse(".material.volume_stiffness is infinite: rigid volumes", "it");
    });
}

ImplicitRecords implicit_records(const PlanBuilder& b)
{
    const ImplicitEuler* m = b.implicit_euler.get();
    return m == nullptr ? ImplicitRecords{} : ImplicitRecords{m->springs, m->solids};
}

void prepare_implicit_euler(PlanBuilder& b)
{
    const Elements elements = acting_elements(b);
    const std::vector<bool> solved = solved_vertices(b.inverse_mass, elements.corners);
    double heaviest = 0;
    for (std::size_t v = 0; v < solved.size(); ++v)
        if (solved[v])
            heaviest = std::max(heaviest, 1 / b.inverse_mass[v]);
    if (!(heaviest > 0))
        return; // nothing can move by a force
    b.implicit_euler = std::make_shared<ImplicitEuler>();
    ImplicitEuler& m = *b.implicit_euler;
    m.scale = power_below(heaviest);
    m.lift = power_below(b.plan.timestep / b.plan.substeps);
    m.spring_count = static_cast<std::uint32_t>(elements.springs.size());
    m.solid_count = static_cast<std::uint32_t>(elements.solids.size());
    m.damped = std::any_of(elements.springs.begin(), elements.springs.end(),
                           [](const StretchElement& e) { return e.damping > 0; });
    with_real(b.plan.precision, [&](auto zero) { add_records<decltype(zero)>(b, m, elements); });
    add_system(b, m, elements, solved);
    add_vectors(b, m);
    const FreeParts parts = free_parts(b.inverse_mass, elements.corners);
    m.part_count = static_cast<std::uint32_t>(parts.start.size() - 1);
    if (m.part_count == 0)
        return;
    m.part_start = b.add_buffer<std::uint32_t>(kImplicitEuler, "free parts, start", parts.start);
    m.part_members = b.add_buffer<std::uint32_t>(kImplicitEuler, "free parts", parts.member);
}

} // namespace taut
