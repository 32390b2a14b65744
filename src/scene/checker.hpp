#pragma once
// Collects what is wrong with a scene: one place for the wording of ranges.

#include "taut/runtime/base/shown.hpp"
#include "taut/scene/descriptor.hpp"
#include "taut/scene/scene.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

/// Most vertices of a generated body; a typing error should not fill the machine's memory.
inline constexpr double kMaxVertices = 1 << 26;

using taut::shown;
std::string shown(const glm::dvec3& value);

/// How much is looked at.
enum class Scope
{
    scene,  ///< everything
    meshes, ///< bodies have theirs already: not where they came from, but the meshes
    keys    ///< each key by itself: others could not be read
};

/// Appends issues whose fields start with a path. Paths become text where there is an issue, and only there:
/// a million vertices have a checker each.
class Checker
{
public:
    explicit Checker(std::vector<SceneIssue>& issues, Scope scope = Scope::scene)
        : issues_(issues),
          scope_(scope)
    {}

    /// A checker for a member ("material") or an element ("pins", 3). The name must outlive it, as those of
    /// keys and literals do. Nine levels at most.
    Checker at(std::string_view member) const { return at(member, kNoIndex); }
    Checker at(std::string_view member, std::size_t index) const;

    void error(std::string_view member, const std::string& text, ErrorCode code = ErrorCode::bad_input) const;
    void warning(std::string_view member, const std::string& text) const;

    /// Finite, and at most kMaxValue in magnitude.
    bool finite(std::string_view member, double value, std::string_view unit,
                ErrorCode code = ErrorCode::bad_input) const;
    bool finite(std::string_view member, const glm::dvec3& value, std::string_view unit) const;
    void word(std::string_view member, const std::string& value,
              std::span<const std::string_view> known) const;

    Scope scope() const { return scope_; }

private:
    static constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);
    struct Step
    {
        std::string_view member;
        std::size_t index = kNoIndex;
    };

    std::string join(std::string_view member) const;

    std::vector<SceneIssue>& issues_;
    std::array<Step, 9> path_;
    std::size_t depth_ = 0;
    Scope scope_;
};

/// Indices of pins, springs, masses and start positions against the number of vertices.
void check_counts(const Body& body, std::size_t vertex_count, const Checker& out);

/// Elements of a mesh against its vertices. `kind` says where it came from.
void check_mesh(const Mesh& mesh, ShapeKind kind, const Checker& out);

// What tables ask for beside the ranges of their keys.
void check_scene(const Scene& scene, const Checker& out);
/// Names of groups that bodies pass through.
void check_groups(const Scene& scene, const Checker& out);
void warn_of_idle_kinematic(const Scene& scene, const Checker& out);
/// Of a scene whose `contact` lets nothing meet.
void warn_of_idle_contact(const Scene& scene, const Checker& out);
void check_method(const MethodSettings& method, const Checker& out);
void check_body(const Body& body, const Checker& out);
void check_grid(const Shape& shape, const Checker& out);
void check_box(const Shape& shape, const Checker& out);
void check_ball(const Shape& shape, const Checker& out);
void check_cloth(const Material& material, const Checker& out);
void check_fabric(const Fabric& fabric, const Checker& out);
void check_fabric_bending(const FabricBending& bending, const Checker& out);
void check_kes(const KesReadings& kes, const Checker& out);
void check_fast(const FastReadings& fast, const Checker& out);
void check_peirce(const PeirceReadings& peirce, const Checker& out);
void check_fabric_beside(const Material& material, const Checker& out);
void check_fabric_body(const Body& body, const Checker& out);
void check_solid(const Material& material, const Checker& out);
void check_kinematic(const Kinematic& kinematic, const Checker& out);
/// Keys of a body that mean nothing beside `kinematic`.
void check_kinematic_body(const Body& body, const Checker& out);
void check_pin(const Pin& pin, const Checker& out);
void check_pin_box(const Pin& pin, const Checker& out);
void check_spring(const Body::Spring& spring, const Checker& out);
void check_collider(const Collider& collider, const Checker& out);

/// An axis that something is turned about: it must have a direction.
void check_axis(const glm::dvec3& axis, double degrees, const Checker& out);
template <class Turned>
void check_turn(const Turned& turned, const Checker& out)
{
    check_axis(turned.rotate_axis, turned.rotate_degrees, out);
}

} // namespace taut::scene_file
