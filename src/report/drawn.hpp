#pragma once
// What elastic energy pins put into a body that they draw: how much at most, and how much of it can have come
// free. Internal to energy_budget.cpp.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// J. `held`: of the bodies as drawn, in balance or not. `freed`: how much less that is than it was, and what
/// was pushed together, which may buckle.
struct DrawnEnergy
{
    double held = 0, freed = 0;
};

/// Bodies whose pins move against each other, against colliders, or against those of other bodies that they
/// meet. Immutable after construction.
///
/// Based on: the principle of least energy: what is in balance has no more elastic energy than if it were
///   drawn evenly over the length between two pins.
/// Departures: where only translations of pins draw a body and nothing can tear, the length by which each two
///   pins have drawn what lies between them is followed over time; otherwise everything moved counts as drawn
///   and as freed.
class DrawnBodies
{
public:
    explicit DrawnBodies(const Scene& resolved);

    /// At `time` [s], m: the longest way by then of anything that moves and can have met a body, and the
    /// deepest start in colliders and surfaces.
    DrawnEnergy at(double time, double travel, double depth) const;

private:
    /// Two pins of a body of which one moves.
    struct Pair
    {
        std::vector<Keyframe> a, b;
        std::vector<glm::dvec3> between; ///< m, from places of one to places of the other, at rest
        double stiffness = 0;            ///< J/m^2
    };
    /// How far a pair is from its distances at rest: apart, and together, m.
    struct Change
    {
        double apart = 0, together = 0;
    };
    static Change change(const Pair& pair, double time);
    void follow(const Body& body);

    std::vector<Pair> pairs_;
    // J/m^2, of bodies that are not followed pair by pair: with all that they can meet, and while nothing
    // that moves has been near.
    double met_stiffness_ = 0, stiffness_ = 0;
};

} // namespace taut
