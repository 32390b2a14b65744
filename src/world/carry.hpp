#pragma once
// Internal to src/world: the state of bodies carried from one world to another that has only some of them.

#include "taut/world/world.hpp"

#include <array>
#include <cstddef>

namespace taut {

inline constexpr std::size_t kCarriedArrays = 7;

/// Of a whole scene what a world carries on: the arrays of WorldState, per vertex, and what friction holds.
struct CarriedState
{
    std::array<std::vector<std::byte>, kCarriedArrays> arrays;
    Clock clock;
    std::uint64_t step = 0;
    ProgramMotion moved; ///< bodies as in the whole scene; whoever carries sees to it
    std::vector<HeldPair> held; ///< with the numbers of the whole scene
};

/// Scene-wide vertex of each plan vertex of a world that has only `bodies` of the scene. `first` is the
/// scene-wide vertex of each body, and the total.
std::vector<std::uint32_t> scene_vertices(const Plan& plan, const std::vector<std::uint32_t>& bodies,
                                          const std::vector<std::uint32_t>& first);

/// Reads a world's vertices into `out`, and its clock; `total` is the number of scene-wide vertices.
void collect(const World& world, const std::vector<std::uint32_t>& vertices, std::size_t total,
             CarriedState& out);

/// The other way; `bodies` of the scene are those of the world.
void deliver(World& world, const std::vector<std::uint32_t>& vertices,
             const std::vector<std::uint32_t>& bodies, const CarriedState& from);

/// What a world of some bodies gives, put where they stand in the scene.
void place(std::vector<glm::dvec3>& out, const std::vector<glm::dvec3>& own, const Plan& plan,
           const std::vector<std::uint32_t>& bodies, const std::vector<std::uint32_t>& first);

/// The scene with only some of its bodies.
Scene with_bodies(const Scene& scene, const std::vector<std::uint32_t>& bodies);

void add(Events& sum, const Events& more);
/// What is counted over a run.
void add(ContactCounts& sum, const ContactCounts& more);
/// `more` comes after what `sum` holds; `most` and `last` follow from that.
void add(SolverReport& sum, const SolverReport& more);

} // namespace taut
