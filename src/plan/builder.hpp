#pragma once
// Internal to src/plan: what effects use to add their buffers and passes while a plan is made.

#include "taut/plan/methods.hpp"
#include "taut/plan/plan.hpp"
#include "taut/runtime/base/bindings.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/paper_device.hpp"

#include <glm/vec4.hpp>

#include <array>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
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
    bool read_only = false; ///< though the kernel may write it: for the accounts
    bool is_set() const { return buffer != kNoBuffer; }
};

/// Buffers of the Jacobi schemes of PBD, kNoBuffer where a scene has no use for them (pbd.hpp).
struct PbdBuffers
{
    std::uint32_t springs = kNoBuffer, hinges = kNoBuffer, volumes = kNoBuffer;
    std::uint32_t spring_slots = kNoBuffer, hinge_slots = kNoBuffer, volume_slots = kNoBuffer;
    std::uint32_t at = kNoBuffer; ///< lists of the constraints at each vertex, one after another
    std::uint32_t hinges_at = 0, volumes_at = 0; ///< where theirs begin; that of springs is the first
    std::uint32_t other = kNoBuffer; ///< the iterate that is not in the plan's `delta`
    std::uint32_t spring_count = 0, hinge_count = 0, volume_count = 0;
};
/// Closed surfaces whose volume is held (surface_volume.hpp); kNoBuffer and 0 where a scene has none.
struct SurfaceBuffers
{
    std::uint32_t table = kNoBuffer, corners = kNoBuffer, values = kNoBuffer, gradient = kNoBuffer,
                  partials = kNoBuffer, multiplier = kNoBuffer;
    std::uint32_t groups = 0, surfaces = 0, vertices = 0;
};
/// Of one shape of colliders, what its triangles need; 0 and kNoBuffer where none meets it (faces.hpp).
struct FaceBuffers
{
    std::uint32_t corners = kNoBuffer; ///< four a triangle: its vertices, and where its bits begin
    std::uint32_t which = kNoBuffer;   ///< the colliders that triangles meet, and bits by body
    std::uint32_t slots = kNoBuffer;   ///< what corners would go, and friction of each collider
    std::uint32_t state = kNoBuffer;   ///< of each triangle whether its slots are of this pass
    std::uint32_t near = kNoBuffer;    ///< of each vertex whether any of its triangles may come near
    std::uint32_t start = kNoBuffer, incident = kNoBuffer; ///< slots at each vertex
    std::uint32_t triangles = 0, listed = 0;
};
struct ForceBuffers;
struct BlockBuffers;
struct MomentumBuffers; // momentum.cpp

struct Acad;
struct ContactBuffers; // contact.hpp
struct PlateBuffers;
struct Plasticity;
struct ImplicitConstraints;
struct ImplicitEuler; // implicit_euler.cpp

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

    /// Adds a pass of the kernel that `bindings` belongs to. Members that the variant does not have stay
    /// unset. `elements`: those that the account of bytes counts, where they are not `count`.
    template <template <typename> typename Bindings>
    void dispatch(std::string_view effect, std::string_view variant, const Bindings<Use>& bindings,
                  const typename Bindings<Use>::Params& params, std::uint32_t count,
                  std::uint64_t elements = 0)
    {
        const KernelInfo& kernel = Bindings<Use>::info(variant, plan.precision);
        add_dispatch(effect, kernel, in_slot_order(kernel, bindings), std::as_bytes(std::span(&params, 1)),
                     count, elements == 0 ? count : elements);
    }

    /// The same of another kernel with these bindings and parameters: a method's for another element.
    template <template <typename> typename Bindings>
    void dispatch_by_name(std::string_view effect, std::string_view name, std::string_view variant,
                          const Bindings<Use>& bindings, const typename Bindings<Use>::Params& params,
                          std::uint32_t count, std::uint64_t elements = 0)
    {
        const KernelInfo& kernel = find_kernel(name, variant, plan.precision);
        add_dispatch(effect, kernel, in_slot_order(kernel, bindings), std::as_bytes(std::span(&params, 1)),
                     count, elements == 0 ? count : elements);
    }

    /// The same of a kernel that has no header here, one of an element that the program has added: every
    /// binding by its name, parameters in their order.
    void dispatch_by_name(std::string_view effect, std::string_view name,
                          std::initializer_list<std::pair<std::string_view, Use>> bindings,
                          std::initializer_list<std::uint32_t> params, std::uint32_t count,
                          std::uint64_t elements = 0);

    /// The same with 12 bytes of a buffer as group counts, read when the dispatch starts; `count` is the
    /// most.
    template <template <typename> typename Bindings>
    void dispatch_indirect(std::string_view effect, std::string_view variant, const Bindings<Use>& bindings,
                           const typename Bindings<Use>::Params& params, std::uint32_t count,
                           std::uint32_t group_counts, std::uint64_t offset = 0)
    {
        const KernelInfo& kernel = Bindings<Use>::info(variant, plan.precision);
        add_dispatch(effect, kernel, in_slot_order(kernel, bindings), std::as_bytes(std::span(&params, 1)),
                     count, count, {group_counts, offset, 12});
    }

    /// Where src/linear makes its matrices and solvers, as on a device. Its buffers become the plan's.
    const std::shared_ptr<PaperDevice>& paper() const { return paper_; }
    /// The plan's number of a buffer made on paper; on first sight it is added, on account of `effect`.
    std::uint32_t adopt(std::string_view effect, const BufferPtr& buffer);
    /// The buffer on paper that stands for one of the plan, for passes that src/linear records.
    BufferPtr on_paper(std::uint32_t buffer);
    /// Appends the passes that `fill` puts into a recorder of paper(), on account of `effect`. `idle`: they
    /// nearly always return at once, so that their bytes are not counted.
    void record(std::string_view effect, const std::function<void(Recorder&)>& fill, bool idle = false);
    /// Copies what was written on paper into the plan; once, after everything was recorded.
    void finish_paper();

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
    bool coasts_first = false; ///< forces act before the guess, so Plan::coasting is taken before them
    const Method& method;
    PbdBuffers pbd;
    SurfaceBuffers surfaces;
    SurfaceBuffers gas; ///< the same of surfaces that enclose one (pressure.hpp)
    std::shared_ptr<ImplicitConstraints> implicit_constraints; ///< null: nothing is constrained
    std::shared_ptr<ImplicitEuler> implicit_euler; ///< under that method
    std::shared_ptr<Acad> acad;                                ///< likewise
    std::array<bool, kColliderKinds> friction = {}; ///< by ColliderKind
    ColliderBuffers friction_taken = kNoColliders;
    ColliderBuffers collider_values = kNoColliders; ///< of shapes that have a buffer of numbers
    std::array<FaceBuffers, kColliderKinds> faces = {}; ///< by ColliderKind
    std::shared_ptr<ForceBuffers> forces; ///< mass_spring.hpp
    std::shared_ptr<BlockBuffers> blocks; ///< vbd.hpp
    std::shared_ptr<Plasticity> plasticity; ///< plasticity.hpp
    std::shared_ptr<PlateBuffers> plate;    ///< plate.hpp
    std::shared_ptr<MomentumBuffers> momentum; ///< momentum.hpp
    std::shared_ptr<ContactBuffers> contact; ///< contact.hpp

    // Of effects that have more than one pass of an account: wind, limits, tearing.
    std::uint32_t wind_triangles = kNoBuffer, wind_start = kNoBuffer, wind_incident = kNoBuffer,
                  wind_impulse = kNoBuffer, attachments = kNoBuffer, tearing = kNoBuffer;
    std::uint32_t wind_triangle_count = 0, attachment_count = 0, tearing_count = 0;
    ConstraintSet limits; ///< springs of strain limits, rest_length the greatest

    /// Before a dispatch that stands for so many: the limit of passes is one of the scene, and holds alike
    /// whether a device groups colours or not.
    void stands_for(std::uint32_t passes) { apart_ += std::int64_t(passes) - 1; }

private:
    void add_dispatch(std::string_view effect, const KernelInfo& kernel, std::span<const Use> uses,
                      std::span<const std::byte> params, std::uint32_t count, std::uint64_t elements,
                      BufferRange indirect = {kNoBuffer, 0, 0});
    void check_pass_count() const;
    void add_pass(std::string_view effect, Dispatch pass, std::uint64_t bytes);
    EffectCost& cost_of(std::string_view effect);

    std::int64_t apart_ = 0; ///< passes beyond those of the plan, if no colours were grouped
    std::shared_ptr<PaperDevice> paper_;
    std::map<const Buffer*, std::uint32_t> adopted_; ///< plan number of a buffer on paper
    std::map<std::uint32_t, BufferPtr> papers_;      ///< the other way
};

/// When in a step an effect acts. The order of the words is the order of a substep.
enum class Stage
{
    force, ///< changes velocities before the inertial guess
    predict,
    hold,    ///< puts held vertices where they belong
    start,   ///< once per substep, before the first iteration
    solve,   ///< once per iteration: constraints
    contact, ///< after all constraints, of every iteration or of the last (Method::contact_each_iteration)
    finish,
    after, ///< with the new state of the substep
};

/// One row of the table of effects.
struct Effect
{
    std::string_view name;
    Stage stage;
    bool (*wanted)(const Scene&);
    void (*prepare)(PlanBuilder&);               ///< buffers, topology; may be null
    void (*record)(PlanBuilder&, const Moment&); ///< passes of one moment; may be null
    MethodSet methods = kAllMethods;             ///< under which it acts like this
};

/// The table, in the order of a step. An effect that a scene does not call for adds nothing.
std::span<const Effect> effect_table();

} // namespace taut
