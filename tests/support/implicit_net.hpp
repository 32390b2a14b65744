#pragma once
// Nets of springs and hinges for the tests of kernels/implicit: random ones with planted degenerate elements,
// their tables (kernels/shared/implicit_table.glsl), and the system of a Newton step by definition in fp64.

#include "support/linear_groups.hpp"

#include <glm/mat3x3.hpp>

#include <map>
#include <set>

namespace taut::conformance {

inline constexpr std::uint32_t kFirst = 0x80000000u, kNowhere = 0xffffffffu;

/// A value with the size of the terms that made it.
struct Sized
{
    glm::dvec3 value{0};
    double size = 0;
    void add(const glm::dvec3& more, double terms)
    {
        value += more;
        size += terms;
    }
};

struct SizedBlock
{
    glm::dmat3 value{0.0};
    double size = 0;
    void add(const glm::dmat3& more, double terms)
    {
        value += more;
        size += terms;
    }
};

using Place = std::pair<std::uint32_t, std::uint32_t>; ///< block row, block column

template <typename Real>
struct Net
{
    std::uint32_t count = 0;
    std::vector<glm::vec<4, Real>> position, low, delta, predicted;
    std::vector<layout::Spring<Real>> springs;
    std::vector<layout::BendingConstraint<Real>> hinges;
    layout::StepValues<Real> step{};
    float scale = 4, lift = 64;
    std::vector<std::uint32_t> held; ///< three words a vertex
    std::vector<std::uint32_t> spring_table, hinge_table;
    std::map<Place, std::uint32_t> blocks; ///< first value of each
    bool diagonal_only = false;            ///< blocks beside the diagonal are not stored

    bool solved(std::uint32_t v) const { return held[3 * v] == 0; }
    double mass(std::uint32_t v) const { return position[v].w > 0 ? 1 / double(position[v].w) : 0; }
    double h() const { return double(step.substep); }
    std::size_t values() const { return (blocks.size() / 32 + 2) * 288; }

    static glm::dvec3 wide(const glm::vec<4, Real>& v) { return glm::dvec3(glm::dvec4(v)); }
    glm::dvec3 between(std::uint32_t from, std::uint32_t to) const
    {
        return (wide(position[to]) - wide(position[from])) + (wide(delta[to]) - wide(delta[from]));
    }
    /// By how much the rounding of its terms is larger than that of the difference itself.
    double reach(std::uint32_t from, std::uint32_t to) const
    {
        const double whole = glm::length(wide(position[to]) - wide(position[from])) +
                             glm::length(wide(delta[to]) - wide(delta[from]));
        const double left = glm::length(between(from, to));
        return left > 0 ? whole / left : 1;
    }

    Buffers buffers() const
    {
        return {{"position", bytes_of(position)}, {"low", bytes_of(low)},
                {"delta", bytes_of(delta)},       {"predicted", bytes_of(predicted)},
                {"spring", bytes_of(springs)},    {"constraint", bytes_of(hinges)},
                {"held", bytes_of(held)},         {"step_values", bytes_of(std::vector{step})},
                {"events", no_events()},          {"table", bytes_of(spring_table)}};
    }
};

/// The table of elements with `arity` corners; places go to `blocks`, those met for the first time marked.
/// `own`: entries have a place for the vertex's own block, too.
template <typename Real>
std::vector<std::uint32_t> make_table(Net<Real>& net, const std::vector<std::uint32_t>& corners,
                                      std::uint32_t arity, std::set<Place>& met, bool own);

template <typename Real>
void make_tables(Net<Real>& net);

/// Vertices in [-1, 1]^3, some held; springs and hinges between random ones. The first springs and hinges are
/// degenerate where there are vertices enough.
template <typename Real>
Net<Real> random_net(std::uint32_t count, std::uint64_t seed);

// ---------------------------------------------------------------- what an element is

/// Methods 5.1: f on end a, and h^2 K + h D, by the textbook.
struct SpringTerms
{
    Sized force;
    SizedBlock block;
    bool degenerate = false;
};

template <typename Real>
SpringTerms spring_terms(const Net<Real>& net, const layout::Spring<Real>& s, bool damped = true);

/// The angle by its definition, with all twelve derivatives; corners edge0, edge1, wing0, wing1.
struct HingeTerms
{
    std::array<glm::dvec3, 4> gradient{};
    double angle = 0;
    double shape = 1; ///< how much rounding grows: reach over the smaller height
    double steep = 0; ///< size of the terms that make a gradient
    bool shaped = true;
};

HingeTerms hinge_terms(const std::array<glm::dvec3, 4>& x);

template <typename Real>
HingeTerms hinge_terms(const Net<Real>& net, const layout::BendingConstraint<Real>& c);

template <typename Real>
std::array<std::uint32_t, 4> corners_of(const layout::BendingConstraint<Real>& c)
{
    return {c.edge0, c.edge1, c.wing0, c.wing1};
}

// ---------------------------------------------------------------- the system

/// Blocks of the springs, dampers and masses of what is solved for, without scale.
template <typename Real>
std::map<Place, SizedBlock> spring_system(const Net<Real>& net, std::uint32_t& degenerate);

template <typename Real>
std::map<Place, SizedBlock> hinge_system(const Net<Real>& net, std::uint32_t& degenerate);

/// y = A x of blocks, with sizes; x three a vertex.
template <typename Real>
std::vector<Sized> product_of(const Net<Real>& net, const std::map<Place, SizedBlock>& blocks,
                              const std::vector<Real>& x);

} // namespace taut::conformance
