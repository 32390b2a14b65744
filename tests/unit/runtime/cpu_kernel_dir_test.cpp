// Native code cannot take an edited kernel text; it says so instead of running the old one.

#include "refusal.hpp"
#include "support/catch.hpp"

#include "taut/kernels/damping.hpp"
#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/device.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace taut;
namespace fs = std::filesystem;
using test::Refusal;
using test::refusal;

/// A folder named by TAUT_KERNEL_DIR for the length of a test.
class KernelDir
{
public:
    KernelDir() : path_(fs::temp_directory_path() / ("taut_cpu_kernel_dir_" + std::to_string(getpid())))
    {
        if (const char* old = std::getenv("TAUT_KERNEL_DIR"))
            old_ = old;
        fs::create_directories(path_ / "step");
        setenv("TAUT_KERNEL_DIR", path_.c_str(), 1);
    }
    ~KernelDir()
    {
        setenv("TAUT_KERNEL_DIR", old_.c_str(), 1);
        fs::remove_all(path_);
    }

    void add(const std::string& name) const { std::ofstream(path_ / "step" / name) << "// edited\n"; }

private:
    fs::path path_;
    std::string old_;
};

} // namespace

TEST_CASE("the native executor refuses a kernel for which TAUT_KERNEL_DIR holds a text, and no other")
{
    const KernelDir folder;
    const auto device = open_cpu(CpuMode::serial, {});
    const BufferPtr velocity = device->make_buffer(1024, "velocity"),
                    step = device->make_buffer(kernels::damping::info().bindings[1].stride, "step");
    const auto compile = [&] {
        Recorder recorder(device);
        recorder.dispatch(
            kernels::damping::Bindings<Recorder::Binding>{.velocity = velocity, .step_values = step}, {64},
            64, {});
        recorder.finish();
    };
    folder.add("predict.comp");
    compile();
    folder.add("damping.comp");
    const Refusal error = refusal(compile);
    CHECK(error.code == ErrorCode::unsupported);
    CHECK(error.says("damping.comp"));
    CHECK(error.says("vulkan"));
}
