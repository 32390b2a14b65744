#include "taut/report/ablation.hpp"

#include "taut/plan/effect_names.hpp"
#include "taut/report/errors.hpp"
#include "taut/report/median.hpp"
#include "taut/report/model.hpp"
#include "taut/runtime/base/csv.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace taut {
namespace {

struct Run
{
    AblationRow row;
    std::unique_ptr<World> world; ///< null where the scene is refused
    std::vector<double> times;    ///< ms
};

struct Accounts
{
    std::int64_t dispatches = 0, bytes = 0, moved = 0;
};

Accounts accounts_of(const Plan& plan)
{
    Accounts out;
    out.bytes = static_cast<std::int64_t>(plan.bytes_allocated());
    out.dispatches = static_cast<std::int64_t>(plan.passes.size());
    for (const EffectCost& effect : plan.effects)
        out.moved += static_cast<std::int64_t>(effect.bytes_per_step);
    return out;
}

std::vector<Run> make_runs(const Scene& scene, const std::shared_ptr<Device>& device)
{
    std::vector<Run> runs(1);
    runs[0].world = std::make_unique<World>(scene, device);
    const std::vector<std::string> names = effect_names(scene);
    for (const std::string& missing : names)
    {
        if (missing == "motion")
            continue;
        Run run;
        run.row.effect = missing;
        WorldOptions options;
        options.plan.available_effects = names;
        std::erase(options.plan.available_effects, missing);
        try
        {
            run.world = std::make_unique<World>(scene, device, options);
        }
        catch (const Error& error)
        {
            run.row.refusal = std::string(to_string(error.code())) + ": " + error.what();
        }
        runs.push_back(std::move(run));
    }
    return runs;
}

/// ms: process time on software devices, which a busy machine spoils less, wall time on a GPU.
double now_ms(bool gpu)
{
    if (gpu)
    {
        const std::chrono::duration<double, std::milli> since =
            std::chrono::steady_clock::now().time_since_epoch();
        return since.count();
    }
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// The frames that were run.
std::uint64_t step_in_turns(std::vector<Run>& runs, std::uint64_t frames,
                            const std::function<bool(std::size_t, std::size_t)>& progress)
{
    const bool gpu = runs[0].world->device().info().hardware_gpu;
    for (std::uint64_t k = 0; k < frames; ++k)
    {
        if (k > 0 && progress && !progress(k, frames))
            return k;
        for (Run& run : runs)
        {
            if (!run.world)
                continue;
            const double start = now_ms(gpu);
            run.world->step();
            run.world->device().wait();
            run.times.push_back(now_ms(gpu) - start);
        }
    }
    return frames;
}

const std::vector<std::string> kHead = {"without",   "ms a step",        "its cost ms",      "its dispatches",
                                        "its bytes", "its bytes a step", "difference e_L %", "refused"};

std::vector<std::string> cells(const AblationRow& row)
{
    if (!row.refusal.empty())
        return {row.effect, "", "", "", "", "", "", row.refusal};
    const bool whole = row.effect.empty();
    return {whole ? "(the whole scene)" : row.effect,
            shown(row.step_ms, 3),
            whole ? "" : shown(row.cost_ms, 3),
            std::to_string(row.dispatches),
            std::to_string(row.bytes),
            std::to_string(row.bytes_moved),
            whole ? "" : shown(100 * row.difference, 3),
            ""};
}

} // namespace

Ablation run_ablation(const Scene& scene, std::shared_ptr<Device> device, std::uint64_t frames,
                      const std::function<bool(std::size_t, std::size_t)>& progress)
{
    Ablation out;
    out.scene = scene.name;
    out.device = device->info();
    std::vector<Run> runs = make_runs(scene, device);
    out.frames = step_in_turns(runs, frames, progress);
    const Accounts whole = accounts_of(runs[0].world->plan());
    const ErrorWeights weights = error_weights(make_model(scene));
    const std::vector<glm::dvec3> end = runs[0].world->positions();
    for (Run& run : runs)
    {
        AblationRow& row = run.row;
        if (run.world)
        {
            const bool first = row.effect.empty();
            const Accounts own = accounts_of(run.world->plan());
            row.step_ms = median(run.times);
            row.cost_ms = first ? 0 : median(runs[0].times) - row.step_ms;
            row.dispatches = first ? own.dispatches : whole.dispatches - own.dispatches;
            row.bytes = first ? own.bytes : whole.bytes - own.bytes;
            row.bytes_moved = first ? own.moved : whole.moved - own.moved;
            row.difference = first ? 0 : largest_error(weights, run.world->positions(), end);
        }
        out.rows.push_back(row);
    }
    return out;
}

std::string ablation_markdown(const Ablation& ablation)
{
    std::string text = "|", rule = "|";
    for (const std::string& name : kHead)
    {
        text += " " + name + " |";
        rule += rule.size() == 1 ? "---|" : "---:|";
    }
    text += "\n" + rule + "\n";
    for (const AblationRow& row : ablation.rows)
    {
        text += "|";
        for (const std::string& cell : cells(row))
            text += " " + cell + " |";
        text += "\n";
    }
    return text;
}

std::string ablation_csv(const Ablation& ablation)
{
    const auto line = [](const std::vector<std::string>& row) {
        std::string text;
        for (const std::string& cell : row)
            text += (text.empty() ? "" : ",") + csv_cell(cell);
        return text + "\n";
    };
    std::string text = line(kHead);
    for (const AblationRow& row : ablation.rows)
        text += line(cells(row));
    return text;
}

} // namespace taut
