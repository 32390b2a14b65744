#pragma once
// Internal to src/plan: elements as the records that kernels read. The one place that knows the order of a
// record's fields.

#include "taut/plan/material.hpp"
#include "taut/plan/solid.hpp"

#ifndef TAUT_HOST
#define TAUT_HOST
#endif
#include "taut/kernels/shared/layouts.h"

#include <vector>

namespace taut {

template <typename Real>
layout::DistanceConstraint<Real> distance_record(const StretchElement& e)
{
    return {e.a, e.b, static_cast<Real>(e.rest_length), static_cast<Real>(e.compliance)};
}

/// A rigid spring has the stiffness 0: methods of forces refuse it, rows of constraints take 0 for rigid.
template <typename Real>
layout::Spring<Real> spring_record(const StretchElement& e)
{
    return {e.a,
            e.b,
            static_cast<Real>(e.rest_length),
            e.compliance > 0 ? static_cast<Real>(1 / e.compliance) : Real(0),
            static_cast<Real>(e.damping),
            static_cast<std::uint32_t>(e.kind)};
}

template <typename Real>
layout::BendingConstraint<Real> bending_record(const BendElement& e)
{
    return {e.edge0, e.edge1, e.wing0, e.wing1, static_cast<Real>(e.rest_angle),
            static_cast<Real>(e.compliance)};
}

template <typename Real>
layout::VolumeConstraint<Real> volume_record(const VolumeElement& e)
{
    return {e.vertex[0], e.vertex[1], e.vertex[2], e.vertex[3], static_cast<Real>(e.rest_volume),
            static_cast<Real>(e.compliance)};
}

template <typename Real>
layout::SolidTetrahedron<Real> solid_record(const SolidElement& e)
{
    const auto b = [&e](int row, int column) { return static_cast<Real>(e.inverse_rest[column][row]); };
    return {e.vertex[0],
            e.vertex[1],
            e.vertex[2],
            e.vertex[3],
            b(0, 0), b(0, 1), b(0, 2),
            b(1, 0), b(1, 1), b(1, 2),
            b(2, 0), b(2, 1), b(2, 2),
            static_cast<Real>(e.rest_volume),
            static_cast<Real>(e.mu),
            static_cast<Real>(e.lambda),
            static_cast<Real>(e.rest),
            static_cast<Real>(e.log)};
}

/// `of` each element, in their order.
template <typename Element, typename Of>
auto records_of(const std::vector<Element>& elements, const Of& of)
{
    std::vector<decltype(of(elements.front()))> out;
    out.reserve(elements.size());
    for (const Element& e : elements)
        out.push_back(of(e));
    return out;
}

} // namespace taut
