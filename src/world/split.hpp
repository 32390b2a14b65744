#pragma once
// One scene on two devices at once, its vertices divided: also a single cloth is cut.

#include "taut/plan/cut.hpp"
#include "taut/world/hybrid.hpp"
#include "taut/world/split_costs.hpp"

namespace taut {

struct SplitOptions
{
    PlanOptions plan;
    /// Of the vertices, those of the first device: 0 to 1; less than 0 = best_share() of measured costs.
    double share = -1;
    Exchange exchange = Exchange::sweep;
};

/// Steps a scene on two devices that both have a part of its vertices. Bodies may be cut: what stands beside
/// the cut is exchanged through the host, between the segments of a step, and results are those of one
/// device, bit for bit where both are software executors. Programs move colliders, pins and wind; vertices
/// and velocities cannot be set, as a part has no more than its own. Takes the methods xpbd and pbd (scheme
/// "coloured").
class SplitWorld : public ProgramMoves
{
public:
    /// Plans both parts; with a negative share it times both halves first. Two native devices run side by
    /// side, in a thread each; else `first` should be the native CPU. Throws what World's constructor throws,
    /// Error{bad_input} for a scene without bodies or a share above 1 (or no number), Error{unsupported}
    /// naming the method or the effect that cannot be cut.
    SplitWorld(const Scene& scene, std::shared_ptr<Device> first, std::shared_ptr<Device> second,
               const SplitOptions& = {});
    ~SplitWorld();
    SplitWorld(SplitWorld&&) noexcept;
    SplitWorld& operator=(SplitWorld&&) noexcept;

    /// Advances by one time step on both devices and waits for both.
    void step();

    std::uint64_t steps() const;
    double time() const;                        ///< s
    const Scene& scene() const;                 ///< resolved
    const Plan& plan() const;                   ///< of the whole
    std::vector<glm::dvec3> positions() const;  ///< m, in the order of the scene
    std::vector<glm::dvec3> velocities() const; ///< m/s, at the step
    Events events() const;                      ///< of both; nothing is counted twice

    double share() const;                  ///< of the first device, as it came out
    const SplitCosts& costs() const;       ///< zero where the share was given
    std::uint64_t work() const;            ///< of the whole; parts() have more together, what both solve
    std::uint64_t exchanges() const;       ///< of a step
    std::uint64_t exchanged_bytes() const; ///< of a step, both ways
    /// bodies: all with a vertex there; milliseconds: by costs(), so 0 where the share was given
    std::vector<HybridPart> parts() const;

    /// As HybridWorld::copy_into.
    void copy_into(World& whole) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace taut
