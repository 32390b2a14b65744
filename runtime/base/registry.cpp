#include "taut/runtime/base/registry.hpp"

#include "taut/runtime/base/error.hpp"

#include <string>

namespace taut {

const KernelInfo& find_kernel(std::string_view name, std::string_view variant, Precision precision)
{
    static const std::vector<const KernelInfo*> kernels = all_kernels();
    for (const KernelInfo* kernel : kernels)
        if (kernel->name == name && kernel->variant == variant && kernel->precision == precision)
            return *kernel;
    throw Error(ErrorCode::unsupported, "there is no kernel \"" + std::string(name) + "\" variant \"" +
                                            std::string(variant) + "\" in " +
                                            std::string(to_string(precision)));
}

} // namespace taut
