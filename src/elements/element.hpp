#pragma once
// Elements as an energy of up to four vertices, said in one GLSL file (kernels/shared/element.glsl) and one
// ElementKind: those of a program's own, that Taut does not have (docs/how-to/add-an-element.md walks through
// it), and Taut's that stand in Body::elements as well.

#include "taut/runtime/base/kernel_info.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// What Taut must know of an element besides its kernels.
struct ElementKind
{
    std::string name;                ///< stem of its GLSL file; also the label of its passes and buffers
    std::uint32_t corners = 2;       ///< vertices of one element, 2 to 4, as its line `//! corners` says
    std::vector<std::string> values; ///< names of the reals that follow the corners in its record, in order
    /// kernels::<name>::all(): those of every method that its line `//! methods` names.
    std::vector<std::span<const KernelInfo>> kernels;
    /// J, >= 0, in fp64, of one element with its corners at `x` (m). Reports count it.
    double (*energy)(std::span<const glm::dvec3> x, std::span<const double> values) = nullptr;
    /// The least and the largest relative change of a length within the element, -1 or more; null if it has
    /// none. Reports give the largest of all; strain beyond Accept::stretch must be paid for by energy.
    std::array<double, 2> (*stretches)(std::span<const glm::dvec3> x,
                                       std::span<const double> values) = nullptr;
};

/// Bytes of one record: `corners` uints, then the values, as std430 lays them out.
std::uint32_t record_bytes(const ElementKind& kind, Precision precision);

/// Makes the kind known to scenes of this program (Body::elements), for good. Throws Error{bad_input} for a
/// name that is taken, by one of Taut's own, too, for corners, values or kernels that do not fit each other,
/// and without an energy. Safe from several threads.
void add_element(const ElementKind& kind);

/// Taut's "membrane", or what was added; else null. The pointer stays good. Safe from several threads.
const ElementKind* find_element(std::string_view name);

/// Whether the kind has `kernel`, a method's kernel by its own stem ("xpbd", "vbd_rise").
bool has_kernel(const ElementKind& kind, std::string_view kernel);

/// All names: "membrane", "cubic_spring".
std::string known_elements();

/// Whether it is one of Taut's own.
bool is_own(const ElementKind& kind);

} // namespace taut
