#pragma once
// What implicit Euler prepares (implicit_euler.cpp) and its passes bind (implicit_step.cpp). Internal to
// src/plan.

#include "taut/linear/two_level.hpp"
#include "taut/plan/builder.hpp"
#include "taut/plan/solve.hpp"

#include <optional>
#include <string_view>

namespace taut {

/// The effect that pays for its buffers and passes.
inline constexpr std::string_view kImplicitEuler = "implicit_euler";

/// Elements of one kind that go through kernels/methods/implicit_euler/.
struct ImplicitKind
{
    std::string effect, stem; ///< who pays; the element's, of which its kernels are named
    std::uint32_t records = kNoBuffer, table = kNoBuffer, count = 0;
    std::uint32_t corners = 4;
};

/// Everything that the passes of a Newton step bind. Kept by the builder until the plan is made.
struct ImplicitEuler
{
    std::uint32_t springs = kNoBuffer, spring_table = kNoBuffer, spring_count = 0;
    std::vector<ImplicitKind> kinds; ///< hinges, and what the program has added
    std::uint32_t solids = kNoBuffer, solid_table = kNoBuffer, solid_state = kNoBuffer, solid_count = 0;
    std::uint32_t held = kNoBuffer, values = kNoBuffer;
    std::uint32_t marks = kNoBuffer; ///< as held, in this Newton step
    std::uint32_t light = kNoBuffer, before = kNoBuffer; ///< what colliders may hold: implicit_hold.comp
    std::uint32_t part_start = kNoBuffer, part_members = kNoBuffer, part_count = 0;
    bool damped = false;
    float scale = 1; ///< of mass: power of two
    float lift = 1;  ///< of displacements: power of two
    std::optional<PlanSolve> solve;
    std::shared_ptr<const linear::TwoLevel> coarse; ///< null: block Jacobi alone
    BufferPtr product, products, curvatures;        ///< of the inertial guess
    std::uint32_t trial_count = 1; ///< the whole step and how often it is halved
    BufferPtr trials;              ///< partial sums of the line search; null: none
    std::uint32_t parts() const
    {
        return 1u + (spring_count > 0 ? 1u : 0u) + static_cast<std::uint32_t>(kinds.size()) +
               (solid_count > 0 ? 1u : 0u);
    }
};

} // namespace taut
