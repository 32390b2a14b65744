// Plates: the rest angles of hinges follow the turns within triangles.
//
// Based on: kernels/plate/plate_turn.comp, plate_rest.comp; src/plan/plate_hinges.cpp.
// Departures: none beyond those named there.

#include "taut/plan/plate.hpp"

#include "taut/kernels/plate_rest.hpp"
#include "taut/kernels/plate_turn.hpp"
#include "taut/plan/constraints.hpp"
#include "taut/plan/plate_hinges.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/kernels/shared/plate_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace taut {
namespace {

constexpr const char* kPlate = "plate";
using Hinge4 = std::array<std::uint32_t, 4>;

/// Of all bodies, in plan vertices; neighbours are numbered over all.
std::vector<PlateHinge> all_plate_hinges(const PlanBuilder& b)
{
    std::vector<PlateHinge> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        if (!is_plate(b.scene.bodies[body]))
            continue;
        const auto first = static_cast<std::uint32_t>(2 * out.size());
        for (PlateHinge h : plate_hinges(b.scene.bodies[body]))
        {
            for (std::uint32_t* v : {&h.element.edge0, &h.element.edge1, &h.element.wing0, &h.element.wing1})
                *v = b.vertex(body, *v);
            for (std::uint32_t& n : h.neighbour)
                n += first;
            out.push_back(h);
        }
    }
    return out;
}

/// Where the method keeps each hinge, by its corners.
template <typename Real>
std::map<Hinge4, std::uint32_t> places(const PlanBuilder& b, std::uint32_t buffer)
{
    using Record = layout::BendingConstraint<Real>;
    const std::vector<std::byte>& bytes = b.plan.buffers[buffer].initial;
    std::map<Hinge4, std::uint32_t> out;
    for (std::uint32_t k = 0; k < bytes.size() / sizeof(Record); ++k)
    {
        Record r;
        std::memcpy(&r, bytes.data() + k * sizeof(Record), sizeof(Record));
        out.emplace(Hinge4{r.edge0, r.edge1, r.wing0, r.wing1}, k);
    }
    return out;
}

template <typename Real>
void append_rule(std::vector<Real>& out, const PlateHinge& h)
{
    out.push_back(static_cast<Real>(h.element.rest_angle));
    out.push_back(static_cast<Real>(h.share));
    for (const auto& side : h.pull)
        for (const double factor : side)
            out.push_back(static_cast<Real>(factor));
}

template <typename Real>
void add_buffers(PlanBuilder& b, PlateBuffers& p, const std::vector<PlateHinge>& hinges)
{
    const auto at = places<Real>(b, p.hinges);
    std::vector<std::uint32_t> record, neighbour;
    std::vector<Real> rule;
    for (const PlateHinge& h : hinges)
    {
        const BendElement& e = h.element;
        record.push_back(at.at({e.edge0, e.edge1, e.wing0, e.wing1}));
        neighbour.insert(neighbour.end(), h.neighbour.begin(), h.neighbour.end());
        append_rule(rule, h);
    }
    p.record = b.add_buffer<std::uint32_t>(kPlate, "hinges of plates", record);
    p.neighbour = b.add_buffer<std::uint32_t>(kPlate, "other edges of their triangles", neighbour);
    p.rule = b.add_buffer<Real>(kPlate, "factors of turns", rule);
}

} // namespace

bool wants_plate(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), is_plate);
}

void check_plate(const Scene& scene, Refusals& out)
{
    const bool tears = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.material.tear_strain > 0; });
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        if (!is_plate(body))
            return;
        const auto refuse = [k](ErrorCode code, const std::string& why) {
            throw Error(code,
                        "bodies[" + std::to_string(k) + "].material.bending_model is \"plate\", but " + why);
        };
        if (scene.method.type != MethodKind::xpbd)
            refuse(ErrorCode::unsupported, "method " + quoted(scene.method.type) +
                                               " has hinges alone; set it to \"hinge\", or take xpbd");
        if (tears)
            refuse(ErrorCode::unsupported,
                   "a body of the scene can tear, and a tear plans the scene anew and "
                   "would forget the turns; set tear_strain to 0, or the model to "
                   "\"hinge\"");
        if (std::isinf(body.material.bending_stiffness))
            refuse(ErrorCode::unsupported, "bending_stiffness is infinite; give a finite one");
        try
        {
            plate_hinges(body);
        }
        catch (const Error& error)
        {
            refuse(error.code(), error.what());
        }
    });
}

void prepare_plate(PlanBuilder& b)
{
    b.plate = std::make_shared<PlateBuffers>();
    PlateBuffers& p = *b.plate;
    const std::vector<PlateHinge> hinges = all_plate_hinges(b);
    const ConstraintSet* set = find_set(b.plan, "bending");
    if (hinges.empty() || set == nullptr)
        return;
    p.hinges = set->buffer;
    p.multipliers = set->multipliers;
    p.count = static_cast<std::uint32_t>(hinges.size());
    with_real(b.plan.precision, [&](auto zero) { add_buffers<decltype(zero)>(b, p, hinges); });
    const std::uint64_t bytes = std::uint64_t(p.count) * 2 * b.real_size();
    p.pull = b.add_buffer(kPlate, "where sides would go", bytes);
    p.turn = b.add_buffer(kPlate, "turns of sides", bytes);
    b.plan.kept.insert(b.plan.kept.end(), {p.hinges, p.pull});
}

void record_plate(PlanBuilder& b, const Moment&)
{
    const PlateBuffers& p = *b.plate;
    if (p.count == 0)
        return;
    const kernels::plate_turn::Bindings<Use> turn = {.record = {p.record},
                                                     .hinge = {p.hinges},
                                                     .multiplier = {p.multipliers},
                                                     .step_values = {b.plan.step_values, 0},
                                                     .rule = {p.rule, 1},
                                                     .pull = {p.pull, 2},
                                                     .turn = {p.turn, 2}};
    b.dispatch(kPlate, "", turn, {p.count}, p.count);
    const kernels::plate_rest::Bindings<Use> rest = {.record = {p.record},
                                                     .neighbour = {p.neighbour, 4},
                                                     .rule = {p.rule, 7},
                                                     .turn = {p.turn, 6},
                                                     .pull = {p.pull, 2},
                                                     .hinge = {p.hinges}};
    b.dispatch(kPlate, "", rest, {p.count}, p.count);
}

} // namespace taut
