#include "taut/report/energy_budget.hpp"

#include "taut/report/contact.hpp"
#include "taut/report/drawn.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"

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
constexpr double kSampleTurn = 0.25; ///< rad: a chord this wide is 0.3 % shorter than its arc

/// Corners of the box of some places; a rigid motion moves none of the places faster than the fastest corner.
std::vector<glm::dvec3> box_corners(const glm::dvec3& low, const glm::dvec3& high)
{
    std::vector<glm::dvec3> out;
    for (int k = 0; k < 8; ++k)
        out.emplace_back((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                         (k & 4) != 0 ? high.z : low.z);
    return out;
}

/// A motion, and the corners of what it carries.
struct Mover
{
    std::vector<Keyframe> motion;
    std::vector<glm::dvec3> corners;
    bool holds = false;
};

std::vector<Mover> movers_of(const Scene& scene, const PhysicalModel& model)
{
    std::vector<Mover> out;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        for (const Pin& pin : scene.bodies[b].pins)
        {
            Extent held;
            for (const std::uint32_t v : pin.vertices)
                held.take(model.start[model.body_start[b] + v]);
            if (!pin.motion.empty() && held.low.x <= held.high.x)
                out.push_back({pin.motion, box_corners(held.low, held.high), true});
        }
    for (const Collider& c : scene.colliders)
    {
        // Of a plane, the part that the bodies can be at.
        const ColliderSolid solid = solid_of(c);
        const ColliderFrame rest = rest_frame(c);
        // A line along y keeps its ends, a box the ball round it.
        const glm::dvec3 along = solid.is_box() ? glm::dvec3(0) : glm::abs(rest.y * solid.half.y);
        const double size = !solid.bounded   ? model.diameter
                            : solid.is_box() ? glm::length(solid.half)
                                             : solid.radius;
        if (!c.motion.empty())
            out.push_back(
                {c.motion, box_corners(rest.centre - along - size, rest.centre + along + size), false});
    }
    return out;
}

/// rad/s: no stretch between two keys turns faster.
double fastest_turn(const std::vector<Keyframe>& motion)
{
    double out = 0;
    for (std::size_t k = 1; k < motion.size(); ++k)
        out = std::max(out, glm::distance(rotation_of(motion[k]), rotation_of(motion[k - 1])) /
                                (motion[k].time - motion[k - 1].time));
    return out;
}

/// What a mover does between two times, added to `reach`; `velocity` [m/s] is that of each corner before, and
/// after, `change` [m/s] by how much it has changed in all.
void extend(const Mover& mover, double from, double to, std::vector<glm::dvec3>& velocity,
            std::vector<double>& change, MoverReach& reach)
{
    const double turn = fastest_turn(mover.motion) * (to - from) / kSampleTurn;
    const int samples = 8 + static_cast<int>(std::min(turn, 1e5));
    for (std::size_t c = 0; c < mover.corners.size(); ++c)
    {
        glm::dvec3 before = pose(mover.motion, from, mover.corners[c]);
        for (int k = 1; k <= samples; ++k)
        {
            const glm::dvec3 now = pose(mover.motion, from + (to - from) * k / samples, mover.corners[c]);
            const glm::dvec3 v = (now - before) * (samples / (to - from));
            change[c] += glm::distance(v, velocity[c]);
            velocity[c] = v;
            reach.speed = std::max(reach.speed, glm::length(v));
            reach.travel = std::max(reach.travel, glm::distance(now, mover.corners[c]));
            reach.low = glm::min(reach.low, glm::min(now, before));
            reach.high = glm::max(reach.high, glm::max(now, before));
            before = now;
        }
        reach.change = std::max(reach.change, change[c]);
    }
}

std::vector<MoverPath> paths_of(const std::vector<Mover>& movers)
{
    std::vector<MoverPath> out;
    for (const Mover& mover : movers)
    {
        MoverPath path{mover.holds, {{}}};
        std::vector<glm::dvec3> velocity(mover.corners.size(), glm::dvec3(0));
        std::vector<double> change(mover.corners.size(), 0.0);
        for (const Keyframe& key : mover.motion)
            if (key.time > path.reach.back().time)
            {
                MoverReach next = path.reach.back();
                next.time = key.time;
                extend(mover, path.reach.back().time, key.time, velocity, change, next);
                path.reach.push_back(next);
            }
        // It stops at its last key.
        MoverReach rest = path.reach.back();
        rest.time = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < change.size(); ++c)
            rest.change = std::max(rest.change, change[c] + glm::length(velocity[c]));
        path.reach.push_back(rest);
        out.push_back(std::move(path));
    }
    return out;
}

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
        const reference::Surface surface = reference::surface_at(c, 0);
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
double elastic_at_start(PhysicalModel model)
{
    const auto drop_rigid = [](auto& elements) {
        std::erase_if(elements, [](const auto& e) { return !(e.compliance > 0); });
    };
    drop_rigid(model.springs);
    drop_rigid(model.hinges);
    drop_rigid(model.volumes);
    drop_rigid(model.surfaces);
    return elastic_energy(model, model.start);
}

/// m: how far springs that a method keeps by projection are from their length at the start. Such a step puts
/// it right at once, at whatever speed that takes.
double largest_violation(const Scene& scene, const PhysicalModel& model)
{
    const MethodSettings& method = scene.method;
    const bool all = method.type == "pbd" || method.constraint_compliance == 0;
    double out = 0;
    for (const StretchElement& e : model.springs)
        if (all || !(e.compliance > 0))
            out = std::max(out, std::abs(glm::distance(model.start[e.a], model.start[e.b]) - e.rest_length));
    return out;
}

/// N: of all triangles in a wind of this speed, were each square to it.
double largest_wind_force(const Scene& scene, double speed)
{
    double out = 0;
    for (const Body& body : scene.bodies)
        for (const auto& t : body.mesh.triangles)
        {
            const auto& x = body.mesh.positions;
            const double area = 0.5 * glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
            out += 0.5 * scene.wind.density * speed * speed * area *
                   (body.material.drag + body.material.friction_drag);
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

EnergyBudget::EnergyBudget(const Scene& resolved)
    : model_(make_model(resolved)),
      paths_(paths_of(movers_of(resolved, model_))),
      depth_(deepest_start(resolved, model_)),
      drawn_(std::make_shared<const DrawnBodies>(resolved)),
      violation_(largest_violation(resolved, model_)),
      depenetration_(resolved.depenetration_speed),
      wind_speed_(largest_wind(resolved.wind)),
      wind_force_(largest_wind_force(resolved, wind_speed_))
{
    lightest_ = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model_.mass.size(); ++i)
        if (!model_.pinned[i])
        {
            mass_ += model_.mass[i];
            lightest_ = std::min(lightest_, model_.mass[i]);
        }
    start_ = kinetic_energy(model_) + elastic_at_start(model_) + gas_energy(model_, model_.start);
    gravity_start_ = gravity_energy(model_, model_.start);
}

MoverReach EnergyBudget::reach_at(double time, std::span<const glm::dvec3> x) const
{
    MoverReach out;
    std::vector<Extent> rooms;
    for (std::size_t b = 0; !paths_.empty() && b + 1 < model_.body_start.size(); ++b)
        rooms.push_back(room_of(model_, x, model_.body_start[b], model_.body_start[b + 1], time));
    for (const MoverPath& path : paths_)
    {
        // The stretch that `time` lies in counts whole.
        const auto end = std::lower_bound(path.reach.begin(), path.reach.end(), time,
                                          [](const MoverReach& r, double t) { return r.time < t; });
        const MoverReach& reach = end == path.reach.end() ? path.reach.back() : *end;
        const bool meets = path.holds || std::any_of(rooms.begin(), rooms.end(), [&](const Extent& room) {
                               return glm::all(glm::lessThanEqual(reach.low, room.high)) &&
                                      glm::all(glm::lessThanEqual(room.low, reach.high));
                           });
        const double passed_on = std::max(kPulls * reach.change, path.holds ? 0.0 : kHits * reach.speed);
        out.speed = std::max(out.speed, meets ? passed_on : 0.0);
        out.travel = std::max(out.travel, meets ? reach.travel : 0.0);
    }
    return out;
}

EnergyMost EnergyBudget::most(std::span<const glm::dvec3> x, const WorldDrive& drive) const
{
    const MoverReach reach = reach_at(drive.time, x);
    const double g = glm::length(model_.gravity);
    double in = start_ - gas_energy(model_, x);
    double root = 0; // what is added to sqrt(E)
    if (drive.steady_gravity)
        in += gravity_start_ - gravity_energy(model_, x) + mass_ * g * reach.travel;
    else
        root += std::sqrt(mass_ / 2) * drive.fall;
    if (depth_ > 0)
        in += mass_ * (g * depth_ + 0.5 * kThrown * kThrown * depenetration_ * depenetration_);
    const double way = reach.travel + std::max(depth_, 0.0);
    in += 0.5 * mass_ * (violation_ / drive.substep) * (violation_ / drive.substep);
    if (wind_force_ > 0)
    {
        double moved = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            moved = std::max(moved, glm::distance(x[i], model_.start[i]));
        in += wind_force_ * moved;
    }
    root += std::sqrt(mass_ / 2) * std::max(reach.speed, wind_force_ > 0 ? kHits * wind_speed_ : 0.0);
    if (drive.push > 0)
        root += drive.push / std::sqrt(2 * lightest_);
    if (root == 0 && wind_force_ == 0 && model_.gases.empty())
        in -= damped_;
    const DrawnEnergy drawn = drawn_->at(drive.time, way);
    const auto with = [&](double elastic) {
        const double all = root + std::sqrt(std::max(in + kHits * elastic, 0.0));
        return all * all;
    };
    return {with(drawn.freed), with(drawn.held)};
}

double EnergyBudget::rounding(Precision precision, double substep) const
{
    const bool single = precision == Precision::float32;
    const double digit = single ? 6e-8 : 1.1e-16; // of a coordinate
    const double strain = single ? 1e-5 : 1e-12;  // that its rounding leaves
    const double speed = 32 * digit * model_.diameter / substep;
    double out = 0.5 * mass_ * speed * speed;
    for (const StretchElement& e : model_.springs)
        if (e.compliance > 0)
            out += 0.5 * strain * strain * e.rest_length * e.rest_length / e.compliance;
    for (const SolidElement& e : model_.solids)
        out += 0.5 * strain * strain * (e.mu + e.lambda) * e.rest_volume;
    for (const BendElement& e : model_.hinges)
        if (e.compliance > 0)
            out += 0.5 * strain * strain / e.compliance;
    return out;
}

double EnergyBudget::small() const
{
    return 0.01 * mass_ * glm::length(model_.gravity) * model_.diameter;
}

} // namespace taut
