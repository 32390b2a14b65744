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

namespace detail {

/// As many elements as one group has invocations: what a kernel without its bound check would hit.
inline Bytes guard_band(const BindingInfo& binding)
{
    Bytes guard(std::size_t{binding.stride} * kGroupSize);
    for (std::size_t i = 0; i < guard.size(); ++i)
        guard[i] = static_cast<std::byte>(0xA5u ^ (i * 29u));
    return guard;
}

inline BufferPtr upload(Device& device, const BindingInfo& binding, const Bytes& contents)
{
    const Bytes guard = guard_band(binding);
    BufferPtr buffer = device.make_buffer(contents.size() + guard.size(), binding.name);
    if (!contents.empty())
        device.write<std::byte>(buffer, contents);
    device.write<std::byte>(buffer, guard, contents.size());
    return buffer;
}

/// Device copies of the buffers of some launches. Contents of two launches that name the same binding are
/// one.
class BufferSet
{
public:
    BufferSet(Device& device, const std::vector<Launch>& launches, const Buffers& in)
        : device_(device),
          in_(in)
    {
        for (const Launch& launch : launches)
            for (const BindingInfo& binding : launch.kernel->bindings)
                add(std::string(binding.name), binding);
    }

    RecordingDesc recording(const std::vector<Launch>& launches) const
    {
        RecordingDesc desc;
        desc.buffers = buffers_;
        for (const Launch& launch : launches)
        {
            Dispatch dispatch;
            dispatch.kernel = launch.kernel;
            dispatch.params = launch.params;
            dispatch.count = launch.count;
            for (const BindingInfo& binding : launch.kernel->bindings)
            {
                const std::uint32_t number = entries_.at(std::string(binding.name)).number;
                dispatch.bindings.push_back({number, 0, buffers_[number]->bytes()});
            }
            desc.dispatches.push_back(std::move(dispatch));
        }
        desc.barrier_before = derive_barriers(desc.dispatches);
        return desc;
    }

    /// Reads everything back; checks that guard bands, and buffers that no launch writes, are as before.
    Buffers read() const
    {
        Buffers out;
        for (const auto& [name, entry] : entries_)
        {
            const BufferPtr& buffer = buffers_[entry.number];
            Bytes all(buffer->bytes());
            device_.read(buffer, 0, all);
            const Bytes& before = in_.at(name);
            const Bytes guard = guard_band(entry.binding);
            const bool guard_untouched =
                std::memcmp(all.data() + before.size(), guard.data(), guard.size()) == 0;
            all.resize(before.size());
            const bool input_untouched = entry.written || all == before;
            INFO("buffer " << name << " on " << device_.info().executor);
            CHECK(guard_untouched);
            CHECK(input_untouched);
            out[name] = std::move(all);
        }
        return out;
    }

private:
    struct Entry
    {
        BindingInfo binding;
        std::uint32_t number = 0;
        bool written = false;
    };

    void add(const std::string& name, const BindingInfo& binding)
    {
        INFO("buffer " << name);
        REQUIRE(in_.count(name) == 1);
        const auto [at, is_new] = entries_.try_emplace(name);
        if (is_new)
        {
            at->second = {binding, static_cast<std::uint32_t>(buffers_.size()), false};
            buffers_.push_back(upload(device_, binding, in_.at(name)));
        }
        at->second.written = at->second.written || writes(binding.access);
    }

    Device& device_;
    const Buffers& in_;
    std::map<std::string, Entry> entries_;
    std::vector<BufferPtr> buffers_;
};

} // namespace detail

/// All launches in one recording, replayed once. Returns the contents afterwards.
inline Buffers run(Device& device, const std::vector<Launch>& launches, const Buffers& in)
{
    detail::BufferSet buffers(device, launches, in);
    device.compile(buffers.recording(launches))->replay();
    return buffers.read();
}

} // namespace taut::conformance
