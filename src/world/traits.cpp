// The four costs that a plan weighs, measured on the device itself with kernels that a step uses.

#include "taut/kernels/xpbd_spring.hpp"
#include "taut/world/kept_traits.hpp"
#include "taut/world/world.hpp"

#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace taut {
namespace {

/// A string of disjoint springs, enough to keep a device busy, with the buffers a pass needs.
class Probe
{
public:
    static constexpr std::uint32_t kSprings = 16384;
    static constexpr std::uint32_t kPhases = 512;
    static constexpr std::uint32_t kLaneSprings = 8192;

    explicit Probe(Device& device) : device_(device)
    {
        std::vector<layout::DistanceConstraint<float>> springs;
        std::vector<glm::vec4> position;
        for (std::uint32_t k = 0; k < kSprings; ++k)
        {
            springs.push_back({2 * k, 2 * k + 1, 1.0f, 0.0f});
            position.emplace_back(0.0f, 0.0f, 0.0f, 1.0f);
            position.emplace_back(1.1f, 0.0f, 0.0f, 1.0f);
        }
        const std::vector<layout::StepValues<float>> step{{0.01f, 100.0f, 0, 0, 0, 1, 1e15f, 0, 0}};
        constraint_ = upload<layout::DistanceConstraint<float>>(springs);
        position_ = upload<glm::vec4>(position);
        delta_ = device.make_buffer(position.size() * sizeof(glm::vec4), "probe delta");
        step_ = upload<layout::StepValues<float>>(step);
        events_ = device.make_buffer(16, "probe events");
        // Colours of one spring each, then one colour of many, then the ranges that the probes run.
        std::vector<std::uint32_t> table;
        for (std::uint32_t k = 0; k <= kPhases; ++k)
            table.push_back(k);
        table.insert(table.end(), {0, kLaneSprings});
        table.insert(table.end(), {0, 1, 0, kPhases, kPhases + 1, kPhases + 2});
        table_ = upload<std::uint32_t>(table);
    }

    std::unique_ptr<Recording> dispatches(std::uint32_t count, std::uint32_t springs)
    {
        Recorder recorder(device_.shared_from_this());
        for (std::uint32_t d = 0; d < count; ++d)
            recorder.dispatch(bindings({}), {0, springs, 1, 0}, springs, {});
        return recorder.finish();
    }

    enum Range : std::uint32_t
    {
        kOneColour = kPhases + 3,
        kManyColours = kPhases + 5,
        kLargeColour = kPhases + 7
    };

    std::unique_ptr<Recording> tail(Range range)
    {
        Recorder recorder(device_.shared_from_this());
        recorder.dispatch(bindings(table_), {range, 1, 1, 0}, 1, {"tail"});
        return recorder.finish();
    }

    /// What `more` takes beyond `less`, ns on the host's clock: the best of several replays of both, in
    /// turns, so that what disturbs the machine meets both. Not above 0 where other work drowned it.
    double beyond(Recording& more, Recording& less)
    {
        double long_one = 1e30, short_one = 1e30;
        for (int run = 0; run < 6; ++run)
        {
            const double a = time(more), b = time(less);
            if (run == 0) // warms up
                continue;
            long_one = std::min(long_one, a);
            short_one = std::min(short_one, b);
        }
        return long_one - short_one;
    }

private:
    kernels::xpbd_spring::Bindings<Recorder::Binding> bindings(BufferPtr table) const
    {
        return {.constraint = constraint_,
                .position = position_,
                .delta = delta_,
                .step_values = step_,
                .events = events_,
                .table = std::move(table)};
    }

    template <typename T>
    BufferPtr upload(const std::vector<T>& values)
    {
        BufferPtr buffer = device_.make_buffer(values.size() * sizeof(T), "probe");
        device_.write<T>(buffer, values);
        return buffer;
    }

    double time(Recording& recording)
    {
        const auto from = std::chrono::steady_clock::now();
        recording.replay();
        device_.wait();
        return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - from).count();
    }

    Device& device_;
    BufferPtr constraint_, position_, delta_, step_, events_, table_;
};

DeviceCosts measured(Device& device)
{
    Probe probe(device);
    const auto few = probe.dispatches(8, 1), many = probe.dispatches(72, 1);
    const auto one = probe.dispatches(1, 1), all = probe.dispatches(1, Probe::kSprings);
    const auto short_tail = probe.tail(Probe::kOneColour), long_tail = probe.tail(Probe::kManyColours);
    const auto large_tail = probe.tail(Probe::kLargeColour);
    return agreed_costs([&] {
        // A driver's threads may share a core for a while, and every dispatch then waits: give them time to
        // part.
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return DeviceCosts{probe.beyond(*many, *few) / 64,
                           probe.beyond(*long_tail, *short_tail) / (Probe::kPhases - 1),
                           probe.beyond(*all, *one) / Probe::kSprings,
                           probe.beyond(*large_tail, *short_tail) / Probe::kLaneSprings};
    });
}

/// From the file, or measured and added to it.
DeviceCosts costs_of(Device& device, const std::string& key)
{
    const std::filesystem::path file = costs_kept_in();
    if (file.empty())
        return measured(device);
    const std::map<std::string, DeviceCosts> kept = read_costs(file);
    if (const auto found = kept.find(key); found != kept.end())
        return found->second;
    const DeviceCosts costs = measured(device);
    add_costs(file, key, costs);
    return costs;
}

} // namespace

DeviceTraits limits_as_traits(const Device& device)
{
    DeviceTraits traits;
    traits.max_buffer_bytes = device.limits().max_buffer_bytes;
    traits.float64 = device.limits().float64;
    traits.executor = device.info().executor;
    traits.hardware_gpu = device.info().hardware_gpu;
    traits.limits = device.limits();
    return traits;
}

DeviceTraits measure_traits(Device& device)
{
    static std::mutex mutex;
    static std::map<std::string, DeviceCosts> known;
    const std::lock_guard lock(mutex);
    const DeviceInfo& info = device.info();
    const std::string key = info.executor + "|" + info.selector + "|" + info.name + "|" + info.driver;
    std::optional<DeviceCosts> costs = fixed_costs();
    if (!costs)
    {
        auto found = known.find(key);
        if (found == known.end())
            found = known.emplace(key, costs_of(device, key)).first;
        costs = found->second;
    }
    DeviceTraits traits = limits_as_traits(device);
    set_costs(traits, *costs);
    return traits;
}

} // namespace taut
