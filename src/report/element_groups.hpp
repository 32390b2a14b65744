#pragma once
// Internal to src/report: the elements of a body in groups of neighbours, most of which a look passes over by
// their bounds alone.

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// Vertices, scene-wide, of a triangle, or of a link, which has the second twice.
using ElementCorners = std::array<std::uint32_t, 3>;

struct ElementGroup
{
    std::size_t first_element = 0, elements = 0;
    std::size_t first_vertex = 0, vertices = 0; ///< in the list of the groups
};

/// All vertices of a scene at a look.
struct SceneMotion
{
    std::span<const glm::dvec3> x, v; ///< m, m/s
    std::span<const glm::dvec3> last; ///< m, at the look before; empty: there was none
};

/// Where the vertices of a group are, and how fast.
struct GroupMotion
{
    glm::dvec3 low{0}, high{0}; ///< m
    double speed = 0;           ///< m/s, of the fastest
    double way = 0;             ///< m, the furthest that one moved since the look before
    bool finite = true;         ///< all places are

    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double radius() const; ///< m, of a ball round the centre that holds all
};

/// The elements of one body, sorted so that each group is a run of them. Vertices of no element make up a
/// last group without elements. Pure; throws nothing but std::bad_alloc.
class ElementGroups
{
public:
    ElementGroups() = default;

    /// `rest`: places of the body's vertices, m, of which the first is number `first` in the scene.
    ElementGroups(const std::vector<ElementCorners>& elements, std::span<const glm::dvec3> rest,
                  std::uint32_t first);

    std::span<const ElementGroup> groups() const { return groups_; }
    std::span<const ElementCorners> elements(const ElementGroup& group) const
    {
        return std::span(elements_).subspan(group.first_element, group.elements);
    }
    /// Vertices of its elements, each once, ascending.
    std::span<const std::uint32_t> vertices(const ElementGroup& group) const
    {
        return std::span(vertices_).subspan(group.first_vertex, group.vertices);
    }
    bool empty() const { return elements_.empty(); } ///< of elements

    GroupMotion motion(const ElementGroup& group, const SceneMotion& now) const;

private:
    void collect_vertices(std::size_t count, std::uint32_t first);

    std::vector<ElementCorners> elements_;
    std::vector<std::uint32_t> vertices_; ///< of one group after the other
    std::vector<ElementGroup> groups_;
};

} // namespace taut
