#pragma once
// Internal to src/world: one device of a scene that is split, with its part of the plan.

#include "taut/plan/cut.hpp"
#include "taut/world/planned.hpp"

#include <memory>
#include <vector>

namespace taut {

struct SplitSide
{
    std::shared_ptr<Device> device;
    PlanPart part;
    std::vector<BufferPtr> buffers;                   ///< as part.plan.buffers; none without vertices
    std::vector<std::unique_ptr<Recording>> segments; ///< null where there is nothing to do

    /// Puts the part onto the device.
    void take(PlanPart&& next);
    bool idle() const { return part.own == 0; }
    bool is_native() const { return device->info().executor.starts_with("cpu"); }

    /// Starts a segment, with what the host hands over.
    void start(std::size_t segment, const std::vector<InputWrite>& inputs = {});
    /// The elements that the other side needs of a buffer, read; and those of its halo, written. Waits.
    void send(std::uint32_t buffer, std::vector<std::byte>& to) const;
    void receive(std::uint32_t buffer, const std::vector<std::byte>& from);
    /// Its own elements, to their places among those of the whole plan.
    void collect(std::uint32_t buffer, std::vector<std::byte>& whole) const;

private:
    std::uint64_t stride(std::uint32_t buffer) const; ///< of buffers of an element a vertex
};

} // namespace taut
