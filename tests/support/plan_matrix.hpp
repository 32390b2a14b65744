#pragma once
// Matrices as the simulator itself forms them: a plan is run on the device, and the buffers that the product
// of its solves reads are read back.

#include "taut/linear/bcsr3.hpp"
#include "taut/plan/plan.hpp"
#include "taut/world/inputs.hpp"
#include "taut/world/world.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace taut::test {

/// The buffers of a plan on cpu:serial, without what a World does around them.
class PlanRun
{
public:
    explicit PlanRun(const Scene& scene)
        : device_(Device::open("cpu:serial")),
          plan_(make_plan(scene, limits_as_traits(*device_)))
    {
        for (const PlanBuffer& buffer : plan_.buffers)
        {
            buffers_.push_back(device_->make_buffer(buffer.bytes, buffer.name));
            if (!buffer.initial.empty())
                device_->write(buffers_.back(), 0, buffer.initial);
        }
        const auto position = device_->read<double>(buffers_[plan_.position], 4 * plan_.vertex_count);
        for (std::size_t w = 3; w < position.size(); w += 4)
            inverse_mass_.push_back(position[w]);
        for (const InputWrite& input : step_inputs(scene, plan_, {0, scene.timestep}))
            device_->write(buffers_[input.buffer], 0, input.bytes);
        recording_ = device_->compile({buffers_, plan_.passes, plan_.barrier_before});
    }

    void step() { recording_->replay(); }

    /// The first pass of a kernel; null: there is none.
    const Dispatch* pass(std::string_view kernel) const
    {
        for (const Dispatch& one : plan_.passes)
            if (one.kernel->name == kernel)
                return &one;
        return nullptr;
    }

    /// What a pass binds by that name.
    template <typename T>
    std::vector<T> bound(const Dispatch& pass, std::string_view name) const
    {
        for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
            if (pass.kernel->bindings[slot].name == name)
                return device_->read<T>(buffers_[pass.bindings[slot].buffer],
                                        pass.bindings[slot].bytes / sizeof(T), pass.bindings[slot].offset);
        throw std::runtime_error("the product binds no " + std::string(name));
    }

    /// Their inverse mass is 0.
    bool held(std::uint32_t vertex) const { return inverse_mass_[vertex] == 0; }

private:
    std::shared_ptr<Device> device_;
    Plan plan_;
    std::vector<BufferPtr> buffers_;
    std::unique_ptr<Recording> recording_;
    std::vector<double> inverse_mass_;
};

/// A matrix by rows or slices of them, as a product binds it.
struct BoundRows
{
    std::vector<std::uint32_t> start, column;
    std::vector<double> values;
};

inline BoundRows bound_rows(const PlanRun& run, const Dispatch& product, std::string_view start)
{
    return {run.bound<std::uint32_t>(product, start), run.bound<std::uint32_t>(product, "column"),
            run.bound<double>(product, "values")};
}

/// Blocks of held vertices and those that fill a slice up are left out; zeros within the others are kept.
inline std::vector<linear::Triplet> block_entries(const PlanRun& run, const Dispatch& product)
{
    const BoundRows m = bound_rows(run, product, "slice_start");
    std::vector<linear::Triplet> entries;
    for (std::uint32_t slice = 0; slice + 1 < m.start.size(); ++slice)
        for (std::uint32_t t = m.start[slice]; t < m.start[slice + 1]; ++t)
            for (std::uint32_t r = 0; r < TAUT_BCSR3_SLICE; ++r)
            {
                const auto value = [&](std::uint32_t e) { return m.values[linear::bcsr3_value(t, e, r)]; };
                const std::uint32_t row = TAUT_BCSR3_SLICE * slice + r;
                const std::uint32_t other = m.column[linear::bcsr3_block(t, r)];
                bool stored = false;
                for (std::uint32_t e = 0; e < 9; ++e)
                    stored = stored || value(e) != 0;
                for (std::uint32_t e = 0; e < 9 && stored && !run.held(row) && !run.held(other); ++e)
                    entries.push_back({3 * row + e / 3, 3 * other + e % 3, value(e)});
            }
    return entries;
}

inline std::vector<linear::Triplet> row_entries(const PlanRun& run, const Dispatch& product)
{
    const BoundRows m = bound_rows(run, product, "row_start");
    std::vector<linear::Triplet> entries;
    for (std::uint32_t row = 0; row + 1 < m.start.size(); ++row)
        for (std::uint32_t k = m.start[row]; k < m.start[row + 1]; ++k)
            entries.push_back({row, m.column[k], m.values[k]});
    return entries;
}

/// The unknowns whose diagonal is not 0, in their order: rods between two held vertices have none.
inline linear::SparseMatrix in_use(std::vector<linear::Triplet> entries)
{
    std::uint32_t rows = 0;
    for (const linear::Triplet& entry : entries)
        rows = std::max(rows, entry.row + 1);
    std::vector<std::uint32_t> number(rows, 0);
    for (const linear::Triplet& entry : entries)
        if (entry.row == entry.column && entry.value != 0)
            number[entry.row] = 1;
    rows = 0;
    for (std::uint32_t& one : number)
        one = one ? rows++ : ~0u;
    std::erase_if(entries, [&](const linear::Triplet& entry) {
        return number[entry.row] == ~0u || number[entry.column] == ~0u;
    });
    for (linear::Triplet& entry : entries)
        entry = {number[entry.row], number[entry.column], entry.value};
    return linear::from_triplets(rows, rows, entries);
}

/// The matrix of the last solve after `steps` time steps of a resolved scene whose method stores one
/// ("assembled", in double): M + h^2 K + h D of implicit_euler times a power of two, J W J^T + compliance /
/// h^2 of implicit_constraints. Held vertices are left out. Nothing but the bodies may move: inputs are those
/// of the first step. Throws std::runtime_error where the plan has no such product.
inline linear::SparseMatrix matrix_of(const Scene& resolved, int steps)
{
    PlanRun run(resolved);
    for (int k = 0; k < steps; ++k)
        run.step();
    if (const Dispatch* blocks = run.pass("spmv_bcsr3"))
        return in_use(block_entries(run, *blocks));
    if (run.pass("spmv_csr_long"))
        throw std::runtime_error("the matrix has rows that csr stores elsewhere");
    if (const Dispatch* rows = run.pass("spmv_csr"))
        return in_use(row_entries(run, *rows));
    throw std::runtime_error("method " + quoted(resolved.method.type) + " stores no matrix here");
}

} // namespace taut::test
