// What one iteration of conjugate gradients binds and dispatches in every format, read off the recording: the
// tables of buffers and kernels of the thesis. Runs nothing.

#include "linear_bench.hpp"

#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/paper_device.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

namespace bench {

using namespace taut;
using namespace taut::linear;

namespace {

constexpr std::uint32_t kSide = 12; ///< of the cube of unknowns

/// A buffer as passes bind it.
struct Used
{
    BufferPtr buffer;
    std::set<std::string> readers, writers; ///< kernels
    bool of_product = false;                ///< bound by the product alone
};

struct Inventory
{
    Format format = Format::csr;
    std::vector<Used> buffers;        ///< in the order in which they are first bound
    std::vector<std::string> kernels; ///< one a dispatch
};

/// As cells name it: what differs from format to format is "product" where the buffer is the same in all.
std::string listed(const std::set<std::string>& kernels, bool of_product)
{
    std::set<std::string> words;
    for (const std::string& kernel : kernels)
        words.insert(of_product || kernel.starts_with("cg_") ? '`' + kernel + '`' : "product");
    std::string out;
    for (const std::string& word : words)
        out += (out.empty() ? "" : ", ") + word;
    return out;
}

void use(const Dispatch& pass, const RecordingDesc& all, Inventory& out)
{
    const bool product = !pass.kernel->name.starts_with("cg_");
    out.kernels.emplace_back(pass.kernel->name);
    for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
    {
        const BufferPtr& buffer = all.buffers[pass.bindings[slot].buffer];
        auto at = std::find_if(out.buffers.begin(), out.buffers.end(),
                               [&](const Used& used) { return used.buffer == buffer; });
        if (at == out.buffers.end())
            at = out.buffers.insert(at, {buffer, {}, {}, true});
        at->of_product = at->of_product && product;
        const Access access = pass.kernel->bindings[slot].access;
        if (reads(access))
            at->readers.emplace(pass.kernel->name);
        if (writes(access))
            at->writers.emplace(pass.kernel->name);
    }
}

Inventory inventory_of(const SparseMatrix& a, Format format, const DeviceInfo& info)
{
    const auto paper = std::make_shared<PaperDevice>(info);
    const auto matrix = DeviceMatrix::upload(paper, a, {format, Precision::float64, false, 0});
    const Preconditioning jacobi{
        Preconditioner::jacobi,
        paper->make_buffer(a.rows * sizeof(double), "inverse of the diagonal", BufferUse::device), nullptr};
    ConjugateGradient cg(paper, matrix, jacobi, false);
    const auto recorded = [&](std::uint32_t iterations) {
        Recorder recorder(paper);
        cg.record_iterations(recorder, iterations);
        return PaperDevice::take(recorder);
    };
    // Both end with the room to form the residual anew; what two iterations have more is one.
    const RecordingDesc one = recorded(1), two = recorded(2);
    Inventory out;
    out.format = format;
    for (std::size_t k = 0; k < two.dispatches.size() - one.dispatches.size(); ++k)
        use(two.dispatches[k], two, out);
    return out;
}

void print(const std::vector<std::string>& cells)
{
    std::printf("|");
    for (const std::string& cell : cells)
        std::printf(" %s |", cell.c_str());
    std::printf("\n");
}

void note(const std::vector<std::string>& cells, std::string& csv)
{
    for (std::string cell : cells)
    {
        std::erase(cell, '`');
        csv += taut::csv_cell(cell) + ',';
    }
    csv.back() = '\n';
}

void put_buffers(const Inventory& one, bool of_product, const std::string& format, std::string& csv)
{
    for (const Used& used : one.buffers)
        if (used.of_product == of_product)
        {
            const std::vector<std::string> cells = {
                format, PaperDevice::label(used.buffer), std::to_string(used.buffer->bytes()),
                listed(used.readers, of_product), listed(used.writers, of_product)};
            print(cells);
            note(cells, csv);
        }
}

void put_dispatches(const Inventory& one, std::string& csv)
{
    const std::string format(to_string(one.format)), count = std::to_string(one.kernels.size());
    std::string order;
    std::uint64_t bytes = 0;
    for (const std::string& kernel : one.kernels)
        order += (order.empty() ? "`" : ", `") + kernel + "`";
    for (const Used& used : one.buffers)
        bytes += used.buffer->bytes();
    print({format, count, std::to_string(one.buffers.size()), std::to_string(bytes), order});
    note({format, "all buffers", std::to_string(bytes), order, ""}, csv);
    note({format, "dispatches", count, order, ""}, csv);
}

} // namespace

void run_inventory(const PrecisionOptions& options, const std::string& conditions)
{
    const DeviceInfo info = taut::Device::open(options.device)->info();
    const SparseMatrix a = poisson3d(kSide);
    std::vector<Inventory> all;
    for (const Format format : all_formats())
        all.push_back(inventory_of(a, format, info));
    std::string csv = "# " + conditions + "\nformat,what,bytes_or_count,read_by,written_by\n";
    std::printf("| format | buffer | bytes | read by | written by |\n|---|---|---:|---|---|\n");
    put_buffers(all[0], false, "every", csv);
    for (const Inventory& one : all)
        put_buffers(one, true, std::string(to_string(one.format)), csv);
    std::printf("\n| format | dispatches an iteration | buffers | their bytes | kernels in order |\n"
                "|---|---:|---:|---:|---|\n");
    for (const Inventory& one : all)
        put_dispatches(one, csv);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv);
}

} // namespace bench
