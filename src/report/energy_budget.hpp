#pragma once
// How much energy a scene can hold: what it starts with, and what gravity, moving pins and colliders, wind,
// gas and forces can have put in since. Soundness (soundness.hpp) compares runs with it.

#include "taut/report/model.hpp"
#include "taut/report/mover_paths.hpp"
#include "taut/world/world.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace taut {

class DrawnBodies;

/// m: what rounding of places up to `far` (m) from the origin can add up to.
double rounded_way(Precision precision, double far);

/// J: the most that energies can be.
struct EnergyMost
{
    double kinetic = 0; ///< less than `all` by what pins hold drawn
    double all = 0;     ///< kinetic and elastic together
    bool exact = false; ///< gravity alone has driven bodies: without losses they would have all of it
};

/// Bounds on energy, fp64 on the host. Const members may be called from any thread.
///
/// Based on: the work-energy theorem. A force that accelerates every part of a mass M by at most g raises
///   sqrt(2 E / M) by at most g t, and what is carried along by at most all changes of velocity together;
///   what moves at V passes on at most a multiple of V to what it meets.
/// Departures: the work of moving pins and colliders is bounded by multiples of their speeds, not integrated.
/// A
///   collider whose way is further from all that a body can have been at than the body is large has done
///   none.
class EnergyBudget
{
public:
    /// `resolved` as the world had it at the start, before anything tore; what its program moves counts by
    /// WorldDrive::moved.
    explicit EnergyBudget(const Scene& resolved);
    /// The same for one who has make_model(resolved) already.
    EnergyBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model);
    /// The same, with its collider_paths().
    EnergyBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model, ColliderPaths colliders);

    const PhysicalModel& model() const { return *shared_; }

    /// At places `x` [m, scene-wide]. Infinite after World::set_positions.
    EnergyMost most(std::span<const glm::dvec3> x, const WorldDrive& drive) const;

    /// J: what rounding and the last digits of strains can make: below it nothing is judged. `substep` in s.
    double rounding(Precision precision, double substep) const;

    /// J: a hundredth of a fall through the scene's own size.
    double small() const;

    double mass() const { return mass_; } ///< kg, of vertices that move

    /// J, that damping is known to have taken out so far: most() is less by it, but where something drives
    /// bodies.
    void set_damped(double energy) { damped_ = energy; }

    /// Speeds of colliders count so often: a mass between two that close in is thrown faster.
    static constexpr double kHits = 4;
    /// Changes of velocity count so often: the free end of what is pulled moves twice as fast.
    static constexpr double kPulls = 2;

private:
    /// Of all that can have touched bodies that are at `x`, together; `speed` is what they can pass on.
    MoverReach reach_at(const WorldDrive& drive, std::span<const glm::dvec3> x) const;

    std::shared_ptr<const PhysicalModel> shared_;
    std::vector<MoverPath> paths_; ///< of pins
    ColliderPaths colliders_;
    double mass_ = 0, lightest_ = 0, start_ = 0, gravity_start_ = 0, depth_ = 0;
    std::shared_ptr<const DrawnBodies> drawn_;
    double damped_ = 0;
    double violation_ = 0;     ///< m: largest of what rigid elements must put right at the start
    double depenetration_ = 0; ///< m/s
    double wind_speed_ = 0;    ///< m/s
    double wind_drag_ = 0;     ///< N s^2/m^2: of all triangles together, over the square of the wind's speed
};

} // namespace taut
