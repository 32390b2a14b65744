#pragma once
// The options of a scene that are one of several: an enum each, and the words by which files, messages and
// reports call its values. Part of scene.hpp.

#include "taut/runtime/base/kernel_info.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace taut {

/// The words of an option, in the order of its enumerators, which count from 0. An enum with words is an
/// Option.
template <class E>
inline constexpr std::nullptr_t kWords = nullptr;

template <class E>
concept Option = std::is_enum_v<E> && requires
{
    kWords<E>.size();
};

template <Option E>
constexpr std::span<const std::string_view> words_of()
{
    return kWords<E>;
}

/// The word of a value; empty for a number that is no enumerator's.
template <Option E>
constexpr std::string_view to_string(E value)
{
    const auto i = static_cast<std::size_t>(value);
    return i < kWords<E>.size() ? kWords<E>[i] : std::string_view();
}

/// The word in quotes, as messages have it.
template <Option E>
std::string quoted(E value)
{
    return '"' + std::string(to_string(value)) + '"';
}

/// Nothing for a word that no value has.
template <Option E>
constexpr std::optional<E> option_of(std::string_view word)
{
    for (std::size_t i = 0; i < kWords<E>.size(); ++i)
        if (kWords<E>[i] == word)
            return static_cast<E>(i);
    return std::nullopt;
}

/// Throws Error{bad_input}: the word, and those that there are.
[[noreturn]] void refuse_word(std::string_view word, std::span<const std::string_view> known);

/// option_of(), which throws Error{bad_input} for a word that no value has.
template <Option E>
E option_named(std::string_view word)
{
    if (const std::optional<E> found = option_of<E>(word))
        return *found;
    refuse_word(word, words_of<E>());
}

template <>
inline constexpr std::array<std::string_view, 2> kWords<Precision> = {to_string(Precision::float32),
                                                                      to_string(Precision::float64)};

// ---------------------------------------------------------------- methods: docs/methods.md

enum class MethodKind : std::uint8_t
{
    mass_spring,
    implicit_euler,
    implicit_constraints,
    acad,
    pbd,
    xpbd,
    vbd
};
template <>
inline constexpr std::array<std::string_view, 7> kWords<MethodKind> = {
    "mass_spring", "implicit_euler", "implicit_constraints", "acad", "pbd", "xpbd", "vbd"};

/// mass_spring: how time advances.
enum class Integrator : std::uint8_t
{
    semi_implicit,
    explicit_euler,
    verlet
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<Integrator> = {"semi_implicit", "explicit", "verlet"};

/// mass_spring, acad, implicit_constraints with springs that stay forces: what becomes of a substep that is
/// longer than the stable one.
enum class StabilityRule : std::uint8_t
{
    refuse,  ///< Error{unstable_timestep}
    substep, ///< as many substeps as it takes
    ignore   ///< at one's own risk
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<StabilityRule> = {"refuse", "substep", "ignore"};

/// In which order elements act.
enum class ElementScheme : std::uint8_t
{
    automatic,         ///< mass_spring: node_centric; pbd: coloured
    node_centric,      ///< each vertex gathers; of pbd Jacobi
    spring_centric,    ///< mass_spring: springs write slots, which their vertices sum
    coloured,          ///< pbd: Gauss-Seidel by colours
    constraint_centric ///< pbd: Jacobi, constraints write slots
};
template <>
inline constexpr std::array<std::string_view, 5> kWords<ElementScheme> = {
    "automatic", "node_centric", "spring_centric", "coloured", "constraint_centric"};

/// implicit_euler, implicit_constraints: the matrix is assembled, or its product formed from the elements.
enum class LinearOperator : std::uint8_t
{
    assembled,
    matrix_free
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<LinearOperator> = {"assembled", "matrix_free"};

/// implicit_euler: of conjugate gradients.
enum class NewtonPreconditioner : std::uint8_t
{
    block_jacobi, ///< blocks of single vertices
    two_level     ///< these, and the translations of aggregates of vertices; of assembled matrices
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<NewtonPreconditioner> = {"block_jacobi", "two_level"};

/// implicit_constraints, acad: which springs may be constraints; the others stay springs.
enum class ConstrainedSprings : std::uint8_t
{
    all,
    structural
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<ConstrainedSprings> = {"all", "structural"};

/// acad: what makes a constraint a spring again.
enum class ReleaseRule : std::uint8_t
{
    multiplier, ///< the sign of its multiplier
    strain      ///< a strain below MethodSettings::release_strain
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<ReleaseRule> = {"multiplier", "strain"};

/// acad: the length that a constraint keeps.
enum class ConstraintTarget : std::uint8_t
{
    threshold, ///< L (1 + activate_strain)
    rest       ///< L
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<ConstraintTarget> = {"threshold", "rest"};

/// vbd: where the sweeps of a substep begin (docs/methods/vbd.md, Start).
enum class SweepStart : std::uint8_t
{
    adaptive,
    inertial,
    previous
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<SweepStart> = {"adaptive", "inertial", "previous"};

// ---------------------------------------------------------------- materials and shapes: docs/scene.md

/// Of cloth that bends.
enum class BendingModel : std::uint8_t
{
    hinge, ///< one at each edge by itself
    plate  ///< hinges whose triangles couple them, which converges to a plate on every mesh; xpbd
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<BendingModel> = {"hinge", "plate"};

/// Of the gas within closed cloth.
enum class PressureLaw : std::uint8_t
{
    constant,
    isothermal ///< the pressure falls as V0 / V where the body swells
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<PressureLaw> = {"constant", "isothermal"};

/// Of solids.
enum class SolidModel : std::uint8_t
{
    neo_hookean,        ///< stable neo-Hookean tetrahedra
    neo_hookean_simple, ///< without the logarithm that keeps them from collapsing to a point (plan/solid.hpp)
    springs             ///< along the edges, and constraints of volume beside them
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<SolidModel> = {"neo_hookean", "neo_hookean_simple",
                                                                       "springs"};

/// Of solids of springs: the volumes that they hold.
enum class HeldVolume : std::uint8_t
{
    tetrahedra, ///< of each
    surface     ///< the one within the surface
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<HeldVolume> = {"tetrahedra", "surface"};

/// Of a grid: how its cells are cut into triangles.
enum class Diagonals : std::uint8_t
{
    alternating, ///< neighbours mirrored (union jack)
    uniform      ///< all alike
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<Diagonals> = {"alternating", "uniform"};

/// Of a box: the tetrahedra of a cell.
enum class BoxSplit : std::uint8_t
{
    five, ///< mirrored from cell to cell
    six   ///< round the cell's diagonal (Kuhn)
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<BoxSplit> = {"five", "six"};

/// Of a fabric: where the warp lies.
enum class GrainSource : std::uint8_t
{
    direction, ///< along Fabric::grain
    texture    ///< along the second texture coordinate (v) of the mesh file
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<GrainSource> = {"direction", "texture"};

/// What the bias rigidity of a fabric was measured on.
enum class BiasSpecimen : std::uint8_t
{
    strip, ///< narrow, with free sides, as a cantilever is
    sheet  ///< wide, curved one way only, as between the clamps of KES-FB2
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<BiasSpecimen> = {"strip", "sheet"};

// ---------------------------------------------------------------- what meets: docs/contact.md

/// What of a body a collider pushes.
enum class ColliderMeets : std::uint8_t
{
    automatic, ///< the surface where the collider could come through between vertices (scene/faces.hpp)
    vertices,
    surface ///< vertices, and points of the triangles
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<ColliderMeets> = {"automatic", "vertices", "surface"};

/// What the coefficients of two surfaces that rub make (TAUT_CONTACT_MIX_* of the kernels, in this order).
enum class FrictionMix : std::uint8_t
{
    mean,
    minimum,
    maximum,
    product,
    geometric_mean
};
template <>
inline constexpr std::array<std::string_view, 5> kWords<FrictionMix> = {"mean", "minimum", "maximum",
                                                                        "product", "geometric_mean"};

/// What becomes of surfaces that meet and go through each other at the start.
enum class ContactStart : std::uint8_t
{
    ignore,  ///< they stay so
    refuse,  ///< World throws
    separate ///< World takes them apart first, and what is nearer than its gap; throws where it cannot
};
template <>
inline constexpr std::array<std::string_view, 3> kWords<ContactStart> = {"ignore", "refuse", "separate"};

enum class Guarantee : std::uint8_t
{
    none,
    no_crossing ///< no pair that meets ever crosses
};
template <>
inline constexpr std::array<std::string_view, 2> kWords<Guarantee> = {"none", "no_crossing"};

} // namespace taut
