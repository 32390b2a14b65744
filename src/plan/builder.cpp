#include "taut/plan/builder.hpp"

#include "taut/plan/material.hpp"
#include "taut/plan/topology.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/scene/held.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <limits>

namespace taut {
namespace {

/// Of the sides of its elements that a vertex may come out of a collider in a substep: a neighbour that stays
/// shows how far springs are stretched by it.
constexpr double kWayOut = 0.25;

/// A recording keeps every pass of a time step; beyond this it would fill the memory before it ran.
constexpr std::int64_t kMaxPasses = std::int64_t(1) << 20;

/// Grids keep their rows, which parity colours want; other meshes follow a space-filling curve.
std::vector<std::uint32_t> body_order(const Body& body)
{
    const std::size_t count = body.mesh.positions.size();
    if (body.mesh.grid_columns == 0 && !body.mesh.triangles.empty())
        return locality_order(body.mesh.positions);
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t v = 0; v < count; ++v)
        order[v] = v;
    return order;
}

/// What src/linear asks a device for.
DeviceInfo info_of(const DeviceTraits& traits)
{
    DeviceInfo info;
    info.selector = info.executor = info.name = traits.executor;
    info.hardware_gpu = traits.hardware_gpu;
    info.limits = traits.limits;
    info.limits.max_buffer_bytes = traits.max_buffer_bytes;
    info.limits.float64 = traits.float64;
    return info;
}

/// Mean length of the sides of a body's elements, m; infinite without any.
double mean_side(const Mesh& mesh)
{
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](const auto& element) {
        for (std::size_t k = 0; k < element.size(); ++k)
        {
            sum += glm::distance(mesh.positions[element[k]],
                                 mesh.positions[element[(k + 1) % element.size()]]);
            ++count;
        }
    };
    std::for_each(mesh.triangles.begin(), mesh.triangles.end(), add);
    std::for_each(mesh.links.begin(), mesh.links.end(), add);
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::infinity();
}

} // namespace

PlanBuilder::PlanBuilder(const Scene& s, const DeviceTraits& t, const PlanOptions& o)
    : scene(s),
      traits(t),
      options(o),
      method(find_method(s.method.type)),
      paper_(std::make_shared<PaperDevice>(info_of(t)))
{
    plan.precision = s.method.precision;
    plan.timestep = s.timestep;
    const Substeps taken = method.substeps != nullptr ? method.substeps(s) : Substeps{s.method.substeps};
    plan.substeps = taken.count;
    plan.largest_substep = taken.largest;
    plan.iterations = s.method.iterations;
    plan.way_out = std::numeric_limits<double>::infinity();
    for (const Body& body : s.bodies)
        plan.way_out = std::min(plan.way_out, kWayOut * mean_side(body.mesh));
    plan.body_start.push_back(0);
    for (const Body& body : s.bodies)
        plan.body_start.push_back(plan.body_start.back() +
                                  static_cast<std::uint32_t>(body.mesh.positions.size()));
    plan.vertex_count = plan.body_start.back();
    plan.original.reserve(plan.vertex_count);
    plan_index.resize(plan.vertex_count);
    for (std::size_t b = 0; b < s.bodies.size(); ++b)
    {
        const Body& body = s.bodies[b];
        const std::vector<double> masses = vertex_masses(body);
        const std::vector<bool> held = held_vertices(body);
        const auto& from = start_of(body);
        for (const std::uint32_t v : body_order(body))
        {
            plan_index[plan.body_start[b] + v] = static_cast<std::uint32_t>(plan.original.size());
            plan.original.push_back(plan.body_start[b] + v);
            inverse_mass.push_back(held[v] ? 0.0 : 1.0 / masses[v]);
            start.push_back(from[v]);
            gap.push_back(body.material.thickness);
        }
    }
}

std::uint32_t PlanBuilder::add_buffer(std::string_view effect, std::string_view name, std::uint64_t bytes)
{
    if (bytes > traits.max_buffer_bytes)
        throw Error(ErrorCode::limit,
                    "effect " + std::string(effect) + ": buffer " + std::string(name) + " needs " +
                        std::to_string(bytes) + " bytes, the device binds at most " +
                        std::to_string(traits.max_buffer_bytes) + "; use a smaller mesh or another device");
    plan.buffers.push_back({std::string(name), std::string(effect), bytes, {}});
    cost_of(effect).bytes_allocated += bytes;
    return static_cast<std::uint32_t>(plan.buffers.size() - 1);
}

EffectCost& PlanBuilder::cost_of(std::string_view effect)
{
    for (EffectCost& cost : plan.effects)
        if (cost.name == effect)
            return cost;
    plan.effects.push_back({std::string(effect), {}, 0, 0, 0});
    return plan.effects.back();
}

void PlanBuilder::check_pass_count() const
{
    if (static_cast<std::int64_t>(plan.passes.size()) + apart_ < kMaxPasses)
        return;
    const bool iterates = plan.iterations > 1;
    throw Error(ErrorCode::limit,
                "method.substeps is " + std::to_string(plan.substeps) +
                    (iterates ? " and method.iterations is " + std::to_string(plan.iterations) : "") +
                    ": a time step of more than " + std::to_string(kMaxPasses) +
                    " passes, one a colour of constraints, however a device groups them; use fewer substeps" +
                    (iterates ? " or iterations" : "") +
                    (plan.solvers.empty() ? ""
                                          : ", or fewer linear_iterations than " +
                                                std::to_string(scene.method.linear_iterations)));
}

void PlanBuilder::add_dispatch(std::string_view effect, const KernelInfo& kernel, std::span<const Use> uses,
                               std::span<const std::byte> params, std::uint32_t count, std::uint64_t elements,
                               BufferRange indirect)
{
    if (count == 0)
        return;
    check_pass_count();
    Dispatch pass;
    pass.kernel = &kernel;
    pass.params.assign(params.begin(), params.end());
    pass.count = count;
    pass.indirect = indirect;
    pass.label = std::string(effect);
    std::uint64_t bytes = 0;
    for (std::size_t slot = 0; slot < uses.size(); ++slot)
    {
        const PlanBuffer& buffer = plan.buffers[uses[slot].buffer];
        pass.bindings.push_back({uses[slot].buffer, 0, buffer.bytes});
        const BindingInfo& binding = kernel.bindings[slot];
        const std::uint64_t touched =
            std::min<std::uint64_t>(buffer.bytes, elements * uses[slot].touched * binding.stride);
        if (binding.access != Access::count)
            bytes += touched * (binding.access == Access::update && !uses[slot].read_only ? 2 : 1);
    }
    add_pass(effect, std::move(pass), bytes);
}

void PlanBuilder::dispatch_by_name(std::string_view effect, std::string_view name,
                                   std::initializer_list<std::pair<std::string_view, Use>> bindings,
                                   std::initializer_list<std::uint32_t> params, std::uint32_t count,
                                   std::uint64_t elements)
{
    const KernelInfo& kernel = find_kernel(name, {}, plan.precision);
    std::vector<NamedBinding> named;
    for (const auto& [word, use] : bindings)
        named.push_back({word, use.is_set()});
    std::vector<Use> uses;
    for (const std::size_t place : places_in_slot_order(kernel, named))
        uses.push_back((bindings.begin() + place)->second);
    assert(params.size() == kernel.params.size());
    add_dispatch(effect, kernel, uses, std::as_bytes(std::span(params)), count,
                 elements == 0 ? count : elements);
}

void PlanBuilder::add_pass(std::string_view effect, Dispatch pass, std::uint64_t bytes)
{
    EffectCost& cost = cost_of(effect);
    const std::string name = full_name(*pass.kernel);
    auto kernel = std::find_if(cost.kernels.begin(), cost.kernels.end(),
                               [&](const KernelCost& known) { return known.name == name; });
    if (kernel == cost.kernels.end())
        kernel = cost.kernels.insert(kernel, KernelCost{name});
    ++kernel->dispatches_per_step;
    kernel->bytes_per_step += bytes;
    ++cost.dispatches_per_step;
    cost.bytes_per_step += bytes;
    plan.passes.push_back(std::move(pass));
}

std::uint32_t PlanBuilder::adopt(std::string_view effect, const BufferPtr& buffer)
{
    const auto found = adopted_.find(buffer.get());
    if (found != adopted_.end())
        return found->second;
    const std::uint32_t id = add_buffer(effect, PaperDevice::label(buffer), buffer->bytes());
    adopted_.emplace(buffer.get(), id);
    papers_.emplace(id, buffer);
    return id;
}

BufferPtr PlanBuilder::on_paper(std::uint32_t buffer)
{
    const auto found = papers_.find(buffer);
    if (found != papers_.end())
        return found->second;
    const PlanBuffer& own = plan.buffers.at(buffer);
    const BufferPtr paper = paper_->make_buffer(own.bytes, own.name, BufferUse::device);
    adopted_.emplace(paper.get(), buffer);
    papers_.emplace(buffer, paper);
    return paper;
}

void PlanBuilder::record(std::string_view effect, const std::function<void(Recorder&)>& fill, bool idle)
{
    Recorder recorder(paper_);
    fill(recorder);
    RecordingDesc desc = PaperDevice::take(recorder);
    for (Dispatch& pass : desc.dispatches)
    {
        check_pass_count();
        std::uint64_t bytes = 0;
        for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
        {
            BufferRange& range = pass.bindings[slot];
            range.buffer = adopt(effect, desc.buffers[range.buffer]);
            const Access access = pass.kernel->bindings[slot].access;
            if (access != Access::count && !idle)
                bytes += range.bytes * (access == Access::update ? 2 : 1);
        }
        if (pass.indirect.buffer != kNoBuffer)
            pass.indirect.buffer = adopt(effect, desc.buffers[pass.indirect.buffer]);
        pass.label = std::string(effect);
        add_pass(effect, std::move(pass), bytes);
    }
}

void PlanBuilder::finish_paper()
{
    for (const auto& [id, buffer] : papers_)
        if (plan.buffers[id].initial.empty())
            plan.buffers[id].initial = PaperDevice::contents(buffer);
}

} // namespace taut
