// The tables of the pages.

#include "taut/scene/key_text.hpp"
#include "taut/scene/method_about.hpp"
#include "taut/scene/schema.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

/// "m/s²": units as the pages have them.
std::string printed(std::string_view unit)
{
    std::string out;
    for (std::size_t i = 0; i < unit.size(); ++i)
        if (unit[i] == '^')
            out += unit[++i] == '2' ? "²" : "³";
        else
            out += unit[i];
    return out;
}

/// A link from a page of docs/.
std::string link(const Key& key)
{
    if (key.page.empty())
        return {};
    const bool here = key.page.starts_with("scene.md#");
    return " ([" + std::string(key.page_name) + "](" + std::string(here ? key.page.substr(8) : key.page) +
           "))";
}

std::string default_cell(const Table& table, const Key& key, const void* defaults)
{
    const bool one = table.choice == Choice::exactly_one && key.is_choice;
    return one ? "" : default_text(key, defaults);
}

std::string cell(const std::string& text) { return text.empty() ? " |" : ' ' + text + " |"; }

std::string table_of(const Table& table)
{
    std::string out = "| key | what | unit | default | range |\n|---|---|---|---|---|\n";
    const auto defaults = defaults_of(table);
    for (const Key& key : table.keys)
    {
        const std::string parts = key.parts.empty() ? "" : std::string(key.parts) + ": ";
        out += "| `" + std::string(key.name) + "` |" + cell(parts + std::string(key.what) + link(key)) +
               cell(printed(unit_of(key))) + cell(default_cell(table, key, defaults.get())) +
               cell(range_text(key)) + '\n';
    }
    return out;
}

std::string methods()
{
    std::string out =
        "| `type` | what corrects the inertial guess | settings that it reads |\n|---|---|---|\n";
    for (std::size_t k = 0; k < kWords<MethodKind>.size(); ++k)
    {
        const std::string name(kWords<MethodKind>[k]);
        const MethodAbout& about = kMethodAbout[k];
        std::string settings;
        for (const Key& key : kMethodTable.keys)
            if (key.readers & only(static_cast<MethodKind>(k)))
                settings += (settings.empty() ? "`" : ", `") + std::string(key.name) + '`';
        out += (about.has_page ? "| [`" + name + "`](methods/" + name + ".md) |" : "| `" + name + "` |") +
               cell(std::string(about.what)) + cell(settings) + '\n';
    }
    return out;
}

std::string marked(std::string_view name, const std::string& table)
{
    return "<!-- " + std::string(name) + " -->\n\n" + table + "\n<!-- end -->\n";
}

} // namespace

std::string tables_as_markdown()
{
    std::string out;
    for (const Table* table : all_tables())
        out += marked(table->name, table_of(*table));
    return out + marked("methods", methods());
}

} // namespace taut::scene_file
