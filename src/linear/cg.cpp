// Based on: kernels/shared/cg_state.glsl (what is decided), kernels/linear/cg_*.comp (what is done).
// Departures: none beyond those named there.

#include "taut/linear/cg.hpp"
#include "taut/linear/cg_state.hpp"
#include "taut/runtime/required.hpp"

#include "taut/kernels/cg_collect.hpp"
#include "taut/kernels/cg_direction.hpp"
#include "taut/kernels/cg_restart.hpp"
#include "taut/kernels/cg_step.hpp"

#include <bit>

namespace taut::linear {
namespace {

/// Iterations between two places where the residual may be formed.
constexpr std::uint32_t kReplacementEvery = 8;
constexpr const char* kCgLabel = "cg";

bool is_diagonal(Preconditioner kind)
{
    return kind == Preconditioner::jacobi || kind == Preconditioner::spai0;
}

bool is_stored(Preconditioner kind)
{
    return kind == Preconditioner::chebyshev || kind == Preconditioner::multigrid;
}

/// `masked`: z is stored, and an inverse of 0 marks the held rows.
std::string_view variant_of(Preconditioner kind, bool masked = false)
{
    if (is_diagonal(kind))
        return "diagonal";
    if (kind == Preconditioner::block_jacobi)
        return "block";
    if (is_stored(kind))
        return masked ? "stored_held" : "stored";
    return "";
}

std::uint32_t word_bytes(std::uint32_t word) { return word * 4; }

void check_preconditioning(const Preconditioning& given, std::uint64_t rows, std::uint64_t real)
{
    const bool block = given.kind == Preconditioner::block_jacobi;
    const std::uint64_t wanted = block ? rows / 3 * 6 * real : rows * real;
    if ((is_diagonal(given.kind) || block) && (!given.inverse || given.inverse->bytes() < wanted))
        throw Error(ErrorCode::bad_input, "the preconditioner " + std::string(to_string(given.kind)) +
                                              " needs an inverse of " + std::to_string(wanted) + " bytes");
    if (is_stored(given.kind) && !given.stored)
        throw Error(ErrorCode::bad_input, "the preconditioner " + std::string(to_string(given.kind)) +
                                              " needs `stored`: the passes that apply it");
}

/// Rows, or block rows, as the passes of conjugate gradients share them.
Grid grid_of(const Operator& op, Preconditioner kind, std::uint32_t groups)
{
    return make_grid(kind == Preconditioner::block_jacobi ? op.rows() / 3 : op.rows(), groups);
}

} // namespace

ConjugateGradient::ConjugateGradient(std::shared_ptr<Device> device, std::shared_ptr<const Operator> op,
                                     Preconditioning preconditioning, bool pairs)
    : device_(required(std::move(device), "a ConjugateGradient")),
      operator_(std::move(op)),
      preconditioning_(std::move(preconditioning)),
      pairs_(pairs),
      precision_(operator_->precision()),
      groups_(group_count_for(operator_->rows(), device_->info()))
{
    check_row_count(operator_->rows());
    always_ = {groups_, nullptr, 0};
    if (pairs_ && precision_ != Precision::float32)
        throw Error(ErrorCode::bad_input, "pairs are made of floats: take an operator in float");
    if (preconditioning_.kind == Preconditioner::block_jacobi && operator_->rows() % 3 != 0)
        throw Error(ErrorCode::bad_input, "block_jacobi needs a multiple of 3 rows, but there are " +
                                              std::to_string(operator_->rows()) + ": take jacobi");
    if (operator_->recomputes() && preconditioning_.kind != Preconditioner::none)
        throw Error(ErrorCode::unsupported,
                    "an operator that recomputes its product takes no preconditioner");
    const std::uint64_t real = real_bytes(precision_);
    const std::uint64_t rows = operator_->rows();
    check_preconditioning(preconditioning_, rows, real);
    const std::uint64_t state = real == 4 ? sizeof(layout::CgState<float>) : sizeof(layout::CgState<double>);
    const auto vector = [&](std::string_view label) { return device_->make_buffer(rows * real, label); };
    b_ = device_->make_buffer(rows * real * (pairs_ ? 2 : 1), "cg b");
    base_ = device_->make_buffer(rows * real * (pairs_ ? 2 : 1), "cg solution");
    x_ = vector("cg x");
    r_ = vector("cg r");
    p_ = vector("cg p");
    if (!operator_->recomputes())
        q_ = vector("cg q");
    if (is_stored(preconditioning_.kind))
        z_ = vector("cg z");
    partials_ = device_->make_buffer(3 * groups_ * real, "cg partials");
    curvatures_ = device_->make_buffer(groups_ * real, "cg curvatures");
    settings_ = device_->make_buffer(state, "cg settings", BufferUse::host_written);
    decided_ = device_->make_buffer(state, "cg decided");
    measured_ = device_->make_buffer(state, "cg measured");
    control_ = device_->make_buffer(word_bytes(TAUT_CONTROL_HISTORY + kHistory), "cg control");
    set({});
}

void ConjugateGradient::set(const CgSettings& settings)
{
    check_settings(settings);
    if (precision_ == Precision::float32)
        device_->write<layout::CgState<float>>(settings_, std::vector{first_state<float>(settings)});
    else
        device_->write<layout::CgState<double>>(settings_, std::vector{first_state<double>(settings)});
}

void ConjugateGradient::use_part(BufferPtr control, std::uint64_t offset)
{
    always_ = {groups_, std::move(control), offset};
}

void ConjugateGradient::record_restart(Recorder& recorder, const Gate& gate, bool begin)
{
    const Grid grid = grid_of(*operator_, preconditioning_.kind, groups_);
    launch(recorder, gate,
           {variant_of(preconditioning_.kind, preconditioning_.inverse != nullptr), precision_, kCgLabel},
           kernels::cg_restart::Bindings<Recorder::Binding>{.residual = r_,
                                                            .b = begin ? b_ : r_,
                                                            .partials = partials_,
                                                            .before = begin ? settings_ : decided_,
                                                            .after = measured_,
                                                            .control = control_,
                                                            .inverse = preconditioning_.inverse},
           {grid.count, grid.chunk, groups_, begin ? 1u : 0u, pairs_ ? 2u : 1u});
    record_preconditioner(recorder, gate);
}

void ConjugateGradient::record_residual(Recorder& recorder, const Gate& gate)
{
    if (pairs_)
        operator_->record_residual_pairs(recorder, gate, base_, b_, r_);
    else
        operator_->record_residual(recorder, gate, base_, b_, r_);
}

void ConjugateGradient::record_preconditioner(Recorder& recorder, const Gate& gate)
{
    if (is_stored(preconditioning_.kind))
        preconditioning_.stored->record(recorder, gate, r_, z_,
                                        {partials_, 0, groups_ * real_bytes(precision_)});
}

void ConjugateGradient::record_begin(Recorder& recorder)
{
    record_collect(recorder, always_, false);
    record_residual(recorder, always_);
    record_restart(recorder, always_, true);
}

void ConjugateGradient::record_iterations(Recorder& recorder, std::uint32_t count)
{
    for (std::uint32_t k = 0; k < count; ++k)
    {
        record_iteration(recorder);
        if ((k + 1) % kReplacementEvery == 0 || k + 1 == count)
            record_replacement(recorder);
    }
}

void ConjugateGradient::record_direction(Recorder& recorder, bool last)
{
    const Gate gate{groups_, control_, word_bytes(TAUT_CONTROL_ITERATE)};
    const Grid grid = grid_of(*operator_, preconditioning_.kind, groups_);
    const bool stored = is_stored(preconditioning_.kind);
    launch(recorder, gate, {variant_of(preconditioning_.kind), precision_, kCgLabel},
           kernels::cg_direction::Bindings<Recorder::Binding>{.residual = stored ? z_ : r_,
                                                              .direction = p_,
                                                              .x = x_,
                                                              .partials = partials_,
                                                              .before = measured_,
                                                              .after = decided_,
                                                              .control = control_,
                                                              .inverse = stored ? nullptr
                                                                                : preconditioning_.inverse},
           {grid.count, grid.chunk, groups_, kHistory, last ? 1u : 0u});
}

void ConjugateGradient::record_iteration(Recorder& recorder)
{
    record_direction(recorder, false);
    const Gate gate{groups_, control_, word_bytes(TAUT_CONTROL_ITERATE)};
    const Grid grid = grid_of(*operator_, preconditioning_.kind, groups_);
    if (operator_->recomputes())
    {
        operator_->record_product(recorder, gate, p_, {}, curvatures_);
        operator_->record_step(recorder, gate,
                               {.direction = p_,
                                .residual = r_,
                                .curvatures = curvatures_,
                                .partials = partials_,
                                .before = decided_,
                                .after = measured_});
        return;
    }
    operator_->record_product(recorder, gate, p_, q_, curvatures_);
    launch(recorder, gate,
           {variant_of(preconditioning_.kind, preconditioning_.inverse != nullptr), precision_, kCgLabel},
           kernels::cg_step::Bindings<Recorder::Binding>{.residual = r_,
                                                         .product = q_,
                                                         .curvatures = curvatures_,
                                                         .partials = partials_,
                                                         .before = decided_,
                                                         .after = measured_,
                                                         .inverse = preconditioning_.inverse},
           {grid.count, grid.chunk, groups_});
    record_preconditioner(recorder, gate);
}

void ConjugateGradient::record_replacement(Recorder& recorder)
{
    const Gate gate{groups_, control_, word_bytes(TAUT_CONTROL_REPLACE)};
    record_collect(recorder, gate, true);
    record_residual(recorder, gate);
    record_restart(recorder, gate, false);
}

void ConjugateGradient::record_end(Recorder& recorder)
{
    record_direction(recorder, true); // takes the last step, and may ask for the residual
    record_replacement(recorder);
    record_direction(recorder, true); // says how it ended
    record_collect(recorder, always_, true);
}

/// base += x where `add`, and x = 0.
void ConjugateGradient::record_collect(Recorder& recorder, const Gate& gate, bool add)
{
    const Grid grid = make_grid(operator_->rows(), groups_);
    launch(recorder, gate, {pairs_ ? "pair" : "", precision_, kCgLabel},
           kernels::cg_collect::Bindings<Recorder::Binding>{.base = base_, .x = x_},
           {grid.count, grid.chunk, add ? 1u : 0u});
}

CgOutcome ConjugateGradient::outcome()
{
    if (precision_ == Precision::float32)
        return outcome_of(device_->read<layout::CgState<float>>(decided_, 1).front());
    return outcome_of(device_->read<layout::CgState<double>>(decided_, 1).front());
}

std::vector<float> ConjugateGradient::history(std::uint32_t first, std::uint32_t last)
{
    const auto words = device_->read<std::uint32_t>(control_, kHistory, word_bytes(TAUT_CONTROL_HISTORY));
    std::vector<float> out;
    for (std::uint32_t k = first; k <= last; ++k)
        out.push_back(std::bit_cast<float>(words[k % kHistory]));
    return out;
}

std::uint64_t ConjugateGradient::bytes() const
{
    std::uint64_t sum = preconditioning_.inverse ? preconditioning_.inverse->bytes() : 0;
    sum += preconditioning_.stored ? preconditioning_.stored->bytes() : 0;
    for (const BufferPtr* buffer : {&b_, &base_, &x_, &r_, &p_, &q_, &z_, &partials_, &curvatures_,
                                    &settings_, &decided_, &measured_, &control_})
        sum += *buffer ? (*buffer)->bytes() : 0;
    return sum;
}

} // namespace taut::linear
