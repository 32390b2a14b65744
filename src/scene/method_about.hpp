#pragma once
// What the pages say of each method. Internal to src/scene.

#include "taut/scene/scene.hpp"

#include <array>

namespace taut::scene_file {

struct MethodAbout
{
    std::string_view what; ///< corrects the inertial guess
    bool has_page = true;  ///< docs/methods/NAME.md
};

/// In the order of MethodKind.
inline constexpr std::array<MethodAbout, kWords<MethodKind>.size()> kMethodAbout = {{
    {"nothing: forces act before the guess"},
    {"Newton steps on the incremental potential, each a linear solve on the device"},
    {"all springs together, as one linear system"},
    {"springs beyond a strain, as one linear system; the others are forces"},
    {"shares of constraints, by colours or by averaged Jacobi; its stiffness is its own"},
    {"constraints, one after another by colours", false},
    {"Newton steps of one vertex at a time, by colours of vertices"},
}};

} // namespace taut::scene_file
