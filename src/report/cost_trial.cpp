#include "taut/report/cost_trial.hpp"

#include "taut/report/median.hpp"
#include "taut/report/report.hpp"
#include "taut/report/residuals.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <deque>

namespace taut::cost {
namespace {

Scene with_settings(const Scene& resolved, const MethodSettings& settings)
{
    Scene scene = resolved;
    scene.method = settings;
    return scene;
}

/// Empty when every vertex has a place within bounds.
std::string lost_vertex(const std::vector<glm::dvec3>& x, Status& status)
{
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double extent = std::max({std::abs(x[i].x), std::abs(x[i].y), std::abs(x[i].z)});
        const bool finite = std::isfinite(x[i].x) && std::isfinite(x[i].y) && std::isfinite(x[i].z);
        if (finite && extent <= kDivergedExtent)
            continue;
        status = finite ? Status::diverged : Status::non_finite;
        return std::string(to_string(status)) + ": vertex " + std::to_string(i);
    }
    return {};
}

double process_ms()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

} // namespace

Trial::Trial(const Scene& resolved, std::shared_ptr<Device> device, const MethodSettings& settings)
    : world_(with_settings(resolved, settings), std::move(device)),
      start_(world_.state()),
      x_(world_.positions())
{}

double Trial::sweeps() const
{
    const Plan& plan = world_.plan();
    const SolverReport solved = world_.solver_report();
    const double seconds = static_cast<double>(world_.steps()) * plan.timestep;
    if (solved.solves > 0 && seconds > 0) // a product with the matrix visits every constraint, and forming it
        return static_cast<double>(solved.iterations + solved.solves) / seconds;
    return static_cast<double>(plan.substeps) * plan.iterations / plan.timestep;
}

bool Trial::advance(Motion& motion)
{
    world_.step();
    x_ = world_.positions();
    if (contacts_)
        contacts_->add(world_, x_);
    ++motion.steps;
    motion.reason = lost_vertex(x_, motion.status);
    if (motion.reason.empty() && world_.events().non_finite > 0)
    {
        motion.status = Status::non_finite;
        motion.reason = "non_finite: a displacement";
    }
    if (!motion.reason.empty())
        motion.reason += " in frame " + std::to_string(motion.steps);
    return motion.reason.empty();
}

void Trial::extend(Motion& motion, std::size_t frames, const std::function<bool()>& enough)
{
    if (motion.frames.empty())
        motion.frames.push_back(x_);
    while (motion.steps < frames && motion.reason.empty() && !(enough && enough()) && advance(motion))
        motion.frames.push_back(x_);
    judge_end(motion);
}

void Trial::judge_end(Motion& motion)
{
    if (!motion.reason.empty() || motion.steps == 0)
        return;
    StepReport report = measure(world_);
    if (report.status == Status::completed)
        judge_residuals(world_.scene(), residuals_ahead(world_), report);
    motion.status = report.status;
    if (report.status != Status::completed)
        motion.reason = std::string(to_string(report.status)) + ": " + report.reason + ", in frame " +
                        std::to_string(motion.steps);
}

Motion Trial::trajectory(std::size_t frames)
{
    Motion out;
    extend(out, frames);
    return out;
}

Motion Trial::settle(const RestRule& rule)
{
    Motion out;
    out.frames.push_back(x_);
    const double timestep = world_.plan().timestep;
    const auto second = static_cast<std::size_t>(std::ceil(1 / timestep));
    const double most = std::ceil(rule.seconds / timestep);
    std::deque<std::vector<glm::dvec3>> window{x_};
    double wandered = 0, bound = 0;
    bool out_of_time = false;
    while (!out.rests && !out_of_time && static_cast<double>(out.steps) < most)
    {
        if (!advance(out))
            return out;
        out_of_time = rule.enough && rule.enough();
        window.push_back(x_);
        if (window.size() > second + 1)
            window.pop_front();
        if (window.size() <= second || out.steps % 4 != 0)
            continue;
        bound = rule.tolerance * distance_by_mass(rule.weights, x_, out.frames[0]);
        if (rule.reference)
            bound = std::max(bound, 0.1 * distance_by_mass(rule.weights, x_, *rule.reference));
        wandered = 0;
        for (const auto& before : window)
            wandered = std::max(wandered, distance_by_mass(rule.weights, x_, before));
        out.rests = wandered <= bound;
    }
    out.frames.push_back(x_);
    if (!out.rests && rule.loose && bound > 0 &&
        wandered <= kLooseRest * distance_by_mass(rule.weights, x_, out.frames[0]))
    {
        out.rests = true;
        out.wander = wandered;
    }
    if (!out.rests)
        out.reason = "not at rest after " +
                     std::to_string(static_cast<int>(static_cast<double>(out.steps) * timestep + 0.5)) +
                     " simulated seconds" + (out_of_time ? ", when the time was up" : "");
    judge_end(out);
    return out;
}

void Trial::trace_contacts(std::size_t frames)
{
    trace_contacts();
    Motion on; // of no interest but for what it adds up
    while (on.steps < frames && advance(on))
        ;
}

void Trial::run(std::size_t frames)
{
    for (std::size_t f = 0; f < frames; ++f)
    {
        world_.step();
        world_.device().wait();
    }
}

void Trial::warm_up(std::size_t frames)
{
    for (int time = 0; time < 3; ++time)
    {
        world_.restore(start_);
        run(std::min<std::size_t>(frames, 3));
    }
}

void Trial::repeat(std::size_t frames, Stopwatch& watch)
{
    world_.restore(start_);
    const double cpu_before = process_ms();
    const auto before = std::chrono::steady_clock::now();
    run(frames);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
    const double simulated = static_cast<double>(frames) * world_.plan().timestep;
    watch.spent += took.count();
    watch.wall.push_back(took.count() / simulated);
    watch.cpu.push_back((process_ms() - cpu_before) / simulated);
}

Timing Stopwatch::timing() const
{
    Timing out;
    out.median = quantile(wall, 0.5);
    out.least = *std::min_element(wall.begin(), wall.end());
    out.cpu = quantile(cpu, 0.5);
    out.repetitions = wall.size();
    out.low = quantile(wall, 0.25);
    out.high = quantile(wall, 0.75);
    out.cpu_low = quantile(cpu, 0.25);
    out.cpu_high = quantile(cpu, 0.75);
    return out;
}

Timing Trial::time(std::size_t frames, double seconds)
{
    warm_up(frames);
    Stopwatch watch;
    const auto enough = [&] {
        const bool many = watch.wall.size() >= 20 || (watch.wall.size() >= 5 && watch.spent > 250);
        return !watch.wall.empty() && (many || watch.spent > 1e3 * seconds);
    };
    while (!enough())
        repeat(frames, watch);
    return watch.timing();
}

} // namespace taut::cost
