#pragma once
// One setting on one device: its trajectory, its state at rest, its time.

#include "taut/report/cost.hpp"
#include "taut/report/errors.hpp"

namespace taut::cost {

struct Motion
{
    Frames frames; ///< the start and every sound frame; after settle(): the start and the last
    Status status = Status::completed;
    std::string reason; ///< why it is not sound, or not at rest
    std::size_t steps = 0;
    bool rests = false; ///< settle() only
    double wander = 0;  ///< m, mass-weighted: of a rest within kLooseRest alone, to be added to its error
};

inline constexpr double kLooseRest = 1e-3; ///< of |x - x_0|

struct Timing
{
    double median = 0, least = 0; ///< wall ms per simulated second
    double cpu = 0;               ///< process ms per simulated second, median
    std::size_t repetitions = 0;
    double low = 0, high = 0, cpu_low = 0, cpu_high = 0; ///< first and third quartile of wall and process
};

/// Repetitions of a timed run.
struct Stopwatch
{
    std::vector<double> wall, cpu; ///< ms per simulated second
    double spent = 0;              ///< wall ms
    Timing timing() const;         ///< at least one repetition
};

/// When a scene counts as at rest: over the last simulated second every frame lay within
/// max(tolerance |x - x_0|, 0.1 |x - x*|) of the last, mass-weighted.
struct RestRule
{
    ErrorWeights weights;
    const std::vector<glm::dvec3>* reference = nullptr; ///< x*; null: only the first bound
    double seconds = 30;                                ///< simulated, at most
    /// At the end of that time kLooseRest will do: float shakes in place where displacements are small.
    bool loose = false;
    std::function<bool()> enough = {}; ///< true ends the run, unrested
    double tolerance = kRestTolerance;
};

class Trial
{
public:
    /// The scene with these settings as its method. Throws what World throws.
    Trial(const Scene& resolved, std::shared_ptr<Device> device, const MethodSettings& settings);

    /// Per simulated second so far: visits of every constraint. Of methods that solve linear systems:
    /// iterations and solves, counted by the device; call it before time().
    double sweeps() const;

    /// From now on contacts of every frame are added up. Costs a read of them a frame.
    void trace_contacts() { contacts_.emplace(); }
    /// The same of so many frames from here on, as after settle().
    void trace_contacts(std::size_t frames);
    const std::optional<ContactTrace>& contacts() const { return contacts_; }

    Motion trajectory(std::size_t frames);
    /// Goes on from where the motion of this trial stands until it has that many frames after the start, or
    /// until `enough`.
    void extend(Motion& motion, std::size_t frames, const std::function<bool()>& enough = {});
    Motion settle(const RestRule& rule);
    /// Three short runs from the start: caches and pipelines.
    void warm_up(std::size_t frames);
    /// One timed run of `frames` from the start.
    void repeat(std::size_t frames, Stopwatch& watch);
    /// Runs `frames` from the start again and again: 3 short runs to warm up, then at least 5 repetitions
    /// (fewer when `seconds` of wall time are over), more while they are short.
    Timing time(std::size_t frames, double seconds);

private:
    bool advance(Motion& motion);
    void run(std::size_t frames);
    /// Gives a motion that came to its end the status of the state there.
    void judge_end(Motion& motion);

    World world_;
    WorldState start_;
    std::vector<glm::dvec3> x_;
    std::optional<ContactTrace> contacts_;
};

} // namespace taut::cost
