// Checks of how a scene advances that take more than one key.

#include "taut/scene/checker.hpp"

namespace taut::scene_file {
namespace {

void check_scheme(const MethodSettings& method, const Checker& out)
{
    if (method.type == MethodKind::pbd && method.scheme == ElementScheme::spring_centric)
        out.error("scheme", "is \"spring_centric\"; pbd has \"coloured\", \"node_centric\" and "
                            "\"constraint_centric\"");
    if (method.type == MethodKind::mass_spring &&
        (method.scheme == ElementScheme::coloured || method.scheme == ElementScheme::constraint_centric))
        out.error("scheme", "is " + quoted(method.scheme) +
                                "; mass_spring has \"node_centric\" and \"spring_centric\"");
}

void check_preconditioner(const MethodSettings& method, const Checker& out)
{
    if (method.type == MethodKind::implicit_euler &&
        method.preconditioner == NewtonPreconditioner::two_level &&
        method.linear_operator == LinearOperator::matrix_free)
        out.error("preconditioner", "is \"two_level\", which is made of the matrix; take linear_operator "
                                    "\"assembled\", or the preconditioner \"block_jacobi\"");
}

} // namespace

void check_method(const MethodSettings& method, const Checker& out)
{
    check_scheme(method, out);
    check_preconditioner(method, out);
    if (method.compress && method.activate_strain >= 1)
        out.error("activate_strain",
                  "is " + shown(method.activate_strain) +
                      "; with compress it must be below 1: no spring is shorter than nothing");
    if (method.release_strain > method.activate_strain)
        out.error("release_strain", "is " + shown(method.release_strain) +
                                        "; it must be 0 or more and at most activate_strain");
}

} // namespace taut::scene_file
