// taut judge: what passes through what in frames of triangles, of a scene that it runs or of files.

#include "taut/judge/judge.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/report/report.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/frame_source.hpp"
#include "taut/scene/settings.hpp"
#include "taut/version.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct JudgeCommand
{
    fs::path input, mesh;
    std::string device;
    std::vector<std::string> settings;
    std::optional<std::uint32_t> frames;
    std::uint32_t every = 1;
    bool json = false;
};

/// The frames of a scene: its start and every step.
class SceneFrames : public FrameSource
{
public:
    explicit SceneFrames(const JudgeCommand& command)
        : file_(command.input.string()),
          world_(resolve_file(file_, command.settings, &issues_), open_device(command.device))
    {
        const Scene& scene = world_.scene();
        const double steps = std::ceil(scene.duration / scene.timestep - 1e-6);
        frames_ = 1 + static_cast<std::size_t>(command.frames ? *command.frames : std::max(steps, 0.0));
        all_ = judging::scene_triangles(scene);
    }

    std::size_t frames() const override { return frames_; }
    const std::vector<judging::Triangle>& triangles() const override { return all_.triangles; }
    std::vector<glm::dvec3> positions(std::size_t frame) override
    {
        while (world_.steps() < frame)
            world_.step();
        if (world_.torn() > 0)
            throw Error(ErrorCode::unsupported,
                        file_ + ": cloth tore in step " + std::to_string(frame) +
                            ", and its triangles are others now; judge the frames before "
                            "by --frames " +
                            std::to_string(frame - 1));
        return world_.positions();
    }
    std::string name(std::size_t frame) const override { return file_ + ", step " + std::to_string(frame); }
    std::vector<std::string> messages() const override
    {
        std::vector<std::string> texts;
        for (const SceneIssue& issue : issues_)
            texts.push_back((issue.field.empty() ? "" : issue.field + ": ") + issue.text);
        return texts;
    }
    const judging::SceneTriangles& all() const { return all_; }
    StepReport report() const { return measure(world_); } ///< of the last step that was taken

private:
    std::string file_;
    std::vector<SceneIssue> issues_; ///< warnings of what was read
    World world_;
    std::size_t frames_ = 0;
    judging::SceneTriangles all_;
};

std::unique_ptr<FrameSource> open_input(const JudgeCommand& command)
{
    std::error_code ignored;
    const std::string extension = command.input.extension().string();
    if (!fs::exists(command.input, ignored))
        throw Error(ErrorCode::io,
                    "there is no " + command.input.string() +
                        "; name a scene (.json), a folder of .obj files or a point cache (.pc2)");
    if (extension != ".json" && !(command.settings.empty() && command.device.empty()))
        throw Error(ErrorCode::bad_input, "--set and --device go with a scene (.json) alone");
    const bool cache = extension == ".pc2", folder = fs::is_directory(command.input, ignored);
    if (cache == command.mesh.empty())
        throw Error(ErrorCode::bad_input, cache
                                              ? "a point cache needs --mesh, the mesh whose vertices it moves"
                                              : "--mesh goes with a point cache (.pc2) alone");
    if (cache)
        return open_point_cache(command.input, command.mesh);
    if (folder)
        return open_frame_folder(command.input);
    if (extension != ".json")
        throw Error(ErrorCode::bad_input, command.input.string() +
                                              " is not judged; name a scene (.json), a folder "
                                              "of .obj files or a point cache (.pc2)");
    return std::make_unique<SceneFrames>(command);
}

/// What a frame is and what went on between it and the one before.
struct Judged
{
    std::size_t frame = 0;
    judging::FrameVerdict verdict;
    bool relinked = false;                ///< a linking number is not what it was
    std::vector<judging::Passing> passed; ///< on the way from the frame before, if that was looked at

    bool clean() const { return verdict.intersecting == 0 && !relinked && passed.empty(); }
};

/// Whether a number differs from the last known one, which it becomes.
bool relinked(std::vector<std::optional<int>>& known, const std::vector<std::optional<int>>& now)
{
    bool any = false;
    known.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
        if (now[k])
        {
            any = any || (known[k] && known[k] != now[k]);
            known[k] = now[k];
        }
    return any;
}

/// Of a judging::Nearest or a judging::Passing.
std::string feature_text(const auto& n, const judging::Surface& surface)
{
    const auto edge = [&](std::uint32_t e) {
        return "edge " + std::to_string(surface.edges[e][0]) + "-" + std::to_string(surface.edges[e][1]);
    };
    return n.edges ? edge(n.a) + ", " + edge(n.b)
                   : "vertex " + std::to_string(n.a) + ", triangle " + std::to_string(n.b);
}

Json verdict_json(const Judged& judged, const FrameSource& input, const judging::Surface& surface)
{
    const judging::FrameVerdict& v = judged.verdict;
    Json linking = Json::array();
    for (const std::optional<int>& number : v.linking)
        linking.push_back(number ? Json(*number) : Json());
    Json json = {{"frame", judged.frame},
                 {"name", input.name(judged.frame)},
                 {"intersecting_pairs", v.intersecting},
                 {"first_pairs", v.first_pairs},
                 {"min_distance", known(v.nearest.distance)},
                 {"min_distance_at", v.nearest.distance < 0 ? "" : feature_text(v.nearest, surface)},
                 {"min_distance_of_parts", known(v.nearest_parts.distance)},
                 {"stretch", v.stretch},
                 {"stretch_at", surface.edges.empty() ? judging::Edge{} : surface.edges[v.stretched_edge]},
                 {"volume_change", known(v.volume_change)},
                 {"linking", linking},
                 {"linking_changed", judged.relinked},
                 {"passed", judged.passed.size()},
                 {"first_passed_at",
                  judged.passed.empty() ? Json() : Json(feature_text(judged.passed.front(), surface))}};
    return json;
}

/// Calls `act`; what it throws names the frame.
template <class Act>
auto naming_frame(const FrameSource& input, std::size_t frame, const Act& act)
{
    try
    {
        return act();
    }
    catch (const Error& error)
    {
        const std::string text = error.what(), name = input.name(frame);
        throw Error(error.code(), text.starts_with(name) ? text : name + ": " + text);
    }
}

struct Findings
{
    std::vector<Judged> frames;
    std::size_t wanted = 0; ///< so many frames were to be judged
};

/// Judges every frame that is due, until the end or Ctrl-C.
Findings judge_all(const JudgeCommand& command, FrameSource& input, const judging::Judge& judge,
                   const std::vector<glm::dvec3>& first)
{
    const InterruptGuard guard;
    Findings out;
    std::vector<glm::dvec3> before;
    std::vector<std::optional<int>> linked; // as last known, pair by pair
    std::size_t frames = input.frames();
    if (command.frames)
        frames = std::min<std::size_t>(frames, std::size_t{*command.frames} + 1);
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
        if (frame % command.every != 0 && frame + 1 != frames)
            continue;
        ++out.wanted;
        if (guard.interrupted())
            continue;
        naming_frame(input, frame, [&] {
            std::vector<glm::dvec3> now = frame == 0 ? first : input.positions(frame);
            Judged judged{frame, judge.look(now), false, {}};
            if (!out.frames.empty() &&
                out.frames.back().frame + 1 == frame) // else the way was hardly straight
                judged.passed = judge.between(before, now);
            before = std::move(now);
            judged.relinked = relinked(linked, judged.verdict.linking);
            out.frames.push_back(std::move(judged));
        });
    }
    return out;
}

std::string percent_or_dash(double share) { return share < 0 ? "-" : shown_percent(share); }
std::string distance_text(const judging::Nearest& n)
{
    return n.distance < 0 ? "-" : number(n.distance, 3) + " m";
}

/// The first crossing of a frame, and the first between two.
void print_first(const std::vector<Judged>& all, const FrameSource& input, const judging::Surface& surface)
{
    const auto crossed =
        std::find_if(all.begin(), all.end(), [](const Judged& j) { return j.verdict.intersecting > 0; });
    if (crossed != all.end())
    {
        std::cout << input.name(crossed->frame) << ": triangles";
        for (const auto& [a, b] : crossed->verdict.first_pairs)
            std::cout << " " << a << "/" << b;
        std::cout << (crossed->verdict.intersecting > crossed->verdict.first_pairs.size() ? " ...\n" : "\n");
    }
    const auto passed =
        std::find_if(all.begin(), all.end(), [](const Judged& j) { return !j.passed.empty(); });
    if (passed != all.end())
        std::cout << "before " << input.name(passed->frame) << ": "
                  << feature_text(passed->passed.front(), surface) << " pass through each other\n";
}

/// The head, and of many frames those with something to say: the first, the last, and where it changes.
void print(const std::vector<Judged>& all, const FrameSource& input, const judging::Surface& surface)
{
    std::vector<std::vector<std::string>> rows{{"frame", "intersecting pairs", "passed", "least distance",
                                                "of parts", "stretch", "volume", "linking"}};
    for (std::size_t k = 0; k < all.size(); ++k)
    {
        const judging::FrameVerdict& v = all[k].verdict;
        const bool same = k > 0 && k + 1 < all.size() && !all[k].relinked &&
                          (v.intersecting > 0) == (all[k - 1].verdict.intersecting > 0) &&
                          all[k].passed.empty() == all[k - 1].passed.empty();
        if (same)
            continue;
        rows.push_back({std::to_string(all[k].frame), std::to_string(v.intersecting),
                        std::to_string(all[k].passed.size()), distance_text(v.nearest),
                        distance_text(v.nearest_parts), percent_or_dash(v.stretch),
                        percent_or_dash(v.volume_change),
                        all[k].relinked               ? "changed"
                        : v.linking.empty() || k == 0 ? "-"
                                                      : "as before"});
    }
    std::cout << surface.triangles.size() << " triangles in " << surface.parts << " parts, "
              << surface.borders.size() << " borders\n"
              << table(rows);
    print_first(all, input, surface);
}

std::string frames_text(std::size_t count)
{
    return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

void print_answer(const Findings& found, std::size_t bad, const StepReport* run)
{
    const std::string frames = frames_text(found.frames.size());
    std::cout << (bad == 0 ? "Nothing passes through anything in " + frames + ".\n"
                           : "In " + std::to_string(bad) + " of " + frames +
                                 " something passes through, or has passed since the frame before.\n");
    if (found.frames.size() < found.wanted)
        std::cout << "Interrupted: " << frames_text(found.wanted) << " were to be judged.\n";
    if (run && !sound(run->status))
        std::cout << "The run itself is " << to_string(run->status) << ": " << run->reason << "\n";
}

int judge_input(const JudgeCommand& command)
{
    const auto input = open_input(command);
    const std::vector<std::string> messages = input->messages();
    std::for_each(messages.begin(), messages.end(), warn);
    const std::vector<glm::dvec3> first = input->positions(0);
    const auto* scene = dynamic_cast<const SceneFrames*>(input.get());
    const judging::SceneTriangles all = scene ? scene->all() : judging::SceneTriangles{};
    const judging::Judge judge = naming_frame(
        *input, 0, [&] { return judging::Judge(input->triangles(), first, all.led, all.passing); });
    const Findings found = judge_all(command, *input, judge, first);
    const auto bad = static_cast<std::size_t>(
        std::count_if(found.frames.begin(), found.frames.end(), [](const Judged& j) { return !j.clean(); }));
    const std::optional<StepReport> run = scene ? std::optional(scene->report()) : std::nullopt;
    if (command.json)
    {
        Json list = Json::array();
        for (const Judged& judged : found.frames)
            list.push_back(verdict_json(judged, *input, judge.surface()));
        std::cout << to_text({{"taut", TAUT_VERSION},
                              {"input", command.input.string()},
                              {"status", run ? Json(to_string(run->status)) : Json()},
                              {"frames", found.frames.size()},
                              {"frames_wanted", found.wanted},
                              {"frames_with_crossings", bad},
                              {"messages", messages},
                              {"judged", list}});
    }
    else
    {
        print(found.frames, *input, judge.surface());
        print_answer(found, bad, run ? &*run : nullptr);
    }
    const bool whole = found.frames.size() == found.wanted;
    return bad == 0 && whole && (!run || sound(run->status)) ? kDone : kNotSound;
}

} // namespace

void add_judge(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("judge", "Find triangles that pass through each other, frame by frame");
    const auto options = std::make_shared<JudgeCommand>();
    command
        ->add_option("input", options->input,
                     "Scene (.json, is run), folder of .obj files, or point cache (.pc2)")
        ->required();
    command->add_option("--mesh", options->mesh, "Mesh whose vertices a point cache moves");
    add_device_option(*command, options->device);
    command->add_option("--set", options->settings, "key=value of the scene, as often as needed");
    command->add_option("--frames", options->frames, "Frames after the first; of a scene: steps")
        ->check(whole_number(0));
    command->add_option("--every", options->every, "Judge every n-th frame, and the last")
        ->check(whole_number(1));
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return judge_input(*options); }; });
}

} // namespace taut::cli
