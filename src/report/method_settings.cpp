#include "taut/report/method_settings.hpp"

#include "taut/scene/key_text.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/tables.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace taut {
namespace {

using Json = nlohmann::ordered_json;
using scene_file::Key;
using scene_file::kMethodTable;
using scene_file::value_of;

/// What the method of these settings reads and is not as by default.
Json details(const MethodSettings& settings)
{
    const MethodSet method = only(settings.type);
    MethodSettings usual;
    usual.release_strain = settings.activate_strain; // as a scene has it that says nothing
    Json out = Json::object();
    for (const Key& key : kMethodTable.keys)
        if ((key.readers & method) && key.name != "iterations")
            if (Json value = value_of(key, &settings); value != value_of(key, &usual))
                out[std::string(key.name)] = std::move(value);
    return out;
}

std::string counted(std::uint32_t n, const char* what)
{
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string_view>& words)
{
    std::string out;
    for (std::size_t k = 0; k < words.size(); ++k)
        out += (k == 0 ? "" : k + 1 < words.size() ? ", " : " and ") + std::string(words[k]);
    return out;
}

} // namespace

MethodKind method_named(std::string_view name)
{
    if (const std::optional<MethodKind> found = option_of<MethodKind>(name))
        return *found;
    throw Error(ErrorCode::bad_input, "there is no method \"" + std::string(name) + "\"; there is " +
                                          scene_file::listing(words_of<MethodKind>()));
}

int method_style(MethodKind kind) { return static_cast<int>(kind); }

MethodSettings settings_for(MethodKind kind, const MethodSettings& base)
{
    MethodSettings out = base;
    out.type = kind;
    if (out.type == base.type)
        return out;
    const MethodSettings usual;
    out.integrator = usual.integrator;
    out.scheme = usual.scheme;
    out.relaxation = usual.relaxation;
    out.spectral_radius = usual.spectral_radius;
    return out;
}

std::vector<MethodKind> methods_listed(const std::vector<std::string>& names)
{
    MethodSet set = 0;
    for (const std::string& name : names)
        set |= name == "all" ? kAllMethods : only(method_named(name));
    std::vector<MethodKind> out;
    for (std::size_t i = 0; i < kWords<MethodKind>.size(); ++i)
        if (set & only(static_cast<MethodKind>(i)))
            out.push_back(static_cast<MethodKind>(i));
    return out;
}

bool reads_iterations(MethodKind kind) { return kind != MethodKind::mass_spring; }

std::vector<std::string_view> keys_read(MethodKind kind)
{
    std::vector<std::string_view> out;
    for (const Key& key : kMethodTable.keys)
        if (key.readers & only(kind))
            out.push_back(key.name);
    return out;
}

std::vector<SceneIssue> unread_keys(const MethodSettings& settings, const std::vector<std::string>& given)
{
    std::vector<SceneIssue> out;
    const std::vector<std::string_view> read = keys_read(settings.type);
    const auto reads = [&](const std::string& name) {
        const Key* key = kMethodTable.find(name);
        return key && (key->readers == 0 || std::find(read.begin(), read.end(), name) != read.end());
    };
    for (const std::string& key : given)
        if (!reads(key))
            out.push_back({false, "method." + key,
                           "method " + quoted(settings.type) +
                               " does not read it; take it out (beside type, substeps and precision it "
                               "reads " +
                               listed(read) + ")"});
    return out;
}

std::string settings_details(const MethodSettings& settings)
{
    std::string out;
    const Json all = details(settings); // outlives the loop
    for (const auto& [key, value] : all.items())
        out += (out.empty() ? "" : ", ") + key + " " +
               (value.is_string() ? value.get<std::string>() : value.dump());
    return out;
}

std::string settings_block(const MethodSettings& settings)
{
    const auto or_automatic = [](std::uint32_t count) {
        return count == 0 ? Json("automatic") : Json(count);
    };
    Json json = {{"type", to_string(settings.type)}, {"substeps", or_automatic(settings.substeps)}};
    if (reads_iterations(settings.type) || settings.iterations > 1)
        json["iterations"] = or_automatic(settings.iterations);
    json["precision"] = to_string(settings.precision);
    json.update(details(settings));
    return json.dump();
}

std::string settings_text(const MethodSettings& settings)
{
    const auto so_many = [](std::uint32_t count, const std::string& what) {
        return count == 0 ? "automatic " + what + "s" : counted(count, what.c_str());
    };
    std::string text = std::string(to_string(settings.type)) + ", " + so_many(settings.substeps, "substep");
    if (reads_iterations(settings.type))
        text += " x " + so_many(settings.iterations, "iteration");
    const std::string more = settings_details(settings);
    return text + " in " + std::string(to_string(settings.precision)) + (more.empty() ? "" : ", " + more);
}

} // namespace taut
