#pragma once
// A recording as OpenGL calls: decided once, replayed as often as wanted.

#include "taut/runtime/opengl/buffer.hpp"
#include "taut/runtime/opengl/program.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace taut::opengl {

/// One OpenGL call. What the fields mean depends on `op`.
struct Command
{
    enum class Op : std::uint8_t
    {
        use_program,       // object
        bind_storage,      // slot, object, offset, bytes
        bind_params,       // object, offset, bytes
        bind_indirect,     // object
        barrier,           // object = bits
        dispatch,          // x, y groups
        dispatch_indirect, // offset
        timestamp,         // object = query
    };
    Op op;
    std::uint32_t slot = 0;
    GLuint object = 0;
    GLuint x = 0;
    GLuint y = 0;
    GLintptr offset = 0;
    GLsizeiptr bytes = 0;
};

/// Parameter blocks of all dispatches in one uniform buffer, each at an offset that may be bound.
class ParamBlocks
{
public:
    /// Call inside a Use.
    ParamBlocks(std::shared_ptr<Context> context, const std::vector<Dispatch>& dispatches);

    GLuint buffer() const { return buffer_ ? buffer_->id() : 0; }
    GLintptr offset(std::size_t dispatch) const { return offsets_[dispatch]; }
    GLsizeiptr bytes(std::size_t dispatch) const { return sizes_[dispatch]; } ///< 0: no parameters

private:
    std::vector<GLintptr> offsets_;
    std::vector<GLsizeiptr> sizes_;
    std::unique_ptr<GlBuffer> buffer_;
};

/// Everything that the calls of a recording refer to.
struct CommandInputs
{
    const std::vector<BufferPtr>& buffers;
    const std::vector<Dispatch>& dispatches;
    const std::vector<bool>& barrier_before;
    const std::vector<std::shared_ptr<Program>>& programs; ///< one per dispatch
    const ParamBlocks& params;
    std::uint32_t max_groups_per_dimension;
};

/// The calls of one replay. `queries`: empty, or two per dispatch that take the time before and after it.
std::vector<Command> make_commands(const CommandInputs& in, const std::vector<GLuint>& queries);

void run(const Gl& gl, const std::vector<Command>& commands);

} // namespace taut::opengl
