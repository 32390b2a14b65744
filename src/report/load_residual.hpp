#pragma once
// Whether bodies answer to their loads.

#include "taut/report/model.hpp"
#include "taut/scene/substeps.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace taut {

/// What a substep left at each vertex, scene-wide.
struct Leftover
{
    std::vector<glm::dvec3> force; ///< N: M (x - x~) / h^2 - f(x)
    /// N: mass times the larger of gravity (or its stand-in) and |(x - x~) / h^2|, of which `gas` is no part.
    std::vector<double> load;
    std::vector<bool> touches; ///< something whose force is on no record: a collider, a limit
    std::vector<double> carried;   ///< m: how far a held one was moved within `time`; may be empty
    double time = 0;               ///< s, > 0: the substep, or what a body has to answer in
    bool against_response = false; ///< loads count by what they move within `time`, not free of everything
    /// N: what gases push with, against which `against_response` counts, too; may be empty.
    std::vector<glm::dvec3> gas = {};
    std::vector<bool> beside = {}; ///< shares an element with one that touches, whose push it has yet to
                                   ///< follow; may be empty
    /// Bodies that leave a larger share are followed to where their elements hold them; `against_response`.
    double followed = HUGE_VAL;
    bool is_beside(std::size_t vertex) const { return !beside.empty() && beside[vertex]; }
};

/// Of accept.residual: where nothing is done all of the loads' motion is left.
inline constexpr double kLoadShare = 0.25;
/// Of accept.residual: bodies that leave more are followed. A cantilever with 0.16 was 5.5 % of its size off
/// where one step led by 1 %.
inline constexpr double kFollowedShare = 0.1;

/// Of one body.
struct LoadResidual
{
    double share = -1; ///< of what its loads move; -1 without a free vertex
    /// Mass-weighted mean of |d| over the diagonal of the box that the body fills; of a body that is followed
    /// the larger of that and of all of Newton's way.
    double way = 0;
};

/// What one exact Newton step d would still move of a body's mass, over what its loads move in the time
/// t: sum m |d| / sum (t^2 l + m c) over its free vertices, c the longest way of one of its held
/// vertices, with (M / t^2 + K) d = -r, K made positive semidefinite element by element. With
/// `against_response` over sum m |e|, (M / t^2 + K) e = l along gravity, or without any along each axis,
/// or e of the gases' forces, whichever moves most. 0 solved, 1 as if nothing pulled. That of the body
/// with the largest share of those whose way is above kSeenWay, or of all where none is. Contacts push
/// after the solve, and what lies on them has yet to follow: vertices that touch stay where they are, and,
/// unless `against_response`, r is 0 at those beside them; of such bodies half of d is counted, with
/// `against_response` without rolling about what touches, where that is narrow and no pin holds the body
/// (docs/decisions.md, 73). Where that is most of a body, r counts beside them, too, and of d what goes along
/// gravity alone; without gravity nothing is said of it. Infinite where the step is not finite. A body
/// whose share is above `followed` is led on by Newton's method, down E(y) + c (y - x) + M (y - x)^2 / (2
/// t^2), c of the force that is left: sweeps strain springs at random by far more than loads do, and the
/// tension of that holds back the first step, but no later one. Models of more than 10,000 free vertices
/// (of solids: 2,000) are solved by conjugate gradients, to about 3 % of the share or 0.002, but where a
/// few loose vertices alone carry what the loads move (docs/decisions.md, 51); the steps that follow a
/// body, from 1,000 free vertices on (of solids: 500), each to 1 % of what it moves.
LoadResidual load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left);

} // namespace taut
