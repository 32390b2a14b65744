// taut schema: the scene format for editors, and the tables of the pages.

#include "taut/scene/schema.hpp"

#include "taut/cli/command.hpp"
#include "taut/cli/output.hpp"

#include <iostream>

namespace taut::cli {

void add_schema(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenes, for editors");
    const auto markdown = std::make_shared<bool>(false);
    command->add_flag("--markdown", *markdown,
                      "Print the tables of docs/scene.md and docs/methods.md instead");
    command->callback([&chosen, markdown] {
        chosen = [markdown] {
            std::cout << (*markdown ? scene_file::tables_as_markdown() : to_text(scene_file::scene_schema()));
            return int(kDone);
        };
    });
}

} // namespace taut::cli
