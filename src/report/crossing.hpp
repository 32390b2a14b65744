#pragma once
// Whether bodies pass through colliders between their vertices, which are all that the methods collide: seen
// at the moments that a watch is shown, and in the motion from one to the next.

#include "taut/report/crossing_shapes.hpp"

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

/// Watches one run. Needs no device; not thread-safe. Throws nothing but std::bad_alloc. A look costs about
/// as much as one sweep over the vertices and triangles of bodies whose bounds are near a collider, and next
/// to nothing without colliders; planes, which have no far side, are left to StepReport::penetration.
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

    /// s from the last look, until which no element reaches the middle of a collider if it does not speed up
    /// to more than twice what its speed (a quarter of its body's at least), gravity and led vertices make:
    /// when to look again. Infinite without colliders.
    double clear_for() const { return clear_; }

    /// Whether there is anything to look at.
    bool needed() const { return !obstacles_.empty(); }

    const Crossings& found() const { return found_; }

private:
    struct Bounds
    {
        glm::dvec3 low{0}, high{0};
        bool finite = true;
        double distance(const glm::dvec3& point) const;
    };
    struct Part /// a body
    {
        std::string name;
        std::size_t first = 0, count = 0;                   ///< vertices, scene-wide
        std::vector<std::array<std::uint32_t, 3>> elements; ///< scene-wide; links have a corner twice
        double edge = 0;                                    ///< m, longest at rest
        double gap = 0;                                     ///< m
        double led_speed = 0;                               ///< m/s, the most of its pins
        Bounds last;                                        ///< at the last look
    };
    struct Motion /// of a body at a look
    {
        Bounds bounds;
        double speed = 0;   ///< m/s, the fastest vertex
        glm::dvec3 mean{0}; ///< m/s
        double way = 0;     ///< m, the furthest that a vertex moved since the last look
    };
    struct Obstacle /// a collider that has an inside
    {
        std::string name;
        Collider collider;
        SolidShape shape;
        double led_speed = 0;
    };
    struct Pair
    {
        bool inside = false; ///< since the start of the run
        bool seen = false, likely = false;
    };
    struct Scan /// what one sweep over the elements of a body finds
    {
        double nearest = 0; ///< m, of an element to the middle, at least
        double clear = 0;   ///< s, as clear_for()
        std::uint64_t deep = 0;
        bool fits = false; ///< the collider through a hole near it
    };
    struct Moment
    {
        std::uint64_t frame = 0;
        double time = 0, substep = 0;
        std::span<const glm::dvec3> x, v;
    };

    Motion motion_of(const Part& part, const Moment& now) const;
    void look_at(const Part& part, const Motion& motion, const Obstacle& obstacle, Pair& pair,
                 const Moment& now);
    void look_closely(const Part& part, const Motion& motion, const Obstacle& obstacle, Pair& pair,
                      const Moment& now);
    Scan scan(const Part& part, const Obstacle& obstacle, const Pair& pair, double speed, double width);
    bool went_through(const Part& part, const Motion& motion, const Obstacle& obstacle, double nearest);
    static void into_frame(const Part& part, const Obstacle& obstacle, std::span<const glm::dvec3> x,
                           double time, std::vector<glm::dvec3>& out);
    double speeds_of(const Part& part, const Obstacle& obstacle, const Moment& now);
    double width_of(const Part& part, const Motion& motion, const Obstacle& obstacle,
                    const Moment& now) const;
    void note(std::vector<Crossing>& list, bool& noted, const Part& part, const Obstacle& obstacle,
              const Moment& now, bool through) const;

    std::vector<Part> parts_;
    std::vector<Obstacle> obstacles_;
    std::vector<Pair> pairs_; ///< [part * obstacles + obstacle]
    double gravity_ = 0, timestep_ = 0;
    std::vector<glm::dvec3> last_; ///< positions at the last look
    std::optional<double> last_time_;
    bool first_ = true;                      ///< no look so far
    std::vector<glm::dvec3> before_, after_; ///< of one body in the frame of a collider
    std::vector<double> speeds_;             ///< m/s, of its vertices relative to the collider
    double clear_ = 0;
    std::uint64_t elements_ = 0; ///< deep at this look
    Crossings found_;
};

} // namespace taut
