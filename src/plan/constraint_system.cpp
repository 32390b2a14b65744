// Based on: kernels/constraint/constraint_{spread,product,matrix}.comp, corner_{spread,product,matrix}.comp.
// Departures: none beyond those named there.

#include "taut/plan/constraint_system.hpp"

#include "taut/kernels/constraint_matrix.hpp"
#include "taut/kernels/constraint_product.hpp"
#include "taut/kernels/constraint_spread.hpp"
#include "taut/kernels/corner_matrix.hpp"
#include "taut/kernels/corner_product.hpp"
#include "taut/kernels/corner_spread.hpp"
#include "taut/kernels/shared/corner_address.h"
#include "taut/runtime/base/error.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr std::uint64_t kMostPatternEntries = std::uint64_t(1) << 26;
constexpr const char* kConstraintProduct = "constraint product";

std::uint64_t degree_of(const Incidence& at, std::size_t v) { return at.start[v + 1] - at.start[v]; }

void check_entries(std::uint64_t most, std::size_t rows)
{
    if (most > kMostPatternEntries)
        throw Error(ErrorCode::limit, "the matrix of " + std::to_string(rows) +
                                          " constraints would have about " + std::to_string(most) +
                                          " entries, more than " + std::to_string(kMostPatternEntries) +
                                          "; take method.linear_operator \"matrix_free\"");
}

std::shared_ptr<linear::DeviceMatrix> upload_csr(PlanBuilder& b, const linear::SparseMatrix& pattern)
{
    linear::UploadOptions options;
    options.format = linear::Format::csr;
    options.precision = b.plan.precision;
    options.rewritable = true;
    return linear::DeviceMatrix::upload(b.paper(), pattern, options);
}

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
    if (rows.corners.count > 0)
    {
        corners_ = b.on_paper(rows.corners.records);
        corner_start_ = b.on_paper(rows.corners.start);
        corner_incident_ = b.on_paper(rows.corners.incident);
        gradient_ = b.on_paper(rows.corners.gradient);
    }
    for (const BufferPtr& read : {records_, start_, incident_, direction_, position_, list_, place_,
                                  corners_, corner_start_, corner_incident_, gradient_})
        bytes_ += read ? read->bytes() : 0;
}

void ConstraintOperator::record_spread(Recorder& recorder, const linear::Gate& gate, Binding x) const
{
    // Rows in use have twice as many vertices at most, so that their groups suffice for these too.
    const std::uint32_t chunk = list_ ? 2 * linear::make_grid(rows_.count, gate.groups).chunk
                                      : linear::make_grid(vertices_, gate.groups).chunk;
    launch(recorder, gate, {list_ ? "listed" : "", precision_, kConstraintProduct},
           kernels::constraint_spread::Bindings<Binding>{.start = start_,
                                                         .incident = incident_,
                                                         .direction = direction_,
                                                         .x = x,
                                                         .position = position_,
                                                         .spread = spread_,
                                                         .list = list_,
                                                         .place = place_},
           {vertices_, chunk});
    if (corners_)
        launch(recorder, gate, {"", precision_, kConstraintProduct},
               kernels::corner_spread::Bindings<Binding>{.start = corner_start_,
                                                         .incident = corner_incident_,
                                                         .gradient = gradient_,
                                                         .x = x,
                                                         .position = position_,
                                                         .spread = spread_},
               {vertices_, chunk, rows_.count});
}

void ConstraintOperator::record_rows(Recorder& recorder, const linear::Gate& gate, const Pass& pass) const
{
    record_spread(recorder, gate, pass.x);
    const Recorder::Form form = {pass.variant, precision_, kConstraintProduct};
    const linear::Grid grid = linear::make_grid(rows_.count, gate.groups);
    launch(recorder, gate, form,
           kernels::constraint_product::Bindings<Binding>{.row = records_,
                                                          .direction = direction_,
                                                          .spread = spread_,
                                                          .x = pass.x,
                                                          .y = pass.y,
                                                          .partials = pass.partials,
                                                          .b = pass.b},
           {grid.count, grid.chunk, gate.groups});
    if (!corners_)
        return;
    const linear::Grid share = linear::make_grid(rows_.corners.count, gate.groups);
    launch(recorder, gate, form,
           kernels::corner_product::Bindings<Binding>{.corners = corners_,
                                                      .gradient = gradient_,
                                                      .spread = spread_,
                                                      .x = pass.x,
                                                      .y = pass.y,
                                                      .partials = pass.partials,
                                                      .b = pass.b},
           {share.count, share.chunk, rows_.count, gate.groups});
}

void ConstraintOperator::record_product(Recorder& recorder, const linear::Gate& gate, Binding x, Binding y,
                                        Binding partials) const
{
    record_rows(recorder, gate, {partials.is_set() ? "dot" : "", x, y, partials, {}});
}

void ConstraintOperator::record_residual(Recorder& recorder, const linear::Gate& gate, Binding x, Binding b,
                                         Binding r) const
{
    record_rows(recorder, gate, {"residual", x, r, {}, b});
}

linear::SparseMatrix constraint_pattern(std::span<const StretchElement> rows, const Incidence& at,
                                        std::span<const double> inverse_mass)
{
    std::uint64_t most = 0;
    for (std::size_t v = 0; v + 1 < at.start.size(); ++v)
    {
        const std::uint64_t degree = degree_of(at, v);
        most += inverse_mass[v] > 0 ? degree * degree : 0;
    }
    check_entries(most, rows.size());
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

namespace {

/// A term of the entry in a column.
struct Term
{
    std::uint32_t column, row_address, column_address;
    double weight;
};

/// Terms of a row through one of its vertices.
void append_terms(std::vector<Term>& out, std::uint32_t address, std::uint32_t v, double w,
                  std::uint32_t springs, const Incidence& at, const Incidence& corners_at)
{
    for (std::uint32_t k = at.start[v]; w > 0 && k < at.start[v + 1]; ++k)
        out.push_back({at.entries[k] / 2, address, at.entries[k], w});
    for (std::uint32_t k = corners_at.start[v]; w > 0 && k < corners_at.start[v + 1]; ++k)
    {
        const std::uint32_t entry = corners_at.entries[k];
        out.push_back({springs + entry / 4, address, TAUT_CORNER_ROW | entry, w});
    }
}

void append_row(ConstraintTerms& out, std::vector<Term>& terms)
{
    std::stable_sort(terms.begin(), terms.end(), [](auto& x, auto& y) { return x.column < y.column; });
    for (std::size_t k = 0; k < terms.size(); ++k)
    {
        if (k == 0 || terms[k].column != terms[k - 1].column)
        {
            out.pattern.column.push_back(terms[k].column);
            out.pattern.value.push_back(0);
            out.start.push_back(out.start.back());
        }
        out.address.insert(out.address.end(), {terms[k].row_address, terms[k].column_address});
        out.weight.push_back(terms[k].weight);
        ++out.start.back();
    }
    out.pattern.row_start.push_back(static_cast<std::uint32_t>(out.pattern.column.size()));
}

} // namespace

ConstraintTerms constraint_terms(std::span<const StretchElement> springs, const Incidence& at,
                                 std::span<const std::uint32_t> corners, const Incidence& corners_at,
                                 std::span<const double> inverse_mass)
{
    const auto count = static_cast<std::uint32_t>(springs.size());
    const std::uint32_t rows = count + static_cast<std::uint32_t>(corners.size() / 4);
    std::uint64_t most = 0;
    for (std::size_t v = 0; v + 1 < at.start.size(); ++v)
    {
        const std::uint64_t degree = degree_of(at, v) + degree_of(corners_at, v);
        most += inverse_mass[v] > 0 ? degree * degree : 0;
    }
    check_entries(most, rows);
    ConstraintTerms out;
    out.pattern.rows = out.pattern.columns = rows;
    std::vector<Term> terms;
    for (std::uint32_t r = 0; r < rows; ++r)
    {
        const std::uint32_t address = r < count ? 2 * r : TAUT_CORNER_ROW | 4 * (r - count);
        terms.assign(1, {r, address, address, 0.0}); // the diagonal is there whatever is held
        for (std::uint32_t c = 0; c < (r < count ? 2u : 4u); ++c)
        {
            const std::uint32_t v = r >= count ? corners[4 * (r - count) + c]
                                    : c == 0   ? springs[r].a
                                               : springs[r].b;
            append_terms(terms, address + c, v, inverse_mass[v], count, at, corners_at);
        }
        append_row(out, terms);
    }
    return out;
}

ConstraintMatrix::ConstraintMatrix(PlanBuilder& b, std::string_view effect,
                                   const linear::SparseMatrix& pattern, std::uint32_t direction)
    : effect_(effect),
      direction_(direction)
{
    matrix_ = upload_csr(b, pattern);
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

ConstraintMatrix::ConstraintMatrix(PlanBuilder& b, std::string_view effect, const ConstraintTerms& terms,
                                   std::uint32_t direction, std::uint32_t gradient)
    : effect_(effect),
      direction_(direction),
      gradient_(gradient)
{
    matrix_ = upload_csr(b, terms.pattern);
    const std::vector<std::uint32_t> slots = matrix_->slots(terms.pattern);
    entries_ = static_cast<std::uint32_t>(slots.size());
    terms_ = static_cast<std::uint32_t>(terms.weight.size());
    std::vector<std::uint32_t> entry(entries_), start = {0}, address;
    for (std::uint32_t k = 0; k < entries_; ++k)
        entry[slots[k]] = k;
    with_real(b.plan.precision, [&](auto zero) {
        std::vector<decltype(zero)> weight;
        for (const std::uint32_t k : entry)
        {
            for (std::uint32_t t = terms.start[k]; t < terms.start[k + 1]; ++t)
            {
                address.insert(address.end(), {terms.address[2 * t], terms.address[2 * t + 1]});
                weight.push_back(static_cast<decltype(zero)>(terms.weight[t]));
            }
            start.push_back(static_cast<std::uint32_t>(weight.size()));
        }
        weight_ = b.add_buffer<decltype(zero)>(effect, "constraint weights", weight);
    });
    start_ = b.add_buffer<std::uint32_t>(effect, "constraint terms, start", start);
    pair_ = b.add_buffer<std::uint32_t>(effect, "constraint terms", address);
    values_ = b.adopt(effect, matrix_->values());
}

void ConstraintMatrix::record(PlanBuilder& b) const
{
    if (start_ == kNoBuffer)
    {
        const kernels::constraint_matrix::Bindings<Use> uses = {
            .pair = {pair_, 2}, .weight = {weight_}, .direction = {direction_, 2}, .values = {values_}};
        b.dispatch(effect_, "", uses, {entries_}, entries_);
        return;
    }
    const std::uint32_t each = terms_ / std::max(entries_, 1u) + 1;
    const kernels::corner_matrix::Bindings<Use> uses = {.start = {start_, 2},
                                                        .term = {pair_, 2 * each},
                                                        .weight = {weight_, each},
                                                        .direction = {direction_, each},
                                                        .gradient = {gradient_, each},
                                                        .values = {values_}};
    b.dispatch(effect_, "", uses, {entries_}, entries_);
}

} // namespace taut
