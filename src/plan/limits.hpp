#pragma once
// Internal to src/plan: what keeps cloth from growing too long (strain limits, long-range attachments), and
// what tells that it did (tearing).

#include "taut/plan/builder.hpp"

#include <cstdint>
#include <vector>

namespace taut {

/// Where a vertex of a body hangs.
struct NearestPin
{
    std::uint32_t pin = 0; ///< the body's own vertex
    double distance = 0;   ///< m, along the edges at rest
};

/// By vertex of a resolved body; infinite distance where no edge leads to a pin, 0 at pins.
/// Based on: Dijkstra. A note on two problems in connexion with graphs. 1959, from all pins at once.
std::vector<NearestPin> nearest_pins(const Body& body);

// Whether a resolved scene calls for each.
bool wants_strain_limit(const Scene& scene);
bool wants_attachment(const Scene& scene);
bool wants_tearing(const Scene& scene);

void prepare_strain_limit(PlanBuilder& builder);
void record_strain_limit(PlanBuilder& builder, const Moment& moment);
void prepare_attachment(PlanBuilder& builder);
void record_attachment(PlanBuilder& builder, const Moment& moment);
void prepare_tearing(PlanBuilder& builder);
void record_tearing(PlanBuilder& builder, const Moment& moment);

} // namespace taut
