#include "taut/report/scene_budget.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/called.hpp"

#include <map>
#include <span>

namespace taut {
namespace {

/// Of a scene: the numbers of the bodies of each part, ascending.
std::vector<std::vector<std::size_t>> bodies_of_parts(const Scene& scene)
{
    std::map<std::size_t, std::vector<std::size_t>> parts;
    const std::vector<std::size_t> part = meeting_parts(scene);
    for (std::size_t b = 0; b < part.size(); ++b)
        parts[part[b]].push_back(b);
    std::vector<std::vector<std::size_t>> out;
    for (auto& [number, bodies] : parts)
        out.push_back(std::move(bodies));
    return out;
}

std::vector<BodyRange> ranges_of(const Scene& scene)
{
    std::vector<BodyRange> out;
    std::uint32_t first = 0;
    for (const Body& body : scene.bodies)
    {
        const auto count = static_cast<std::uint32_t>(body.mesh.positions.size());
        out.push_back({first, count});
        first += count;
    }
    return out;
}

std::vector<glm::dvec3> those_of(std::span<const glm::dvec3> all, const std::vector<BodyRange>& ranges)
{
    std::vector<glm::dvec3> out;
    for (const BodyRange& range : ranges)
    {
        const auto of_body = all.subspan(range.first, range.count);
        out.insert(out.end(), of_body.begin(), of_body.end());
    }
    return out;
}

} // namespace

SceneBudget::SceneBudget(const Scene& resolved)
    : SceneBudget(resolved, nullptr)
{}

SceneBudget::SceneBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model)
{
    const std::vector<std::vector<std::size_t>> parts = bodies_of_parts(resolved);
    if (parts.size() <= 1)
    {
        if (!model)
            model = std::make_shared<const PhysicalModel>(make_model(resolved));
        parts_.push_back({"", {}, {}, EnergyBudget(resolved, std::move(model))});
        return;
    }
    const double diameter = rest_diameter(resolved);
    const ColliderPaths paths = collider_paths(resolved, diameter);
    const std::vector<BodyRange> ranges = ranges_of(resolved);
    vertices_ = ranges.back().first + ranges.back().count;
    Scene around = resolved; // of each part in turn, with all that bodies meet
    around.bodies.clear();
    Scene bare = around; // what a part keeps
    bare.colliders.clear();
    for (const std::vector<std::size_t>& bodies : parts)
    {
        Scene scene = bare;
        std::vector<BodyRange> own;
        for (const std::size_t b : bodies)
        {
            scene.bodies.push_back(resolved.bodies[b]);
            own.push_back(ranges[b]);
        }
        auto part = std::make_shared<PhysicalModel>(make_model(scene));
        part->diameter = diameter; // what is small, and what rounding makes, is so for the scene
        std::swap(around.bodies, scene.bodies);
        EnergyBudget budget(around, std::move(part), paths);
        std::swap(around.bodies, scene.bodies);
        const std::size_t first = bodies.front();
        parts_.push_back({called("bodies", first, resolved.bodies[first].name), std::move(own),
                          std::move(scene), std::move(budget)});
    }
}

std::vector<Soundness> SceneBudget::judge_parts(const World& world, Judged what) const
{
    const std::vector<glm::dvec3> x = world.positions(), v = world.velocities();
    const auto judge = [&](const Part& part, const RunState& state) {
        return what == Judged::motion ? judge_motion(part.budget, state) : judge_state(part.budget, state);
    };
    if (parts_.size() > 1 && x.size() != vertices_)
        throw Error(ErrorCode::bad_input, "the world has torn since the budget of its scene was made");
    const WorldDrive drive = world.drive();
    const Precision precision = world.plan().precision;
    std::vector<Soundness> out;
    for (const Part& part : parts_)
        if (part.ranges.empty())
            out.push_back(judge(part, {world.scene(), x, v, drive, precision, {}, 0}));
        else
        {
            const std::vector<glm::dvec3> own_x = those_of(x, part.ranges), own_v = those_of(v, part.ranges);
            out.push_back(
                judge(part, {part.scene, own_x, own_v, drive, precision, {}, 0, world.scene().colliders}));
            if (!out.back().sound())
                out.back().reason = "of " + part.name + ": " + out.back().reason;
        }
    return out;
}

Soundness SceneBudget::judge_whole(const World& world, const std::vector<Soundness>& parts) const
{
    const Plan& plan = world.plan();
    const double substeps = static_cast<double>(world.steps()) * plan.substeps;
    Soundness out = judge_counts(world.scene(), world.events(), substeps * plan.vertex_count);
    double energy = 0, most = 0;
    bool exact = true;
    for (const Soundness& part : parts)
    {
        out = worse(part, out);
        energy += part.energy;
        most += part.energy_most;
        exact = exact && part.energy_exact;
    }
    out.energy = energy;
    out.energy_most = most;
    out.energy_exact = exact;
    return out;
}

void SceneBudget::set_damped(const std::vector<double>& energy)
{
    for (std::size_t p = 0; p < parts_.size(); ++p)
        parts_[p].budget.set_damped(energy.at(p));
}

Soundness judge(const SceneBudget& budget, const World& world, Judged what)
{
    return budget.judge_whole(world, budget.judge_parts(world, what));
}

} // namespace taut
