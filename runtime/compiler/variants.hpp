#pragma once
// What the `//!` lines of kernels and elements say.

#include "taut/runtime/compiler/compiler.hpp"

namespace taut {

/// The macro that a kernel includes its element by.
std::string element_include(const ElementFile& element);

/// The macros under which a kernel is compiled for an element, in both languages.
std::vector<std::pair<std::string, std::string>> element_defines(const ElementFile& element);

/// Where the text of a kernel stands below a folder of kernels: `<name>.comp`, or of a kernel for an element
/// `<stem>.comp` and `elements/<element>.glsl` (or `colliders/`) with the name <stem>_<element>.
struct KernelFile
{
    std::filesystem::path path; ///< empty: there is none
    ElementFile element;
};

/// Throws Error{kernel_compilation} when two texts fit, Error{io} when the folder cannot be searched.
KernelFile find_kernel_file(const std::filesystem::path& root, std::string_view name);

} // namespace taut
