#include "taut/elements/element.hpp"

#include "taut/elements/membrane.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/registry.hpp"

#include <deque>
#include <mutex>

namespace taut {
namespace {

struct Kinds
{
    std::mutex mutex;
    std::deque<ElementKind> list{membrane_kind()}; // Taut's own first; what it holds keeps its place
};

Kinds& kinds()
{
    static Kinds all;
    return all;
}

std::uint32_t aligned(std::uint32_t bytes, std::uint32_t to) { return (bytes + to - 1) / to * to; }

[[noreturn]] void refuse(const ElementKind& kind, const std::string& why)
{
    throw Error(ErrorCode::bad_input, "element \"" + kind.name + "\": " + why);
}

/// Bytes of the record that a kernel reads of each element; 0 if it reads none.
std::uint32_t record_of(const KernelInfo& kernel)
{
    for (const BindingInfo& binding : kernel.bindings)
        if (binding.name == "constraint")
            return binding.stride;
    return 0;
}

void check_kernel(const ElementKind& kind, const KernelInfo& kernel)
{
    const std::uint32_t expected = record_bytes(kind, kernel.precision), found = record_of(kernel);
    if (found != expected)
        refuse(kind, "the record of kernel " + std::string(kernel.name) + " in " +
                         std::string(to_string(kernel.precision)) + " takes " + std::to_string(found) +
                         " bytes, " + std::to_string(kind.corners) + " corners and " +
                         std::to_string(kind.values.size()) + " values take " + std::to_string(expected));
    if (!kernel.name.ends_with("_" + kind.name)) // by which plans look it up
        refuse(kind, "it has the kernel " + std::string(kernel.name) + "; pass those of the file " +
                         kind.name + ".glsl");
}

void check_kind(const ElementKind& kind)
{
    if (kind.name.empty())
        refuse(kind, "it has no name; give it the stem of its GLSL file");
    if (kind.corners < 2 || kind.corners > 4)
        refuse(kind, "corners is " + std::to_string(kind.corners) + "; it must be 2, 3 or 4");
    if (kind.energy == nullptr)
        refuse(kind, "it has no energy; reports could not tell motion that it made from motion it was given");
    if (kind.kernels.empty())
        refuse(kind, "it has no kernels; pass kernels::" + kind.name + "::all()");
    for (const auto& kernels : kind.kernels)
        for (const KernelInfo& kernel : kernels)
            check_kernel(kind, kernel);
}

} // namespace

std::uint32_t record_bytes(const ElementKind& kind, Precision precision)
{
    const std::uint32_t real = real_bytes(precision);
    const std::uint32_t at = aligned(4 * kind.corners, real);
    return aligned(at + real * static_cast<std::uint32_t>(kind.values.size()), real);
}

void add_element(const ElementKind& kind)
{
    check_kind(kind);
    Kinds& all = kinds();
    const std::lock_guard lock(all.mutex);
    for (const ElementKind& other : all.list)
        if (other.name == kind.name)
            refuse(kind, "there is one of this name; each name can be added once");
    for (const auto& kernels : kind.kernels)
        register_kernels(kernels);
    all.list.push_back(kind);
}

const ElementKind* find_element(std::string_view name)
{
    Kinds& all = kinds();
    const std::lock_guard lock(all.mutex);
    for (const ElementKind& kind : all.list)
        if (kind.name == name)
            return &kind;
    return nullptr;
}

bool has_kernel(const ElementKind& kind, std::string_view kernel)
{
    const std::string name = std::string(kernel) + "_" + kind.name;
    for (const auto& kernels : kind.kernels)
        if (!kernels.empty() && kernels.front().name == name)
            return true;
    return false;
}

std::string known_elements()
{
    Kinds& all = kinds();
    const std::lock_guard lock(all.mutex);
    std::string out;
    for (const ElementKind& kind : all.list)
        out += (out.empty() ? "\"" : ", \"") + kind.name + '"';
    return out;
}

bool is_own(const ElementKind& kind) { return kind.name == "membrane"; }

} // namespace taut
