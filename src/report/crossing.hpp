#pragma once
// Whether bodies pass through colliders between their vertices, which are all that the methods collide: seen
// at the moments that a watch is shown, and in the motion from one to the next.

#include "taut/report/close_look.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// The first time that a body was seen in a collider.
struct Crossing
{
    std::string body, collider; ///< names, or numbers as "bodies[0]" where there is none
    std::uint64_t frame = 0;    ///< of the look
    double time = 0;            ///< s
    bool through = false;       ///< the surface went through the middle; else an element lies deep in it
};

struct Crossings
{
    std::uint64_t elements = 0;   ///< triangles and links that lay deep in a collider, most at one look
    double depth = 0;             ///< m: of the deepest of them below the surface
    std::uint64_t passed = 0;     ///< looks before which a surface went through a collider's middle
    std::uint64_t may_tunnel = 0; ///< looks at which sizes and speeds of a body near a collider allowed it
    std::vector<Crossing> seen;   ///< one of each body and collider at most
    std::vector<Crossing> likely; ///< the same of may_tunnel
};

/// What may_tunnel goes by. docs/statuses.md tells how they were chosen.
inline constexpr double kTunnelHole = 1;     ///< a hole between vertices over the width of a collider
inline constexpr double kTunnelTravel = 0.5; ///< relative way of a vertex in a substep / a collider's size
/// Looks at a run on the way, beside those that must not come later (CrossingWatch::clear_for).
inline constexpr std::uint64_t kCrossingLooks = 8;

/// Watches one run. Needs no device; not thread-safe. Throws nothing but std::bad_alloc. A look costs about
/// one sweep over the vertices of bodies, and over those groups of triangles that are near a collider or that
/// decide when to look again; next to nothing without colliders. Planes, which have no far side, are left to
/// StepReport::penetration.
///
/// Colliders move by the keyframes of the scene: those that a program moves are not followed.
///
/// Where a body and a collider start in each other, nothing is said of them until they have parted.
class CrossingWatch
{
public:
    explicit CrossingWatch(const Scene& resolved);

    /// The meshes have changed (cloth tore): the next look is not compared with the last one.
    void set_scene(const Scene& resolved);

    /// `positions` (m) and `velocities` (m/s) in the order of the scene, at `time` (s); `substep` in s.
    /// Positions that are not finite are not looked at, nor anything of their body.
    void look(std::uint64_t frame, double time, double substep, std::span<const glm::dvec3> positions,
              std::span<const glm::dvec3> velocities);

    /// s from the last look, until which no element reaches the middle of a collider if its velocity does not
    /// change by more than its speed (a quarter of its body's at least), half as much again as gravity makes,
    /// and what leads vertices: when to look again. Infinite without colliders.
    double clear_for() const { return clear_; }

    /// Whether there is anything to look at.
    bool needed() const { return !colliders_.empty(); }

    const Crossings& found() const { return found_; }

private:
    struct Bounds
    {
        glm::dvec3 low{0}, high{0};
        double distance(const glm::dvec3& point) const;
    };
    struct Motion /// of a body at a look
    {
        Bounds bounds;
        double speed = 0; ///< m/s, the fastest vertex
        bool finite = true;
    };
    struct Pair
    {
        bool inside = false; ///< since the start of the run
        bool seen = false, likely = false;
        bool by_triangles = false; ///< the collider meets the body's triangles, so no hole lets it through
    };

    Motion motion_of(const WatchedBody& body, const LookMoment& now);
    void look_at(const WatchedBody& body, const Bounds& last, const Motion& motion,
                 const WatchedCollider& collider, Pair& pair, const LookMoment& now);
    void look_closely(const WatchedBody& body, double speed, const WatchedCollider& collider, Pair& pair,
                      const LookMoment& now);
    static void note(std::vector<Crossing>& list, bool& noted, const WatchedBody& body,
                     const WatchedCollider& collider, const LookMoment& now, bool through);

    std::vector<WatchedBody> bodies_;
    std::vector<WatchedCollider> colliders_;
    std::vector<Pair> pairs_;    ///< [body * colliders + collider]
    std::vector<Bounds> bounds_; ///< of bodies at the last look
    double gravity_ = 0, timestep_ = 0;
    std::vector<glm::dvec3> last_; ///< positions at the last look
    std::optional<double> last_time_;
    bool first_ = true;                ///< no look so far
    std::vector<GroupMotion> motions_; ///< of the body that is looked at
    CloseLook close_;
    double clear_ = 0;
    std::uint64_t elements_ = 0; ///< deep at this look
    Crossings found_;
};

} // namespace taut
