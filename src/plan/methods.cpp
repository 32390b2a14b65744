#include "taut/plan/methods.hpp"

#include "taut/plan/acad.hpp"
#include "taut/plan/implicit_constraints.hpp"
#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/plan/stability.hpp"
#include "taut/plan/vbd.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"

#include <algorithm>

namespace taut {
namespace {

// clang-format off
constexpr Method kMethods[] = {
    //                                 contacts each  keeps
    // kind                            iteration      guess   check                       substeps
    {MethodKind::mass_spring,          false,         false,  check_mass_spring,          stable_substeps},
    {MethodKind::implicit_euler,       false,         true,   check_implicit_euler,       nullptr},
    {MethodKind::implicit_constraints, false,         false,  check_implicit_constraints, stable_substeps},
    {MethodKind::acad,                 false,         false,  check_acad,                 stable_substeps},
    {MethodKind::pbd,                  true,          false,  check_pbd,                  nullptr},
    {MethodKind::xpbd,                 true,          false,  nullptr,                    nullptr},
    {MethodKind::vbd,                  false,         true,   check_vbd,                  nullptr},
};
// clang-format on

} // namespace

MethodKind method_of(const Scene& scene)
{
    const auto found = std::find(kMethodNames.begin(), kMethodNames.end(), scene.method.type);
    if (found == kMethodNames.end())
        throw Error(ErrorCode::unsupported, "method.type \"" + scene.method.type +
                                                "\" is not there; there is " +
                                                scene_file::listing(kMethodNames));
    return static_cast<MethodKind>(found - kMethodNames.begin());
}

const Method& find_method(MethodKind kind)
{
    for (const Method& method : kMethods)
        if (method.kind == kind)
            return method;
    throw Error(ErrorCode::unsupported, "method.type \"" +
                                            std::string(kMethodNames[static_cast<std::size_t>(kind)]) +
                                            "\" is not built yet");
}

} // namespace taut
