#pragma once
// What `taut run` steps: a world on one device, or one scene on two.

#include "taut/report/report.hpp"
#include "taut/world/hybrid.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

class Simulation
{
public:
    virtual ~Simulation() = default;
    virtual void step() = 0; ///< waits for the device
    virtual const Scene& scene() const = 0;
    virtual double time() const = 0;
    virtual std::vector<glm::dvec3> positions() const = 0;
    virtual std::vector<glm::dvec3> velocities() const = 0;
    virtual std::uint32_t substeps() const = 0; ///< of a time step, as planned
    virtual Events events() const = 0;
    virtual SolverReport solver_report() const = 0;
    virtual double active_share() const { return -1; } ///< as World::active_share
    /// Linear systems that the method solves in a substep.
    virtual std::size_t solvers() const = 0;
    /// As World::torn; scene() and positions() change with it.
    virtual std::uint64_t torn() const { return 0; }
    /// As ContactCounts::pinched.
    virtual std::uint64_t pinched() const { return 0; }
    /// A world in the state of the simulation, for reports and pictures. Stays the simulation's. Where it is
    /// not the one that runs, it counts nothing: events() and solver_report() are those of the run.
    virtual World& whole() = 0;
    virtual bool is_whole() const { return true; } ///< whether whole() is the world that runs
    /// Where whole() is not the world that runs, and surfaces meet: puts what they did into a report of it.
    virtual void take_contacts(StepReport&) const {}
    virtual std::vector<HybridPart> parts() const { return {}; } ///< empty on one device
    virtual std::optional<std::size_t> asleep() const { return {}; } ///< bodies, where they may sleep
};

/// What --split takes: what two devices divide.
inline constexpr std::string_view kSplitBodies = "bodies", kSplitVertices = "vertices";

struct SimulationOptions
{
    /// As --device has it. "hybrid" is the native CPU and the best other device, "hybrid:vulkan" (or another
    /// selector) says which, "hybrid:cpu:serial+cpu:serial" names both.
    std::string device;
    std::string split = std::string(kSplitBodies);
    std::optional<double> share; ///< of the vertices, the first device's; none: as measured
    bool sleep = false;          ///< bodies at rest sleep, on one device
};

/// Throws Error{no_device} where there is no other device, Error{bad_input} for options that do not go
/// together, Error{unsupported} where the scene's method keeps what two worlds cannot put together, or the
/// scene cannot be cut.
std::unique_ptr<Simulation> open_simulation(const SimulationOptions& options, const Scene& resolved);

} // namespace taut::cli
