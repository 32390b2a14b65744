// taut plan: what a step of a scene would run, and what memory a device takes for it. Runs nothing of it.

#include "taut/plan/plan.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/inventory_text.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/run_result.hpp"
#include "taut/scene/settings.hpp"
#include "taut/version.hpp"
#include "taut/world/kept_traits.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <iostream>
#include <optional>

namespace taut::cli {
namespace {

struct PlanCommand
{
    std::string scene, device;
    std::vector<std::string> settings;
    bool json = false, buffers = false;
};

/// A plan and what it was made for.
struct Planned
{
    const Plan& plan;
    const DeviceTraits& traits;
    std::string device = {};                   ///< its name; empty: for none
    std::optional<DeviceCounters> memory = {}; ///< of that device, with the scene on it
};

/// Words in lines of at most `width` columns, the first after `head`, the others below its end.
std::string wrapped(const std::string& head, const std::vector<std::string>& words, std::size_t width)
{
    std::string text = head;
    std::size_t column = head.size();
    for (const std::string& word : words)
    {
        if (column + 1 + word.size() > width && column > head.size())
        {
            text += "\n" + std::string(head.size(), ' ');
            column = head.size();
        }
        text += " " + word;
        column += 1 + word.size();
    }
    return text + "\n";
}

/// What the plan weighed, and where it comes from.
std::string costs_text(const DeviceTraits& traits, bool measured)
{
    const auto ns = [](double value) { return number(value, 3) + " ns"; };
    const std::string file = costs_kept_in().string();
    return "costs: a dispatch " + ns(traits.dispatch_ns) + ", a barrier in a group " +
           ns(traits.group_barrier_ns) + ", an element " + ns(traits.element_ns) + ", in one group alone " +
           ns(traits.lane_element_ns) +
           (fixed_costs()  ? " (as given)"
            : !measured    ? " (assumed; --device measures)"
            : file.empty() ? " (measured now)"
                           : " (from " + file + ")") +
           "\n";
}

Json to_json(const PlanCommand& options, const Planned& planned)
{
    const Plan& plan = planned.plan;
    const DeviceTraits& traits = planned.traits;
    Json effects = Json::array();
    for (const EffectCost& effect : plan.effects)
        effects.push_back({{"name", effect.name},
                           {"kernels", effect.kernel_names()},
                           {"dispatches_per_step", effect.dispatches_per_step},
                           {"bytes_allocated", effect.bytes_allocated},
                           {"bytes_per_step", effect.bytes_per_step}});
    Json json = {{"taut", TAUT_VERSION}, {"scene", options.scene}};
    json["device"] = planned.device.empty() ? Json(nullptr) : Json(planned.device);
    json["costs_ns"] = {{"dispatch", traits.dispatch_ns},
                        {"group_barrier", traits.group_barrier_ns},
                        {"element", traits.element_ns},
                        {"lane_element", traits.lane_element_ns}};
    json["precision"] = to_string(plan.precision);
    json["substeps"] = plan.substeps;
    json["iterations"] = plan.iterations;
    json["vertices"] = plan.vertex_count;
    json["constraints"] = plan.constraint_counts();
    json["effects"] = effects;
    json["dispatches_per_step"] = plan.passes.size();
    json["barriers_per_step"] = plan.barrier_count();
    json["bytes_allocated"] = plan.bytes_allocated();
    if (planned.memory)
        json["memory"] = memory_json(*planned.memory);
    json["buffers"] = buffers_json(plan);
    json["kernels"] = kernels_json(plan);
    json["colours"] = plan.colour_counts();
    json["warnings"] = nlohmann::json::array();
    for (const PlanWarning& warning : plan.warnings)
        json["warnings"].push_back(warning.sentence());
    return json;
}

std::string to_table(const Plan& plan)
{
    std::vector<std::vector<std::string>> rows = {{"effect", "dispatches", "allocated", "moved"}};
    std::size_t longest = 0;
    for (const EffectCost& effect : plan.effects)
    {
        rows.push_back({effect.name, std::to_string(effect.dispatches_per_step),
                        bytes_text(effect.bytes_allocated), bytes_text(effect.bytes_per_step)});
        longest = std::max(longest, effect.name.size());
    }
    std::string text = table(rows) + "\nkernels\n";
    for (const EffectCost& effect : plan.effects)
        text +=
            wrapped(effect.name + std::string(longest - effect.name.size(), ' '), effect.kernel_names(), 100);
    text += "\n";
    text += std::to_string(plan.vertex_count) + " vertices, " + std::string(to_string(plan.precision)) +
            ", " + std::to_string(plan.substeps) + " substeps of " + std::to_string(plan.iterations) +
            " iterations\n";
    const auto colours = plan.colour_counts();
    for (const auto& [kind, count] : plan.constraint_counts())
    {
        const auto found = colours.find(kind);
        text += std::to_string(count) + " " + kind + " constraints in " +
                std::to_string(found == colours.end() ? 0 : found->second) + " colours\n";
    }
    text += "a step: " + std::to_string(plan.passes.size()) + " dispatches, " +
            std::to_string(plan.barrier_count()) + " barriers, " + bytes_text(plan.bytes_allocated()) +
            " allocated\n";
    return text;
}

void print(const PlanCommand& options, const Planned& planned)
{
    if (options.json)
        std::cout << to_text(to_json(options, planned));
    else if (options.buffers)
        std::cout << inventory_markdown(planned.plan);
    else
        std::cout << to_table(planned.plan) << (planned.memory ? memory_line(*planned.memory) : "")
                  << costs_text(planned.traits, !planned.device.empty());
}

void show_for_none(const PlanCommand& options, const Scene& scene)
{
    DeviceTraits traits;
    if (const auto costs = fixed_costs())
        set_costs(traits, *costs);
    const Plan plan = make_plan(scene, traits);
    print(options, {plan, traits});
}

/// By a world, as `taut run` makes it: what pools and staging add to the buffers of a scene only the device
/// can say.
void show_for_device(const PlanCommand& options, const Scene& scene)
{
    auto device = open_device(options.device);
    if (!costs_kept_in().empty())
    { // Measuring leaves larger pools behind, and the run that follows finds the costs kept.
        measure_traits(*device);
        device = open_device(options.device);
    }
    const World world(scene, device);
    const DeviceCounters memory = device->counters();
    const DeviceTraits traits = measure_traits(*device); // as the world has them
    print(options, {world.plan(), traits, device->info().name, memory});
}

int show_plan(const PlanCommand& options)
{
    const Scene scene = resolve_file(options.scene, options.settings);
    naming(options.scene,
           [&] { options.device.empty() ? show_for_none(options, scene) : show_for_device(options, scene); });
    return kDone;
}

} // namespace

void add_plan(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("plan", "Show what a step would run: passes, barriers, bytes, per effect");
    const auto options = std::make_shared<PlanCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    add_device_option(*command, options->device);
    add_costs_option(*command);
    command->add_option("--set", options->settings, "A value of the scene: method.type=implicit_euler");
    command->add_flag("--buffers", options->buffers, "Print buffers and kernels instead, as Markdown");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return show_plan(*options); }; });
}

} // namespace taut::cli
