// Keys of "method", and which method reads them.

#include "taut/scene/checker.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

constexpr MethodSet kMassSpring = only(MethodKind::mass_spring), kEuler = only(MethodKind::implicit_euler),
                    kAcad = only(MethodKind::acad), kPbd = only(MethodKind::pbd),
                    kVbd = only(MethodKind::vbd);
constexpr MethodSet kConstraints = only(MethodKind::implicit_constraints) | kAcad;
constexpr MethodSet kSolvers = kEuler | kConstraints;

/// A scene that names one strain has it for both ways.
void read_release_strain(const Field& method, MethodSettings& out)
{
    out.release_strain = out.activate_strain;
    if (const auto strain = method.find("release_strain"))
        out.release_strain = strain->number();
}

constexpr Key kMethod[] = {
    key<&MethodSettings::type>("type", "the method"),
    key<&MethodSettings::substeps>("substeps", "parts of a time step; the main price of accuracy")
        .range(1, kMostSubsteps)
        .or_word("automatic", 0)
        .usually("\"automatic\": what mesh, material and loads ask for "
                 "([rule](methods.md#substeps-that-nobody-named))"),
    key<&MethodSettings::iterations>(
        "iterations", "in a substep: sweeps (pbd, xpbd, vbd), Newton steps (implicit_euler), linear solves "
                      "(implicit_constraints, acad), solves for the volume within surfaces (mass_spring)")
        .range(1, 1000)
        .or_word("automatic", 0)
        .usually("\"automatic\": 1, but 2 under implicit_euler where cloth or chains are stiff "
                 "([rule](methods.md#iterations-that-nobody-named))")
        .read_by(kAllMethods),
    key<&MethodSettings::precision>("precision", "the arithmetic of the kernels"),
    // implicit_constraints and acad refuse what is not "semi_implicit".
    key<&MethodSettings::integrator>("integrator",
                                     "mass_spring: how time advances; implicit_constraints, acad: "
                                     "only \"semi_implicit\"")
        .read_by(kMassSpring | kConstraints),
    key<&MethodSettings::stability>(
        "stability",
        "mass_spring, acad, implicit_constraints with springs that stay forces: beyond the stable "
        "step refuse, take more substeps, or go on")
        .read_by(kMassSpring | kConstraints),
    key<&MethodSettings::scheme>("scheme",
                                 "mass_spring: vertices gather, or springs write slots; pbd: colours "
                                 "(Gauss-Seidel), or Jacobi by vertices or constraints")
        .read_by(kMassSpring | kPbd),
    key<&MethodSettings::stretch>("stretch", "pbd: stiffness of springs, whatever the number of iterations")
        .range(0, 1)
        .read_by(kPbd),
    key<&MethodSettings::bend>("bend", "pbd: stiffness of hinges").range(0, 1).read_by(kPbd),
    key<&MethodSettings::volume>("volume", "pbd: stiffness of the volumes of tetrahedra")
        .range(0, 1)
        .read_by(kPbd),
    key<&MethodSettings::relaxation>("relaxation", "pbd, vbd: every correction times this")
        .above(0)
        .below(2)
        .read_by(kPbd | kVbd),
    key<&MethodSettings::linear_iterations>(
        "linear_iterations", "implicit methods, acad: at most so many of conjugate gradients a solve")
        .range(1, 100000)
        .read_by(kSolvers),
    key<&MethodSettings::linear_tolerance>("linear_tolerance",
                                           "of the residual, relative to the right-hand side")
        .above(0)
        .below(1)
        .read_by(kSolvers),
    // acad's rows are never assembled.
    key<&MethodSettings::linear_operator>("linear_operator",
                                          "the matrix is assembled, or its product formed from the springs")
        .read_by(kEuler | only(MethodKind::implicit_constraints)),
    key<&MethodSettings::preconditioner>(
        "preconditioner",
        "implicit_euler: of conjugate gradients: blocks of single vertices, or these and the "
        "translations of aggregates of vertices, which stiff and large bodies want")
        .read_by(kEuler),
    key<&MethodSettings::line_search>(
        "line_search", "implicit_euler: so often a Newton step is halved that would raise the incremental "
                       "potential; 0: it is taken as it is")
        .range(0, 16)
        .or_word("automatic")
        .usually("\"automatic\": 16 where a body has tetrahedra, else 2")
        .read_by(kEuler),
    key<&MethodSettings::constrained>("constrained", "implicit_constraints, acad: which springs may be "
                                                     "constraints; the others stay springs")
        .read_by(kConstraints),
    key<&MethodSettings::constraint_compliance>(
        "constraint_compliance", "of the constraints; 0 is rigid; \"material\": each spring's own")
        .unit("m/N")
        .at_least(0)
        .or_word("material")
        .read_by(kConstraints),
    key<&MethodSettings::activate_strain>("activate_strain",
                                          "acad: a spring longer by this share becomes a constraint")
        .above(0)
        .read_by(kAcad)
        .ranges("above 0, with `compress` below 1"),
    key<&MethodSettings::release_strain>("release_strain", "acad: below it a constraint is a spring again")
        .at_least(0)
        .read_by(kAcad)
        .reads<read_release_strain>()
        .usually("`activate_strain`")
        .ranges("0 to `activate_strain`"),
    key<&MethodSettings::release>("release", "acad: a constraint ends by its multiplier's sign, or by strain")
        .read_by(kAcad),
    key<&MethodSettings::target>("target",
                                 "acad: the constraint's length: that of the threshold, or the rest length")
        .read_by(kAcad),
    key<&MethodSettings::compress>("compress",
                                   "acad: a spring shorter by `activate_strain` becomes a constraint, too")
        .read_by(kAcad),
    key<&MethodSettings::start>("start", "vbd: where a substep's sweeps begin").read_by(kVbd),
    key<&MethodSettings::spectral_radius>("spectral_radius", "vbd, pbd: of Chebyshev acceleration; 0: none")
        .at_least(0)
        .below(1)
        .read_by(kVbd | kPbd),
};

} // namespace

constinit const TableOf<MethodSettings> kMethodTable =
    TableOf<MethodSettings>("method", kMethod).checks<check_method>();

} // namespace taut::scene_file
