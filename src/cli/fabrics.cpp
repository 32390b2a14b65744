// taut fabrics: the measured fabrics that a scene may name.

#include "taut/scene/fabric_presets.hpp"

#include "taut/cli/command.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"

#include <iomanip>
#include <iostream>

namespace taut::cli {
namespace {

Json as_json()
{
    Json list = Json::array();
    for (const FabricPreset& preset : fabric_presets())
        list.push_back({{"name", preset.name},
                        {"density", preset.density},
                        {"warp", preset.fabric.warp},
                        {"weft", preset.fabric.weft},
                        {"poissons_ratio", preset.fabric.poissons_ratio},
                        {"shear", preset.fabric.shear},
                        {"source", preset.source}});
    return {{"fabrics", list}};
}

void print()
{
    const auto row = [](const auto&... cell) { ((std::cout << std::left << std::setw(10) << cell), ...); };
    std::cout << std::left << std::setw(22) << "preset";
    row("kg/m^2", "warp N/m", "weft N/m", "shear N/m", "nu");
    for (const FabricPreset& preset : fabric_presets())
    {
        const Fabric& f = preset.fabric;
        std::cout << '\n' << std::left << std::setw(22) << preset.name;
        row(number(preset.density, 3), number(f.warp, 5), number(f.weft, 5), number(f.shear, 3),
            number(f.poissons_ratio, 3));
        std::cout << "\n    " << preset.source;
    }
    std::cout << '\n';
}

} // namespace

void add_fabrics(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("fabrics", "List the measured fabrics that a scene may name");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print the list as one JSON object");
    command->callback([&chosen, json] {
        chosen = [json] {
            if (*json)
                std::cout << to_text(as_json());
            else
                print();
            return int(kDone);
        };
    });
}

} // namespace taut::cli
