// Based on: kernels/linear/stencil7.comp.
// Departures: none.

#include "taut/linear/stencil.hpp"

#include "taut/kernels/stencil7.hpp"

namespace taut::linear {

Stencil7::Stencil7(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, Precision precision, double scale)
    : nx_(nx),
      ny_(ny),
      nz_(nz),
      precision_(precision),
      scale_(static_cast<float>(scale))
{
    const std::string sizes = "a 7-point stencil on " + std::to_string(nx) + " x " + std::to_string(ny) +
                              " x " + std::to_string(nz) + " unknowns";
    if (nx == 0 || ny == 0 || nz == 0)
        throw Error(ErrorCode::bad_input, sizes + " has none: every size must be 1 or more");
    constexpr std::uint64_t most = (std::uint64_t{1} << 31) - 1;
    if (std::uint64_t{nx} * ny > most || std::uint64_t{nx} * ny * nz > most)
        throw Error(ErrorCode::limit, sizes + ": at most " + std::to_string(most) + " can be numbered");
    if (!(scale > 0) || static_cast<double>(scale_) != scale)
        throw Error(ErrorCode::bad_input, "the scale of a 7-point stencil is " + std::to_string(scale) +
                                              ": a positive number is wanted that float holds exactly, a "
                                              "power of two for one");
}

void Stencil7::record(Recorder& recorder, const Gate& gate, std::string_view variant,
                      const kernels::stencil7::Bindings<Binding>& bindings) const
{
    const Grid grid = make_grid(rows(), gate.groups);
    launch(recorder, gate, {variant, precision_, "stencil7"}, bindings,
           {nx_, ny_, nz_, grid.chunk, gate.groups, scale_});
}

void Stencil7::record_product(Recorder& recorder, const Gate& gate, Binding x, Binding y,
                              Binding partials) const
{
    const std::string_view variant = !y.is_set() ? "curvature" : partials.is_set() ? "dot" : "";
    record(recorder, gate, variant, {.x = x, .y = y, .partials = partials});
}

void Stencil7::record_residual(Recorder& recorder, const Gate& gate, Binding x, Binding b, Binding r) const
{
    record(recorder, gate, "residual", {.x = x, .y = r, .b = b});
}

void Stencil7::record_residual_pairs(Recorder& recorder, const Gate& gate, Binding x, Binding b,
                                     Binding r) const
{
    if (precision_ != Precision::float32)
        return Operator::record_residual_pairs(recorder, gate, x, b, r);
    record(recorder, gate, "residual_pairs", {.x = x, .y = r, .b = b});
}

void Stencil7::record_step(Recorder& recorder, const Gate& gate, const StepBuffers& at) const
{
    record(recorder, gate, "step",
           {.x = at.direction,
            .partials = at.partials,
            .residual = at.residual,
            .curvatures = at.curvatures,
            .before = at.before,
            .after = at.after});
}

} // namespace taut::linear
