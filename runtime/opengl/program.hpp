#pragma once
// A kernel as the driver compiled it, checked against what the kernel's table says.

#include "taut/runtime/opengl/context.hpp"

#include <memory>
#include <string>

namespace taut::opengl {

class Program
{
public:
    /// Call inside a Use. Throws Error{kernel_compilation} with the driver's words, or when the driver lays
    /// out parameters or buffers differently from `kernel`; Error{unsupported} without that form of the
    /// kernel.
    Program(std::shared_ptr<Context> context, const KernelInfo& kernel, bool spirv);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    GLuint id() const { return id_; }

private:
    void compile(GLuint shader, const KernelInfo& kernel, bool spirv);
    void link(GLuint shader, const KernelInfo& kernel);
    void check_params(const KernelInfo& kernel) const;
    void check_buffers(const KernelInfo& kernel) const;
    GLint element_stride(GLuint block) const; ///< bytes; 0: the kernel never touches the block
    GLint resource(GLenum interface, GLuint index, GLenum property) const;
    [[noreturn]] void refuse(const KernelInfo& kernel, const std::string& why) const;

    std::shared_ptr<Context> context_;
    GLuint id_ = 0;
};

/// Kernels with equal keys compile to the same program.
std::string program_key(const KernelInfo& kernel, bool spirv);

} // namespace taut::opengl
