#pragma once
// A compiled list of dispatches on OpenGL.

#include "taut/runtime/opengl/commands.hpp"

namespace taut::opengl {

class GlRecording final : public Recording
{
public:
    /// Call inside a Use. `programs`: one per dispatch.
    GlRecording(std::shared_ptr<Context> context, RecordingDesc desc,
                std::vector<std::shared_ptr<Program>> programs, std::uint32_t max_groups_per_dimension);

    void replay() override;
    std::vector<DispatchTime> replay_timed() override;

private:
    CommandInputs inputs() const;
    void submit(const std::vector<Command>& commands);

    std::shared_ptr<Context> context_;
    std::vector<BufferPtr> buffers_;
    std::vector<std::shared_ptr<Program>> programs_;
    std::uint32_t max_groups_per_dimension_;
    ParamBlocks params_;
    std::vector<Command> commands_;
};

} // namespace taut::opengl
