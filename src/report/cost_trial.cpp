#include "taut/report/cost_trial.hpp"

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

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

Trial::Trial(const Scene& resolved, std::shared_ptr<Device> device, const MethodSettings& settings)
    : world_(with_settings(resolved, settings), std::move(device)),
      budget_(world_.scene()),
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

void Trial::extend(Motion& motion, std::size_t frames)
{
    if (motion.frames.empty())
        motion.frames.push_back(x_);
    while (motion.steps < frames && motion.reason.empty() && advance(motion))
        motion.frames.push_back(x_);
    judge_end(motion);
}

void Trial::judge_end(Motion& motion)
{
    if (!motion.reason.empty() || motion.steps == 0)
        return;
    StepReport report;
    set_status(judge(budget_, world_), report);
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
    while (!out.rests && static_cast<double>(out.steps) < most)
    {
        if (!advance(out))
            return out;
        window.push_back(x_);
        if (window.size() > second + 1)
            window.pop_front();
        if (window.size() <= second || out.steps % 4 != 0)
            continue;
        bound = 1e-5 * distance_by_mass(rule.weights, x_, out.frames[0]);
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
        out.reason =
            "not at rest after " + std::to_string(static_cast<int>(rule.seconds)) + " simulated seconds";
    judge_end(out);
    return out;
}

Timing Trial::time(std::size_t frames, double seconds)
{
    const auto run = [&](std::size_t count) {
        for (std::size_t f = 0; f < count; ++f)
        {
            world_.step();
            world_.device().wait();
        }
    };
    for (int warm_up = 0; warm_up < 3; ++warm_up)
    {
        world_.restore(start_);
        run(std::min<std::size_t>(frames, 3));
    }
    std::vector<double> wall, cpu;
    double spent = 0; // ms
    const auto enough = [&] {
        const bool many = wall.size() >= 20 || (wall.size() >= 5 && spent > 250);
        return !wall.empty() && (many || spent > 1e3 * seconds);
    };
    const double simulated = static_cast<double>(frames) * world_.plan().timestep;
    while (!enough())
    {
        world_.restore(start_);
        const double cpu_before = process_ms();
        const auto before = std::chrono::steady_clock::now();
        run(frames);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
        spent += took.count();
        wall.push_back(took.count() / simulated);
        cpu.push_back((process_ms() - cpu_before) / simulated);
    }
    return {median(wall), *std::min_element(wall.begin(), wall.end()), median(cpu), wall.size()};
}

} // namespace taut::cost
