#pragma once
// Internal to src/report: a world's state in fp64 beside the model of its scene.

#include "taut/report/hinge.hpp"
#include "taut/report/model.hpp"
#include "taut/world/world.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <vector>

namespace taut::reference {

using DistanceRecord = layout::DistanceConstraint<double>;
using BendingRecord = layout::BendingConstraint<double>;

/// A world's state with its model. Vertices scene-wide.
struct View
{
    explicit View(const World& w);

    double length(const DistanceRecord& c) const;
    HingeAngle<double> angle(const BendingRecord& c) const;
    /// m: rest lengths of `distance` as the plan made them, before plasticity changed any; empty where the
    /// method has no such constraints.
    std::vector<double> first_lengths() const;

    const World& world;
    const Plan& plan;
    PhysicalModel model;
    std::vector<glm::dvec3> x, v;
    std::vector<DistanceRecord> distance;
    std::vector<BendingRecord> bending;
};

} // namespace taut::reference
