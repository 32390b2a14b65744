#pragma once
// Internal to src/scene: waves along chains, by which vertex block descent takes its substeps.

#include "taut/scene/scene.hpp"

namespace taut {

/// (edges / s)^2, by the mean of its springs: how far waves run along a resolved body that has links and
/// springs alone. 0 of others, where all springs are rigid or where none has masses. Time: linear.
double chain_waves(const Body& resolved);

/// Whether a resolved body begins plumb below its pins and at rest, where no gravity is as it was made, and
/// neither pins, moving colliders nor forces drive it: then it stretches, but does not swing.
bool hangs_still(const Scene& resolved, const Body& body);

} // namespace taut
