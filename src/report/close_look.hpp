#pragma once
// Internal to src/report: one body against one collider at a look, group by group of its elements.

#include "taut/report/crossing_shapes.hpp"
#include "taut/report/element_groups.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace taut {

struct WatchedBody
{
    std::string name;
    std::size_t first = 0, count = 0; ///< vertices, scene-wide
    ElementGroups groups;
    double edge = 0;      ///< m, longest at rest
    double gap = 0;       ///< m
    double led_speed = 0; ///< m/s, the most of its pins
};

/// A collider that has an inside.
struct WatchedCollider
{
    std::string name;
    Collider collider;
    SolidShape shape;
    double led_speed = 0; ///< m/s, the most that its keyframes make anywhere on it

    /// m/s, of its centre from `time` over `substep`, s.
    glm::dvec3 velocity(double time, double substep) const;
};

struct LookMoment
{
    std::uint64_t frame = 0;
    double time = 0, substep = 0; ///< s
    SceneMotion motion;
    std::optional<double> last_time; ///< s, of the look before
};

/// What a close look goes by.
struct LookBounds
{
    double speed = 0;    ///< m/s, of the fastest vertex relative to the collider
    double width = 0;    ///< m, half of what has to fit through a hole
    double timestep = 0; ///< s
    double gravity = 0;  ///< m/s^2
    bool depth = false;  ///< whether to measure it
};

/// What a close look finds.
struct LookFound
{
    double clear = 0;       ///< s, as CrossingWatch::clear_for()
    std::uint64_t deep = 0; ///< elements
    double depth = 0;       ///< m, of the deepest below the surface
    bool fits = false;      ///< the collider through a hole near it
};

/// Half sizes of a collider's middle: the point, or axis, or what is deeper in a box than its smallest half
/// size.
glm::dvec3 middle_half(const SolidShape& shape);

/// m: how far something may get in `time` (s): it goes on with `speed` (m/s), as much again in any direction,
/// and falls with 1.5 times `gravity` (m/s^2), since neighbours pull.
double way_over(double time, double speed, double gravity);
/// s: how long that is less than `distance` (m).
double time_over(double distance, double speed, double gravity);

/// Keeps what it needs from look to look; not thread-safe. `motions`: of the body's groups.
class CloseLook
{
public:
    LookFound look(const WatchedBody& body, const WatchedCollider& collider,
                   std::span<const GroupMotion> motions, const LookMoment& now, const LookBounds& bounds);

    /// Whether the surface went through the collider's middle since the look before.
    bool went_through(const WatchedBody& body, const WatchedCollider& collider,
                      std::span<const GroupMotion> motions, const LookMoment& now);

private:
    void order_groups(const WatchedBody& body, const WatchedCollider& collider,
                      std::span<const GroupMotion> motions, const LookMoment& now, const LookBounds& bounds);
    void look_at_elements(const WatchedBody& body, const WatchedCollider& collider, const ElementGroup& group,
                          const LookBounds& bounds, LookFound& out);
    bool group_went_through(const WatchedBody& body, const WatchedCollider& collider,
                            const ElementGroup& group) const;

    std::vector<glm::dvec3> before_, after_;            ///< of the body in the frame of the collider
    std::vector<glm::dvec3> velocities_;                ///< m/s, relative to it, in its frame
    std::vector<std::pair<double, std::size_t>> order_; ///< groups by the soonest that they may arrive, s
    std::vector<glm::dvec3> middle_;                    ///< of the collider
};

} // namespace taut
