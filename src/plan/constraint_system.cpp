// Based on: kernels/constraint/constraint_spread.comp, constraint_product.comp, constraint_matrix.comp.
// Departures: none beyond those named there.

#include "taut/plan/constraint_system.hpp"

#include "taut/kernels/constraint_matrix.hpp"
#include "taut/kernels/constraint_product.hpp"
#include "taut/kernels/constraint_spread.hpp"
#include "taut/kernels/volume_product.hpp"
#include "taut/kernels/volume_spread.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr std::uint64_t kMostPatternEntries = std::uint64_t(1) << 26;
constexpr const char* kLabel = "constraint product";

} // namespace

ConstraintOperator::ConstraintOperator(PlanBuilder& b, const ConstraintRows& rows)
    : rows_(rows),
      precision_(b.plan.precision),
      vertices_(b.plan.vertex_count)
{
    records_ = b.on_paper(rows.records);
    start_ = b.on_paper(rows.start);
    incident_ = b.on_paper(rows.incident);
    direction_ = b.on_paper(rows.direction);
    position_ = b.on_paper(b.plan.position);
    spread_ = b.on_paper(rows.spread);
    if (rows.list != kNoBuffer)
    {
        list_ = b.on_paper(rows.list);
        place_ = b.on_paper(rows.place);
    }
    if (rows.volumes.count > 0)
    {
        tetrahedra_ = b.on_paper(rows.volumes.records);
        volume_start_ = b.on_paper(rows.volumes.start);
        volume_incident_ = b.on_paper(rows.volumes.incident);
        gradient_ = b.on_paper(rows.volumes.gradient);
    }
    for (const BufferPtr& read : {records_, start_, incident_, direction_, position_, list_, place_,
                                  tetrahedra_, volume_start_, volume_incident_, gradient_})
        bytes_ += read ? read->bytes() : 0;
}

void ConstraintOperator::record_spread(Recorder& recorder, const linear::Gate& gate, Binding x) const
{
    // Rows in use have twice as many vertices at most, so that their groups suffice for these too.
    const std::uint32_t chunk = list_ ? 2 * linear::make_grid(rows_.count, gate.groups).chunk
                                      : linear::make_grid(vertices_, gate.groups).chunk;
    std::vector<Binding> bindings = {start_, incident_, direction_, x, position_, spread_};
    if (list_)
        bindings.insert(bindings.end(), {list_, place_});
    launch(recorder, gate, kernels::constraint_spread::info(list_ ? "listed" : "", precision_),
           std::move(bindings), kernels::constraint_spread::Params{vertices_, chunk}, kLabel);
    if (tetrahedra_)
        launch(recorder, gate, kernels::volume_spread::info("", precision_),
               {volume_start_, volume_incident_, gradient_, std::move(x), position_, spread_},
               kernels::volume_spread::Params{vertices_, chunk, rows_.count}, kLabel);
}

void ConstraintOperator::record_volumes(Recorder& recorder, const linear::Gate& gate,
                                        std::string_view variant, std::vector<Binding> bindings) const
{
    if (!tetrahedra_)
        return;
    const linear::Grid grid = linear::make_grid(rows_.volumes.count, gate.groups);
    launch(recorder, gate, kernels::volume_product::info(variant, precision_), std::move(bindings),
           kernels::volume_product::Params{grid.count, grid.chunk, rows_.count, gate.groups}, kLabel);
}

void ConstraintOperator::record_product(Recorder& recorder, const linear::Gate& gate, Binding x, Binding y,
                                        Binding partials) const
{
    record_spread(recorder, gate, x);
    const linear::Grid grid = linear::make_grid(rows_.count, gate.groups);
    std::vector<Binding> bindings = {records_, direction_, spread_, x, y};
    std::vector<Binding> volumes = {tetrahedra_, gradient_, spread_, std::move(x), std::move(y)};
    const bool dot = partials.buffer != nullptr;
    if (dot)
    {
        bindings.push_back(partials);
        volumes.push_back(std::move(partials));
    }
    launch(recorder, gate, kernels::constraint_product::info(dot ? "dot" : "", precision_),
           std::move(bindings), kernels::constraint_product::Params{grid.count, grid.chunk, gate.groups},
           kLabel);
    record_volumes(recorder, gate, dot ? "dot" : "", std::move(volumes));
}

void ConstraintOperator::record_residual(Recorder& recorder, const linear::Gate& gate, Binding x, Binding b,
                                         Binding r) const
{
    record_spread(recorder, gate, x);
    const linear::Grid grid = linear::make_grid(rows_.count, gate.groups);
    launch(recorder, gate, kernels::constraint_product::info("residual", precision_),
           {records_, direction_, spread_, x, r, b},
           kernels::constraint_product::Params{grid.count, grid.chunk, gate.groups}, kLabel);
    record_volumes(recorder, gate, "residual",
                   {tetrahedra_, gradient_, spread_, std::move(x), std::move(r), std::move(b)});
}

linear::SparseMatrix constraint_pattern(std::span<const StretchElement> rows, const Incidence& at,
                                        std::span<const double> inverse_mass)
{
    std::uint64_t most = 0;
    for (std::size_t v = 0; v + 1 < at.start.size(); ++v)
    {
        const std::uint64_t degree = at.start[v + 1] - at.start[v];
        most += inverse_mass[v] > 0 ? degree * degree : 0;
    }
    if (most > kMostPatternEntries)
        throw Error(ErrorCode::limit, "the matrix of " + std::to_string(rows.size()) +
                                          " constraints would have about " + std::to_string(most) +
                                          " entries, more than " + std::to_string(kMostPatternEntries) +
                                          "; take method.linear_operator \"matrix_free\"");
    linear::SparseMatrix out;
    out.rows = out.columns = static_cast<std::uint32_t>(rows.size());
    std::vector<std::pair<std::uint32_t, double>> row;
    for (std::uint32_t r = 0; r < out.rows; ++r)
    {
        row.assign(1, {r, 0.0}); // the diagonal is there whatever is held
        for (std::uint32_t end = 0; end < 2; ++end)
        {
            const std::uint32_t v = end == 0 ? rows[r].a : rows[r].b;
            for (std::uint32_t k = at.start[v]; inverse_mass[v] > 0 && k < at.start[v + 1]; ++k)
                row.emplace_back(at.entries[k] / 2,
                                 at.entries[k] % 2 == end ? inverse_mass[v] : -inverse_mass[v]);
        }
        std::stable_sort(row.begin(), row.end(), [](auto& x, auto& y) { return x.first < y.first; });
        for (std::size_t k = 0; k < row.size(); ++k)
            if (k > 0 && row[k].first == row[k - 1].first)
                out.value.back() += row[k].second;
            else
            {
                out.column.push_back(row[k].first);
                out.value.push_back(row[k].second);
            }
        out.row_start.push_back(static_cast<std::uint32_t>(out.column.size()));
    }
    return out;
}

ConstraintMatrix::ConstraintMatrix(PlanBuilder& b, std::string_view effect,
                                   const linear::SparseMatrix& pattern, std::uint32_t direction)
    : effect_(effect),
      direction_(direction)
{
    linear::UploadOptions options;
    options.format = linear::Format::csr;
    options.precision = b.plan.precision;
    options.rewritable = true;
    matrix_ = linear::DeviceMatrix::upload(b.paper(), pattern, options);
    // The tables follow the order of the stored values, so that a pass writes memory as it lies.
    const std::vector<std::uint32_t> slots = matrix_->slots(pattern);
    entries_ = static_cast<std::uint32_t>(slots.size());
    std::vector<std::uint32_t> pair(2 * slots.size());
    with_real(b.plan.precision, [&](auto zero) {
        std::vector<decltype(zero)> weight(slots.size());
        for (std::uint32_t r = 0; r < pattern.rows; ++r)
            for (std::uint32_t k = pattern.row_start[r]; k < pattern.row_start[r + 1]; ++k)
            {
                pair[2 * slots[k]] = r;
                pair[2 * slots[k] + 1] = pattern.column[k];
                weight[slots[k]] = static_cast<decltype(zero)>(pattern.value[k]);
            }
        weight_ = b.add_buffer<decltype(zero)>(effect, "constraint weights", weight);
    });
    pair_ = b.add_buffer<std::uint32_t>(effect, "constraint pairs", pair);
    values_ = b.adopt(effect, matrix_->values());
}

void ConstraintMatrix::record(PlanBuilder& b) const
{
    const Use uses[] = {{pair_, 2}, {weight_}, {direction_, 2}, {values_}};
    b.dispatch(effect_, "constraint_matrix", "", uses, kernels::constraint_matrix::Params{entries_},
               entries_);
}

} // namespace taut
