#pragma once
// Device, Buffer, Recorder, Recording: everything above the runtime speaks to a device through
// these four. Knows no physics and no graphics API.

#include "taut/runtime/base/bindings.hpp"
#include "taut/runtime/base/dispatch.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/kernel_info.hpp"
#include "taut/runtime/base/registry.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace taut {

/// What a device can do. Exceeding a limit throws Error{limit} with both numbers.
struct DeviceLimits
{
    std::uint64_t max_buffer_bytes = 0;        ///< of one binding
    std::uint64_t offset_alignment = 1;        ///< bytes, of a binding's offset
    std::uint32_t max_groups_per_dimension = 0;
    std::uint32_t max_group_size = 0;          ///< invocations of one group
    std::uint32_t max_shared_bytes = 0;
    std::uint32_t max_param_bytes = 0;
    std::uint32_t max_bindings = 0;
    bool float64 = false;
};

/// Who a device is.
struct DeviceInfo
{
    std::string selector; ///< opens this device again: "vulkan:0", "opengl", "cpu"
    std::string executor; ///< "vulkan", "opengl", "opengl:spirv", "cpu", "cpu:serial", "cpu:shuffled"
    std::string name;     ///< as the driver names it
    std::string driver;   ///< name and version
    bool hardware_gpu = false; ///< false for lavapipe, llvmpipe and the native CPU
    DeviceLimits limits;
};

struct OpenOptions
{
    bool validation = false;      ///< Vulkan: turn on the validation layers (core and synchronisation)
    std::string pipeline_cache;   ///< Vulkan: path of a cache file; empty: no file is touched
    unsigned threads = 0;         ///< CPU: 0 = all cores
    std::uint64_t seed = 1;       ///< CPU shuffled: seed of the order
};

/// What a device was asked to do so far. Exact numbers, for tests and for `taut plan`.
struct DeviceCounters
{
    std::uint64_t submissions = 0;
    std::uint64_t dispatches = 0;
    std::uint64_t barriers = 0;
    std::uint64_t bytes_allocated = 0; ///< now, over all buffers
    std::uint64_t bytes_reserved = 0;  ///< now, asked of driver or system: buffers, free room, staging
    std::uint64_t memory_blocks = 0; ///< allocations made from the driver, now
    std::uint64_t validation_messages = 0;
};

/// Where a buffer's memory should lie. A wish: the answer never depends on it.
enum class BufferUse
{
    device,       ///< read and written by kernels
    host_written, ///< small, written by the host before a replay: Device::write then needs no submission
};

/// Device memory of fixed size. Contents are zero at first.
class Buffer
{
public:
    virtual ~Buffer() = default;
    std::uint64_t bytes() const { return bytes_; }

protected:
    explicit Buffer(std::uint64_t bytes) : bytes_(bytes) {}

private:
    std::uint64_t bytes_;
};

using BufferPtr = std::shared_ptr<Buffer>;

/// New contents of a buffer from `offset` [bytes] on; whole words of 4 bytes. Those of one submission do not
/// overlap.
struct BufferWrite
{
    BufferPtr buffer;
    std::span<const std::byte> bytes;
    std::uint64_t offset = 0;
};

/// Device time of one dispatch of a timed replay.
struct DispatchTime
{
    std::size_t dispatch = 0;
    double nanoseconds = 0;
};

/// A compiled list of dispatches. Keeps its buffers alive. One replay is one submission.
class Recording
{
public:
    virtual ~Recording() = default;

    /// Starts the work and returns; Device::wait or any read waits for it.
    virtual void replay() = 0;

    /// Runs once with a timestamp around every dispatch, waits, returns device times in order.
    /// Uses a second recording, so that replay() is untouched.
    virtual std::vector<DispatchTime> replay_timed() = 0;

    std::span<const Dispatch> dispatches() const { return dispatches_; }
    const std::vector<bool>& barrier_before() const { return barrier_before_; }
    std::size_t barrier_count() const;

protected:
    std::vector<Dispatch> dispatches_;
    std::vector<bool> barrier_before_;
};

/// What a Device compiles: dispatches whose buffer numbers index `buffers`.
struct RecordingDesc
{
    std::vector<BufferPtr> buffers;
    std::vector<Dispatch> dispatches;
    std::vector<bool> barrier_before;
};

/// Threads: several may open and list devices, and may call all functions of one device at once, each on
/// buffers and recordings of its own: calls take turns where the executor asks for it. A buffer or recording
/// that two threads use is theirs to order. A device that an engine adopted shares its queue by the rules of
/// VulkanContext::queue_mutex.
class Device : public std::enable_shared_from_this<Device>
{
public:
    /// `auto` (a hardware GPU if there is one, else the native CPU), `vulkan`, `vulkan:1`, a fragment
    /// of a device name, `opengl`, `opengl:spirv`, `cpu`, `cpu:serial`, `cpu:shuffled`. An empty
    /// selector takes the environment variable TAUT_DEVICE, or `auto`.
    /// Throws Error{no_device} with the list of what there is.
    static std::shared_ptr<Device> open(std::string_view selector = {}, const OpenOptions& = {});

    /// Every device that open() could give, best first.
    static std::vector<DeviceInfo> list();

    virtual ~Device() = default;
    const DeviceInfo& info() const { return info_; }
    const DeviceLimits& limits() const { return info_.limits; }

    /// Zero-filled. Throws Error{limit} beyond limits().max_buffer_bytes, Error{bad_input} for 0 bytes.
    virtual BufferPtr make_buffer(std::uint64_t bytes, std::string_view label,
                                  BufferUse use = BufferUse::device) = 0;

    /// Host to device and back. Both wait for work in flight. Out of range: Error{bad_input}.
    virtual void write(const BufferPtr&, std::uint64_t offset, std::span<const std::byte>) = 0;
    virtual void read(const BufferPtr&, std::uint64_t offset, std::span<std::byte>) = 0;

    /// Checks limits and hands the list to the executor. Prefer Recorder.
    virtual std::unique_ptr<Recording> compile(RecordingDesc desc) = 0;

    /// Hands `writes` over and starts a replay of one of this device's recordings, which sees them; what was
    /// submitted before does not. Waits for nothing where the executor can (Vulkan; OpenGL orders it itself).
    virtual void replay(Recording& recording, std::span<const BufferWrite> writes);

    /// Waits until everything submitted is done. Throws Error{device_lost} if the device failed.
    virtual void wait() = 0;

    virtual DeviceCounters counters() const = 0;

    template <typename T>
    void write(const BufferPtr& buffer, std::span<const T> values, std::uint64_t offset = 0)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        write(buffer, offset, std::as_bytes(values));
    }

    template <typename T>
    std::vector<T> read(const BufferPtr& buffer, std::size_t count, std::uint64_t offset = 0)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(count);
        read(buffer, offset, std::as_writable_bytes(std::span<T>(values)));
        return values;
    }

protected:
    DeviceInfo info_;
};

/// Collects dispatches, derives the barriers and compiles a Recording.
class Recorder
{
public:
    explicit Recorder(std::shared_ptr<Device> device) : device_(std::move(device)) {}

    struct Binding
    {
        BufferPtr buffer;
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0; ///< 0: to the end of the buffer
        Binding(BufferPtr b = nullptr, std::uint64_t o = 0, std::uint64_t n = 0)
            : buffer(std::move(b)), offset(o), bytes(n) {}
        bool is_set() const { return buffer != nullptr; }
    };

    /// Which form of a kernel a dispatch takes.
    struct Form
    {
        std::string_view variant = {};
        Precision precision = Precision::float32;
        std::string_view label = {}; ///< empty: the kernel's name
        /// Of another kernel with the same bindings and parameters; empty: the one of the Bindings.
        std::string_view kernel = {};
    };

    /// Adds one dispatch over `count` elements (or groups); a count of 0 is checked but adds nothing.
    /// `bindings` is the generated Bindings struct of the kernel: every member goes to the slot of its name,
    /// and members that the variant does not have stay unset. Throws std::logic_error where they do not fit
    /// the variant, and Error{bad_input} where a buffer does not fit.
    template <template <typename> typename Bindings>
    Recorder& dispatch(const Bindings<Binding>& bindings, const typename Bindings<Binding>::Params& params,
                       std::uint32_t count, const Form& form)
    {
        const KernelInfo& kernel = kernel_of<Bindings<Binding>>(form);
        return add(kernel, in_slot_order(kernel, bindings), std::as_bytes(std::span(&params, 1)), count, {},
                   form.label);
    }

    /// The same for a kernel that was compiled from a text of the caller's, with bindings in order of slot.
    /// Throws Error{bad_input} when bindings or parameters do not fit the kernel.
    template <typename Params>
    Recorder& dispatch(const KernelInfo& kernel, std::vector<Binding> bindings, const Params& params,
                       std::uint32_t count, std::string_view label = {})
    {
        static_assert(std::is_trivially_copyable_v<Params>);
        return add(kernel, std::move(bindings), std::as_bytes(std::span(&params, 1)), count, {}, label);
    }

    Recorder& dispatch(const KernelInfo& kernel, std::vector<Binding> bindings, std::uint32_t count,
                       std::string_view label = {})
    {
        return add(kernel, std::move(bindings), {}, count, {}, label);
    }

    /// The same with the parameters as bytes.
    Recorder& dispatch(const KernelInfo& kernel, std::vector<Binding> bindings,
                       std::span<const std::byte> params, std::uint32_t count, std::string_view label = {})
    {
        return add(kernel, std::move(bindings), params, count, {}, label);
    }

    /// Group counts come from 12 bytes of a buffer when the dispatch starts; zero groups cost nothing.
    template <template <typename> typename Bindings>
    Recorder& dispatch_indirect(const Bindings<Binding>& bindings,
                                const typename Bindings<Binding>::Params& params, Binding group_counts,
                                std::uint32_t largest_count, const Form& form)
    {
        const KernelInfo& kernel = kernel_of<Bindings<Binding>>(form);
        return add(kernel, in_slot_order(kernel, bindings), std::as_bytes(std::span(&params, 1)),
                   largest_count, std::move(group_counts), form.label);
    }

    /// The same with bindings in order of slot.
    Recorder& dispatch_indirect(const KernelInfo& kernel, std::vector<Binding> bindings,
                                std::span<const std::byte> params, Binding group_counts,
                                std::uint32_t largest_count, std::string_view label = {})
    {
        return add(kernel, std::move(bindings), params, largest_count, std::move(group_counts), label);
    }

    std::size_t size() const { return dispatches_.size(); }

    /// Derives barriers and compiles. The recorder is empty afterwards.
    std::unique_ptr<Recording> finish();

private:
    template <typename Bindings>
    static const KernelInfo& kernel_of(const Form& form)
    {
        return form.kernel.empty() ? Bindings::info(form.variant, form.precision)
                                   : find_kernel(form.kernel, form.variant, form.precision);
    }
    Recorder& add(const KernelInfo&, std::vector<Binding>, std::span<const std::byte> params,
                  std::uint32_t count, std::optional<Binding> indirect, std::string_view label);
    BufferRange intern(const Binding& binding);

    std::shared_ptr<Device> device_;
    std::vector<BufferPtr> buffers_;
    std::unordered_map<const Buffer*, std::uint32_t> number_of_; ///< index in buffers_
    std::vector<Dispatch> dispatches_;
};

} // namespace taut
