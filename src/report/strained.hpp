#pragma once
// How far elements are from what a scene accepts, and the energy of those: what soundness (soundness.hpp)
// judges.

#include "taut/report/soundness.hpp"

namespace taut {

/// What is strained beyond what the scene accepts.
struct Strained
{
    double energy = 0; ///< J, of elements with a stiffness whose shape at rest the model knows
    /// J, of tetrahedra strained beyond kSlightStrain of that, but for those that contacts pushed last
    double slight_energy = 0;
    double kept_strain = 0;   ///< largest strain of those that the method keeps by projection
    double limit_strain = 0;  ///< largest strain above a strain_limit
    double active_strain = 0; ///< largest above activate_strain, of springs that acad may constrain
    double kept_volume = 0;   ///< largest share by which a body is off the volumes that the method keeps so
};

/// Of one state. Hinges count by their angle in rad.
Strained strained(const PhysicalModel& model, const RunState& state);

} // namespace taut
