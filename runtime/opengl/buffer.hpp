#pragma once
// Device memory on OpenGL: one immutable storage per buffer.

#include "taut/runtime/opengl/context.hpp"

namespace taut::opengl {

class GlBuffer final : public Buffer
{
public:
    /// Zero-filled; call inside a Use. Throws Error{out_of_memory}.
    GlBuffer(std::shared_ptr<Context> context, std::uint64_t bytes, std::string_view label);
    ~GlBuffer() override;

    GLuint id() const { return id_; }
    const Context& context() const { return *context_; }
    const std::string& label() const { return label_; }

private:
    std::shared_ptr<Context> context_;
    std::string label_;
    GLuint id_ = 0;
};

} // namespace taut::opengl
