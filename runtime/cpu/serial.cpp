#include "taut/runtime/cpu/runner.hpp"

namespace taut::cpu {
namespace {

class SerialRunner final : public Runner
{
public:
    void run(std::span<Pass> passes, Way) override
    {
        for (const Pass& pass : passes)
            if (const std::uint32_t elements = pass.elements())
                pass.run(0, elements);
    }
};

} // namespace

std::unique_ptr<Runner> make_serial_runner() { return std::make_unique<SerialRunner>(); }

} // namespace taut::cpu
