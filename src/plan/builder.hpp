#pragma once
// Internal to src/plan: what effects use to add their buffers and passes while a plan is made.

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/registry.hpp"

#include <glm/vec4.hpp>

#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace taut {

/// Calls f(float{}) or f(double{}).
template <typename F>
auto with_real(Precision precision, F&& f)
{
    return precision == Precision::float64 ? f(double{}) : f(float{});
}

template <typename T>
std::vector<std::byte> to_bytes(std::span<const T> values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

/// Where in a time step work is recorded.
struct Moment
{
    std::uint32_t substep = 0;
    std::uint32_t iteration = 0;
    bool last = false; ///< last iteration of the last substep: count what reports ask for
};

/// One binding of a pass, with the elements that one invocation touches in it (for byte accounts).
struct Use
{
    std::uint32_t buffer = kNoBuffer;
    std::uint32_t touched = 1;
};

class PlanBuilder
{
public:
    PlanBuilder(const Scene& scene, const DeviceTraits& traits, const PlanOptions& options);

    /// Bytes of zero. Throws Error{limit} beyond the device's range, naming effect, buffer and sizes.
    std::uint32_t add_buffer(std::string_view effect, std::string_view name, std::uint64_t bytes);
    template <typename T>
    std::uint32_t add_buffer(std::string_view effect, std::string_view name, std::span<const T> values)
    {
        const std::uint32_t id = add_buffer(effect, name, values.size_bytes());
        plan.buffers[id].initial = to_bytes(values);
        return id;
    }

    template <typename Params>
    void dispatch(std::string_view effect, std::string_view kernel, std::string_view variant,
                  std::span<const Use> uses, const Params& params, std::uint32_t count,
                  std::uint64_t elements = 0)
    {
        add_dispatch(effect, find_kernel(kernel, variant, plan.precision), uses,
                     std::as_bytes(std::span(&params, 1)), count, elements == 0 ? count : elements);
    }

    std::uint64_t real_size() const { return real_bytes(plan.precision); }
    /// Plan vertex of a body's own vertex.
    std::uint32_t vertex(std::size_t body, std::uint32_t v) const
    {
        return plan_index[plan.body_start[body] + v];
    }

    const Scene& scene;
    const DeviceTraits& traits;
    const PlanOptions& options;
    Plan plan;
    std::vector<std::uint32_t> plan_index; ///< scene-wide vertex -> plan vertex
    std::vector<double> inverse_mass;      ///< plan order, 1/kg, 0 = held
    std::vector<glm::dvec3> start;         ///< plan order, m
    std::vector<double> gap;               ///< plan order, kept from colliders, m
    std::uint32_t pin_vertices = kNoBuffer;
    std::array<bool, 2> friction = {};     ///< by ColliderKind
    std::array<std::uint32_t, 2> friction_taken = {kNoBuffer, kNoBuffer};

private:
    void add_dispatch(std::string_view effect, const KernelInfo& kernel, std::span<const Use> uses,
                      std::span<const std::byte> params, std::uint32_t count, std::uint64_t elements);
    EffectCost& cost_of(std::string_view effect);
};

/// When in a step an effect acts. The order of the words is the order of a substep.
enum class Stage
{
    force,   ///< changes velocities before the inertial guess
    predict,
    hold,    ///< puts held vertices where they belong
    solve,   ///< once per iteration: constraints
    contact, ///< once per iteration, after all constraints
    finish,
};

/// One row of the table of effects.
struct Effect
{
    std::string_view name;
    Stage stage;
    bool (*wanted)(const Scene&);
    void (*prepare)(PlanBuilder&);                ///< buffers, topology; may be null
    void (*record)(PlanBuilder&, const Moment&);  ///< passes of one moment; may be null
};

/// The table, in the order of a step. An effect that a scene does not call for adds nothing.
std::span<const Effect> effect_table();

} // namespace taut
