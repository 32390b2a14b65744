#pragma once
// `taut run` looks whether surfaces that are to meet go through each other, and says so: exactly, by the
// judge (docs/judge.md), not by the lists of contact, which hold only what is near on its right side.

#include "taut/cli/simulation.hpp"
#include "taut/judge/swept.hpp"
#include "taut/report/report.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut::cli {

class ContactWatch
{
public:
    /// `simulation` at its start; outlives the watch. Without contact in the scene nothing is looked at.
    ContactWatch(const Simulation& simulation, std::uint64_t frames);

    /// After so many frames: looks at the last one and fifteen before it, at all of few triangles, at those
    /// in which the guarantee was pinched, and each time at which surfaces passed through others since the
    /// frame before. One that hangs together cannot pass through itself without a triangle in another one
    /// that stays, so that is left to the looks. Triangles that had a common vertex before cloth came apart
    /// there are not looked at: they go on touching.
    void after(std::uint64_t frame);

    /// Adds what was seen: crossings make a run `unconverged`, pairs that no list held are a message.
    void describe(StepReport& report, std::vector<std::string>& messages) const;

private:
    void look(std::uint64_t frame, const std::vector<glm::dvec3>& positions);
    void look_between(std::uint64_t frame, const std::vector<glm::dvec3>& positions);
    bool meets_passing(const judging::Passing& passing) const;
    void learn_surfaces();
    bool meets(std::uint32_t a, std::uint32_t b) const;
    bool torn_apart(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const;

    const Simulation& simulation_;
    std::uint64_t frames_;
    bool wanted_, guarded_;
    judging::Surface surface_;
    std::vector<std::uint32_t> body_;     ///< per vertex
    std::vector<std::uint32_t> untorn_;   ///< per vertex: the first one that rests in the same place
    std::size_t at_start_ = 0, most_ = 0; ///< pairs of triangles
    std::uint64_t most_frame_ = 0;
    std::uint64_t pinched_ = 0; ///< as the simulation counted before
    std::size_t passed_ = 0; ///< pairs that met between two frames
    std::uint64_t passed_frame_ = 0;
    std::vector<glm::dvec3> before_;
    std::string most_bodies_;
};

} // namespace taut::cli
