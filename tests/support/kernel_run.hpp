#pragma once
// Runs kernels of the tables on one device with buffers given by name, so that a test reads the same for
// every variant (slots differ). Each buffer has a guard band behind it that nobody may touch.

#include "support/catch.hpp"
#include "taut/runtime/device.hpp"

#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace taut::conformance {

using Bytes = std::vector<std::byte>;
using Buffers = std::map<std::string, Bytes>; ///< contents by the name of the binding

template <typename T>
Bytes bytes_of(const std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    Bytes bytes(values.size() * sizeof(T));
    if (!bytes.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <typename T>
std::vector<T> values_of(const Bytes& bytes)
{
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty())
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

/// One dispatch: kernel, parameters, elements (or groups).
struct Launch
{
    const KernelInfo* kernel = nullptr;
    Bytes params;
    std::uint32_t count = 0;
};

template <typename Params>
Launch make_launch(const KernelInfo& kernel, const Params& params, std::uint32_t count)
{
    return {&kernel, bytes_of(std::vector<Params>{params}), count};
}

/// All launches in one recording, replayed once. Returns the contents afterwards. Checks that guard bands,
/// and buffers that no launch writes, are as before.
Buffers run(Device& device, const std::vector<Launch>& launches, const Buffers& in);

} // namespace taut::conformance
