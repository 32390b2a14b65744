#include "support/kernel_run.hpp"

namespace taut::conformance {

namespace {

/// As many elements as one group has invocations: what a kernel without its bound check would hit.
Bytes guard_band(const BindingInfo& binding)
{
    Bytes guard(std::size_t{binding.stride} * kGroupSize);
    for (std::size_t i = 0; i < guard.size(); ++i)
        guard[i] = static_cast<std::byte>(0xA5u ^ (i * 29u));
    return guard;
}

BufferPtr upload(Device& device, const BindingInfo& binding, const Bytes& contents)
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

} // namespace

Buffers run(Device& device, const std::vector<Launch>& launches, const Buffers& in)
{
    BufferSet buffers(device, launches, in);
    device.compile(buffers.recording(launches))->replay();
    return buffers.read();
}

} // namespace taut::conformance
