#include "taut/cli/simulation.hpp"

#include "taut/cli/device_option.hpp"
#include "taut/report/contact_depth.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/sleep.hpp"
#include "taut/world/split.hpp"

#include <utility>

namespace taut::cli {
namespace {

constexpr std::string_view kHybrid = "hybrid";

class OneDevice final : public Simulation
{
public:
    OneDevice(const Scene& scene, std::shared_ptr<Device> device) : world_(scene, std::move(device)) {}

    void step() override
    {
        world_.step();
        world_.device().wait();
    }
    const Scene& scene() const override { return world_.scene(); }
    double time() const override { return world_.time(); }
    std::vector<glm::dvec3> positions() const override { return world_.positions(); }
    std::vector<glm::dvec3> velocities() const override { return world_.velocities(); }
    std::uint32_t substeps() const override { return world_.plan().substeps; }
    Events events() const override { return world_.events(); }
    SolverReport solver_report() const override { return world_.solver_report(); }
    double active_share() const override { return world_.active_share(); }
    std::size_t solvers() const override { return world_.plan().solvers.size(); }
    std::uint64_t torn() const override { return world_.torn(); }
    std::uint64_t pinched() const override { return world_.contacts().pinched; }
    World& whole() override { return world_; }

private:
    World world_;
};

/// `Both`: HybridWorld or SplitWorld.
template <typename Both>
class TwoDevices final : public Simulation
{
public:
    template <typename... Options>
    TwoDevices(const Scene& scene, std::shared_ptr<Device> first, std::shared_ptr<Device> second,
               const Options&... options)
        : whole_(scene, first),
          both_(scene, first, std::move(second), options...)
    {
        both_.copy_into(whole_); // refuses now what it would refuse at the end
    }

    void step() override { both_.step(); }
    const Scene& scene() const override { return both_.scene(); }
    double time() const override { return both_.time(); }
    std::vector<glm::dvec3> positions() const override { return both_.positions(); }
    std::vector<glm::dvec3> velocities() const override { return both_.velocities(); }
    std::uint32_t substeps() const override { return whole_.plan().substeps; }
    Events events() const override { return both_.events(); }
    SolverReport solver_report() const override
    {
        if constexpr (requires { both_.solver_report(); })
            return both_.solver_report();
        else
            return {}; // methods that solve systems cannot be cut
    }
    std::size_t solvers() const override { return whole_.plan().solvers.size(); }
    World& whole() override
    {
        both_.copy_into(whole_);
        return whole_;
    }
    bool is_whole() const override { return false; }
    std::vector<HybridPart> parts() const override { return both_.parts(); }

private:
    World whole_;
    Both both_;
};

class Sleeping final : public Simulation
{
public:
    Sleeping(const Scene& scene, const std::shared_ptr<Device>& device)
        : whole_(scene, device),
          sleep_(scene, device)
    {}

    void step() override
    {
        sleep_.step();
        whole_.device().wait();
    }
    const Scene& scene() const override { return sleep_.scene(); }
    double time() const override { return sleep_.time(); }
    std::vector<glm::dvec3> positions() const override { return sleep_.positions(); }
    std::vector<glm::dvec3> velocities() const override { return sleep_.velocities(); }
    std::uint32_t substeps() const override { return whole_.plan().substeps; }
    Events events() const override { return sleep_.events(); }
    SolverReport solver_report() const override { return {}; } // such methods cannot sleep
    std::size_t solvers() const override { return 0; }
    std::optional<std::size_t> asleep() const override { return sleep_.asleep(); }
    World& whole() override
    {
        sleep_.copy_into(whole_);
        return whole_;
    }
    bool is_whole() const override { return false; }
    void take_contacts(StepReport& report) const override
    {
        report.contacts = sleep_.contacts();
        report.contact_forces = sleep_.contact_forces();
        report.contact_depth = contact_depth(sleep_.awake(), sleep_.awake().positions());
    }

private:
    World whole_;
    SleepWorld sleep_;
};

/// The best device that is not the native CPU.
std::shared_ptr<Device> best_other()
{
    for (const DeviceInfo& info : Device::list())
        if (!info.executor.starts_with("cpu"))
            return open_device(info.selector);
    throw Error(ErrorCode::no_device,
                "--device hybrid needs a second device beside the native CPU, and there "
                "is none; `taut devices` lists what there is");
}

bool is_hybrid(const std::string& selector)
{
    return selector == kHybrid || selector.starts_with(std::string(kHybrid) + ":");
}

/// What "hybrid", "hybrid:SECOND" or "hybrid:FIRST+SECOND" names.
std::pair<std::shared_ptr<Device>, std::shared_ptr<Device>> open_both(const std::string& selector)
{
    const std::string named = selector == kHybrid ? "" : selector.substr(kHybrid.size() + 1);
    const std::size_t plus = named.find('+');
    if (named.empty())
        return {open_device("cpu"), best_other()};
    if (plus == std::string::npos)
        return {open_device("cpu"), open_device(named)};
    return {open_device(named.substr(0, plus)), open_device(named.substr(plus + 1))};
}

void check_options(const SimulationOptions& options)
{
    const bool vertices = options.split == kSplitVertices;
    if (vertices && !is_hybrid(options.device))
        throw Error(ErrorCode::bad_input,
                    "--split vertices divides a scene between two devices; add --device "
                    "hybrid, hybrid:DEVICE or hybrid:DEVICE+DEVICE");
    if (options.share && !vertices)
        throw Error(ErrorCode::bad_input,
                    "--share is the first device's part of the vertices; add --split vertices");
    if (options.sleep && is_hybrid(options.device))
        throw Error(ErrorCode::unsupported,
                    "--sleep and --device hybrid do not go together yet; use one device");
}

} // namespace

std::unique_ptr<Simulation> open_simulation(const SimulationOptions& options, const Scene& resolved)
{
    check_options(options);
    if (!is_hybrid(options.device))
    {
        if (options.sleep)
            return std::make_unique<Sleeping>(resolved, open_device(options.device));
        return std::make_unique<OneDevice>(resolved, open_device(options.device));
    }
    const auto [first, second] = open_both(options.device);
    if (options.split != kSplitVertices)
        return std::make_unique<TwoDevices<HybridWorld>>(resolved, first, second);
    return std::make_unique<TwoDevices<SplitWorld>>(resolved, first, second,
                                                    SplitOptions{{}, options.share.value_or(-1)});
}

} // namespace taut::cli
