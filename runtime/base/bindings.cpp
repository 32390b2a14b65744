#include "taut/runtime/base/bindings.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace taut {
namespace {

[[noreturn]] void refuse(const KernelInfo& kernel, std::string_view binding, const char* why)
{
    throw std::logic_error("kernel \"" + std::string(kernel.name) + "\"" +
                           (kernel.variant.empty() ? "" : " (variant " + std::string(kernel.variant) + ")") +
                           ": binding \"" + std::string(binding) + "\" " + why);
}

} // namespace

std::vector<std::size_t> places_in_slot_order(const KernelInfo& kernel, std::span<const NamedBinding> named)
{
    std::vector<std::size_t> places;
    for (const BindingInfo& binding : kernel.bindings)
    {
        const auto at = std::find_if(named.begin(), named.end(), [&](const NamedBinding& n) {
            return n.name == binding.name && n.is_set;
        });
        if (at == named.end())
            refuse(kernel, binding.name, "is not set");
        places.push_back(static_cast<std::size_t>(at - named.begin()));
    }
    for (const NamedBinding& n : named)
    {
        const auto has = [&](const BindingInfo& binding) { return binding.name == n.name; };
        if (n.is_set && std::none_of(kernel.bindings.begin(), kernel.bindings.end(), has))
            refuse(kernel, n.name, "is set, but there is no such binding");
    }
    return places;
}

} // namespace taut
