#include "taut/runtime/opengl/opengl_device.hpp"

#include "taut/runtime/compiler/override.hpp"
#include "taut/runtime/limits.hpp"
#include "taut/runtime/opengl/recording.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace taut {
namespace opengl {
namespace {

std::uint32_t small(std::int64_t value)
{
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(value, 0, 0xffffffff));
}

std::uint32_t groups_per_dimension(const Context& context)
{
    GLint x = 0, y = 0; // groups are folded into these two
    context.gl().GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &x);
    context.gl().GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &y);
    return small(std::min(x, y));
}

std::uint32_t group_size(const Context& context)
{
    GLint x = 0;
    context.gl().GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 0, &x);
    return small(std::min<std::int64_t>(x, context.number(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS)));
}

DeviceLimits read_limits(const Context& context)
{
    DeviceLimits limits;
    limits.max_buffer_bytes = static_cast<std::uint64_t>(context.number(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
    limits.offset_alignment =
        static_cast<std::uint64_t>(std::max(context.number(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT),
                                            context.number(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)));
    limits.max_groups_per_dimension = groups_per_dimension(context);
    limits.max_group_size = group_size(context);
    limits.max_shared_bytes = small(context.number(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE));
    limits.max_param_bytes = small(context.number(GL_MAX_UNIFORM_BLOCK_SIZE));
    limits.max_bindings = small(std::min(context.number(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS),
                                         context.number(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS)));
    limits.float64 = true; // core since 4.0
    return limits;
}

DeviceInfo describe(const Context& context, bool spirv)
{
    DeviceInfo info;
    info.selector = info.executor = spirv ? "opengl:spirv" : "opengl";
    info.name = context.renderer();
    info.driver = context.text(GL_VENDOR) + ", OpenGL " + context.version();
    info.hardware_gpu = context.hardware();
    info.limits = read_limits(context);
    return info;
}

class GlDevice final : public Device
{
public:
    GlDevice(std::shared_ptr<Context> context, bool spirv) : context_(std::move(context)), spirv_(spirv)
    {
        info_ = describe(*context_, spirv_);
    }

    BufferPtr make_buffer(std::uint64_t bytes, std::string_view label, BufferUse use) override;
    void write(const BufferPtr& buffer, std::uint64_t offset, std::span<const std::byte> data) override;
    void read(const BufferPtr& buffer, std::uint64_t offset, std::span<std::byte> data) override;
    std::unique_ptr<Recording> compile(RecordingDesc desc) override;

    void wait() override
    {
        const Context::Use use(*context_);
        context_->wait();
    }

    DeviceCounters counters() const override { return context_->counters(); }

private:
    const GlBuffer& own(const BufferPtr& buffer) const;
    const GlBuffer& own_range(const BufferPtr& buffer, std::uint64_t offset, std::uint64_t bytes) const;
    std::shared_ptr<Program> program(const KernelInfo& kernel);

    std::shared_ptr<Context> context_;
    bool spirv_;
    std::map<std::string, std::shared_ptr<Program>> programs_; // by text, kept for the next recording
};

BufferPtr GlDevice::make_buffer(std::uint64_t bytes, std::string_view label, BufferUse)
{
    const std::string what = "buffer " + std::string(label);
    if (bytes == 0)
        throw Error(ErrorCode::bad_input, what + " has 0 bytes: a buffer needs at least 1");
    if (bytes > limits().max_buffer_bytes)
        throw Error(ErrorCode::limit, what + " has " + std::to_string(bytes) + " bytes, " + info().name +
                                          " allows " + std::to_string(limits().max_buffer_bytes) +
                                          " (GL_MAX_SHADER_STORAGE_BLOCK_SIZE)");
    const Context::Use use(*context_);
    return std::make_shared<GlBuffer>(context_, bytes, label);
}

const GlBuffer& GlDevice::own(const BufferPtr& buffer) const
{
    const auto* mine = dynamic_cast<const GlBuffer*>(buffer.get());
    if (!mine || &mine->context() != context_.get())
        throw Error(ErrorCode::bad_input,
                    std::string(buffer ? "a buffer of another device" : "a null buffer") + " was given to " +
                        info().name + ": make it with this device");
    return *mine;
}

const GlBuffer& GlDevice::own_range(const BufferPtr& buffer, std::uint64_t offset, std::uint64_t bytes) const
{
    const GlBuffer& mine = own(buffer);
    if (offset > mine.bytes() || bytes > mine.bytes() - offset)
        throw Error(ErrorCode::bad_input, "bytes " + std::to_string(offset) + " to " +
                                              std::to_string(offset + bytes) + " are outside buffer " +
                                              mine.label() + " of " + std::to_string(mine.bytes()) +
                                              " bytes");
    return mine;
}

void GlDevice::write(const BufferPtr& buffer, std::uint64_t offset, std::span<const std::byte> data)
{
    const GlBuffer& target = own_range(buffer, offset, data.size());
    const Context::Use use(*context_);
    context_->wait();
    context_->gl().NamedBufferSubData(target.id(), static_cast<GLintptr>(offset),
                                      static_cast<GLsizeiptr>(data.size()), data.data());
    context_->check("writing buffer " + target.label());
}

void GlDevice::read(const BufferPtr& buffer, std::uint64_t offset, std::span<std::byte> data)
{
    const GlBuffer& source = own_range(buffer, offset, data.size());
    const Context::Use use(*context_);
    context_->wait();
    context_->gl().GetNamedBufferSubData(source.id(), static_cast<GLintptr>(offset),
                                         static_cast<GLsizeiptr>(data.size()), data.data());
    context_->check("reading buffer " + source.label());
}

std::shared_ptr<Program> GlDevice::program(const KernelInfo& kernel)
{
    const std::shared_ptr<const CompiledKernel> edited = kernel_override(kernel);
    const KernelInfo& used = edited ? edited->info : kernel;
    std::shared_ptr<Program>& known = programs_[program_key(used, spirv_)];
    if (!known)
        known = std::make_shared<Program>(context_, used, spirv_);
    return known;
}

std::unique_ptr<Recording> GlDevice::compile(RecordingDesc desc)
{
    for (const BufferPtr& buffer : desc.buffers)
        own(buffer);
    check_limits(desc, info_);
    const Context::Use use(*context_);
    std::map<const KernelInfo*, std::shared_ptr<Program>> once; // an edited text: once a recording
    std::vector<std::shared_ptr<Program>> programs;
    for (const Dispatch& dispatch : desc.dispatches)
    {
        std::shared_ptr<Program>& known = once[dispatch.kernel];
        if (!known)
            known = program(*dispatch.kernel);
        programs.push_back(known);
    }
    return std::make_unique<GlRecording>(context_, std::move(desc), std::move(programs),
                                         limits().max_groups_per_dimension);
}

} // namespace
} // namespace opengl

std::vector<DeviceInfo> list_opengl()
{
    try
    {
        const auto context = opengl::Context::open(false);
        const opengl::Context::Use use(*context);
        std::vector<DeviceInfo> out = {opengl::describe(*context, false)};
        if (context->takes_spirv())
            out.push_back(opengl::describe(*context, true));
        return out;
    }
    catch (const Error&)
    {
        return {}; // open_opengl tells why
    }
}

std::shared_ptr<Device> open_opengl(bool spirv, const OpenOptions& options)
{
    const auto context = opengl::Context::open(options.validation);
    if (spirv && !context->takes_spirv())
        throw Error(ErrorCode::unsupported,
                    context->renderer() + " takes no SPIR-V (no GL_ARB_gl_spirv): open \"opengl\" instead");
    const opengl::Context::Use use(*context);
    return std::make_shared<opengl::GlDevice>(context, spirv);
}

} // namespace taut
