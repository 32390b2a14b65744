// How a cell of the robustness map is run and judged.

#include "hard/map_parts.hpp"

#include <cmath>
#include <iterator>
#include <limits>

namespace taut::hard {
namespace {

bool is_hashed(int step)
{
    return std::find(std::begin(kHashed), std::end(kHashed), step) != std::end(kHashed);
}

/// The last step up to `most` whose positions are hashed.
int hashed_up_to(int most)
{
    return *std::prev(std::upper_bound(std::begin(kHashed), std::end(kHashed), std::max(most, kHashed[0])));
}

void look(const World& world, Journey& out)
{
    const StepReport report = measure(world);
    out.highest_energy = std::max(out.highest_energy, energy(report));
    out.fastest = std::max(out.fastest, report.max_speed);
    out.stretch = std::max(out.stretch, report.max_stretch);
    out.deepest = std::max(out.deepest, report.penetration);
    out.volume = std::max(out.volume, std::abs(report.volume.ratio - 1));
    if (!out.start.empty())
    {
        const auto x = world.positions();
        const auto [low, high] = std::ranges::minmax(x, {}, &glm::dvec3::y);
        out.lowest_centre = std::min(out.lowest_centre, mean(x).y);
        out.thinnest = std::min(out.thinnest, high.y - low.y);
        for (std::size_t v = 0; v < std::min(x.size(), out.held.size()); ++v)
            out.farthest = std::max(out.farthest, out.held[v] ? 0 : glm::distance(x[v], out.start[v]));
    }
    out.hashes[static_cast<int>(world.steps())] = report.position_hash;
    out.last = report;
}

/// What energies are compared with: a fall through the body's own size, and what is there at the start.
double energy_scale(const World& world, const StepReport& first)
{
    const PhysicalModel model = make_model(world.scene());
    const double elastic = first.potential_energy - gravity_energy(model, world.positions());
    const double scale = total_weight(model) * model.diameter + first.kinetic_energy + std::max(elastic, 0.0);
    return scale > 1e-9 ? scale : 1; // nothing that falls or is strained: J
}

/// The kinematic bound of what may be reported: a projection moves a vertex by about what is violated, a
/// body's size, and nothing by ten of them in a substep.
Measured step_of_fastest(const Journey& j)
{
    const PhysicalModel model = make_model(j.world.scene());
    glm::dvec3 low(kInfinity), high(-kInfinity);
    for (const glm::dvec3& x : j.start)
    {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const double size = std::max(model.diameter, j.start.empty() ? 0 : glm::distance(low, high));
    const double substep = j.world.plan().timestep / j.world.plan().substeps;
    return above("way of a substep / size", j.fastest * substep / (size > 0 ? size : 1), 10);
}

void judge_what_all_have(const MapCase& c, const Journey& j, Outcome& out)
{
    const double work = c.work ? c.work(j) : 0;
    out.energy = (j.highest_energy - energy(j.first) - work) / (j.scale + work);
    out.inverted = static_cast<double>(j.last.volume.inverted);
    out.volume = std::abs(j.last.volume.ratio - 1);
    out.own.push_back(above("energy above the start / scale", out.energy, c.most_energy));
    out.own.push_back(above("inverted tetrahedra", out.inverted, 0));
    out.own.push_back(above("volume lost or gained", out.volume, c.most_volume));
}

Scene scene_for(const MapCase& c, MethodKind method)
{
    Scene scene = c.full_size && !short_run() ? c.full_size() : c.scene;
    set_method(scene, method);
    if (const auto more = c.effort.find(method); more != c.effort.end())
    {
        // Beyond 1,000 the world refuses.
        scene.method.substeps = scene.method.substeps * more->second.substeps;
        scene.method.iterations = scene.method.iterations * more->second.iterations;
        scene.method.precision = more->second.in_double ? Precision::float64 : Precision::float32;
    }
    return scene;
}

/// See Outcome::called.
std::string called(const World& world, const SoundnessWatch& watch, StepReport report)
{
    judge_end(world, watch, report);
    return report.status == Status::completed ? ""
                                              : std::string(to_string(report.status)) + ": " + report.reason;
}

/// Runs the case's scene and fills in what it came to, but for the word of the verdict.
void run_scene(const MapCase& c, const Scene& scene, const std::shared_ptr<Device>& device, int steps,
               bool judge, Outcome& out)
{
    World world(scene, device);
    Journey journey{world, world.positions(), measure(world), {}};
    journey.scale = energy_scale(world, journey.first);
    journey.held = make_model(scene).pinned;
    journey.highest_energy = energy(journey.first);
    const int every = steps > 5000 ? 1000 : 10;
    SoundnessWatch watch(static_cast<std::uint64_t>(steps));
    for (int k = 0; k < steps; ++k)
    {
        if (c.before_step)
            c.before_step(world, k);
        world.step();
        if (judge && !c.before_step && watch.found().sound())
            watch.after(static_cast<std::uint64_t>(k) + 1, world);
        const bool often = judge && (k < 5 || k % every == every - 1);
        if (often || is_hashed(k + 1) || k + 1 == steps)
            look(world, journey);
    }
    out.hashes = journey.hashes;
    if (!finite(world.positions()) || !finite(world.velocities()))
        out.verdict = "FAIL";
    else if (journey.last.status != Status::completed) // judged all the same: by how much it is wrong
        out.verdict = "stops " + std::string(to_string(journey.last.status));
    if (!judge || out.verdict == "FAIL")
        return;
    out.called = called(world, watch, journey.last);
    if (c.judge)
    {
        const Findings found = c.judge(journey);
        out.own.insert(out.own.end(), found.list.begin(), found.list.end());
    }
    out.of_case = out.own.size();
    judge_what_all_have(c, journey, out);
    const bool missed =
        std::any_of(out.own.begin(), out.own.end(), [](const Measured& m) { return m.missed(); });
    // What is thrown from outside may be fast.
    if (const Measured far = step_of_fastest(journey); missed && far.missed() && !c.before_step)
        out.far = far;
}

} // namespace

int steps_of(const MapCase& c)
{
    if (!short_run() || c.short_steps == 0)
        return c.steps;
    return c.short_steps > 0 ? c.short_steps : kStepsShort;
}

Measured Outcome::shown() const
{
    if (own.empty() || refused())
        return {"", std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    if (far)
        return *far;
    const auto missed = std::find_if(own.begin(), own.end(), [](const Measured& m) { return m.missed(); });
    return verdict == "runs" || missed == own.end() ? own.front() : *missed;
}

std::vector<Measured> Outcome::also_missed() const
{
    std::vector<Measured> out;
    bool said = far.has_value(); // the first is the cell's number
    for (std::size_t k = 0; k < of_case && verdict != "runs"; ++k)
    {
        if (own[k].missed() && said)
            out.push_back(own[k]);
        said = said || own[k].missed();
    }
    return out;
}

Outcome judged(const MapCase& c, MethodKind method, const std::shared_ptr<Device>& device)
{
    Outcome out;
    try
    {
        const Scene scene = scene_for(c, method);
        const int steps = steps_of(c);
        bool enough = steps == c.steps || c.short_steps > 0;
        if (c.check)
        {
            const Findings found = c.check(scene, device, steps);
            out.own = found.list;
            enough = enough && found.judged;
        }
        run_scene(c, scene, device, steps, true, out);
        const bool missed =
            std::any_of(out.own.begin(), out.own.end(), [](const Measured& m) { return m.missed(); });
        const bool may = (c.may_report & only(method)) != 0 && !out.far;
        if (out.verdict.empty())
            out.verdict = !enough ? "runs" : !missed ? "pass" : may ? "reports" : "FAIL";
        if (out.verdict == "pass" && !out.called.empty())
            out.verdict = "stops " + out.called.substr(0, out.called.find(':'));
    }
    catch (const Error& error)
    {
        out.verdict = "refuses " + std::string(to_string(error.code()));
    }
    return out;
}

int steps_within(std::uint64_t dispatches, const MapCase& c, MethodKind method,
                 const std::shared_ptr<Device>& device, int steps)
{
    if (c.check) // has worlds of its own, and may refuse before a step
        return steps;
    const std::size_t each = World(scene_for(c, method), device).plan().passes.size();
    return std::min(steps, hashed_up_to(static_cast<int>(dispatches / std::max<std::size_t>(each, 1))));
}

Outcome repeated(const MapCase& c, MethodKind method, const std::shared_ptr<Device>& device, int steps,
                 std::uint64_t dispatches)
{
    Outcome out;
    try
    {
        const Scene scene = scene_for(c, method);
        if (dispatches > 0)
            steps = steps_within(dispatches, c, method, device, steps);
        if (c.check && steps == steps_of(c))
            out.own = c.check(scene, device, steps).list;
        run_scene(c, scene, device, steps, false, out);
    }
    catch (const Error& error)
    {
        out.verdict = "refuses " + std::string(to_string(error.code()));
    }
    return out;
}

void set_method(Scene& scene, MethodKind method)
{
    MethodSettings& m = scene.method;
    m.type = method;
    m.iterations = 1;
    m.substeps = 10;
    switch (method)
    {
    case MethodKind::implicit_euler: m.substeps = 4, m.iterations = 2; break;
    case MethodKind::implicit_constraints:
        m.substeps = 5, m.iterations = 2, m.linear_operator = LinearOperator::matrix_free;
        break;
    case MethodKind::pbd: m.iterations = 2; break;
    case MethodKind::vbd: m.substeps = 5, m.iterations = 4; break;
    case MethodKind::mass_spring: // as many substeps as they need: what they refuse then is out of reach
    case MethodKind::acad: m.stability = StabilityRule::substep; break;
    case MethodKind::xpbd: break;
    }
    for (Body& body : scene.bodies)
    {
        if (!find_method(method).elastic && is_solid(body.shape.kind))
            body.material.model = SolidModel::springs;
        if (!find_method(method).volumes && body.material.volume != HeldVolume::surface)
            body.material.volume_stiffness = 0;
    }
}

} // namespace taut::hard
