// taut run: simulates a scene; writes meshes, a report and pictures.

#include "taut/cli/command.hpp"
#include "taut/cli/contact_watch.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/mesh_sequence.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/pictures.hpp"
#include "taut/cli/progress.hpp"
#include "taut/cli/run_result.hpp"
#include "taut/cli/simulation.hpp"
#include "taut/cli/tunnelling.hpp"
#include "taut/report/energy_lost.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/residuals.hpp"
#include "taut/report/soundness_watch.hpp"
#include "taut/report/warnings.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/embedding.hpp"
#include "taut/scene/mesh_issues.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <utility>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct RunCommand
{
    std::string scene;
    SimulationOptions simulation;
    std::vector<std::string> settings;
    fs::path folder;
    std::optional<std::uint32_t> frames, every;
    bool json = false, no_picture = false;
};

std::uint64_t frame_count(const RunCommand& options, const Scene& scene)
{
    if (options.frames)
        return *options.frames;
    // 4 s of 1/60 s are 240 frames, whatever the last bit of the quotient says.
    const double frames = std::ceil(scene.duration / scene.timestep - 1e-6);
    if (!(frames < std::numeric_limits<std::uint32_t>::max()))
        throw Error(ErrorCode::bad_input, options.scene + ": duration " + number(scene.duration) +
                                              " s has more than " +
                                              "4294967295 time steps; shorten it or give --frames.");
    return static_cast<std::uint64_t>(std::max(frames, 0.0));
}

/// About thirty meshes a simulated second, unless --every says otherwise; 0 = none.
std::uint64_t mesh_interval(const RunCommand& options, const Scene& scene)
{
    if (options.every)
        return *options.every;
    return static_cast<std::uint64_t>(std::max(1.0, std::round(1.0 / (30 * scene.timestep))));
}

/// What an earlier run left: a folder with a report always holds the run of that report.
void forget_older_run(const fs::path& folder)
{
    for (const char* name : {"report.json", "picture.png", "contact_sheet.png"})
    {
        std::error_code error;
        fs::remove(folder / name, error);
        if (error)
            throw Error(ErrorCode::io,
                        "cannot replace " + (folder / name).string() + ": " + error.message() + ".");
    }
}

/// The loop over frames, with what it keeps on the way.
class Runner
{
public:
    Runner(const RunCommand& options, Simulation& simulation, std::uint64_t frames)
        : options_(options),
          simulation_(simulation),
          frames_(frames),
          every_(mesh_interval(options, simulation.scene())),
          moment_frames_(options.no_picture ? std::vector<std::uint64_t>{} : moment_frames(frames)),
          meshes_(options.folder),
          series_(frames),
          watch_(frames),
          tunnelling_(simulation, frames),
          contact_(simulation, frames)
    {
        if (simulation.solvers() > 0)
            stretchable_ = stretchable(simulation.scene());
    }

    /// Up to the last frame, an interruption, energy from nowhere or a value that is not finite.
    void run(const InterruptGuard& guard)
    {
        Progress progress(frames_);
        look();
        keep();
        while (goes_on(guard))
        {
            step();
            if (goes_on(guard))
                keep();
            progress.update(done_);
        }
        if (done_ > 0)
            keep_last();
        meshes_.remove_older();
    }

    std::uint64_t done() const { return done_; }
    std::size_t mesh_count() const { return meshes_.count(); }
    const std::vector<double>& step_ms() const { return step_ms_; }
    /// The smallest V / V0 of all frames.
    double volume_min() const { return volume_.least; }
    const std::vector<PictureMoment>& moments() const { return moments_; }
    const std::vector<TimeSample>& series() const { return series_.list(); }
    const SoundnessWatch& watch() const { return watch_; }
    const Crossings& crossings() const { return tunnelling_.found(); }
    const ContactWatch& contact() const { return contact_; }

private:
    bool goes_on(const InterruptGuard& guard) const
    {
        return done_ < frames_ && finite_ && watch_.found().sound() && !guard.interrupted();
    }

    void step()
    {
        const auto start = std::chrono::steady_clock::now();
        simulation_.step();
        step_ms_.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        ++done_;
        if (volume_.any)
            volume_.least =
                std::min(volume_.least, measure_volume(simulation_.scene(), simulation_.positions()).least);
        finite_ = simulation_.events().non_finite == 0;
        if (finite_ && watch_.due(done_)) // whole() may have to put it together
            watch_.after(done_, simulation_.whole());
        if (finite_ && series_.due(done_))
            look();
        if (!finite_)
            return;
        tunnelling_.after(done_);
        contact_.after(done_);
    }

    /// Of methods that solve linear systems, which neither sleep nor let springs flow.
    void look()
    {
        if (simulation_.solvers() == 0)
            return;
        if (simulation_.torn() != looked_torn_)
            stretchable_ = stretchable(simulation_.scene());
        looked_torn_ = simulation_.torn();
        const double stretch =
            largest_stretch(stretchable_.springs, simulation_.positions(), stretchable_.elements);
        series_.add(done_, simulation_.time(), stretch, simulation_.active_share(),
                    simulation_.solver_report());
    }

    /// The mesh and the moment of a frame, where they are due.
    void keep()
    {
        const bool mesh = every_ != 0 && done_ % every_ == 0;
        const bool moment = std::binary_search(moment_frames_.begin(), moment_frames_.end(), done_);
        write(mesh, moment);
    }

    /// The frame at which it ended, due or not.
    void keep_last() { write(every_ != 0, !options_.no_picture); }

    void write(bool mesh, bool moment)
    {
        if (!mesh && !moment)
            return;
        std::vector<glm::dvec3> positions = simulation_.positions();
        const std::optional<std::uint64_t> torn = simulation_.torn();
        if (mesh && std::exchange(meshes_torn_, torn) != torn)
            meshes_.set_scene(simulation_.scene());
        if (moment && std::exchange(moment_torn_, torn) != torn)
            moment_scene_ = std::make_shared<const Scene>(simulation_.scene());
        if (mesh)
            meshes_.write(shown_positions(simulation_.scene(), positions), done_, simulation_.time());
        if (moment)
            moments_.push_back({simulation_.time(), std::move(positions), moment_scene_});
    }

    const RunCommand& options_;
    Simulation& simulation_;
    std::uint64_t frames_, every_, done_ = 0;
    bool finite_ = true;
    std::vector<std::uint64_t> moment_frames_;
    std::vector<double> step_ms_;
    std::vector<PictureMoment> moments_;
    MeshSequence meshes_;
    VolumeReport volume_ = measure_volume(simulation_.scene(), simulation_.positions());
    TimeSeries series_;
    SoundnessWatch watch_;
    TunnelWatch tunnelling_;
    ContactWatch contact_;
    Stretchable stretchable_; ///< where looks are wanted
    std::uint64_t looked_torn_ = 0;
    std::optional<std::uint64_t> meshes_torn_;  ///< torn() of the scene that `meshes_` know
    std::optional<std::uint64_t> moment_torn_;  ///< that of `moment_scene_`
    std::shared_ptr<const Scene> moment_scene_;
};

/// Device times by effect: the median of three further frames. Timestamps never touch what was simulated,
/// because everything has been measured and written before.
std::vector<EffectTime> time_passes(World& world)
{
    const std::vector<EffectTime> samples[3] = {world.step_timed(), world.step_timed(), world.step_timed()};
    std::vector<EffectTime> passes;
    for (std::size_t p = 0; p < samples[0].size(); ++p)
    {
        double times[3];
        for (int s = 0; s < 3; ++s)
            times[s] = samples[s][p].milliseconds;
        std::sort(std::begin(times), std::end(times));
        if (samples[0][p].dispatches > 0) // an effect may own buffers and no pass
            passes.push_back({samples[0][p].name, samples[0][p].dispatches, times[1]});
    }
    return passes;
}

RunResult describe(const RunCommand& options, const World& world, const Runner& runner)
{
    RunResult result;
    result.scene = options.scene;
    result.folder = options.folder.string();
    result.device = world.device().info();
    result.counters = world.device().counters();
    result.precision = world.plan().precision;
    result.frames = runner.done();
    result.vertices = world.plan().vertex_count;
    result.constraints = world.plan().constraint_counts();
    result.colours = world.plan().colour_counts();
    result.solvers = world.plan().solvers.size();
    result.report = measure(world);
    result.energy_takers = energy_takers(world.scene());
    result.series = runner.series();
    result.crossings = runner.crossings();
    result.volume_min = runner.volume_min();
    result.step_ms = runner.step_ms();
    for (const PlanWarning& warning : world.plan().warnings)
        result.messages.push_back(warning.sentence());
    result.meshes = runner.mesh_count();
    return result;
}

/// Where the world that is measured did not run: it counted nothing.
void describe_counts(const Simulation& simulation, RunResult& result)
{
    if (simulation.is_whole())
        return;
    simulation.take_contacts(result.report);
    const Events events = simulation.events();
    add_warnings(events, result.report.warnings);
    result.report.solver = simulation.solver_report();
    count(Warning::iteration_limit, result.report.solver.limited, result.report.warnings);
    count(Warning::solve_failed, result.report.solver.failed, result.report.warnings);
    if (events.non_finite > 0)
        set_status({Status::non_finite,
                    "displacements were not finite " + std::to_string(events.non_finite) + " times"},
                   result.report);
    const double substeps = static_cast<double>(result.frames) * simulation.substeps();
    const auto vertices = static_cast<double>(result.vertices);
    set_status(judge_clamps(simulation.scene(), events, substeps * vertices), result.report);
}

/// What the looks on the way found, beside the state at the end.
void describe_soundness(const Runner& runner, RunResult& result)
{
    set_status(runner.watch().found(), result.report);
    count(Warning::unconverged, runner.watch().unconverged(), result.report.warnings);
}

/// A hybrid run: who did what.
void describe_parts(const Simulation& simulation, RunResult& result)
{
    result.parts = simulation.parts();
    if (result.parts.empty())
        return;
    result.device.executor = "hybrid";
    result.device.name = result.parts[0].device.name + " and " + result.parts[1].device.name;
}

/// What went wrong is worth a look, too, where there is a place for every vertex.
bool drawable(Status status) { return sound(status) || status == Status::unconverged; }

void draw(const RunCommand& options, const World& world, const std::shared_ptr<Device>& device,
          const Runner& runner, RunResult& result)
{
    std::string why_not;
    result.pictures = draw_pictures(world, device, runner.moments(), options.folder, why_not);
    if (!why_not.empty())
        result.messages.push_back(why_not);
}

RunResult simulate(const RunCommand& options, Scene scene, const InterruptGuard& guard)
{
    const std::unique_ptr<Simulation> simulation =
        naming(options.scene, [&] { return open_simulation(options.simulation, scene); });
    const std::uint64_t frames = frame_count(options, scene);
    scene = Scene(); // the simulation has its own
    make_folder(options.folder);
    forget_older_run(options.folder);
    Runner runner(options, *simulation, frames);
    runner.run(guard);

    World& world = simulation->whole();
    const auto device = world.device().shared_from_this();
    RunResult result = describe(options, world, runner);
    describe_counts(*simulation, result);
    describe_soundness(runner, result);
    describe_parts(*simulation, result);
    describe_crossings(result.crossings, result.report.warnings, result.messages);
    runner.contact().describe(result.report, result.messages);
    result.asleep = simulation->asleep();
    result.frames_wanted = frames;
    if (runner.done() < frames && sound(result.report.status))
        result.report.status = Status::interrupted;
    if (!options.no_picture && drawable(result.report.status))
        draw(options, world, device, runner, result);
    if (rank(result.report.status) < rank(Status::diverged) && !guard.interrupted() &&
        runner.done() == frames)
    {
        if (frames > 0) // where nothing was solved, nothing was left unsolved
            judge_residuals(world.scene(), residuals_ahead(world), result.report);
        if (result.parts.empty())
            result.passes = time_passes(world);
    }
    return result;
}

int run(RunCommand options)
{
    std::vector<SceneIssue> issues;
    Scene scene = resolve_file(options.scene, options.settings, &issues);
    for (const auto& more :
         {unread_keys(scene.method, given_method_keys(options.scene, options.settings)), mesh_issues(scene)})
        issues.insert(issues.end(), more.begin(), more.end());
    if (options.folder.empty())
        options.folder = fs::path("out") / fs::path(options.scene).stem();
    const InterruptGuard guard; // until the report is written
    RunResult result = simulate(options, std::move(scene), guard);
    for (const SceneIssue& issue : issues)
        result.messages.push_back((issue.field.empty() ? "" : issue.field + ": ") + issue.text);
    const std::string report = to_text(to_json(result));
    write_file(options.folder / "report.json", report);
    std::cout << (options.json ? report : summary(result));
    return exit_status(result.report.status);
}

} // namespace

void add_run(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("run", "Simulate a scene; write meshes, a report and pictures");
    const auto options = std::make_shared<RunCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    add_device_option(*command, options->simulation.device,
                      ", hybrid (the native CPU and the best other device at once), hybrid:DEVICE, "
                      "hybrid:DEVICE+DEVICE");
    add_costs_option(*command);
    command
        ->add_option("--split", options->simulation.split,
                     "What --device hybrid divides: bodies (default), or vertices, which can cut one cloth")
        ->check(CLI::IsMember({kSplitBodies, kSplitVertices}));
    command
        ->add_option("--share", options->simulation.share,
                     "Of the vertices, those of the first device, 0 to 1 (default: as measured)")
        ->check(number_between(0, 1, Ends::closed));
    command->add_option("--set", options->settings, "A value of the scene: method.substeps=20");
    command->add_option("--frames", options->frames, "Time steps to run (default: the scene's duration)")
        ->check(whole_number(0));
    command->add_option("--out", options->folder, "Folder for what is written (default: out/<scene>)");
    command
        ->add_option("--every", options->every,
                     "Frames from one mesh file to the next, 0 = no meshes (default: 30 files a second)")
        ->check(whole_number(0));
    command->add_flag("--sleep", options->simulation.sleep,
                      "Bodies at rest sleep and cost nothing until something moves them");
    command->add_flag("--no-picture", options->no_picture, "Draw no pictures");
    command->add_flag("--json", options->json, "Print the report as one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace taut::cli
