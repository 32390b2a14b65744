#pragma once
// What a run has lost of its energy, where that can be told: by what a scene asks for (damping, contacts), or
// by its method.

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace taut {

struct PhysicalModel;
struct Scene;
struct Soundness;
struct StepReport;
class World;

/// J: what the bodies of `world`, whose vertices are at `x` [m, scene-wide], would have beside the kinetic
/// and elastic energy of `report` if nothing took any. None where more than gravity has driven them, after
/// tearing, and under pbd, which has no energies.
std::optional<double> energy_lost(const World& world, const PhysicalModel& model,
                                  std::span<const glm::dvec3> x, const Soundness& found,
                                  const StepReport& report);

/// Of what was set free (lost, or moving now) the share that is lost; 0 where that is next to nothing beside
/// `most` [J], all that there can be.
double lost_share(double lost, double kinetic, double most);

/// What a scene has that takes energy by itself: "damping", "stretch_damping", "air", "colliders", "contact",
/// "plasticity", "max_speed". Where none is, the method loses what is lost.
std::vector<std::string_view> energy_takers(const Scene& scene);

} // namespace taut
