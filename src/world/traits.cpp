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
#include <mutex>

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
        const std::vector<layout::StepValues<float>> step{{0.01f, 100.0f, 0, 0, 0, 1, 1e15f, 0}};
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

    /// Best of several replays, ns on the host's clock.
    double time_dispatches(std::uint32_t dispatches, std::uint32_t springs)
    {
        Recorder recorder(device_.shared_from_this());
        for (std::uint32_t d = 0; d < dispatches; ++d)
            recorder.dispatch(kernels::xpbd_spring::info(), {constraint_, position_, delta_, step_, events_},
                              kernels::xpbd_spring::Params{0, springs, 1, 0}, springs);
        return best(*recorder.finish());
    }

    enum Range : std::uint32_t
    {
        kOneColour = kPhases + 3,
        kManyColours = kPhases + 5,
        kLargeColour = kPhases + 7
    };

    double time_tail(Range range)
    {
        Recorder recorder(device_.shared_from_this());
        recorder.dispatch(kernels::xpbd_spring::info("tail"),
                          {constraint_, position_, delta_, step_, events_, table_},
                          kernels::xpbd_spring::Params{range, 1, 1, 0}, 1);
        return best(*recorder.finish());
    }

private:
    template <typename T>
    BufferPtr upload(const std::vector<T>& values)
    {
        BufferPtr buffer = device_.make_buffer(values.size() * sizeof(T), "probe");
        device_.write<T>(buffer, values);
        return buffer;
    }

    double best(Recording& recording)
    {
        double least = 1e30;
        for (int run = 0; run < 6; ++run)
        {
            const auto from = std::chrono::steady_clock::now();
            recording.replay();
            device_.wait();
            const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - from;
            if (run > 0) // the first run warms up
                least = std::min(least, took.count());
        }
        return least;
    }

    Device& device_;
    BufferPtr constraint_, position_, delta_, step_, events_, table_;
};

DeviceCosts measured(Device& device)
{
    DeviceCosts out;
    Probe probe(device);
    const double few = probe.time_dispatches(8, 1), many = probe.time_dispatches(72, 1);
    out.dispatch_ns = std::max((many - few) / 64, 1.0);
    const double short_tail = probe.time_tail(Probe::kOneColour),
                 long_tail = probe.time_tail(Probe::kManyColours);
    out.group_barrier_ns = std::max((long_tail - short_tail) / (Probe::kPhases - 1), 1.0);
    const double all = probe.time_dispatches(1, Probe::kSprings), one = probe.time_dispatches(1, 1);
    out.element_ns = std::max((all - one) / Probe::kSprings, 1e-3);
    out.lane_element_ns =
        std::max((probe.time_tail(Probe::kLargeColour) - short_tail) / Probe::kLaneSprings, out.element_ns);
    return out;
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
    auto found = known.find(key);
    if (found == known.end())
        found = known.emplace(key, costs_of(device, key)).first;
    DeviceTraits traits = limits_as_traits(device);
    traits.dispatch_ns = found->second.dispatch_ns;
    traits.group_barrier_ns = found->second.group_barrier_ns;
    traits.element_ns = found->second.element_ns;
    traits.lane_element_ns = found->second.lane_element_ns;
    return traits;
}

} // namespace taut
