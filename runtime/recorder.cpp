// What a dispatch must satisfy before it is recorded (Recorder) and before it is compiled
// (check_limits). Messages name the kernel, the binding and both numbers.

#include "taut/runtime/limits.hpp"

#include <algorithm>
#include <cassert>

namespace taut {
namespace {

constexpr std::uint64_t kGroupCountBytes = 12; // uint32 x, y, z

std::string number(std::uint64_t value) { return std::to_string(value); }

/// Beginning of a message. A value, because a string for every binding that is right would cost more than
/// the checks.
struct Where
{
    const KernelInfo* kernel = nullptr;
    std::size_t binding = kNone; ///< index, kNone for the kernel as a whole, or kGroupCounts

    static constexpr std::size_t kNone = ~std::size_t{0};
    static constexpr std::size_t kGroupCounts = kNone - 1;

    std::string text() const
    {
        if (!kernel)
            return "a dispatch";
        std::string text = "kernel \"" + std::string(kernel->name) + "\"";
        if (!kernel->variant.empty())
            text += " (variant " + std::string(kernel->variant) + ")";
        if (binding == kGroupCounts)
            text += ", indirect group counts";
        else if (binding != kNone)
            text +=
                ", binding " + number(binding) + " \"" + std::string(kernel->bindings[binding].name) + "\"";
        return text;
    }
};

[[noreturn]] void refuse(ErrorCode code, const std::string& text) { throw Error(code, text); }

void check_inside(const Where& where, const BufferRange& range, std::uint64_t buffer_bytes)
{
    if (range.bytes == 0)
        refuse(ErrorCode::bad_input, where.text() + ": the range is empty: it begins at byte " +
                                         number(range.offset) + " of a buffer of " + number(buffer_bytes) +
                                         " bytes");
    if (range.offset > buffer_bytes || range.bytes > buffer_bytes - range.offset)
        refuse(ErrorCode::bad_input, where.text() + ": bytes " + number(range.offset) + " to " +
                                         number(range.offset + range.bytes) +
                                         " lie outside the buffer, which has " + number(buffer_bytes) +
                                         " bytes");
}

void check_alignment(ErrorCode code, const Where& where, std::uint64_t offset, std::uint64_t alignment)
{
    if (alignment > 1 && offset % alignment != 0)
        refuse(code, where.text() + ": offset " + number(offset) + " is not a multiple of the " +
                         number(alignment) + " bytes that this device requires");
}

/// A range that was asked for by its size must hold whole elements; "to the end" may not.
void check_elements(const Where& where, std::uint64_t bytes, std::uint32_t stride, bool whole)
{
    if (stride != 0 && (bytes < stride || (whole && bytes % stride != 0)))
        refuse(ErrorCode::bad_input, where.text() + ": " + number(bytes) +
                                         " bytes are not a whole number of elements of " + number(stride) +
                                         " bytes");
}

void check_params(const KernelInfo& kernel, std::size_t bytes)
{
    if (bytes != kernel.param_bytes)
        refuse(ErrorCode::bad_input, Where{&kernel}.text() + " takes " + number(kernel.param_bytes) +
                                         " bytes of parameters, but " + number(bytes) + " were given");
}

void check_binding_count(const KernelInfo& kernel, std::size_t count)
{
    if (count != kernel.bindings.size())
        refuse(ErrorCode::bad_input, Where{&kernel}.text() + " has " + number(kernel.bindings.size()) +
                                         " bindings, but " + number(count) + " buffers were given");
}

BufferRange range_of(const Recorder::Binding& binding)
{
    const std::uint64_t all = binding.buffer->bytes();
    const std::uint64_t rest = binding.offset < all ? all - binding.offset : 0;
    return {kNoBuffer, binding.offset, binding.bytes != 0 ? binding.bytes : rest};
}

void check_binding(const KernelInfo& kernel, std::size_t index, const Recorder::Binding& binding,
                   const DeviceLimits& limits)
{
    const Where where{&kernel, index};
    if (!binding.buffer)
        refuse(ErrorCode::bad_input, where.text() + ": there is no buffer");
    const BufferRange range = range_of(binding);
    check_inside(where, range, binding.buffer->bytes());
    check_alignment(ErrorCode::bad_input, where, range.offset, limits.offset_alignment);
    check_elements(where, range.bytes, kernel.bindings[index].stride, binding.bytes != 0);
}

void check_group_counts(const KernelInfo& kernel, const Recorder::Binding& counts)
{
    const Where where{&kernel, Where::kGroupCounts};
    if (!counts.buffer)
        refuse(ErrorCode::bad_input, where.text() + ": there is no buffer");
    check_inside(where, {kNoBuffer, counts.offset, kGroupCountBytes}, counts.buffer->bytes());
    check_alignment(ErrorCode::bad_input, where, counts.offset, 4);
}

} // namespace

// ---------------------------------------------------------------- Recorder

BufferRange Recorder::intern(const Binding& binding)
{
    const auto next = static_cast<std::uint32_t>(buffers_.size());
    const auto [at, is_new] = number_of_.try_emplace(binding.buffer.get(), next);
    if (is_new)
        buffers_.push_back(binding.buffer);
    BufferRange range = range_of(binding);
    range.buffer = at->second;
    return range;
}

Recorder& Recorder::add(const KernelInfo& kernel, std::vector<Binding> bindings,
                        std::span<const std::byte> params, std::uint32_t count,
                        std::optional<Binding> indirect, std::string_view label)
{
    assert(device_);
    check_binding_count(kernel, bindings.size());
    check_params(kernel, params.size());
    for (std::size_t i = 0; i < bindings.size(); ++i)
        check_binding(kernel, i, bindings[i], device_->limits());
    if (indirect)
        check_group_counts(kernel, *indirect);
    if (count == 0)
        return *this;

    Dispatch dispatch;
    dispatch.kernel = &kernel;
    for (const Binding& binding : bindings)
        dispatch.bindings.push_back(intern(binding));
    dispatch.params.assign(params.begin(), params.end());
    dispatch.count = count;
    if (indirect)
    {
        indirect->bytes = kGroupCountBytes;
        dispatch.indirect = intern(*indirect);
    }
    dispatch.label = label.empty() ? std::string(kernel.name) : std::string(label);
    dispatches_.push_back(std::move(dispatch));
    return *this;
}

std::unique_ptr<Recording> Recorder::finish()
{
    RecordingDesc desc;
    desc.buffers = std::exchange(buffers_, {});
    desc.dispatches = std::exchange(dispatches_, {});
    number_of_.clear();
    desc.barrier_before = derive_barriers(desc.dispatches);
    return device_->compile(std::move(desc));
}

std::size_t Recording::barrier_count() const
{
    return static_cast<std::size_t>(std::count(barrier_before_.begin(), barrier_before_.end(), true));
}

// ---------------------------------------------------------------- limits

namespace {

void check_at_most(const Where& where, const char* thing, std::uint64_t is, std::uint64_t limit)
{
    if (is > limit)
        refuse(ErrorCode::limit, where.text() + " needs " + number(is) + " " + thing +
                                     ", but this device has a limit of " + number(limit));
}

void check_kernel(const KernelInfo& kernel, const DeviceInfo& info)
{
    const Where where{&kernel};
    const DeviceLimits& limits = info.limits;
    check_at_most(where, "storage buffers", kernel.bindings.size(), limits.max_bindings);
    check_at_most(where, "invocations a group", kernel.group_size, limits.max_group_size);
    check_at_most(where, "bytes of group memory", kernel.shared_bytes, limits.max_shared_bytes);
    check_at_most(where, "bytes of parameters", kernel.param_bytes, limits.max_param_bytes);
    if (kernel.precision == Precision::float64 && !limits.float64)
        refuse(ErrorCode::unsupported, where.text() + " computes in double, but \"" + info.name +
                                           "\" has no 64-bit floats: use precision float or the device cpu");
}

void check_ranges(const Dispatch& dispatch, const std::vector<BufferPtr>& buffers, const DeviceLimits& limits)
{
    const KernelInfo& kernel = *dispatch.kernel;
    for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
    {
        const BufferRange& range = dispatch.bindings[i];
        const Where where{&kernel, i};
        if (range.buffer >= buffers.size() || !buffers[range.buffer])
            refuse(ErrorCode::bad_input, where.text() + ": buffer number " + number(range.buffer) +
                                             " is not one of the " + number(buffers.size()) + " buffers");
        check_inside(where, range, buffers[range.buffer]->bytes());
        check_at_most(where, "bytes in one binding", range.bytes, limits.max_buffer_bytes);
        check_alignment(ErrorCode::limit, where, range.offset, limits.offset_alignment);
    }
}

void check_indirect(const Dispatch& dispatch, const std::vector<BufferPtr>& buffers)
{
    const BufferRange& range = dispatch.indirect;
    if (range.buffer == kNoBuffer)
        return;
    const Where where{dispatch.kernel, Where::kGroupCounts};
    if (range.buffer >= buffers.size() || !buffers[range.buffer])
        refuse(ErrorCode::bad_input, where.text() + ": buffer number " + number(range.buffer) +
                                         " is not one of the " + number(buffers.size()) + " buffers");
    check_inside(where, {kNoBuffer, range.offset, kGroupCountBytes}, buffers[range.buffer]->bytes());
    check_alignment(ErrorCode::bad_input, where, range.offset, 4);
}

} // namespace

void check_limits(const RecordingDesc& desc, const DeviceInfo& info)
{
    if (desc.barrier_before.size() != desc.dispatches.size())
        refuse(ErrorCode::bad_input, "a list of " + number(desc.dispatches.size()) +
                                         " dispatches came with " + number(desc.barrier_before.size()) +
                                         " barrier flags: there must be one flag a dispatch");
    const KernelInfo* checked = nullptr; // runs of one kernel are common
    for (const Dispatch& dispatch : desc.dispatches)
    {
        if (!dispatch.kernel)
            refuse(ErrorCode::bad_input, "a dispatch names no kernel");
        const KernelInfo& kernel = *dispatch.kernel;
        if (checked != &kernel)
            check_kernel(kernel, info);
        checked = &kernel;
        check_binding_count(kernel, dispatch.bindings.size());
        check_params(kernel, dispatch.params.size());
        check_ranges(dispatch, desc.buffers, info.limits);
        check_indirect(dispatch, desc.buffers);
        const std::uint32_t per_dimension = info.limits.max_groups_per_dimension;
        check_at_most(Where{&kernel}, "groups", group_count(kernel, dispatch.count),
                      std::uint64_t{per_dimension} * per_dimension);
    }
}

std::uint32_t group_count(const KernelInfo& kernel, std::uint32_t count)
{
    if (kernel.group_kernel)
        return count;
    const std::uint32_t size = std::max(kernel.group_size, 1u);
    return count / size + (count % size != 0 ? 1u : 0u);
}

GroupFold fold_groups(std::uint32_t count, std::uint32_t max_per_dimension)
{
    if (count <= max_per_dimension)
        return {count, count == 0 ? 0u : 1u};
    const std::uint64_t limit = max_per_dimension;
    check_at_most(Where{}, "groups", count, limit * limit);
    const std::uint64_t y = (count + limit - 1) / limit;
    const std::uint64_t x = (count + y - 1) / y;
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
}

} // namespace taut
