#include "taut/report/energy_budget.hpp"

#include "taut/report/contact.hpp"
#include "taut/report/drawn.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/start_surfaces.hpp"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut {
namespace {

/// Of depenetration_speed: as fast as an elastic body leaves a collider that pushes its lower side out at
/// that speed, in one blow. The rest of it is squeezed until it moves as fast, and springs back: as a ball
/// from a racket.
constexpr double kThrown = 2;
constexpr double kRounded = 1e-9; ///< of all energy: what lengths off by rounding alone can give

/// Where the body of the vertices from `first` to before `last` can have been: a box around its start and
/// now, as much larger on every side as it was itself and as its speed at the start took it.
Extent room_of(const PhysicalModel& model, std::span<const glm::dvec3> x, std::uint32_t first,
               std::uint32_t last, double time)
{
    Extent start, all;
    double speed = 0;
    for (std::uint32_t i = first; i < last; ++i)
    {
        start.take(model.start[i]);
        all.take(model.start[i]);
        all.take(x[i]);
        speed = std::max(speed, glm::length(model.velocity[i]));
    }
    const double more = start.size() + speed * time;
    return {all.low - more, all.high + more};
}

double deepest_start(const Scene& scene, const PhysicalModel& model)
{
    double depth = 0;
    for (const Collider& c : scene.colliders)
    {
        Collider start = c;
        if (c.moved_by_program)
            start.motion.clear();
        const reference::Surface surface = reference::surface_at(start, 0);
        for (std::size_t i = 0; i < model.start.size(); ++i)
            if (!model.pinned[i])
                depth = std::max(depth, model.gap[i] - surface.touch(model.start[i], 0).height);
    }
    return depth;
}

double kinetic_energy(const PhysicalModel& model)
{
    double out = 0;
    for (std::size_t i = 0; i < model.mass.size(); ++i)
        out += 0.5 * model.mass[i] * glm::dot(model.velocity[i], model.velocity[i]);
    return out;
}

/// A rigid element that starts off its rest length has no energy to speak of: it counts as 0 here.
double elastic_at_start(const PhysicalModel& model)
{
    const auto rigid = [](const auto& e) { return !(e.compliance > 0); };
    const auto any_rigid = [&](const auto& elements) {
        return std::any_of(elements.begin(), elements.end(), rigid);
    };
    if (!any_rigid(model.springs) && !any_rigid(model.hinges) && !any_rigid(model.volumes) &&
        !any_rigid(model.surfaces))
        return elastic_energy(model, model.start);
    PhysicalModel soft = model;
    std::erase_if(soft.springs, rigid);
    std::erase_if(soft.hinges, rigid);
    std::erase_if(soft.volumes, rigid);
    std::erase_if(soft.surfaces, rigid);
    return elastic_energy(soft, soft.start);
}

/// m: how far springs that a method keeps by projection are from their length at the start. Such a step puts
/// it right at once, at whatever speed that takes.
double largest_violation(const Scene& scene, const PhysicalModel& model)
{
    const MethodSettings& method = scene.method;
    const bool all = method.type == MethodKind::pbd || method.constraint_compliance == 0;
    double out = 0;
    for (const StretchElement& e : model.springs)
        if (all || !(e.compliance > 0))
            out = std::max(out, std::abs(glm::distance(model.start[e.a], model.start[e.b]) - e.rest_length));
    return out;
}

/// m: how far pins take their vertices at time 0, in one substep.
double largest_jump(const Scene& scene)
{
    double out = 0;
    for (const Body& body : scene.bodies)
        for (const Pin& pin : body.pins)
            for (std::size_t own = 0; is_led(pin) && own < pin.vertices.size(); ++own)
            {
                const std::uint32_t v = pin.vertices[own];
                const glm::dvec3 held = held_at(pin, 0, own, held_rest_of(body)[v]);
                out = std::max(out, glm::distance(held, start_of(body)[v]));
            }
    return out;
}

/// J, of what nothing holds: what is led has its height from what leads it.
double free_gravity_energy(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    double energy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        energy -= model.pinned[i] ? 0 : model.mass[i] * glm::dot(model.gravity, x[i]);
    return energy;
}

/// N s^2/m^2: the force on all triangles, were each square to the wind, over the square of its speed.
double wind_drag(const Scene& scene)
{
    double out = 0;
    for (const Body& body : scene.bodies)
        for (const auto& t : body.mesh.triangles)
        {
            const auto& x = body.mesh.positions;
            const double area = 0.5 * glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
            out += 0.5 * scene.wind.density * area * (body.material.drag + body.material.friction_drag);
        }
    return out;
}

double largest_wind(const Wind& wind)
{
    double out = glm::length(wind.velocity);
    for (const Wind::Key& key : wind.keys)
        out = std::max(out, glm::length(key.velocity));
    return wind.density > 0 ? out : 0;
}

} // namespace

double rounded_way(Precision precision, double far)
{
    const double digit = precision == Precision::float32 ? 6e-8 : 1.1e-16; // of a coordinate
    return 32 * digit * far;
}

EnergyBudget::EnergyBudget(const Scene& resolved)
    : EnergyBudget(resolved, std::make_shared<const PhysicalModel>(make_model(resolved)))
{}

EnergyBudget::EnergyBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model)
    : EnergyBudget(resolved, model, collider_paths(resolved, model->diameter))
{}

EnergyBudget::EnergyBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model,
                           ColliderPaths colliders)
    : shared_(std::move(model)),
      paths_(pin_paths(resolved)),
      colliders_(std::move(colliders)),
      depth_(std::max(deepest_start(resolved, *shared_), deepest_contact(resolved))),
      drawn_(std::make_shared<const DrawnBodies>(resolved)),
      violation_(std::max(largest_violation(resolved, *shared_), largest_jump(resolved))),
      depenetration_(resolved.depenetration_speed),
      wind_speed_(largest_wind(resolved.wind)),
      wind_drag_(wind_drag(resolved))
{
    lightest_ = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < shared_->mass.size(); ++i)
        if (!shared_->pinned[i])
        {
            mass_ += shared_->mass[i];
            lightest_ = std::min(lightest_, shared_->mass[i]);
        }
    start_ = kinetic_energy(*shared_) + elastic_at_start(*shared_) + gas_energy(*shared_, shared_->start);
    gravity_start_ = free_gravity_energy(*shared_, shared_->start);
}

MoverReach EnergyBudget::reach_at(const WorldDrive& drive, std::span<const glm::dvec3> x) const
{
    MoverReach out;
    const bool moved = !paths_.empty() || !colliders_->empty() || !drive.moved.empty();
    std::vector<Extent> rooms;
    const auto first_of = [&](std::size_t body) {
        return shared_->pinned.begin() + shared_->body_start[body];
    };
    for (std::size_t b = 0; moved && b + 1 < shared_->body_start.size(); ++b)
        if (!std::all_of(first_of(b), first_of(b + 1), [](bool pinned) { return pinned; }))
            rooms.push_back(
                room_of(*shared_, x, shared_->body_start[b], shared_->body_start[b + 1], drive.time));
    const auto add = [&](bool holds, const MoverReach& reach) {
        const bool meets = holds || std::any_of(rooms.begin(), rooms.end(), [&](const Extent& room) {
                               return glm::all(glm::lessThanEqual(reach.low, room.high)) &&
                                      glm::all(glm::lessThanEqual(room.low, reach.high));
                           });
        const double passed_on = std::max(kPulls * reach.change, holds ? 0.0 : kHits * reach.speed);
        out.speed = std::max(out.speed, meets ? passed_on : 0.0);
        out.travel = std::max(out.travel, meets ? reach.travel : 0.0);
    };
    for (const std::vector<MoverPath>* paths : {&paths_, colliders_.get()})
        for (const MoverPath& path : *paths)
        {
            // The stretch that the time lies in counts whole.
            const auto end = std::lower_bound(path.reach.begin(), path.reach.end(), drive.time,
                                              [](const MoverReach& r, double t) { return r.time < t; });
            add(path.holds, end == path.reach.end() ? path.reach.back() : *end);
        }
    for (const DrivenMover& mover : drive.moved)
        add(mover.holds, mover.reach);
    return out;
}

EnergyMost EnergyBudget::most(std::span<const glm::dvec3> x, const WorldDrive& drive) const
{
    if (drive.placed > 0)
        return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), false};
    const MoverReach reach = reach_at(drive, x);
    const double wind = std::max(wind_speed_, drive.wind), wind_force = wind_drag_ * wind * wind;
    const double g = glm::length(shared_->gravity);
    double in = start_ - gas_energy(*shared_, x);
    double root = 0; // what is added to sqrt(E)
    if (drive.steady_gravity)
        in += gravity_start_ - free_gravity_energy(*shared_, x) + mass_ * g * reach.travel;
    else
        root += std::sqrt(mass_ / 2) * drive.fall;
    if (depth_ > 0)
        in += mass_ * (g * depth_ + 0.5 * kThrown * kThrown * depenetration_ * depenetration_);
    const double put_right = 0.5 * mass_ * (violation_ / drive.substep) * (violation_ / drive.substep);
    in += put_right;
    if (wind_force > 0)
    {
        double moved = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            moved = std::max(moved, glm::distance(x[i], shared_->start[i]));
        in += wind_force * moved;
    }
    root += std::sqrt(mass_ / 2) * std::max(reach.speed, wind_force > 0 ? kHits * wind : 0.0);
    root += drive.kick;
    if (drive.push > 0)
        root += drive.push / std::sqrt(2 * lightest_);
    if (root == 0 && wind_force == 0 && shared_->gases.empty())
        in -= damped_;
    const DrawnEnergy drawn = drawn_->at(drive.time, reach.travel, std::max(depth_, 0.0));
    const auto with = [&](double elastic) {
        const double all = root + std::sqrt(std::max(in + kHits * elastic, 0.0));
        return all * all;
    };
    const bool exact = root == 0 && wind_force == 0 && shared_->gases.empty() && depth_ <= 0 &&
                       put_right <= kRounded * in && damped_ == 0 && reach.travel == 0 && drawn.held == 0 &&
                       drive.steady_gravity;
    return {with(drawn.freed), with(drawn.held), exact};
}

double EnergyBudget::rounding(Precision precision, double substep) const
{
    const double strain = precision == Precision::float32 ? 1e-5 : 1e-12; // that rounding leaves
    const double speed = rounded_way(precision, shared_->diameter) / substep;
    double out = 0.5 * mass_ * speed * speed;
    for (const StretchElement& e : shared_->springs)
        if (e.compliance > 0)
            out += 0.5 * strain * strain * e.rest_length * e.rest_length / e.compliance;
    for (const SolidElement& e : shared_->solids)
        out += 0.5 * strain * strain * (e.mu + e.lambda) * e.rest_volume;
    for (const BendElement& e : shared_->hinges)
        if (e.compliance > 0)
            out += 0.5 * strain * strain / e.compliance;
    for (const PlateHinge& h : shared_->plates)
        out += 0.5 * strain * strain / h.element.compliance;
    return out;
}

double EnergyBudget::small() const
{
    return 0.01 * mass_ * glm::length(shared_->gravity) * shared_->diameter;
}

} // namespace taut
