// Distance constraints of a 256 x 256 grid with diagonals and skip-one springs: 12 colours, 390,658.

#include "bench.hpp"
#include "plain.hpp"

#include "taut/kernels/xpbd_spring.hpp"
#include "taut/plan/topology.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/runtime/device.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>

namespace bench {
namespace {

constexpr std::uint32_t kSide = 256;
constexpr float kInverseStep = 600;

struct Problem
{
    std::vector<plain::Constraint> constraints;
    std::vector<std::uint32_t> colour_start;
    std::vector<plain::Vec4> position, delta;
};

Problem make_problem()
{
    Problem p;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(-1e-3f, 1e-3f);
    const float spacing = 2.0f / (kSide - 1);
    for (std::uint32_t v = 0; v < kSide * kSide; ++v)
    {
        p.position.push_back(
            {spacing * static_cast<float>(v % kSide), spacing * static_cast<float>(v / kSide), 0, 1});
        p.delta.push_back({noise(random), noise(random), noise(random), 0});
    }
    const auto springs = taut::grid_springs(kSide, kSide, true, true);
    const taut::Colouring colouring = taut::colouring_of(springs);
    for (const std::uint32_t k : colouring.order)
    {
        const plain::Vec4 &a = p.position[springs[k].a], &b = p.position[springs[k].b];
        p.constraints.push_back({springs[k].a, springs[k].b, std::hypot(a.x - b.x, a.y - b.y), 0});
    }
    p.colour_start = colouring.colour_start;
    return p;
}

/// The problem on a device: one replay is one sweep from wherever the last one left the displacements.
class OnDevice
{
public:
    OnDevice(const std::string& selector, const Problem& p)
        : device_(taut::Device::open(selector)),
          problem_(p)
    {
        constraint_ = upload(p.constraints);
        position_ = upload(p.position);
        delta_ = upload(p.delta);
        const std::vector<taut::layout::StepValues<float>> step{
            {1 / kInverseStep, kInverseStep, 0, 0, 0, 1, 1e15f, 0}};
        step_ = upload(step);
        events_ = device_->make_buffer(16, "events");
        const taut::kernels::xpbd_spring::Bindings<taut::Recorder::Binding> bindings = {
            .constraint = constraint_,
            .position = position_,
            .delta = delta_,
            .step_values = step_,
            .events = events_};
        taut::Recorder recorder(device_);
        for (std::size_t c = 0; c + 1 < p.colour_start.size(); ++c)
        {
            const std::uint32_t first = p.colour_start[c], count = p.colour_start[c + 1] - first;
            recorder.dispatch(bindings, {first, count, 1, 0}, count, {});
        }
        recording_ = recorder.finish();
    }

    void sweep()
    {
        recording_->replay();
        device_->wait();
    }

    void reset() { device_->write<plain::Vec4>(delta_, problem_.delta); }
    std::vector<plain::Vec4> delta() { return device_->read<plain::Vec4>(delta_, problem_.delta.size()); }

private:
    template <typename T>
    taut::BufferPtr upload(const std::vector<T>& values)
    {
        taut::BufferPtr buffer = device_->make_buffer(values.size() * sizeof(T), "bench");
        device_->write<T>(buffer, values);
        return buffer;
    }

    std::shared_ptr<taut::Device> device_;
    const Problem& problem_;
    taut::BufferPtr constraint_, position_, delta_, step_, events_;
    std::unique_ptr<taut::Recording> recording_;
};

double difference(const std::vector<plain::Vec4>& a, const std::vector<plain::Vec4>& b)
{
    double worst = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        worst = std::max({worst, std::abs(double(a[v].x) - b[v].x), std::abs(double(a[v].y) - b[v].y),
                          std::abs(double(a[v].z) - b[v].z)});
    return worst;
}

/// Gives the error back, or throws.
double verified(const std::string& who, double error)
{
    if (!(error <= kLargestError))
        throw std::runtime_error(who + " is " + taut::shown(error, 3) +
                                 " m from plain C++ after ten sweeps; nothing is timed above " +
                                 taut::shown(kLargestError) + " m");
    return error;
}

struct GraphicsDevice
{
    std::string selector;
    std::unique_ptr<OnDevice> problem;
};

/// Those that are there.
std::vector<GraphicsDevice> open_graphics(const Problem& problem)
{
    std::vector<GraphicsDevice> out;
    for (const char* selector : {"vulkan", "opengl"})
        try
        {
            out.push_back({selector, std::make_unique<OnDevice>(selector, problem)});
        }
        catch (const taut::Error& error)
        {
            if (error.code() != taut::ErrorCode::no_device)
                throw;
        }
    return out;
}

/// Keeps one core busy while it lives.
class BusyCore
{
public:
    BusyCore() : thread_([this] { while (!stop_.load(std::memory_order_relaxed)) {} }) {}
    ~BusyCore()
    {
        stop_ = true;
        thread_.join();
    }

private:
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

} // namespace

std::vector<Row> distance_rows()
{
    const Problem problem = make_problem();
    OnDevice serial("cpu:serial", problem), parallel("cpu", problem);
    std::vector<plain::Vec4> delta = problem.delta, position = problem.position;
    const auto sweep_plain = [&] {
        plain::sweep_displacements(problem.constraints, problem.colour_start, problem.position.data(),
                                   delta.data(), kInverseStep);
    };

    const std::vector<GraphicsDevice> graphics = open_graphics(problem);

    // Verify, then time: ten sweeps of each from the same start.
    for (int i = 0; i < 10; ++i)
    {
        sweep_plain();
        serial.sweep();
        parallel.sweep();
        for (const GraphicsDevice& device : graphics)
            device.problem->sweep();
    }
    const double serial_error = verified("native serial", difference(delta, serial.delta()));
    const double parallel_error = verified("native parallel", difference(delta, parallel.delta()));
    std::vector<double> graphics_errors;
    for (const GraphicsDevice& device : graphics)
        graphics_errors.push_back(verified(device.selector, difference(delta, device.problem->delta())));

    std::vector<Rival> rivals = {
        {"plain C++, displacements", sweep_plain},
        {"plain C++, positions only",
         [&] {
             plain::sweep_positions(problem.constraints, problem.colour_start, position.data(), kInverseStep);
         }},
        {"native serial", [&] { serial.sweep(); }},
        {"native parallel", [&] { parallel.sweep(); }},
    };
    take_turns(rivals, 40);
    // Turns of their own: the drivers' threads still run when a replay is over, and would be in the way.
    std::vector<Rival> drivers;
    for (const GraphicsDevice& device : graphics)
        drivers.push_back(
            {device.selector + ", wall time of replay and wait", [&] { device.problem->sweep(); }});
    take_turns(drivers, 40);

    std::vector<Rival> crowded = {{"native serial, one core busy", [&] { serial.sweep(); }},
                                  {"native parallel, one core busy", [&] { parallel.sweep(); }}};
    {
        const BusyCore busy;
        take_turns(crowded, 40);
    }
    const double loop = rivals[0].median(), one = rivals[2].median();
    std::vector<Row> rows = {
        {rivals[0].name, loop, rivals[0].best(), 0, 1, "", 0},
        {rivals[1].name, rivals[1].median(), rivals[1].best(), 0, rivals[1].median() / loop, rivals[0].name,
         0},
        {rivals[2].name, one, rivals[2].best(), serial_error, one / loop, rivals[0].name, 0.55},
        {rivals[3].name, rivals[3].median(), rivals[3].best(), parallel_error, rivals[3].median() / one,
         rivals[2].name, 0.6},
        {crowded[0].name, crowded[0].median(), crowded[0].best(), serial_error, 1, "", 0},
        {crowded[1].name, crowded[1].median(), crowded[1].best(), parallel_error,
         crowded[1].median() / crowded[0].median(), crowded[0].name, 1.3},
    };
    for (std::size_t i = 0; i < graphics.size(); ++i)
    {
        const Rival& rival = drivers[i];
        rows.push_back({rival.name, rival.median(), rival.best(), graphics_errors[i], rival.median() / loop,
                        rivals[0].name, 0});
    }
    return rows;
}

} // namespace bench
