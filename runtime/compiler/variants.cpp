#include "taut/runtime/compiler/variants.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

namespace taut {
namespace {

[[noreturn]] void refuse(const std::string& why)
{
    throw Error(ErrorCode::kernel_compilation, why);
}

/// What follows `//! KEY ` in every line that begins so.
std::vector<std::string> directives(std::string_view text, std::string_view key)
{
    const std::string start = "//! " + std::string(key) + " ";
    std::istringstream lines{std::string(text)};
    std::vector<std::string> out;
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(start, 0) == 0)
            out.push_back(line.substr(start.size()));
    return out;
}

std::vector<std::string> split(const std::string& line)
{
    std::istringstream words(line);
    std::vector<std::string> out;
    for (std::string word; words >> word;)
        out.push_back(word);
    return out;
}

/// One `//! variant` line; `ability` is what an element must have for it.
KernelVariant variant_of(std::string_view kernel, const std::string& line, std::string& ability)
{
    KernelVariant variant;
    const std::vector<std::string> words = split(line);
    for (std::size_t k = 0; k < words.size(); ++k)
    {
        const auto equal = words[k].find('=');
        if (k == 0)
            variant.name = words[k];
        else if (words[k] == "with" && k + 2 == words.size())
            ability = words[++k];
        else if (equal == std::string::npos)
            refuse("kernel " + std::string(kernel) + ": expected MACRO=VALUE in \"//! variant " + line +
                   "\"");
        else
            variant.defines.emplace_back(words[k].substr(0, equal), words[k].substr(equal + 1));
    }
    return variant;
}

std::string read(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Of a kernel called `name` whose text is in `file`: its element, or nothing if the text is another's.
ElementFile element_of(const std::filesystem::path& root, const std::filesystem::path& file,
                       std::string_view name)
{
    const std::string start = file.stem().string() + "_";
    if (name.size() <= start.size() || name.substr(0, start.size()) != start)
        return {};
    for (const std::string folder : {"elements/", "colliders/"})
    {
        const std::string path = folder + std::string(name.substr(start.size())) + ".glsl";
        if (!std::filesystem::exists(root / path))
            continue;
        ElementFile element = element_file(path, read(root / path));
        if (is_for(each_of(read(file)), element))
            return element;
    }
    return {};
}

} // namespace

KernelFile find_kernel_file(const std::filesystem::path& root, std::string_view name)
{
    namespace fs = std::filesystem;
    KernelFile found;
    std::error_code error;
    for (fs::recursive_directory_iterator it(root, error), end; !error && it != end; it.increment(error))
    {
        const std::string stem = it->path().stem().string();
        if (it->path().extension() != ".comp")
            continue;
        ElementFile element = stem == name ? ElementFile() : element_of(root, it->path(), name);
        if (stem != name && element.path.empty())
            continue;
        if (!found.path.empty())
            throw Error(ErrorCode::kernel_compilation, root.string() + " holds two kernels called " +
                                                           std::string(name) + ": " + found.path.string() +
                                                           " and " + it->path().string() +
                                                           "; keep one of them");
        found = {it->path(), std::move(element)};
    }
    if (error)
        throw Error(ErrorCode::io, root.string() + " cannot be searched: " + error.message());
    return found;
}

std::vector<KernelVariant> kernel_variants(std::string_view name, std::string_view text,
                                           const ElementFile& element)
{
    std::vector<KernelVariant> variants(1);
    std::set<std::string> macros;
    for (const std::string& line : directives(text, "variant"))
    {
        std::string ability;
        KernelVariant variant = variant_of(name, line, ability);
        for (const auto& define : variant.defines)
            macros.insert(define.first);
        const auto& has = element.abilities;
        if (ability.empty() || std::find(has.begin(), has.end(), ability) != has.end())
            variants.push_back(std::move(variant));
    }
    for (KernelVariant& variant : variants)
        for (const std::string& macro : macros)
            if (std::none_of(variant.defines.begin(), variant.defines.end(),
                             [&](const auto& define) { return define.first == macro; }))
                variant.defines.emplace_back(macro, "0");
    return variants;
}

ElementFile element_file(const std::string& path, std::string_view text)
{
    ElementFile out;
    out.path = path;
    out.stem = std::filesystem::path(path).stem().string();
    for (const std::string& line : directives(text, "corners"))
        out.corners = line == "2" ? 2 : line == "3" ? 3 : line == "4" ? 4 : 0;
    for (const std::string& line : directives(text, "methods"))
        out.methods = split(line);
    for (const std::string& line : directives(text, "with"))
        out.abilities.push_back(line);
    for (const std::string& line : directives(text, "collider"))
    {
        const std::vector<std::string> words = split(line);
        out.collider = words.empty() ? "" : words.front();
        const auto has = [&](std::string_view word) {
            return std::find(words.begin(), words.end(), word) != words.end();
        };
        out.has_values = has("values");
        out.has_faces = has("faces");
        if ((out.collider == "once" || out.collider == "each_substep") &&
            words.size() == 1u + out.has_values + out.has_faces)
            return out;
        refuse("shape " + path +
               ": expected \"//! collider once\" or \"//! collider each_substep\", and behind it \" values\" "
               "where the shape has a buffer of numbers and \" faces\" where triangles meet it");
    }
    if (out.corners == 0)
        refuse("element " + path + ": expected a line \"//! corners N\" with N from 2 to 4");
    if (out.methods.empty())
        refuse("element " + path + ": expected a line \"//! methods NAME ...\"");
    return out;
}

std::string each_of(std::string_view text)
{
    const std::vector<std::string> found = directives(text, "each");
    return found.empty() ? std::string() : found.front();
}

bool is_for(std::string_view each, const ElementFile& element)
{
    if (!element.collider.empty())
        return each == "collider" || (each == "collider with faces" && element.has_faces);
    return std::any_of(element.methods.begin(), element.methods.end(),
                       [&](const std::string& method) { return each == "element of " + method; });
}

std::string element_include(const ElementFile& element)
{
    return element.collider.empty() ? "TAUT_ELEMENT" : "TAUT_COLLIDER";
}

std::vector<std::pair<std::string, std::string>> element_defines(const ElementFile& element)
{
    if (!element.collider.empty())
        return {{"COLLIDER_STEM", element.stem},
                {"COLLIDER_POSES", element.collider == "each_substep" ? "1" : "0"},
                {"COLLIDER_VALUES", element.has_values ? "1" : "0"}};
    std::vector<std::pair<std::string, std::string>> out = {
        {"ELEMENT_STEM", element.stem}, {"ELEMENT_CORNERS", std::to_string(element.corners)}};
    for (const std::string& ability : element.abilities)
    {
        std::string name = "ELEMENT_WITH_" + ability;
        std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
            return static_cast<char>(std::toupper(c));
        });
        out.emplace_back(std::move(name), "1");
    }
    return out;
}

} // namespace taut
