#include "taut/runtime/opengl/buffer.hpp"

#include <utility>

namespace taut::opengl {

GlBuffer::GlBuffer(std::shared_ptr<Context> context, std::uint64_t bytes, std::string_view label)
    : Buffer(bytes),
      context_(std::move(context)),
      label_(label)
{
    const Gl& gl = context_->gl();
    // Whole words, because clearing by words is the fast way.
    const std::uint64_t storage = (bytes + 15) / 16 * 16;
    gl.CreateBuffers(1, &id_);
    gl.NamedBufferStorage(id_, static_cast<GLsizeiptr>(storage), nullptr, GL_DYNAMIC_STORAGE_BIT);
    try
    {
        context_->check("making buffer " + label_ + " of " + std::to_string(bytes) + " bytes");
        gl.ClearNamedBufferData(id_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        context_->check("clearing buffer " + label_);
    }
    catch (...)
    {
        gl.DeleteBuffers(1, &id_);
        throw;
    }
    context_->count().bytes_allocated += bytes;
    ++context_->count().memory_blocks;
}

GlBuffer::~GlBuffer()
{
    try
    {
        const Context::Use use(*context_);
        context_->gl().DeleteBuffers(1, &id_);
        context_->count().bytes_allocated -= bytes();
        --context_->count().memory_blocks;
    }
    catch (const Error&)
    {
        // A lost context takes its buffers with it.
    }
}

} // namespace taut::opengl
