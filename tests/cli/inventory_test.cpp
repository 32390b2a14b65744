// The page of buffers and kernels is what the program prints (docs/results/update_inventory.sh writes it).

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// A command of the page and the table below it.
struct Part
{
    std::vector<std::string> arguments;
    std::string table;
};

/// The words of a command line of the page; scenes are where the sources are.
std::vector<std::string> words_of(const std::string& line)
{
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; in >> word;)
        words.push_back(word.starts_with("examples/") ? TAUT_SOURCE_DIR "/" + word : word);
    return words;
}

std::vector<Part> parts_of(const std::string& page)
{
    const std::string command = "    taut ";
    std::vector<Part> parts;
    std::istringstream in(page);
    bool inside = false;
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(command))
            parts.push_back({words_of(line.substr(command.size())), ""});
        else if (line.starts_with("<!-- "))
            inside = line != "<!-- end -->";
        else if (inside)
            parts.back().table += line + "\n";
    return parts;
}

} // namespace

TEST_CASE("the page of buffers and kernels has what the program prints")
{
    const program::Folder folder;
    const std::vector<Part> parts = parts_of(program::read(TAUT_SOURCE_DIR "/docs/results/inventory.md"));
    CHECK(parts.size() >= 10);
    for (const Part& part : parts)
    {
        const program::Result result = folder.taut(part.arguments);
        INFO(result.err);
        REQUIRE(result.status == 0);
        CHECK(part.table == "\n" + result.out + "\n");
    }
}

TEST_CASE("what plan says of buffers adds up to what it says of effects")
{
    const program::Folder folder;
    const std::string scene = TAUT_SOURCE_DIR "/examples/scenes/implicit_constraints.json";
    const auto plan = program::parse(folder.taut({"plan", scene, "--json"}).out);
    std::uint64_t bytes = 0, dispatches = 0;
    std::set<std::string> readers;
    for (const auto& buffer : plan["buffers"])
    {
        bytes += buffer["bytes"].get<std::uint64_t>();
        for (const auto& kernel : buffer["read_by"])
            readers.insert(kernel.get<std::string>());
        CHECK(buffer["written_by_host"] == (buffer["name"] == "step values"));
    }
    for (const auto& kernel : plan["kernels"])
    {
        dispatches += kernel["dispatches_per_step"].get<std::uint64_t>();
        CHECK(readers.count(kernel["name"].get<std::string>()) == 1); // none works on nothing
    }
    CHECK(bytes == plan["bytes_allocated"]);
    CHECK(dispatches == plan["dispatches_per_step"]);
}
