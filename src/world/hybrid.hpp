#pragma once
// One scene on two devices at once: its bodies, which do not touch each other, are divided between them.

#include "taut/world/world.hpp"

namespace taut {

struct HybridOptions
{
    WorldOptions world;
    /// Steps between two measurements of both devices' speed, each followed by a new division where that
    /// promises a tenth less time; 0 = only before the first step.
    std::uint64_t measure_every = 240;
};

/// What one of the two devices does.
struct HybridPart
{
    DeviceInfo device;
    std::vector<std::uint32_t> bodies; ///< of the scene; where bodies are cut, those with a vertex here
    std::uint64_t vertices = 0;        ///< that it moves
    std::uint64_t work = 0;            ///< vertices and elements that it works on
    double milliseconds = 0;           ///< of a step of the part alone, as measured last; 0: not measured
};

/// Steps a scene on two devices. A body moves as it would alone, so results are those of one device within
/// the tolerance between devices: bit for bit between the software executors. Methods that solve one linear
/// system for all bodies (implicit_euler, implicit_constraints, acad) agree to the tolerance of that solve.
class HybridWorld : public ProgramMoves
{
public:
    /// Plans both parts and times them. `second` runs beside `first`, so `first` should be the native CPU.
    HybridWorld(const Scene& scene, std::shared_ptr<Device> first, std::shared_ptr<Device> second,
                const HybridOptions& = {});
    ~HybridWorld();
    HybridWorld(HybridWorld&&) noexcept;
    HybridWorld& operator=(HybridWorld&&) noexcept;

    /// Advances by one time step on both devices and waits for both.
    void step();

    std::uint64_t steps() const;
    double time() const;                        ///< s
    const Scene& scene() const;                 ///< resolved, whole
    std::vector<glm::dvec3> positions() const;  ///< m, in the order of the scene
    std::vector<glm::dvec3> velocities() const; ///< m/s
    Events events() const;                      ///< of both, and of what ran before a new division
    /// Of both, in the same way; a substep has a solve on each device that has bodies.
    SolverReport solver_report() const;
    std::vector<HybridPart> parts() const;
    std::uint64_t divisions() const; ///< how often bodies changed sides, the first division not counted

    /// As those of World, of one body.
    void set_positions(std::size_t body, std::span<const glm::dvec3> positions);
    void set_velocities(std::size_t body, std::span<const glm::dvec3> velocities);

    /// Gives `whole`, a world of the same scene, the state of this one (for reports and pictures). Throws
    /// Error{unsupported} where the method keeps more than places and speeds (Plan::kept).
    void copy_into(World& whole) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Bodies on the first device: a division of `work` by speed (work a millisecond) that ends soonest, bodies
/// given in falling order of work each to the device that would be done with it first (Graham 1969, LPT).
std::vector<bool> divide(const std::vector<std::uint64_t>& work, double first_speed, double second_speed);

} // namespace taut
