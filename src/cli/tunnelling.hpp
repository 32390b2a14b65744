#pragma once
// `taut run` looks whether bodies pass through colliders, and says so.

#include "taut/cli/output.hpp"
#include "taut/cli/simulation.hpp"
#include "taut/report/crossing.hpp"

#include <map>

namespace taut::cli {

/// Shows a run to a CrossingWatch: at its start and end, eight times on the way, and before anything can
/// have come as far as the middle of a collider.
class TunnelWatch
{
public:
    /// `simulation` at its start; outlives the watch.
    TunnelWatch(const Simulation& simulation, std::uint64_t frames);

    /// After so many frames.
    void after(std::uint64_t frame);

    const Crossings& found() const { return watch_.found(); }

private:
    void look(std::uint64_t frame);

    const Simulation& simulation_;
    std::uint64_t frames_, torn_ = 0;
    double looked_ = 0; ///< s
    CrossingWatch watch_;
};

/// Adds warnings, and a sentence each for the first of what was seen and of what may have been.
void describe_crossings(const Crossings& crossings, std::map<std::string, std::uint64_t>& warnings,
                        std::vector<std::string>& messages);

/// The key "tunnelling" of docs/program.md.
Json tunnelling_json(const Crossings& crossings);

} // namespace taut::cli
