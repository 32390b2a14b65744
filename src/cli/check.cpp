// taut check: everything that is wrong with a scene, by field. Runs nothing.

#include "taut/cli/command.hpp"
#include "taut/cli/output.hpp"
#include "taut/plan/plan.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/report/deep_vertices.hpp"
#include "taut/report/holes.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/mesh_issues.hpp"
#include "taut/scene/settings.hpp"
#include "taut/version.hpp"
#include "taut/world/crossed_start.hpp"
#include "taut/world/separate_start.hpp"

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>

namespace taut::cli {
namespace {

/// What taking surfaces apart does to a scene. Throws what separate_start() throws.
void add_separated(const Scene& resolved, std::vector<SceneIssue>& issues)
{
    const SeparatedStart found = separate_start(resolved);
    if (found.crossed.empty() && found.near == 0)
        return;
    issues.push_back({false, "contact.start",
                      "takes surfaces apart before the run; through each other: " +
                          (found.crossed.empty() ? "none" : found.crossed) +
                          "; nearer than their gap: " + std::to_string(found.near) + " pairs" +
                          (found.left > 0 ? ", afterwards still " + std::to_string(found.left) : "") +
                          "; no vertex moves further than " + shown(found.farthest, 3) + " m"});
}

/// What resolving and planning find beyond `issues`, which stay first. resolve() repeats what check() said.
void add_resolved(const Scene& scene, std::vector<SceneIssue>& issues)
{
    std::vector<SceneIssue> found;
    const auto take = [&] {
        for (const SceneIssue& f : found)
            if (std::none_of(issues.begin(), issues.end(),
                             [&](const SceneIssue& i) { return i.field == f.field && i.text == f.text; }))
                issues.push_back(f);
    };
    try
    {
        const Scene resolved = resolve(scene, &found);
        take();
        found = check_resolved(resolved);
        take();
        if (any_error(issues))
            return;
        found = plan_issues(resolved, DeviceTraits{});
        take();
        if (any_error(issues))
            return;
        for (const SceneIssue& issue : mesh_issues(resolved))
            issues.push_back(issue);
        for (const SceneIssue& issue : holes_issues(resolved))
            issues.push_back(issue);
        for (const SceneIssue& issue : deep_start_issues(resolved))
            issues.push_back(issue);
        for (const PlanWarning& warning : make_plan(resolved).warnings)
            issues.push_back({false, "", warning.sentence()});
        if (resolved.contact.start == ContactStart::separate)
            add_separated(resolved, issues);
        else if (const std::string crossed = crossed_at_start(resolved); !crossed.empty())
            issues.push_back({resolved.contact.start == ContactStart::refuse, "contact.start", crossed});
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::out_of_memory)
            throw;
        take();
        if (!any_error(issues))
            issues.push_back(issue_of(error));
    }
}

constexpr char kOfBody[] = "bodies[";

/// The body that a field is of, if it is of one.
std::optional<std::size_t> body_of(const std::string& field)
{
    if (!field.starts_with(kOfBody))
        return {};
    return std::stoul(field.substr(sizeof(kOfBody) - 1));
}

/// The numbers of the bodies that no error is of; none if one is of the scene itself, or of all bodies.
std::vector<std::size_t> sound_bodies(const Scene& scene, const std::vector<SceneIssue>& issues)
{
    std::set<std::size_t> faulty;
    for (const SceneIssue& issue : issues)
        if (const auto body = body_of(issue.field); body && issue.error)
            faulty.insert(*body);
        else if (issue.error)
            return {};
    std::vector<std::size_t> out;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (!faulty.contains(b))
            out.push_back(b);
    return out;
}

/// An error in a body's values hides what its mesh would show, and one in its mesh what a plan would: bodies
/// without any are looked at by themselves, until they show no more.
void add_hidden(const Scene& scene, std::vector<SceneIssue>& issues)
{
    for (bool more = any_error(issues); more;)
    {
        more = false;
        const std::vector<std::size_t> sound = sound_bodies(scene, issues);
        Scene others = scene;
        others.contact = {}; // what is asked of bodies together cannot be judged of some
        others.bodies.clear();
        for (const std::size_t b : sound)
            others.bodies.push_back(scene.bodies[b]);
        std::vector<SceneIssue> found;
        if (!sound.empty())
            add_resolved(others, found);
        for (SceneIssue& issue : found)
            if (const auto body = body_of(issue.field); body && issue.error)
            {
                issue.field.replace(0, issue.field.find(']'), kOfBody + std::to_string(sound.at(*body)));
                issues.push_back(issue);
                more = true;
            }
    }
}

/// From the file to the plan, as far as it goes. A file that cannot be read, or memory that runs out, is no
/// issue of a scene and is thrown on.
std::vector<SceneIssue> find_issues(const std::string& file)
{
    std::vector<SceneIssue> issues;
    try
    {
        Scene scene;
        std::vector<std::string> given;
        issues = check_file(file, &scene, &given);
        if (!any_error(issues))
        {
            for (const SceneIssue& unread : unread_keys(scene.method, given))
                issues.push_back(unread);
            add_resolved(scene, issues);
        }
        add_hidden(scene, issues);
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::io)
            throw;
        const std::string text = error.what();
        if (error.code() == ErrorCode::out_of_memory)
            throw Error(error.code(), text.starts_with(file + ":") ? text : file + ": " + text);
        issues.push_back({true, "", text});
    }
    return issues;
}

void print_json(const std::string& file, const std::vector<SceneIssue>& issues)
{
    Json list = Json::array();
    for (const SceneIssue& issue : issues)
        list.push_back({{"error", issue.error}, {"field", issue.field}, {"text", issue.text}});
    std::cout << to_text(
        {{"taut", TAUT_VERSION}, {"scene", file}, {"sound", !any_error(issues)}, {"issues", list}});
}

int check_as_json(const std::string& file)
{
    std::vector<SceneIssue> issues;
    Exit status = kDone;
    try
    {
        issues = find_issues(file);
        status = any_error(issues) ? kBadInput : kDone;
    }
    catch (const Error& error) // who reads JSON reads of it there
    {
        issues = {{true, "", error.what()}};
        status = exit_status(error.code());
    }
    print_json(file, issues);
    return status;
}

int check_scene(const std::string& file)
{
    const std::vector<SceneIssue> issues = find_issues(file);
    const bool bad = any_error(issues);
    for (const SceneIssue& issue : issues)
        std::cout << (issue.error ? "error: " : "warning: ")
                  << (issue.field.empty() ? "" : issue.field + ": ") << issue.text << "\n";
    if (!bad)
        std::cout << file << " is a sound scene" << (issues.empty() ? ".\n" : ", with the warnings above.\n");
    return bad ? kBadInput : kDone;
}

} // namespace

void add_check(CLI::App& app, Command& chosen)
{
    struct Options
    {
        std::string scene;
        bool json = false;
    };
    CLI::App* command = app.add_subcommand("check", "Say what is wrong with a scene, by field");
    const auto options = std::make_shared<Options>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options] {
        chosen = [options] {
            return options->json ? check_as_json(options->scene) : check_scene(options->scene);
        };
    });
}

} // namespace taut::cli
