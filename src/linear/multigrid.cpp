// Based on: Briggs, Henson, McCormick. A Multigrid Tutorial, 2nd ed. 2000 (V-cycle); Adams et al. Parallel
//   multigrid smoothing: polynomial versus Gauss-Seidel. JCP 2003 (Chebyshev smoothers).
// Departures: the coarsest system is a product with its dense inverse, since no pass here is sequential.

#include "taut/linear/multigrid.hpp"

#include "taut/kernels/cg_collect.hpp"
#include "taut/kernels/dot.hpp"

#include "taut/linear/reals.hpp"

#include <cmath>

namespace taut::linear {
namespace {

constexpr int kSmootherDegree = 2;
constexpr double kSmootherSpread = 4; ///< the upper quarter of the spectrum: the rest is for coarser levels
constexpr const char* kMultigridLabel = "multigrid";

SparseMatrix negative(SparseMatrix a)
{
    for (double& value : a.value)
        value = -value;
    return a;
}

} // namespace

BufferPtr Multigrid::make_vector(std::uint32_t rows, std::string_view label)
{
    const std::uint64_t bytes = std::uint64_t{rows} * real_bytes(precision_);
    bytes_ += bytes;
    return device_->make_buffer(bytes, label);
}

Multigrid::Multigrid(std::shared_ptr<Device> device, const AggregationHierarchy& hierarchy,
                     std::shared_ptr<const Operator> fine, int exponent)
    : device_(std::move(device)),
      precision_(fine->precision())
{
    const auto upload = [&](const SparseMatrix& a, int by) -> std::shared_ptr<const Operator> {
        auto out = DeviceMatrix::upload(device_, a, {Format::csr, precision_, false, by, true});
        bytes_ += out->bytes();
        return out;
    };
    for (std::size_t k = 0; k + 1 < hierarchy.levels.size(); ++k)
    {
        const AggregationLevel& from = hierarchy.levels[k];
        Level level;
        level.matrix = k == 0 ? fine : upload(from.matrix, exponent);
        level.prolongation = upload(negative(from.prolongation), 0);
        level.restriction = upload(from.restriction, 0);
        std::vector<double> inverse = jacobi_inverse(from.matrix);
        const Interval interval = chebyshev_interval(from.matrix, inverse, kSmootherSpread);
        for (double& value : inverse)
            value = std::ldexp(value, -exponent);
        BufferPtr diagonal = make_vector(from.matrix.rows, "multigrid inverse");
        write_reals(*device_, diagonal, inverse, precision_);
        level.smoother =
            std::make_shared<Chebyshev>(device_, level.matrix, diagonal, interval, kSmootherDegree);
        level.smooth = make_vector(from.matrix.rows, "multigrid smooth");
        level.corrected = make_vector(from.matrix.rows, "multigrid corrected");
        level.rest = make_vector(from.matrix.rows, "multigrid rest");
        if (k > 0)
        {
            level.right = make_vector(from.matrix.rows, "multigrid right");
            level.out = make_vector(from.matrix.rows, "multigrid out");
        }
        levels_.push_back(std::move(level));
    }
    const SparseMatrix& last = hierarchy.levels.back().matrix;
    const SparseMatrix inverse = from_dense(last.rows, last.rows, hierarchy.coarsest_inverse);
    auto dense = DeviceMatrix::upload(device_, inverse, {Format::dense, precision_, false, -exponent, false});
    bytes_ += dense->bytes();
    Level coarsest;
    coarsest.matrix = dense;
    coarsest.right = make_vector(last.rows, "multigrid right");
    coarsest.out = make_vector(last.rows, "multigrid out");
    levels_.push_back(std::move(coarsest));
}

void Multigrid::record_level(Recorder& recorder, const Gate& gate, std::size_t k, Operator::Binding r,
                             Operator::Binding z) const
{
    const Level& level = levels_[k];
    const Operator::Binding none(nullptr);
    if (k + 1 == levels_.size())
        return level.matrix->record_product(recorder, gate, r, z, none);
    const Level& next = levels_[k + 1];
    level.smoother->record(recorder, gate, r, level.smooth, none);
    level.matrix->record_residual(recorder, gate, level.smooth, r, level.rest);
    level.restriction->record_product(recorder, gate, level.rest, next.right, none);
    record_level(recorder, gate, k + 1, next.right, next.out);
    level.prolongation->record_residual(recorder, gate, next.out, level.smooth, level.corrected);
    level.matrix->record_residual(recorder, gate, level.corrected, r, level.rest);
    level.smoother->record(recorder, gate, level.rest, z, none);
    const Grid grid = make_grid(level.matrix->rows(), gate.groups);
    launch(recorder, gate, {"", precision_, kMultigridLabel},
           kernels::cg_collect::Bindings<Recorder::Binding>{.base = z, .x = level.corrected},
           {grid.count, grid.chunk, 1});
}

void Multigrid::record(Recorder& recorder, const Gate& gate, Operator::Binding r, Operator::Binding z,
                       Operator::Binding partials) const
{
    record_level(recorder, gate, 0, r, z);
    const Grid grid = make_grid(levels_.front().matrix->rows(), gate.groups);
    launch(recorder, gate, {"", precision_, kMultigridLabel},
           kernels::dot::Bindings<Recorder::Binding>{.x = r, .y = z, .partials = partials},
           {grid.count, grid.chunk, gate.groups});
}

} // namespace taut::linear
