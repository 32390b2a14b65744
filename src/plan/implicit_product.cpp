// Based on: kernels/implicit/implicit_product.comp, implicit_euler_product.comp, implicit_solid_product.comp.
// Departures: none.

#include "taut/plan/implicit_product.hpp"

#include "taut/kernels/implicit_euler_product_hinge.hpp"
#include "taut/kernels/implicit_product.hpp"
#include "taut/kernels/implicit_solid_product.hpp"

namespace taut {
namespace {

constexpr const char* kImplicitProduct = "implicit product";

} // namespace

void ImplicitProduct::record_springs(Recorder& recorder, const linear::Gate& gate, const Pass& pass) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    linear::launch(recorder, gate, {pass.variant, at_.precision, kImplicitProduct},
                   kernels::implicit_product::Bindings<Binding>{.position = at_.position,
                                                                .delta = at_.delta,
                                                                .spring = at_.springs,
                                                                .table = at_.spring_table,
                                                                .step_values = at_.step_values,
                                                                .x = pass.x,
                                                                .y = pass.y,
                                                                .partials = pass.partials,
                                                                .b = pass.b},
                   {grid.count, grid.chunk, gate.groups, at_.scale});
}

void ImplicitProduct::record_kind(Recorder& recorder, const linear::Gate& gate,
                                  const ImplicitKindBuffers& kind, const Pass& pass) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    linear::launch(recorder, gate, {pass.variant, at_.precision, kImplicitProduct, kind.kernel},
                   kernels::implicit_euler_product_hinge::Bindings<Binding>{.position = at_.position,
                                                                            .delta = at_.delta,
                                                                            .constraint = kind.records,
                                                                            .table = kind.table,
                                                                            .step_values = at_.step_values,
                                                                            .x = pass.x,
                                                                            .y = pass.y,
                                                                            .partials = pass.partials},
                   {grid.count, grid.chunk, gate.groups, at_.scale});
}

void ImplicitProduct::record_solids(Recorder& recorder, const linear::Gate& gate, const Pass& pass) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    linear::launch(recorder, gate, {pass.variant, at_.precision, kImplicitProduct},
                   kernels::implicit_solid_product::Bindings<Binding>{.solid = at_.solids,
                                                                      .state = at_.solid_state,
                                                                      .table = at_.solid_table,
                                                                      .x = pass.x,
                                                                      .y = pass.y,
                                                                      .partials = pass.partials},
                   {grid.count, grid.chunk, gate.groups});
}

/// The last pass takes the partial sums, of y as it is then.
void ImplicitProduct::record_product(Recorder& recorder, const linear::Gate& gate, Binding x, Binding y,
                                     Binding partials) const
{
    const Pass plain = {"", x, y, {}, {}};
    const Pass last = {partials.is_set() ? "dot" : "", x, y, partials, {}};
    record_springs(recorder, gate, at_.kinds.empty() && !at_.solids ? last : plain);
    for (const ImplicitKindBuffers& kind : at_.kinds)
        record_kind(recorder, gate, kind, &kind == &at_.kinds.back() && !at_.solids ? last : plain);
    if (at_.solids)
        record_solids(recorder, gate, last);
}

/// The first pass takes b, the others go on from its residual.
void ImplicitProduct::record_residual(Recorder& recorder, const linear::Gate& gate, Binding x, Binding b,
                                      Binding r) const
{
    record_springs(recorder, gate, {"residual", x, r, {}, b});
    for (const ImplicitKindBuffers& kind : at_.kinds)
        record_kind(recorder, gate, kind, {"residual", x, r, {}, {}});
    if (at_.solids)
        record_solids(recorder, gate, {"residual", x, r, {}, {}});
}

} // namespace taut
