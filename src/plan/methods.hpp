#pragma once
// The table of methods: how a step advances. A method is a row; what it adds to a step are rows of the table
// of effects (builder.hpp) that name it.

#include "taut/scene/method_kind.hpp"
#include "taut/scene/scene.hpp"

#include <cstdint>
#include <string>

namespace taut {

class Refusals;

struct DeviceTraits;

/// Substeps of a time step, and the longest that a substep may become later, s; 0 = any length.
struct Substeps
{
    std::uint32_t count = 1;
    double largest = 0;
};

struct Method
{
    MethodKind kind;
    /// Contacts after every iteration of the solver (position-based methods), or once, after the last.
    bool contact_each_iteration = false;
    /// The inertial guess of each substep's displacement is kept beside the displacement.
    bool keeps_guess = false;
    /// Throws Error{unsupported, bad_timestep, ...} for what the method cannot do; may be null.
    void (*check)(const Scene& resolved, Refusals&) = nullptr; ///< what of the scene it cannot do
    bool volumes = false;        ///< can hold volumes of tetrahedra
    bool elastic = false;        ///< can move neo-Hookean tetrahedra
    bool surface_volume = false; ///< can hold the volume within a closed surface
    /// Substeps that the method takes; null: as the scene says. Throws Error{unstable_timestep}.
    Substeps (*substeps)(const Scene& resolved) = nullptr;
};

/// Throws Error{unsupported} for what is no enumerator.
const Method& find_method(MethodKind kind);
/// The names of the methods that can do something, as a list in words.
std::string methods_with(bool Method::*can);

/// Refuses, as `unsupported`, bodies whose tetrahedra the scene's method cannot move, or whose volume it
/// cannot hold, as their material says, naming the methods that can; what check_surface throws for a surface.
void check_solids(const Scene& resolved, Refusals& out);

} // namespace taut
