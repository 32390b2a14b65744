// Based on: kernels/implicit/implicit_product.comp, implicit_hinge_product.comp, implicit_solid_product.comp.
// Departures: none.

#include "taut/plan/implicit_product.hpp"

#include "taut/kernels/implicit_hinge_product.hpp"
#include "taut/kernels/implicit_product.hpp"
#include "taut/kernels/implicit_solid_product.hpp"

namespace taut {
namespace {

constexpr const char* kLabel = "implicit product";

} // namespace

void ImplicitProduct::record_springs(Recorder& recorder, const linear::Gate& gate, std::string_view variant,
                                     Binding x, Binding y, Binding last) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    std::vector<Binding> bindings = {
        at_.position, at_.delta, at_.springs, at_.spring_table, at_.step_values, x, y};
    if (!variant.empty())
        bindings.push_back(std::move(last));
    linear::launch(recorder, gate, kernels::implicit_product::info(variant, at_.precision),
                   std::move(bindings),
                   kernels::implicit_product::Params{grid.count, grid.chunk, gate.groups, at_.scale}, kLabel);
}

void ImplicitProduct::record_hinges(Recorder& recorder, const linear::Gate& gate, std::string_view variant,
                                    Binding x, Binding y, Binding last) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    std::vector<Binding> bindings = {at_.position,    at_.delta, at_.hinges, at_.hinge_table,
                                     at_.step_values, x,         y};
    if (variant == "dot")
        bindings.push_back(std::move(last));
    linear::launch(
        recorder, gate, kernels::implicit_hinge_product::info(variant, at_.precision), std::move(bindings),
        kernels::implicit_hinge_product::Params{grid.count, grid.chunk, gate.groups, at_.scale}, kLabel);
}

void ImplicitProduct::record_solids(Recorder& recorder, const linear::Gate& gate, std::string_view variant,
                                    Binding x, Binding y, Binding last) const
{
    const linear::Grid grid = linear::make_grid(at_.vertices, gate.groups);
    std::vector<Binding> bindings = {at_.solids, at_.solid_state, at_.solid_table, x, y};
    if (variant == "dot")
        bindings.push_back(std::move(last));
    linear::launch(recorder, gate, kernels::implicit_solid_product::info(variant, at_.precision),
                   std::move(bindings),
                   kernels::implicit_solid_product::Params{grid.count, grid.chunk, gate.groups}, kLabel);
}

/// The last pass takes the partial sums, of y as it is then.
void ImplicitProduct::record_product(Recorder& recorder, const linear::Gate& gate, Binding x, Binding y,
                                     Binding partials) const
{
    const std::string_view variant = partials.buffer ? "dot" : "";
    record_springs(recorder, gate, at_.hinges || at_.solids ? "" : variant, x, y, partials);
    if (at_.hinges)
        record_hinges(recorder, gate, at_.solids ? "" : variant, x, y, partials);
    if (at_.solids)
        record_solids(recorder, gate, variant, x, y, partials);
}

void ImplicitProduct::record_residual(Recorder& recorder, const linear::Gate& gate, Binding x, Binding b,
                                      Binding r) const
{
    record_springs(recorder, gate, "residual", x, r, b);
    if (at_.hinges)
        record_hinges(recorder, gate, "residual", x, r, b);
    if (at_.solids)
        record_solids(recorder, gate, "residual", x, r, b);
}

} // namespace taut
