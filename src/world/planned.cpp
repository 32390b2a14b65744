#include "taut/world/planned.hpp"

namespace taut {

std::vector<BufferPtr> make_buffers(Device& device, const Plan& plan)
{
    std::vector<BufferPtr> buffers;
    for (const PlanBuffer& buffer : plan.buffers)
    {
        buffers.push_back(device.make_buffer(buffer.bytes, buffer.name));
        if (!buffer.initial.empty())
            device.write(buffers.back(), 0, buffer.initial);
    }
    return buffers;
}

std::vector<BufferWrite> writes_of(const std::vector<BufferPtr>& buffers,
                                   const std::vector<InputWrite>& inputs)
{
    std::vector<BufferWrite> writes;
    for (const InputWrite& input : inputs)
        writes.push_back({buffers[input.buffer], input.bytes, input.offset});
    return writes;
}

} // namespace taut
