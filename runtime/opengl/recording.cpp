#include "taut/runtime/opengl/recording.hpp"

#include <utility>

namespace taut::opengl {
namespace {

/// Query objects of one timed replay.
class Queries
{
public:
    Queries(const Gl& gl, std::size_t count) : gl_(gl), ids_(count)
    {
        gl_.CreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(count), ids_.data());
    }
    ~Queries() { gl_.DeleteQueries(static_cast<GLsizei>(ids_.size()), ids_.data()); }
    Queries(const Queries&) = delete;
    Queries& operator=(const Queries&) = delete;

    const std::vector<GLuint>& ids() const { return ids_; }

    GLuint64 nanoseconds(std::size_t at) const
    {
        GLuint64 value = 0;
        gl_.GetQueryObjectui64v(ids_[at], GL_QUERY_RESULT, &value);
        return value;
    }

private:
    const Gl& gl_;
    std::vector<GLuint> ids_;
};

} // namespace

GlRecording::GlRecording(std::shared_ptr<Context> context, RecordingDesc desc,
                         std::vector<std::shared_ptr<Program>> programs,
                         std::uint32_t max_groups_per_dimension)
    : context_(std::move(context)),
      buffers_(std::move(desc.buffers)),
      programs_(std::move(programs)),
      max_groups_per_dimension_(max_groups_per_dimension),
      params_(context_, desc.dispatches)
{
    dispatches_ = std::move(desc.dispatches);
    barrier_before_ = std::move(desc.barrier_before);
    commands_ = make_commands(inputs(), {});
    context_->check("compiling a recording");
}

CommandInputs GlRecording::inputs() const
{
    return {buffers_, dispatches_, barrier_before_, programs_, params_, max_groups_per_dimension_};
}

void GlRecording::submit(const std::vector<Command>& commands)
{
    run(context_->gl(), commands);
    context_->submit();
    DeviceCounters& counters = context_->count();
    ++counters.submissions;
    counters.dispatches += dispatches_.size();
    counters.barriers += barrier_count();
}

void GlRecording::replay()
{
    const Context::Use use(*context_);
    submit(commands_);
}

std::vector<DispatchTime> GlRecording::replay_timed()
{
    const Context::Use use(*context_);
    GLint bits = 0;
    context_->gl().GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0)
        throw Error(ErrorCode::unsupported, context_->renderer() + " measures no device times");
    const Queries queries(context_->gl(), 2 * dispatches_.size());
    submit(make_commands(inputs(), queries.ids()));
    context_->wait();
    std::vector<DispatchTime> times(dispatches_.size());
    for (std::size_t i = 0; i < times.size(); ++i)
        times[i] = {i, static_cast<double>(queries.nanoseconds(2 * i + 1) - queries.nanoseconds(2 * i))};
    return times;
}

} // namespace taut::opengl
