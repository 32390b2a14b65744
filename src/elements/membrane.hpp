#pragma once
// The membrane of woven cloth (kernels/elements/membrane.glsl) as a kind of element, in fp64 on the host.

#include "taut/elements/element.hpp"

namespace taut {

/// Three corners; values p11, p12, p21, p22 (1/m) and c11, c12, c22, c33 (J), docs/fabric.md. Known to every
/// scene without add_element().
ElementKind membrane_kind();

} // namespace taut
