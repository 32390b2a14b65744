#include "taut/report/method_settings.hpp"

#include "taut/scene/keys.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace taut {
namespace {

using Json = nlohmann::ordered_json;

constexpr MethodSet kSolvers =
    only(MethodKind::implicit_euler) | only(MethodKind::implicit_constraints) | only(MethodKind::acad);
constexpr MethodSet kConstraints = only(MethodKind::implicit_constraints) | only(MethodKind::acad);

struct Setting
{
    const char* key;
    MethodSet methods; ///< that read it
    Json (*value)(const MethodSettings&);
};

Json compliance(const MethodSettings& m)
{
    return m.constraint_compliance < 0 ? Json("material") : Json(m.constraint_compliance);
}

// clang-format off
constexpr Setting kSettings[] = {
    // The others refuse what is not "semi_implicit".
    {"integrator", only(MethodKind::mass_spring) | kConstraints,
     [](const MethodSettings& m) { return Json(m.integrator); }},
    {"stability", only(MethodKind::mass_spring) | kConstraints,
     [](const MethodSettings& m) { return Json(m.stability); }},
    {"scheme", only(MethodKind::mass_spring) | only(MethodKind::pbd),
     [](const MethodSettings& m) { return Json(m.scheme); }},
    {"stretch", only(MethodKind::pbd), [](const MethodSettings& m) { return Json(m.stretch); }},
    {"bend", only(MethodKind::pbd), [](const MethodSettings& m) { return Json(m.bend); }},
    {"volume", only(MethodKind::pbd), [](const MethodSettings& m) { return Json(m.volume); }},
    {"relaxation", only(MethodKind::pbd) | only(MethodKind::vbd),
     [](const MethodSettings& m) { return Json(m.relaxation); }},
    {"linear_iterations", kSolvers, [](const MethodSettings& m) { return Json(m.linear_iterations); }},
    {"linear_tolerance", kSolvers, [](const MethodSettings& m) { return Json(m.linear_tolerance); }},
    {"linear_operator", only(MethodKind::implicit_euler) | only(MethodKind::implicit_constraints),
     [](const MethodSettings& m) { return Json(m.linear_operator); }},
    {"line_search", only(MethodKind::implicit_euler),
     [](const MethodSettings& m) { return Json(m.line_search); }},
    {"constrained", kConstraints, [](const MethodSettings& m) { return Json(m.constrained); }},
    {"constraint_compliance", kConstraints, compliance},
    {"activate_strain", only(MethodKind::acad),
     [](const MethodSettings& m) { return Json(m.activate_strain); }},
    {"release_strain", only(MethodKind::acad),
     [](const MethodSettings& m) { return Json(m.release_strain); }},
    {"release", only(MethodKind::acad), [](const MethodSettings& m) { return Json(m.release); }},
    {"target", only(MethodKind::acad), [](const MethodSettings& m) { return Json(m.target); }},
    {"compress", only(MethodKind::acad), [](const MethodSettings& m) { return Json(m.compress); }},
    {"start", only(MethodKind::vbd), [](const MethodSettings& m) { return Json(m.start); }},
    {"spectral_radius", only(MethodKind::vbd) | only(MethodKind::pbd),
     [](const MethodSettings& m) { return Json(m.spectral_radius); }},
};
// clang-format on

/// What the method of these settings reads and is not as by default.
Json details(const MethodSettings& settings)
{
    const MethodSet method = only(method_named(settings.type));
    MethodSettings usual;
    usual.release_strain = settings.activate_strain; // as a scene has it that says nothing
    Json out = Json::object();
    for (const Setting& setting : kSettings)
        if ((setting.methods & method) && setting.value(settings) != setting.value(usual))
            out[setting.key] = setting.value(settings);
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
    const auto found = std::find(kMethodNames.begin(), kMethodNames.end(), name);
    if (found == kMethodNames.end())
        throw Error(ErrorCode::bad_input, "there is no method \"" + std::string(name) + "\"; there is " +
                                              scene_file::listing(kMethodNames));
    return static_cast<MethodKind>(found - kMethodNames.begin());
}

std::string_view method_name(MethodKind kind) { return kMethodNames[static_cast<std::size_t>(kind)]; }

int method_style(std::string_view name) { return static_cast<int>(method_named(name)); }

MethodSettings settings_for(MethodKind kind, const MethodSettings& base)
{
    MethodSettings out = base;
    out.type = std::string(method_name(kind));
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
    for (std::size_t i = 0; i < kMethodNames.size(); ++i)
        if (set & only(static_cast<MethodKind>(i)))
            out.push_back(static_cast<MethodKind>(i));
    return out;
}

bool reads_iterations(MethodKind kind) { return kind != MethodKind::mass_spring; }

std::vector<std::string_view> keys_read(MethodKind kind)
{
    std::vector<std::string_view> out = {"iterations"}; // mass_spring: of the volume within a surface
    for (const Setting& setting : kSettings)
        if (setting.methods & only(kind))
            out.push_back(setting.key);
    return out;
}

std::vector<SceneIssue> unread_keys(const MethodSettings& settings, const std::vector<std::string>& given)
{
    const auto type = std::find(kMethodNames.begin(), kMethodNames.end(), settings.type);
    std::vector<SceneIssue> out;
    if (type == kMethodNames.end())
        return out;
    const std::vector<std::string_view> read =
        keys_read(static_cast<MethodKind>(type - kMethodNames.begin()));
    const auto among = [](const auto& keys, const std::string& key) {
        return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
    };
    constexpr std::string_view kCommon[] = {"type", "substeps", "precision"};
    for (const std::string& key : given)
        if (!among(kCommon, key) && !among(read, key))
            out.push_back({false, "method." + key,
                           "method \"" + settings.type +
                               "\" does not read it; take it out (beside type, substeps and precision it "
                               "reads " + listed(read) + ")"});
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
    const Json substeps = settings.substeps == 0 ? Json("automatic") : Json(settings.substeps);
    Json json = {{"type", settings.type}, {"substeps", substeps}};
    if (reads_iterations(method_named(settings.type)) || settings.iterations != 1)
        json["iterations"] = settings.iterations;
    json["precision"] = settings.precision;
    json.update(details(settings));
    return json.dump();
}

std::string settings_text(const MethodSettings& settings)
{
    const bool automatic = settings.substeps == 0;
    std::string text =
        settings.type + ", " + (automatic ? "automatic substeps" : counted(settings.substeps, "substep"));
    if (reads_iterations(method_named(settings.type)))
        text += " x " + counted(settings.iterations, "iteration");
    const std::string more = settings_details(settings);
    return text + " in " + settings.precision + (more.empty() ? "" : ", " + more);
}

} // namespace taut
