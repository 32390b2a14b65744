#pragma once
// One OpenGL context without a window, and what is true of it as a whole: who may use it, whether it
// still works, when the work handed to it is done, and what it was asked to do.

#include "taut/runtime/device.hpp"
#include "taut/runtime/opengl/egl.hpp"
#include "taut/runtime/opengl/gl.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace taut::opengl {

class Context
{
public:
    /// The first display with a hardware driver, else the first that works.
    /// Throws Error{no_device} naming every display tried and its reason.
    static std::shared_ptr<Context> open(bool validation);

    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();

    /// Makes the context current in this thread; gives back what was current before when it ends.
    /// One thread at a time; a second use in the same thread is free.
    class Use
    {
    public:
        explicit Use(Context& context);
        ~Use();
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

    private:
        Context& context_;
        std::unique_lock<std::recursive_mutex> lock_;
    };

    bool is_current() const;

    /// Throws for errors that the driver noted since the last check: Error{out_of_memory}, else
    /// Error{device_lost}; after the latter every use throws. `doing` completes "while ...".
    void check(std::string_view doing);

    /// Drops the driver's notes of errors that the caller has already reported.
    void forget_errors();

    /// Ends a submission: later wait() calls wait for everything given so far.
    void submit();

    /// Until all submissions are done. Throws Error{device_lost}.
    void wait();

    const Gl& gl() const { return gl_; }
    const std::string& renderer() const { return renderer_; }
    const std::string& version() const { return version_; }
    bool takes_spirv() const { return gl_.SpecializeShader != nullptr; }
    bool hardware() const;
    std::string text(GLenum name) const;
    std::int64_t number(GLenum name) const;

    DeviceCounters counters() const;
    DeviceCounters& count() { return counters_; } ///< only inside a Use

private:
    Context(const Egl& egl, EGLDisplay display, EGLContext context);
    static std::shared_ptr<Context> open_on(const Egl& egl, EGLDisplay display, bool validation);
    void load_functions();
    void listen();
    bool has_extension(std::string_view name) const;
    [[noreturn]] void lose(const std::string& why);
    static void APIENTRY on_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar*,
                                    const void* self);

    const Egl& egl_;
    EGLDisplay display_;
    EGLContext context_;
    Gl gl_;
    std::string renderer_, version_, lost_;
    mutable std::recursive_mutex mutex_;
    int depth_ = 0;
    CurrentContext before_;
    GLsync fence_ = nullptr;
    DeviceCounters counters_;
    std::atomic<std::uint64_t> messages_{0};
};

} // namespace taut::opengl
