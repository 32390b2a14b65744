#include "taut/cli/inventory_text.hpp"

#include "taut/plan/inventory.hpp"

#include <vector>

namespace taut::cli {
namespace {

/// "`predict`, `finish`"; empty for none.
std::string quoted(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "`" : ", `") + name + "`";
    return text;
}

std::string row(const std::vector<std::string>& cells)
{
    std::string text = "|";
    for (const std::string& cell : cells)
        text += cell.empty() ? " |" : " " + cell + " |";
    return text + "\n";
}

/// What a program writes before a step comes first.
std::string writers(const BoundBuffer& use)
{
    const std::string kernels = quoted(use.written_by);
    return !use.host_written ? kernels : kernels.empty() ? "the host" : "the host, " + kernels;
}

} // namespace

Json buffers_json(const Plan& plan)
{
    Json out = Json::array();
    for (const BoundBuffer& use : buffer_uses(plan))
        out.push_back({{"name", use.name},
                       {"effect", use.effect},
                       {"bytes", use.bytes},
                       {"written_by_host", use.host_written},
                       {"read_by", use.read_by},
                       {"written_by", use.written_by}});
    return out;
}

Json kernels_json(const Plan& plan)
{
    Json out = Json::array();
    for (const DispatchedKernel& use : kernel_uses(plan))
        out.push_back({{"name", use.name},
                       {"effect", use.effect},
                       {"dispatches_per_step", use.dispatches},
                       {use.of_groups ? "groups_per_step" : "elements_per_step", use.elements}});
    return out;
}

std::string inventory_markdown(const Plan& plan)
{
    std::string text =
        row({"buffer", "effect", "bytes", "read by", "written by"}) + "|---|---|---:|---|---|\n";
    for (const BoundBuffer& use : buffer_uses(plan))
        text += row({use.name, use.effect, std::to_string(use.bytes), quoted(use.read_by), writers(use)});
    text +=
        "\n" + row({"kernel", "effect", "dispatches a step", "elements a step"}) + "|---|---|---:|---:|\n";
    for (const DispatchedKernel& use : kernel_uses(plan))
        text += row({"`" + use.name + "`", use.effect, std::to_string(use.dispatches),
                     std::to_string(use.elements) + (use.of_groups ? " groups" : "")});
    return text;
}

} // namespace taut::cli
