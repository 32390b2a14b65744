// Based on:
//   Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM 1987
//   (the coarse space).
//   Toselli, Widlund. Domain Decomposition Methods. 2005, chapter 3 (both levels added up).
// Departures: the coarse system is a product with its dense inverse, since no pass here is sequential; its
//   diagonal is raised by 2^-14, which keeps every pivot of the inversion above its rounding (a Schur
//   complement of A + S is at least S).

#include "taut/linear/two_level.hpp"

#include "taut/linear/partition.hpp"

#include "taut/kernels/coarse_correct.hpp"
#include "taut/kernels/coarse_matrix.hpp"
#include "taut/kernels/coarse_pivot.hpp"
#include "taut/kernels/coarse_restrict.hpp"
#include "taut/kernels/spmv_dense.hpp"

#include <algorithm>
#include <string>

namespace taut::linear {
namespace {

constexpr const char* kTwoLevelLabel = "two levels";

BufferPtr upload(Device& device, const std::vector<std::uint32_t>& words, std::string_view label)
{
    BufferPtr buffer = device.make_buffer(std::max<std::size_t>(words.size(), 1) * 4, label);
    device.write<std::uint32_t>(buffer, words);
    return buffer;
}

std::uint32_t count_of(std::span<const std::uint32_t> aggregate)
{
    std::uint32_t count = 0;
    for (const std::uint32_t a : aggregate)
        if (a != kNoPart)
            count = std::max(count, a + 1);
    return count;
}

/// As coarse_restrict.comp reads it.
std::vector<std::uint32_t> members_of(std::span<const std::uint32_t> aggregate, std::uint32_t count)
{
    std::vector<std::vector<std::uint32_t>> members(count);
    for (std::uint32_t v = 0; v < aggregate.size(); ++v)
        if (aggregate[v] != kNoPart)
            members[aggregate[v]].push_back(v);
    std::vector<std::uint32_t> table;
    std::uint32_t begin = count + 1;
    for (const auto& list : members)
    {
        table.push_back(begin);
        begin += static_cast<std::uint32_t>(list.size());
    }
    table.push_back(begin);
    for (const auto& list : members)
        table.insert(table.end(), list.begin(), list.end());
    return table;
}

/// As coarse_matrix.comp reads them.
struct Pairs
{
    std::vector<std::uint32_t> pairs, blocks;
    std::uint32_t longest = 0; ///< blocks of a pair
};

Pairs pairs_of(const SparseMatrix& pattern, std::span<const std::uint32_t> slots,
               std::span<const std::uint32_t> aggregate, std::uint32_t count)
{
    std::vector<std::vector<std::uint32_t>> lists(std::size_t{count} * count);
    for (std::uint32_t v = 0; v < aggregate.size(); ++v)
        for (std::uint32_t k = pattern.row_start[3 * v]; k < pattern.row_start[3 * v + 1]; ++k)
        {
            const std::uint32_t a = aggregate[v], b = aggregate[pattern.column[k] / 3];
            if (a != kNoPart && b != kNoPart && a <= b && pattern.column[k] % 3 == 0)
                lists[std::size_t{a} * count + b].push_back(slots[k]);
        }
    Pairs out;
    for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = a; b < count; ++b)
        {
            const auto& list = lists[std::size_t{a} * count + b];
            out.pairs.insert(out.pairs.end(), {a, b, static_cast<std::uint32_t>(out.blocks.size())});
            out.blocks.insert(out.blocks.end(), list.begin(), list.end());
            out.longest = std::max(out.longest, static_cast<std::uint32_t>(list.size()));
        }
    const auto end = static_cast<std::uint32_t>(out.blocks.size());
    out.pairs.insert(out.pairs.end(), {0u, 0u, end});
    return out;
}

} // namespace

TwoLevel::TwoLevel(std::shared_ptr<Device> device, std::shared_ptr<const DeviceMatrix> matrix,
                   const SparseMatrix& pattern, BufferPtr inverse, std::span<const std::uint32_t> aggregate)
    : matrix_(std::move(matrix)),
      aggregates_(count_of(aggregate)),
      inverse_(std::move(inverse))
{
    if (matrix_->format() != Format::bcsr3 || 3 * aggregate.size() != matrix_->rows())
        throw Error(ErrorCode::bad_input,
                    "a preconditioner of two levels takes a matrix in bcsr3 and an aggregate for each "
                    "of its block rows");
    if (aggregates_ == 0 || aggregates_ > kMostAggregates)
        throw Error(ErrorCode::bad_input, "there are " + std::to_string(aggregates_) +
                                              " aggregates: make 1 to " + std::to_string(kMostAggregates));
    const Pairs pairs = pairs_of(pattern, matrix_->slots(pattern), aggregate, aggregates_);
    if (!device->info().executor.starts_with("cpu") && 9ull * pairs.longest > kMaxLoopTrips)
        throw Error(ErrorCode::limit, "an aggregate of " + std::to_string(pairs.longest) + " blocks makes " +
                                          std::to_string(9ull * pairs.longest) + " loop trips, and " +
                                          std::to_string(kMaxLoopTrips) +
                                          " are safe on this device; use the device cpu, or block_jacobi");
    aggregate_ = upload(*device, {aggregate.begin(), aggregate.end()}, "aggregates");
    pairs_ = upload(*device, pairs.pairs, "pairs of aggregates");
    blocks_ = upload(*device, pairs.blocks, "blocks of aggregates");
    members_ = upload(*device, members_of(aggregate, aggregates_), "vertices of aggregates");
    const std::uint64_t real = real_bytes(matrix_->precision()), entries = std::uint64_t{rows()} * rows();
    coarse_ = device->make_buffer(entries * real, "coarse inverse");
    other_ = device->make_buffer(entries * real, "coarse inverse, to and fro");
    right_ = device->make_buffer(rows() * real, "coarse residual");
    left_ = device->make_buffer(rows() * real, "coarse correction");
}

void TwoLevel::form(Recorder& recorder, const Gate& gate) const
{
    const Recorder::Form form{"", matrix_->precision(), kTwoLevelLabel};
    BufferPtr from = rows() % 2 == 0 ? coarse_ : other_, to = rows() % 2 == 0 ? other_ : coarse_;
    const Grid pairs = make_grid(aggregates_ * (aggregates_ + 1) / 2, gate.groups, 1);
    launch(recorder, gate, form,
           kernels::coarse_matrix::Bindings<Recorder::Binding>{
               .pair = pairs_, .block = blocks_, .values = matrix_->values(), .coarse = from},
           {pairs.count, pairs.chunk, rows()});
    const Grid grid = make_grid(rows(), gate.groups, 1);
    for (std::uint32_t pivot = 0; pivot < rows(); ++pivot, std::swap(from, to))
        launch(recorder, gate, form,
               kernels::coarse_pivot::Bindings<Recorder::Binding>{.before = from, .after = to},
               {grid.count, grid.chunk, pivot});
}

void TwoLevel::record(Recorder& recorder, const Gate& gate, Operator::Binding r, Operator::Binding z,
                      Operator::Binding partials) const
{
    const Recorder::Form form{"", matrix_->precision(), kTwoLevelLabel};
    const Grid coarse = make_grid(rows(), gate.groups, 1);
    launch(recorder, gate, form,
           kernels::coarse_restrict::Bindings<Recorder::Binding>{
               .table = members_, .residual = r, .coarse = right_},
           {coarse.count, coarse.chunk});
    launch(recorder, gate, form,
           kernels::spmv_dense::Bindings<Recorder::Binding>{.values = coarse_, .x = right_, .y = left_},
           {coarse.count, coarse.chunk, gate.groups, 0});
    const Grid fine = make_grid(matrix_->rows() / 3, gate.groups);
    launch(recorder, gate, form,
           kernels::coarse_correct::Bindings<Recorder::Binding>{.residual = r,
                                                                .inverse = inverse_,
                                                                .aggregate = aggregate_,
                                                                .coarse = left_,
                                                                .z = z,
                                                                .partials = partials},
           {fine.count, fine.chunk, gate.groups});
}

std::uint64_t TwoLevel::bytes() const
{
    std::uint64_t sum = 0;
    for (const BufferPtr* buffer :
         {&aggregate_, &pairs_, &blocks_, &members_, &coarse_, &other_, &right_, &left_})
        sum += (*buffer)->bytes();
    return sum;
}

} // namespace taut::linear
