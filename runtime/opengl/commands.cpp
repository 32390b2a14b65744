#include "taut/runtime/opengl/commands.hpp"

#include "taut/runtime/limits.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace taut::opengl {
namespace {

GLuint buffer_id(const CommandInputs& in, std::uint32_t number)
{
    return static_cast<const GlBuffer&>(*in.buffers[number]).id();
}

bool overlap(const BufferRange& a, const BufferRange& b)
{
    return a.buffer == b.buffer && a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
}

bool writes_to(const Dispatch& dispatch, const BufferRange& range)
{
    for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
        if (writes(dispatch.kernel->bindings[i].access) && overlap(dispatch.bindings[i], range))
            return true;
    return false;
}

/// For each dispatch, the first dispatch that writes its group counts; size() if none does.
std::vector<std::size_t> first_count_writers(const std::vector<Dispatch>& dispatches)
{
    // Many dispatches share their counts.
    std::map<std::pair<std::uint32_t, std::uint64_t>, std::size_t> known;
    std::vector<std::size_t> first(dispatches.size(), dispatches.size());
    for (std::size_t i = 0; i < dispatches.size(); ++i)
    {
        const BufferRange& counts = dispatches[i].indirect;
        if (counts.buffer == kNoBuffer)
            continue;
        const auto [it, fresh] = known.try_emplace({counts.buffer, counts.offset});
        if (fresh)
            it->second = static_cast<std::size_t>(
                std::find_if(dispatches.begin(), dispatches.end(),
                             [&](const Dispatch& d) { return writes_to(d, counts); }) -
                dispatches.begin());
        first[i] = it->second;
    }
    return first;
}

/// Bits of the barrier before dispatch `at`: group counts are read by another path than buffers, so they
/// need a bit of their own if a dispatch before this barrier wrote them.
GLbitfield barrier_bits(const std::vector<bool>& barrier_before, const std::vector<std::size_t>& writers,
                        std::size_t at)
{
    for (std::size_t i = at; i < writers.size() && (i == at || !barrier_before[i]); ++i)
        if (writers[i] < at)
            return GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT;
    return GL_SHADER_STORAGE_BARRIER_BIT;
}

/// Writes commands and remembers what is bound, so that nothing is bound twice in a row.
class Writer
{
public:
    Writer(const CommandInputs& in, std::vector<Command>& out) : in_(in), out_(out) {}

    void barrier(GLbitfield bits) { out_.push_back({.op = Command::Op::barrier, .object = bits}); }
    void timestamp(GLuint query) { out_.push_back({.op = Command::Op::timestamp, .object = query}); }

    void bind(std::size_t at)
    {
        const Dispatch& dispatch = in_.dispatches[at];
        set(program_, {.op = Command::Op::use_program, .object = in_.programs[at]->id()});
        for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
            bind_storage(dispatch.kernel->bindings[i].slot, dispatch.bindings[i]);
        if (in_.params.bytes(at) > 0)
            set(params_, {.op = Command::Op::bind_params,
                          .object = in_.params.buffer(),
                          .offset = in_.params.offset(at),
                          .bytes = in_.params.bytes(at)});
        if (dispatch.indirect.buffer != kNoBuffer)
            set(indirect_,
                {.op = Command::Op::bind_indirect, .object = buffer_id(in_, dispatch.indirect.buffer)});
    }

    void launch(std::size_t at)
    {
        const Dispatch& dispatch = in_.dispatches[at];
        if (dispatch.indirect.buffer != kNoBuffer)
        {
            out_.push_back({.op = Command::Op::dispatch_indirect,
                            .offset = static_cast<GLintptr>(dispatch.indirect.offset)});
            return;
        }
        const std::uint32_t groups = group_count(*dispatch.kernel, dispatch.count);
        const GroupFold fold = fold_groups(groups, in_.max_groups_per_dimension);
        if (groups > 0)
            out_.push_back({.op = Command::Op::dispatch, .x = fold.x, .y = fold.y});
    }

private:
    void bind_storage(std::uint32_t slot, const BufferRange& range)
    {
        if (slot >= storage_.size())
            storage_.resize(slot + 1);
        set(storage_[slot], {.op = Command::Op::bind_storage,
                             .slot = slot,
                             .object = buffer_id(in_, range.buffer),
                             .offset = static_cast<GLintptr>(range.offset),
                             .bytes = static_cast<GLsizeiptr>(range.bytes)});
    }

    void set(Command& bound, const Command& wanted)
    {
        if (bound.object == wanted.object && bound.offset == wanted.offset && bound.bytes == wanted.bytes)
            return;
        bound = wanted;
        out_.push_back(wanted);
    }

    const CommandInputs& in_;
    std::vector<Command>& out_;
    // Object 0 stands for "unknown": other recordings and the caller bind as they like.
    Command program_{}, params_{}, indirect_{};
    std::vector<Command> storage_;
};

} // namespace

ParamBlocks::ParamBlocks(std::shared_ptr<Context> context, const std::vector<Dispatch>& dispatches)
    : offsets_(dispatches.size()),
      sizes_(dispatches.size())
{
    // std140 rounds a block up to 16 bytes, and the bound range must cover it.
    const auto step = static_cast<std::size_t>(
        std::max<std::int64_t>(context->number(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT), 16));
    std::string bytes;
    std::map<std::string, std::size_t> seen; // equal blocks are stored once
    for (std::size_t i = 0; i < dispatches.size(); ++i)
    {
        const std::vector<std::byte>& params = dispatches[i].params;
        if (params.empty())
            continue;
        const std::string block(reinterpret_cast<const char*>(params.data()), params.size());
        const auto [it, fresh] = seen.try_emplace(block, bytes.size());
        if (fresh)
        {
            bytes += block;
            bytes.resize((bytes.size() + step - 1) / step * step);
        }
        offsets_[i] = static_cast<GLintptr>(it->second);
        sizes_[i] = static_cast<GLsizeiptr>((block.size() + 15) / 16 * 16);
    }
    if (bytes.empty())
        return;
    buffer_ = std::make_unique<GlBuffer>(context, bytes.size(), "parameters");
    context->gl().NamedBufferSubData(buffer_->id(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

std::vector<Command> make_commands(const CommandInputs& in, const std::vector<GLuint>& queries)
{
    std::vector<Command> out;
    Writer writer(in, out);
    const std::vector<std::size_t> writers = first_count_writers(in.dispatches);
    // Earlier replays may have written anything, group counts included.
    writer.barrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    for (std::size_t i = 0; i < in.dispatches.size(); ++i)
    {
        if (in.barrier_before[i])
            writer.barrier(barrier_bits(in.barrier_before, writers, i));
        writer.bind(i);
        if (!queries.empty())
            writer.timestamp(queries[2 * i]);
        writer.launch(i);
        if (!queries.empty())
            writer.timestamp(queries[2 * i + 1]);
    }
    writer.barrier(GL_BUFFER_UPDATE_BARRIER_BIT); // Device::read and Device::write come next
    return out;
}

void run(const Gl& gl, const std::vector<Command>& commands)
{
    for (const Command& c : commands)
        switch (c.op)
        {
        case Command::Op::use_program: gl.UseProgram(c.object); break;
        case Command::Op::bind_storage:
            gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, c.slot, c.object, c.offset, c.bytes);
            break;
        case Command::Op::bind_params:
            gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, c.object, c.offset, c.bytes);
            break;
        case Command::Op::bind_indirect: gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, c.object); break;
        case Command::Op::barrier: gl.MemoryBarrier(c.object); break;
        case Command::Op::dispatch: gl.DispatchCompute(c.x, c.y, 1); break;
        case Command::Op::dispatch_indirect: gl.DispatchComputeIndirect(c.offset); break;
        case Command::Op::timestamp: gl.QueryCounter(c.object, GL_TIMESTAMP); break;
        }
}

} // namespace taut::opengl
