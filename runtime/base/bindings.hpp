#pragma once
// Bindings by name: from the Bindings struct that the build generates for a kernel to the slots of a variant.
// What a Binding is, its user says; it must be copyable and have `bool is_set() const`.

#include "taut/runtime/base/kernel_info.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace taut {

/// A binding that a caller can name, and whether this caller did set it.
struct NamedBinding
{
    std::string_view name;
    bool is_set = false;
};

/// For each slot of `kernel` the index in `named` of what belongs there. Throws std::logic_error, a fault of
/// the program, with the names of kernel, variant and binding where one is not set that the variant has, or
/// one is set that it does not have.
std::vector<std::size_t> places_in_slot_order(const KernelInfo& kernel, std::span<const NamedBinding> named);

/// The members of a generated Bindings struct that a variant has, in order of slot.
template <template <typename> typename Bindings, typename Binding>
std::vector<Binding> in_slot_order(const KernelInfo& kernel, const Bindings<Binding>& bindings)
{
    const auto members = bindings.named();
    std::vector<NamedBinding> named;
    for (const auto& [name, member] : members)
        named.push_back({name, member->is_set()});
    std::vector<Binding> out;
    for (const std::size_t place : places_in_slot_order(kernel, named))
        out.push_back(*members[place].second);
    return out;
}

} // namespace taut
