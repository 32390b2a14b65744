#include "taut/scene/few_substeps.hpp"

#include "taut/scene/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace taut {

std::vector<SceneIssue> few_substeps_issues(const Scene& resolved)
{
    const MethodKind method = resolved.method.type;
    if (method != MethodKind::xpbd && method != MethodKind::implicit_euler)
        return {};
    const double most = kMostSubsteps; // beyond it the plan warns
    const double wanted = std::min(substeps_of_solids(resolved), most);
    if (!(kFewSubsteps * resolved.method.substeps < wanted))
        return {};
    const double taken = std::max<double>(std::ceil(wanted), kLeastSubsteps);
    return {{false, "method.substeps",
             "is " + std::to_string(resolved.method.substeps) + "; for these solids automatic takes " +
                 std::to_string(static_cast<std::uint32_t>(taken)) +
                 ": so few may leave them too soft, or with energy that nothing put in"}};
}

} // namespace taut
