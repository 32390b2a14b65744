// What recording and replaying cost the host.

#include "bench.hpp"

#include "taut/kernels/damping.hpp"
#include "taut/runtime/device.hpp"

#include <memory>

namespace bench {

std::vector<Row> recording_rows()
{
    std::vector<Row> rows;
    for (const std::string selector : {"cpu:serial", "vulkan", "opengl"})
    {
        std::shared_ptr<taut::Device> device;
        try
        {
            device = taut::Device::open(selector);
        }
        catch (const taut::Error&)
        {
            continue;
        }
        const taut::BufferPtr velocity = device->make_buffer(1024, "velocity"),
                              step = device->make_buffer(taut::kernels::damping::info().bindings[1].stride,
                                                         "step");
        std::unique_ptr<taut::Recording> recording;
        const auto record = [&] {
            taut::Recorder recorder(device);
            for (int i = 0; i < 1000; ++i)
                recorder.dispatch(taut::kernels::damping::info(), {velocity, step},
                                  taut::kernels::damping::Params{64}, 64);
            recording = recorder.finish();
        };
        std::vector<Rival> rivals = {{"record", record}, {"replay", [&] {
                                                              recording->replay();
                                                              device->wait();
                                                          }}};
        take_turns(rivals, 20);
        const std::uint64_t before = device->counters().submissions;
        recording->replay();
        device->wait();
        const double submissions = static_cast<double>(device->counters().submissions - before);
        rows.push_back({"record 1,000 dispatches, " + selector, rivals[0].median(), rivals[0].best(), 0,
                        rivals[0].median(), "1 ms", 1});
        rows.push_back(
            {"replay them (" + std::to_string(static_cast<int>(submissions)) + " submission), " + selector,
             rivals[1].median(), rivals[1].best(), 0, submissions, "1 submission", 1});
    }
    return rows;
}

} // namespace bench
