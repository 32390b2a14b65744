#pragma once
// GLSL text in, everything a device needs out: SPIR-V for Vulkan and OpenGL, flattened GLSL, and
// the table of bindings and parameters read back from the SPIR-V. Used by the build (through
// taut-kernelc) and at run time, for users' own kernels and for TAUT_KERNEL_DIR.

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/kernel_info.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut {

/// One set of macros under which a kernel is compiled: `//! variant lambda LAMBDA=1`.
struct KernelVariant
{
    std::string name; ///< "" for the base kernel
    std::vector<std::pair<std::string, std::string>> defines;
};

/// What a kernel is compiled for, once for each: an element (kernels/elements/<stem>.glsl,
/// shared/element.glsl) or a shape of colliders (kernels/colliders/<stem>.glsl, shared/contact.glsl).
struct ElementFile
{
    std::string path; ///< below the include root, "elements/spring.glsl"; empty: none
    std::string stem;
    std::uint32_t corners = 0;          ///< of an element 2 to 4
    std::vector<std::string> methods;   ///< `//! methods xpbd pbd`: whose kernels it is compiled into
    std::vector<std::string> abilities; ///< `//! with dampers`: variants and a macro of its own
    std::string collider;               ///< of a shape "once" or "each_substep": `//! collider once`
    bool has_values = false;            ///< of a shape with a buffer `values`: `//! collider once values`
    bool has_faces = false; ///< of a shape that triangles meet (shared/face.glsl): `//! collider once faces`
};

/// Reads the `//!` lines. Throws Error{kernel_compilation} for a file without `//! collider` that has no
/// `//! corners 2` to 4 or no `//! methods`.
ElementFile element_file(const std::string& path, std::string_view text);

/// "element of METHOD", "collider" or "collider with faces" of a kernel with the line `//! each element of
/// METHOD`, `//! each collider` or `//! each collider with faces`; empty for all others.
std::string each_of(std::string_view text);

/// Whether kernels with that line are compiled for this.
bool is_for(std::string_view each, const ElementFile& element);

struct KernelSource
{
    std::string name; ///< stem; of a kernel for one element, stem and element: "xpbd_spring"
    std::string text; ///< as in the file; `#include "shared/..."` is resolved by `include_root`
    std::filesystem::path include_root; ///< folder that holds shared/; empty: the built-in copies
    KernelVariant variant;
    Precision precision = Precision::float32;
    ElementFile element = {}; ///< what `#include TAUT_ELEMENT` or TAUT_COLLIDER means
};

/// Member of a record that a buffer holds, as the shader compiler laid it out.
struct LayoutMember
{
    std::string record; ///< "DistanceConstraint"
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t stride = 0; ///< of the whole record
};

/// Owns what its `info` points to. Neither copied nor moved.
struct CompiledKernel
{
    CompiledKernel() = default;
    CompiledKernel(const CompiledKernel&) = delete;
    CompiledKernel& operator=(const CompiledKernel&) = delete;

    KernelInfo info;
    std::string name, variant, glsl;
    std::vector<std::uint32_t> spirv_vulkan, spirv_opengl;
    std::vector<BindingInfo> bindings;
    std::vector<std::string> binding_types; ///< of an element of each, as GLSL spells it
    std::vector<ParamInfo> params;
    std::vector<LayoutMember> layouts;
    std::vector<std::unique_ptr<std::string>> names; ///< storage behind string_views
};

/// The base variant and every `//! variant` line of a kernel text, each with all macros defined; of lines
/// that end `with ABILITY` those of the element's abilities. Throws Error{kernel_compilation} for a malformed
/// line.
std::vector<KernelVariant> kernel_variants(std::string_view name, std::string_view text,
                                           const ElementFile& element = {});

/// Compiles, validates with SPIRV-Tools and reflects. Throws Error{kernel_compilation} with the
/// compiler's words, each line naming file and line.
std::shared_ptr<const CompiledKernel> compile_kernel(const KernelSource& source);

/// Text of a built-in shared include ("shared/portable.glsl"), empty if there is none.
std::string_view builtin_include(std::string_view path);

} // namespace taut
