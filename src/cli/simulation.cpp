#include "taut/cli/simulation.hpp"

#include "taut/cli/device_option.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/sleep.hpp"

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
    World& whole() override { return world_; }

private:
    World world_;
};

class TwoDevices final : public Simulation
{
public:
    TwoDevices(const Scene& scene, std::shared_ptr<Device> cpu, std::shared_ptr<Device> other)
        : whole_(scene, cpu),
          hybrid_(scene, cpu, std::move(other))
    {
        hybrid_.copy_into(whole_); // refuses now what it would refuse at the end
    }

    void step() override { hybrid_.step(); }
    const Scene& scene() const override { return hybrid_.scene(); }
    double time() const override { return hybrid_.time(); }
    std::vector<glm::dvec3> positions() const override { return hybrid_.positions(); }
    std::vector<glm::dvec3> velocities() const override { return hybrid_.velocities(); }
    std::uint32_t substeps() const override { return whole_.plan().substeps; }
    Events events() const override { return hybrid_.events(); }
    SolverReport solver_report() const override { return hybrid_.solver_report(); }
    std::size_t solvers() const override { return whole_.plan().solvers.size(); }
    World& whole() override
    {
        hybrid_.copy_into(whole_);
        return whole_;
    }
    bool is_whole() const override { return false; }
    std::vector<HybridPart> parts() const override { return hybrid_.parts(); }

private:
    World whole_;
    HybridWorld hybrid_;
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

} // namespace

std::unique_ptr<Simulation> open_simulation(const std::string& selector, const Scene& resolved, bool sleep)
{
    if (selector != kHybrid && !selector.starts_with(std::string(kHybrid) + ":"))
    {
        if (sleep)
            return std::make_unique<Sleeping>(resolved, open_device(selector));
        return std::make_unique<OneDevice>(resolved, open_device(selector));
    }
    if (sleep)
        throw Error(ErrorCode::unsupported,
                    "--sleep and --device hybrid do not go together yet; use one device");
    const std::string other = selector == kHybrid ? "" : selector.substr(kHybrid.size() + 1);
    return std::make_unique<TwoDevices>(resolved, open_device("cpu"),
                                        other.empty() ? best_other() : open_device(other));
}

} // namespace taut::cli
