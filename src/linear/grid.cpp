#include "taut/linear/grid.hpp"

#include <algorithm>

namespace taut::linear {

std::uint32_t group_count_for(std::uint32_t rows, const DeviceInfo& device)
{
    const std::uint32_t most = device.hardware_gpu ? 1024 : 256;
    const std::uint32_t wanted = rows / TAUT_LINEAR_GROUP + (rows % TAUT_LINEAR_GROUP != 0 ? 1 : 0);
    return std::clamp(wanted, 1u, most);
}

Grid make_grid(std::uint32_t count, std::uint32_t groups, std::uint32_t multiple)
{
    const std::uint32_t share = count / groups + (count % groups != 0 ? 1 : 0);
    return {count, groups, (share + multiple - 1) / multiple * multiple};
}

void launch(Recorder& recorder, const Gate& gate, const KernelInfo& kernel,
            std::vector<Recorder::Binding> bindings, std::span<const std::byte> params,
            std::string_view label)
{
    if (gate.control)
        recorder.dispatch_indirect(kernel, std::move(bindings), params, {gate.control, gate.offset, 12},
                                   gate.groups, label);
    else
        recorder.dispatch(kernel, std::move(bindings), params, gate.groups, label);
}

} // namespace taut::linear
