#include "taut/runtime/base/registry.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <mutex>
#include <string>

namespace taut {
namespace {

/// What the build compiled in, and what the program has added.
struct Registry
{
    std::mutex mutex;
    std::vector<const KernelInfo*> kernels = all_kernels();

    const KernelInfo* find(std::string_view name, std::string_view variant, Precision precision) const
    {
        for (const KernelInfo* kernel : kernels)
            if (kernel->name == name && kernel->variant == variant && kernel->precision == precision)
                return kernel;
        return nullptr;
    }
};

Registry& registry()
{
    static Registry all;
    return all;
}

} // namespace

const KernelInfo& find_kernel(std::string_view name, std::string_view variant, Precision precision)
{
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    if (const KernelInfo* kernel = all.find(name, variant, precision))
        return *kernel;
    throw Error(ErrorCode::unsupported, "there is no kernel \"" + std::string(name) + "\" variant \"" +
                                            std::string(variant) + "\" in " +
                                            std::string(to_string(precision)));
}

std::string full_name(const KernelInfo& kernel)
{
    return std::string(kernel.name) + (kernel.variant.empty() ? "" : ":" + std::string(kernel.variant));
}

void register_kernels(std::span<const KernelInfo> kernels)
{
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    for (const KernelInfo& kernel : kernels)
        if (all.find(kernel.name, kernel.variant, kernel.precision) != nullptr)
            throw Error(ErrorCode::bad_input, "there are two kernels called \"" + std::string(kernel.name) +
                                                  "\"; rename one of their files");
    for (const KernelInfo& kernel : kernels)
        all.kernels.push_back(&kernel);
}

} // namespace taut
