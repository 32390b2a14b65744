// taut judge: what passes through what in frames of triangles, of a scene that it runs or of files.

#include "taut/judge/judge.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/judge/sequence.hpp"
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
class SceneFrames : public judging::Sequence
{
public:
    explicit SceneFrames(const JudgeCommand& command)
        : file_(command.input.string()),
          world_(resolve_file(file_, command.settings), open_device(command.device))
    {
        const Scene& scene = world_.scene();
        const double steps = std::ceil(scene.duration / scene.timestep - 1e-6);
        frames_ = 1 + static_cast<std::size_t>(command.frames ? *command.frames : std::max(steps, 0.0));
        std::uint32_t first = 0;
        for (const Body& body : scene.bodies)
        {
            for (judging::Triangle t : body.mesh.triangles)
            {
                for (std::uint32_t& v : t)
                    v += first;
                triangles_.push_back(t);
            }
            first += static_cast<std::uint32_t>(body.mesh.positions.size());
        }
    }

    std::size_t frames() const override { return frames_; }
    const std::vector<judging::Triangle>& triangles() const override { return triangles_; }
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

private:
    std::string file_;
    World world_;
    std::size_t frames_ = 0;
    std::vector<judging::Triangle> triangles_;
};

std::unique_ptr<judging::Sequence> open_input(const JudgeCommand& command)
{
    std::error_code ignored;
    const std::string extension = command.input.extension().string();
    const bool cache = extension == ".pc2", folder = fs::is_directory(command.input, ignored);
    if (cache == command.mesh.empty())
        throw Error(ErrorCode::bad_input, cache
                                              ? "a point cache needs --mesh, the mesh whose vertices it moves"
                                              : "--mesh goes with a point cache (.pc2) alone");
    if (cache)
        return judging::open_point_cache(command.input, command.mesh);
    if (folder)
        return judging::open_folder(command.input);
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

bool changed(const std::vector<std::optional<int>>& before, const std::vector<std::optional<int>>& after)
{
    for (std::size_t k = 0; k < std::min(before.size(), after.size()); ++k)
        if (before[k] && after[k] && before[k] != after[k])
            return true;
    return false;
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

Json verdict_json(const Judged& judged, const judging::Sequence& input, const judging::Surface& surface)
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

/// Judges every frame that is due, until the end or Ctrl-C.
std::vector<Judged> judge_all(const JudgeCommand& command, judging::Sequence& input,
                              const judging::Judge& judge, const std::vector<glm::dvec3>& first)
{
    const InterruptGuard guard;
    std::vector<Judged> all;
    std::vector<glm::dvec3> before;
    std::size_t frames = input.frames();
    if (command.frames)
        frames = std::min<std::size_t>(frames, std::size_t{*command.frames} + 1);
    for (std::size_t frame = 0; frame < frames && !guard.interrupted(); ++frame)
    {
        if (frame % command.every != 0 && frame + 1 != frames)
            continue;
        try
        {
            std::vector<glm::dvec3> now = frame == 0 ? first : input.positions(frame);
            Judged judged{frame, judge.look(now)};
            if (!all.empty() && all.back().frame + 1 == frame) // else the way was hardly straight
                judged.passed = judge.between(before, now);
            before = std::move(now);
            judged.relinked = !all.empty() && changed(all.back().verdict.linking, judged.verdict.linking);
            all.push_back(std::move(judged));
        }
        catch (const Error& error)
        {
            const std::string text = error.what(), name = input.name(frame);
            throw Error(error.code(), text.starts_with(name) ? text : name + ": " + text);
        }
    }
    return all;
}

std::string percent(double share) { return share < 0 ? "-" : number(100 * share, 3) + " %"; }
std::string distance_text(const judging::Nearest& n)
{
    return n.distance < 0 ? "-" : number(n.distance, 3) + " m";
}

/// The first crossing of a frame, and the first between two.
void print_first(const std::vector<Judged>& all, const judging::Sequence& input,
                 const judging::Surface& surface)
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
void print(const std::vector<Judged>& all, const judging::Sequence& input, const judging::Surface& surface)
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
                        distance_text(v.nearest_parts), percent(v.stretch), percent(v.volume_change),
                        all[k].relinked     ? "changed"
                        : v.linking.empty() ? "-"
                                            : "as before"});
    }
    std::cout << surface.triangles.size() << " triangles in " << surface.parts << " parts, "
              << surface.borders.size() << " borders\n"
              << table(rows);
    print_first(all, input, surface);
}

int judge_input(const JudgeCommand& command)
{
    const auto input = open_input(command);
    const std::vector<glm::dvec3> first = input->positions(0);
    const judging::Judge judge(input->triangles(), first);
    const std::vector<Judged> all = judge_all(command, *input, judge, first);
    const auto bad = std::count_if(all.begin(), all.end(), [](const Judged& j) { return !j.clean(); });
    if (command.json)
    {
        Json list = Json::array();
        for (const Judged& judged : all)
            list.push_back(verdict_json(judged, *input, judge.surface()));
        std::cout << to_text({{"taut", TAUT_VERSION},
                              {"input", command.input.string()},
                              {"frames", all.size()},
                              {"frames_with_crossings", bad},
                              {"judged", list}});
    }
    else
    {
        print(all, *input, judge.surface());
        std::cout << (bad == 0
                          ? "Nothing passes through anything in " + std::to_string(all.size()) + " frames.\n"
                          : "In " + std::to_string(bad) + " of " + std::to_string(all.size()) +
                                " frames something passes through, or has passed since the frame before.\n");
    }
    return bad == 0 ? kDone : kNotSound;
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
