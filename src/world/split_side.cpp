#include "taut/world/split_side.hpp"

#include <cstring>

namespace taut {

void SplitSide::take(PlanPart&& next)
{
    part = std::move(next);
    segments.clear();
    buffers.clear();
    if (idle())
        return;
    buffers = make_buffers(*device, part.plan);
    const std::vector<Dispatch>& passes = part.plan.passes;
    for (std::size_t s = 0; s + 1 < part.segment_start.size(); ++s)
    {
        const std::vector<Dispatch> own(passes.begin() + static_cast<std::ptrdiff_t>(part.segment_start[s]),
                                        passes.begin() +
                                            static_cast<std::ptrdiff_t>(part.segment_start[s + 1]));
        segments.push_back(own.empty() ? nullptr : device->compile({buffers, own, derive_barriers(own)}));
    }
}

void SplitSide::start(std::size_t segment, const std::vector<InputWrite>& inputs)
{
    if (!idle() && segments[segment])
        device->replay(*segments[segment], writes_of(buffers, inputs));
}

std::uint64_t SplitSide::stride(std::uint32_t buffer) const
{
    return part.plan.buffers[buffer].bytes / part.vertices.size();
}

void SplitSide::send(std::uint32_t buffer, std::vector<std::byte>& to) const
{
    to.resize(part.sent * stride(buffer));
    device->read(buffers[buffer], (part.own - part.sent) * stride(buffer), to);
}

void SplitSide::receive(std::uint32_t buffer, const std::vector<std::byte>& from)
{
    device->write(buffers[buffer], part.own * stride(buffer), from);
}

void SplitSide::collect(std::uint32_t buffer, std::vector<std::byte>& whole) const
{
    if (idle())
        return;
    const std::uint64_t each = stride(buffer);
    std::vector<std::byte> own(part.own * each);
    device->read(buffers[buffer], 0, own);
    for (std::uint32_t v = 0; v < part.own; ++v)
        std::memcpy(whole.data() + part.vertices[v] * each, own.data() + v * each, each);
}

} // namespace taut
