// The parts of docs/results/gpu.md.

#include "hardware/roofline.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#undef TAUT_HOST

#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/sparse.hpp"
#include "taut/plan/plan.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/runtime/limits.hpp"
#include "taut/runtime/paper_device.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <map>

namespace taut::hardware {
namespace {

constexpr std::uint32_t kSmallest = 64;

/// What the page takes of a plan; the largest plans take seconds to make.
struct Step
{
    std::vector<Dispatch> passes;
    std::vector<EffectCost> effects;
    double substeps = 0;
};

const Step& cloth(std::uint32_t cells)
{
    static std::map<std::uint32_t, Step> made;
    const auto found = made.find(cells);
    if (found != made.end())
        return found->second;
    const std::string side = std::to_string(cells);
    const std::string settings[] = {"bodies[0].grid.cells=[" + side + "," + side + "]",
                                    "bodies[0].contact.self=false", // searches have no fixed length
                                    "method.substeps=20"};
    Plan plan = make_plan(resolve_file(TAUT_SOURCE_DIR "/examples/scenes/drape.json", settings));
    return made[cells] = {std::move(plan.passes), std::move(plan.effects), double(plan.substeps)};
}

/// The passes of one kernel in a step, of those that one effect asked for.
struct KernelWork
{
    std::string effect, kernel;
    double invocations = 0; ///< of all its passes
    Work work;
};

/// The work of a plan by effect and kernel, in order of the plan.
std::vector<KernelWork> by_kernel(const Table& table, const std::string& family, const Step& plan)
{
    std::vector<KernelWork> out;
    for (const EffectCost& effect : plan.effects)
        for (const KernelCost& kernel : effect.kernels)
        {
            KernelWork& part = out.emplace_back(KernelWork{effect.name, kernel.name, 0, {}});
            part.work.bytes = static_cast<double>(kernel.bytes_per_step);
            for (const Dispatch& pass : plan.passes)
                if (pass.label == effect.name && full_name(*pass.kernel) == kernel.name)
                {
                    part.work += work_of(table, family, pass);
                    part.invocations +=
                        double(group_count(*pass.kernel, pass.count)) * pass.kernel->group_size;
                }
        }
    return out;
}

Work total(const std::vector<KernelWork>& parts)
{
    Work out;
    for (const KernelWork& part : parts)
        out += part.work;
    return out;
}

std::string row(std::initializer_list<std::string> cells)
{
    std::string out = "|";
    for (const std::string& cell : cells)
        out += " " + cell + " |";
    return out + "\n";
}

std::string time(double seconds, double unit) { return shown(seconds / unit, 3); }

std::string square(std::uint32_t side) { return std::to_string(side) + "²"; }

/// bytes, instructions, waves, dispatches, and which is largest.
std::string roof_cells(const Roofs& roofs, double unit)
{
    return time(roofs.bytes, unit) + " | " + time(roofs.instructions, unit) + " | " +
           time(roofs.waves, unit) + " | " + time(roofs.dispatches, unit) + " | " + roofs.dominant();
}

constexpr const char* kRoofHead = " bytes | instructions | waves | dispatches | largest |\n";

/// Effects that have several passes a substep because of colours.
bool is_coloured(const std::string& effect) { return effect == "distance" || effect == "bending"; }

/// Passes of a step that have colours, or those that have none; of one effect alone if it is named.
double passes(const std::vector<KernelWork>& parts, bool coloured, std::string_view effect = {})
{
    double out = 0;
    for (const KernelWork& part : parts)
        if (is_coloured(part.effect) == coloured && (effect.empty() || effect == part.effect))
            out += static_cast<double>(part.work.dispatches);
    return out;
}

/// The passes of an iteration of conjugate gradients with a diagonal, for a matrix in a format.
std::vector<Dispatch> iteration(const linear::SparseMatrix& a, linear::Format format)
{
    DeviceInfo info;
    info.executor = "vulkan";
    info.hardware_gpu = true; // as many groups as a GPU gets
    info.limits = DeviceTraits().limits;
    const auto device = std::make_shared<PaperDevice>(info);
    linear::UploadOptions options;
    options.format = format;
    options.precision = Precision::float32;
    const auto op = linear::DeviceMatrix::upload(device, a, options);
    linear::Preconditioning jacobi;
    jacobi.kind = linear::Preconditioner::jacobi;
    jacobi.inverse = device->make_buffer(std::uint64_t(a.rows) * sizeof(float), "inverse", BufferUse::device);
    linear::ConjugateGradient solver(device, op, jacobi, false);
    Recorder recorder(device);
    solver.record_iterations(recorder, 1);
    return PaperDevice::take(recorder).dispatches;
}

/// Each lane of such a pass goes through its share of the rows.
Work work_of_rows(const Table& table, const std::string& family, std::span<const Dispatch> passes,
                  double rows)
{
    Work out;
    for (const Dispatch& pass : passes)
    {
        out += work_of(table, family, pass, rows / (double(pass.count) * TAUT_LINEAR_GROUP));
        for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
            out.bytes += static_cast<double>(pass.bindings[slot].bytes) *
                         (pass.kernel->bindings[slot].access == Access::update ? 2 : 1);
    }
    return out;
}

} // namespace

std::string page_gpus()
{
    std::string text = "| GPU | family | compute units | SIMDs of each | GHz | GB/s | source |\n"
                       "|---|---|---:|---:|---:|---:|---|\n";
    for (const Gpu& gpu : kGpus)
        text += row({gpu.name, gpu.family, shown(gpu.units, 3), shown(gpu.simds, 3), time(gpu.clock, 1e9),
                     time(gpu.bandwidth, 1e9), gpu.source});
    text += "\n| a dispatch, µs | source |\n|---:|---|\n";
    for (const Latency& latency : {kRecorded, kLaunched})
        text += row({time(latency.seconds, 1e-6), latency.source});
    return text;
}

std::string page_cloth(const Table& table, std::uint32_t most)
{
    std::string text = std::string("| cells | GPU | dispatches | MB |") + kRoofHead +
                       "|---|---|---:|---:|---:|---:|---:|---:|---|\n";
    for (std::uint32_t cells = kSmallest; cells <= most; cells *= 2)
    {
        const Step& plan = cloth(cells);
        for (const Gpu& gpu : kGpus)
        {
            const Work work = total(by_kernel(table, gpu.family, plan));
            text += row({square(cells), gpu.name, std::to_string(work.dispatches), shown(work.bytes / 1e6, 3),
                         roof_cells(roofs_of(work, gpu), 1e-3)});
        }
    }
    return text;
}

std::string page_passes(const Table& table)
{
    const Gpu& gpu = kGpus[std::size(kGpus) - 1];
    std::string text = std::string("| cells | effect | kernel | dispatches | invocations of one |") +
                       kRoofHead + "|---|---|---|---:|---:|---:|---:|---:|---:|---|\n";
    for (const std::uint32_t cells : {kSmallest, 4 * kSmallest})
        for (const KernelWork& part : by_kernel(table, gpu.family, cloth(cells)))
            text += row({square(cells), part.effect, "`" + part.kernel + "`",
                         std::to_string(part.work.dispatches),
                         shown(part.invocations / double(part.work.dispatches), 6),
                         roof_cells(roofs_of(part.work, gpu), 1e-6)});
    return text;
}

std::string page_dispatches(const Table& table, std::uint32_t most)
{
    const Gpu& gpu = kGpus[std::size(kGpus) - 1];
    std::string text =
        "| cells | dispatches | at 0.876 µs | at 3 µs | bytes, instructions: the larger | dispatches "
        "that take as long, at 0.876 µs |\n|---|---:|---:|---:|---:|---:|\n";
    for (std::uint32_t cells = kSmallest; cells <= most; cells *= 2)
    {
        const Work work = total(by_kernel(table, gpu.family, cloth(cells)));
        const Roofs roofs = roofs_of(work, gpu);
        const double rest = std::max(roofs.bytes, roofs.instructions);
        text += row({square(cells), std::to_string(work.dispatches), time(roofs.dispatches, 1e-3),
                     time(double(work.dispatches) * kLaunched.seconds, 1e-3), time(rest, 1e-3),
                     shown(rest / kRecorded.seconds, 3)});
    }
    const Step& plan = cloth(kSmallest);
    const std::vector<KernelWork> parts = by_kernel(table, gpu.family, plan);
    const double coloured = passes(parts, true), others = passes(parts, false), substeps = plan.substeps;
    const double bending = passes(parts, true, "bending");
    text += "\n| a step of that scene | dispatches | ms at 0.876 µs | ms at 3 µs "
            "|\n|---|---:|---:|---:|\n";
    const auto line = [&](const char* what, double dispatches) {
        text += row({what, shown(dispatches, 4), time(dispatches * kRecorded.seconds, 1e-3),
                     time(dispatches * kLaunched.seconds, 1e-3)});
    };
    line("as it is", coloured + others);
    line("passes over vertices fused, one a substep", coloured + substeps);
    line("bending without colours (one pass a substep)", coloured - bending + substeps + others);
    line("both", coloured - bending + 2 * substeps);
    line("colours and all in one dispatch a substep", substeps);
    line("a step in one dispatch", 1);
    return text;
}

std::string page_gradients(const Table& table, std::uint32_t most)
{
    std::string text = std::string("| unknowns | format | GPU | dispatches | MB |") + kRoofHead +
                       "|---|---|---|---:|---:|---:|---:|---:|---:|---|\n";
    for (std::uint32_t n = kSmallest; n <= most; n *= 2)
    {
        const linear::SparseMatrix a = linear::poisson2d(n);
        for (const linear::Format format : {linear::Format::csr, linear::Format::sell})
        {
            const std::vector<Dispatch> passes = iteration(a, format);
            for (const Gpu& gpu : kGpus)
            {
                const Work work = work_of_rows(table, gpu.family, passes, a.rows);
                text += row({square(n), std::string(linear::to_string(format)), gpu.name,
                             std::to_string(work.dispatches), shown(work.bytes / 1e6, 3),
                             roof_cells(roofs_of(work, gpu), 1e-6)});
            }
        }
    }
    return text;
}

} // namespace taut::hardware
