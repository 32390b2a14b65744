#include "taut/runtime/compiler/override.hpp"

#include "taut/runtime/compiler/variants.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace taut {
namespace {

namespace fs = std::filesystem;

/// The folder that TAUT_KERNEL_DIR names, or an empty path.
fs::path override_root()
{
    const char* const variable = std::getenv("TAUT_KERNEL_DIR");
    if (variable == nullptr || *variable == '\0')
        return {};
    std::error_code ignored;
    if (!fs::is_directory(variable, ignored))
        throw Error(ErrorCode::io,
                    "TAUT_KERNEL_DIR=" + std::string(variable) + " is not a folder; unset it or name one");
    return variable;
}

KernelSource load(const KernelFile& found, const fs::path& root, const KernelInfo& kernel)
{
    const fs::path& path = found.path;
    std::ifstream file(path);
    if (!file)
        throw Error(ErrorCode::io, "cannot read the kernel " + path.string());
    KernelSource source;
    source.name = std::string(kernel.name);
    source.text.assign(std::istreambuf_iterator<char>(file), {});
    source.include_root = root;
    source.precision = kernel.precision;
    source.element = found.element;
    for (KernelVariant& variant : kernel_variants(kernel.name, source.text, found.element))
        if (variant.name == kernel.variant)
        {
            source.variant = std::move(variant);
            return source;
        }
    throw Error(ErrorCode::kernel_compilation, path.string() + " has no line \"//! variant " +
                                                   std::string(kernel.variant) +
                                                   " ...\", which this recording needs");
}

bool same(const BindingInfo& a, const BindingInfo& b)
{
    return a.name == b.name && a.slot == b.slot && a.access == b.access && a.stride == b.stride;
}

bool same(const ParamInfo& a, const ParamInfo& b)
{
    return a.name == b.name && a.type == b.type && a.offset == b.offset;
}

template <typename Entry>
std::string difference(std::span<const Entry> built, std::span<const Entry> edited, const char* what)
{
    for (std::size_t i = 0; i < std::max(built.size(), edited.size()); ++i)
    {
        const std::string number = std::string(what) + " " + std::to_string(i);
        if (i >= edited.size())
            return number + " (" + std::string(built[i].name) + ") is missing";
        if (i >= built.size())
            return number + " (" + std::string(edited[i].name) + ") is new";
        if (!same(built[i], edited[i]))
            return number + " is " + std::string(edited[i].name) + ", not the same " +
                   std::string(built[i].name) +
                   " as the host uses (name, type, access, size and place must agree)";
    }
    return {};
}

/// A sentence about the first difference that the host would trip over, or nothing.
std::string difference(const KernelInfo& built, const KernelInfo& edited)
{
    if (std::string text = difference(built.bindings, edited.bindings, "binding"); !text.empty())
        return text;
    if (std::string text = difference(built.params, edited.params, "parameter"); !text.empty())
        return text;
    if (built.param_bytes != edited.param_bytes)
        return "the parameters take " + std::to_string(edited.param_bytes) + " bytes, not " +
               std::to_string(built.param_bytes);
    if (built.group_kernel != edited.group_kernel || built.group_size != edited.group_size)
        return "the group has " + std::to_string(edited.group_size) + " invocations" +
               (edited.group_kernel ? " (GROUP_KERNEL)" : " (KERNEL)") + ", not " +
               std::to_string(built.group_size) + (built.group_kernel ? " (GROUP_KERNEL)" : " (KERNEL)");
    return {};
}

} // namespace

fs::path kernel_override_file(const KernelInfo& kernel)
{
    const fs::path root = override_root();
    return root.empty() ? fs::path() : find_kernel_file(root, kernel.name).path;
}

std::shared_ptr<const CompiledKernel> kernel_override(const KernelInfo& kernel)
{
    const fs::path root = override_root();
    const KernelFile found = root.empty() ? KernelFile() : find_kernel_file(root, kernel.name);
    const fs::path& path = found.path;
    if (path.empty())
        return nullptr;
    std::shared_ptr<const CompiledKernel> edited = compile_kernel(load(found, root, kernel));
    if (const std::string text = difference(kernel, edited->info); !text.empty())
        throw Error(ErrorCode::kernel_compilation, path.string() + " does not fit the host code: " + text +
                                                       "; rebuild to change an interface");
    return edited;
}

} // namespace taut
