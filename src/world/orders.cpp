// Orders of the program to what it moves: each is checked whole before it changes anything.

#include "taut/plan/wind.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/moved.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut {
namespace {

constexpr double kHalfTurn = glm::pi<double>() * (1 + 1e-9); // rounding

[[noreturn]] void refuse(const std::string& who, const std::string& text,
                         ErrorCode code = ErrorCode::bad_input)
{
    throw Error(code, who + ": " + text);
}

std::string name_of(const char* what, std::size_t index) { return what + (" " + std::to_string(index)); }

void require_finite(const glm::dvec3& v, const std::string& who, const std::string& what)
{
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        refuse(who, what + " is not finite");
}

void require_speed(double speed, const std::string& who, const std::string& what)
{
    if (!(speed <= ProgramMoves::kFastestMove))
        refuse(who,
               what + " would move at " + shown(speed, 3) + " m/s in the next step, at most " +
                   shown(ProgramMoves::kFastestMove, 3) +
                   " m/s; places are in m: take smaller steps, or restore() a state to put it elsewhere");
}

void require_pose(const Keyframe& pose, const std::string& who, const std::string& what)
{
    require_finite(pose.translate, who, "translate of " + what);
    require_finite(pose.rotate_axis, who, "rotate_axis of " + what);
    require_finite(pose.rotate_centre, who, "rotate_centre of " + what);
    if (!std::isfinite(pose.rotate_degrees))
        refuse(who, "rotate_degrees of " + what + " is not finite");
    if (pose.rotate_degrees != 0 && glm::length(pose.rotate_axis) == 0)
        refuse(who, "rotate_axis of " + what + " is 0; it must have a direction, for example (0, 1, 0)");
}

void require_targets(const PinMove& move, std::span<const glm::dvec3> targets, double timestep,
                     const char* who)
{
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
        const std::string what = "target " + std::to_string(k) + " of pin " + std::to_string(move.pin) +
                                 " of body " + std::to_string(move.body);
        require_finite(targets[k], who, what);
        require_speed(glm::distance(targets[k], move.from[k]) / timestep, who, what);
    }
}

void require_turn(double turn, const std::string& who, const std::string& what)
{
    if (turn > kHalfTurn)
        refuse(who, what + " would turn by " + shown(glm::degrees(turn), 4) +
                        " degrees in the next step, at most 180; take smaller steps");
}

glm::dvec3 placed(const Keyframe& pose, const glm::dvec3& rest)
{
    return taut::pose({pose}, pose.time, rest);
}

} // namespace

const ColliderMove* Moved::find(std::size_t collider) const
{
    const auto found = std::find_if(values_.colliders.begin(), values_.colliders.end(),
                                    [&](const ColliderMove& m) { return m.collider == collider; });
    return found == values_.colliders.end() ? nullptr : &*found;
}

/// Made where there is none.
ColliderMove& Moved::move_of(std::size_t collider)
{
    const auto at = std::find_if(values_.colliders.begin(), values_.colliders.end(),
                                 [&](const ColliderMove& m) { return m.collider >= collider; });
    if (at != values_.colliders.end() && at->collider == collider)
        return *at;
    ColliderMove fresh;
    fresh.collider = static_cast<std::uint32_t>(collider);
    return *values_.colliders.insert(at, fresh);
}

PinMove* Moved::find_pin(std::size_t body, std::size_t pin)
{
    const auto found = std::find_if(values_.pins.begin(), values_.pins.end(),
                                    [&](const PinMove& m) { return m.body == body && m.pin == pin; });
    return found == values_.pins.end() ? nullptr : &*found;
}

void Moved::require_collider(std::size_t collider, const char* who) const
{
    if (collider >= scene_->colliders.size())
        refuse(who, name_of("collider", collider) + " of " + std::to_string(scene_->colliders.size()) +
                        ", numbered from 0");
    const Collider& c = scene_->colliders[collider];
    if (!c.moved_by_program && !c.motion.empty())
        refuse(who,
               name_of("collider", collider) +
                   " moves by the keyframes of the scene; leave its motion out to move it by the program");
}

/// As it would be after the order.
ColliderMove Moved::ordered(std::size_t collider, const Keyframe& pose, const char* who) const
{
    require_collider(collider, who);
    const std::string name = name_of("collider", collider);
    require_pose(pose, who, name);
    const Collider& c = scene_->colliders[collider];
    if (c.kind == ColliderKind::plane && pose.rotate_degrees != 0)
        refuse(who, "rotate_degrees turns " + name + ", a plane; planes only translate so far");
    ColliderMove move;
    if (const ColliderMove* had = find(collider))
        move = *had;
    move.collider = static_cast<std::uint32_t>(collider);
    move.goes_on = false;
    move.to = pose;
    if (move.from.translate == glm::dvec3(0) && move.from.rotate_degrees == 0)
        move.from.rotate_centre = pose.rotate_centre; // at rest any is right, and this one does not travel
    take_short_way(move.from, move.to);
    const glm::dvec3 middle = rest_frame(c).centre;
    const double way = glm::distance(placed(move.from, middle), placed(move.to, middle));
    require_speed(way / scene_->timestep, who, name);
    require_turn(turn_between(move.from, move.to), who, name);
    return move;
}

void Moved::set_poses(std::span<const std::size_t> colliders, std::span<const Keyframe> poses,
                      const char* who)
{
    if (colliders.size() != poses.size())
        refuse(who, std::to_string(poses.size()) + " poses for " + std::to_string(colliders.size()) +
                        " colliders; give one a collider");
    std::vector<ColliderMove> moves;
    for (std::size_t k = 0; k < colliders.size(); ++k)
    {
        moves.push_back(ordered(colliders[k], poses[k], who));
        if (std::find(colliders.begin(), colliders.begin() + static_cast<std::ptrdiff_t>(k), colliders[k]) !=
            colliders.begin() + static_cast<std::ptrdiff_t>(k))
            refuse(who, name_of("collider", colliders[k]) + " is there twice");
    }
    for (const ColliderMove& move : moves)
        move_of(move.collider) = move;
}

void Moved::set_velocity(std::size_t collider, const glm::dvec3& velocity, const glm::dvec3& turn)
{
    const char* who = "set_collider_velocity";
    require_collider(collider, who);
    const std::string name = name_of("collider", collider);
    require_finite(velocity, who, "the velocity of " + name);
    require_finite(turn, who, "the turn of " + name);
    const Collider& c = scene_->colliders[collider];
    if (c.kind == ColliderKind::plane && turn != glm::dvec3(0))
        refuse(who, "turns " + name + ", a plane; planes only translate so far");
    require_speed(glm::length(velocity), who, name);
    require_turn(glm::length(turn) * scene_->timestep, who, name);
    ColliderMove& move = move_of(collider);
    move.goes_on = true;
    move.velocity = velocity;
    move.turn = turn;
    move.to = moved_on(move.from, rest_frame(c).centre, velocity, turn, scene_->timestep);
}

Keyframe Moved::pose_of(std::size_t collider) const
{
    require_collider(collider, "collider_pose");
    const ColliderMove* move = find(collider);
    return move != nullptr ? move->to : Keyframe{};
}

void Moved::set_targets(std::span<const glm::dvec3> targets)
{
    const char* who = "set_pin_targets";
    std::size_t count = 0;
    for (const PinMove& move : values_.pins)
        count += move.to.size();
    if (targets.size() != count)
        refuse(who, std::to_string(targets.size()) + " targets for " + std::to_string(count) +
                        " vertices of pins with moved_by_program; give one a vertex");
    std::size_t first = 0;
    for (const PinMove& move : values_.pins)
    {
        require_targets(move, targets.subspan(first, move.to.size()), scene_->timestep, who);
        first += move.to.size();
    }
    first = 0;
    for (PinMove& move : values_.pins)
        for (glm::dvec3& target : move.to)
            target = targets[first++];
}

void Moved::set_targets(std::size_t body, std::size_t pin, std::span<const glm::dvec3> targets,
                        const char* who)
{
    if (body >= scene_->bodies.size())
        refuse(who,
               name_of("body", body) + " of " + std::to_string(scene_->bodies.size()) + ", numbered from 0");
    if (pin >= scene_->bodies[body].pins.size())
        refuse(who, name_of("pin", pin) + " of " + std::to_string(scene_->bodies[body].pins.size()) +
                        " of body " + std::to_string(body) + ", numbered from 0");
    PinMove* move = find_pin(body, pin);
    if (move == nullptr)
        refuse(who, name_of("pin", pin) + " of body " + std::to_string(body) +
                        " is not moved by the program; set its moved_by_program to true");
    if (targets.size() != move->to.size())
        refuse(who, std::to_string(targets.size()) + " targets for " + std::to_string(move->to.size()) +
                        " vertices of pin " + std::to_string(pin) + " of body " + std::to_string(body) +
                        "; give one a vertex");
    require_targets(*move, targets, scene_->timestep, who);
    move->to.assign(targets.begin(), targets.end());
}

void Moved::set_pin_pose(std::size_t body, std::size_t pin, const Keyframe& pose)
{
    const char* who = "set_pin_pose";
    require_pose(pose, who, name_of("pin", pin));
    std::vector<glm::dvec3> targets;
    if (const PinMove* move = find_pin(body, pin))
        for (const glm::dvec3& rest : move->rest)
            targets.push_back(placed(pose, rest));
    set_targets(body, pin, targets, who);
}

std::vector<glm::dvec3> Moved::targets() const
{
    std::vector<glm::dvec3> out;
    for (const PinMove& move : values_.pins)
        out.insert(out.end(), move.to.begin(), move.to.end());
    return out;
}

void Moved::set_wind(const glm::dvec3& velocity)
{
    const char* who = "set_wind";
    const bool caught = std::any_of(scene_->bodies.begin(), scene_->bodies.end(), catches_air);
    if (!(scene_->wind.density > 0) || !caught)
        refuse(who, "the scene has no wind effect; it needs wind.density above 0 and a body with drag",
               ErrorCode::unsupported);
    if (!values_.wind && !scene_->wind.keys.empty())
        refuse(who, "the wind follows the keys of the scene; leave them out to set it by the program");
    require_finite(velocity, who, "the velocity");
    require_speed(glm::length(velocity), who, "the wind");
    if (!values_.wind)
        values_.wind = WindMove{scene_->wind.velocity, {}, 0};
    values_.wind->to = velocity;
}

void ProgramMoves::set_collider_pose(std::size_t collider, const Keyframe& pose)
{
    moved_->set_poses({&collider, 1}, {&pose, 1}, "set_collider_pose");
}
void ProgramMoves::set_collider_poses(std::span<const std::size_t> colliders, std::span<const Keyframe> poses)
{
    moved_->set_poses(colliders, poses, "set_collider_poses");
}
void ProgramMoves::set_collider_velocity(std::size_t collider, const glm::dvec3& velocity,
                                         const glm::dvec3& turn)
{
    moved_->set_velocity(collider, velocity, turn);
}
Keyframe ProgramMoves::collider_pose(std::size_t collider) const { return moved_->pose_of(collider); }
void ProgramMoves::set_pin_targets(std::span<const glm::dvec3> targets) { moved_->set_targets(targets); }
void ProgramMoves::set_pin_targets(std::size_t body, std::size_t pin, std::span<const glm::dvec3> targets)
{
    moved_->set_targets(body, pin, targets, "set_pin_targets");
}
void ProgramMoves::set_pin_pose(std::size_t body, std::size_t pin, const Keyframe& pose)
{
    moved_->set_pin_pose(body, pin, pose);
}
std::vector<glm::dvec3> ProgramMoves::pin_targets() const { return moved_->targets(); }
void ProgramMoves::set_wind(const glm::dvec3& velocity) { moved_->set_wind(velocity); }

} // namespace taut
