#include "taut/scene/mesh_issues.hpp"

#include "taut/scene/fabric_mesh.hpp"
#include "taut/scene/few_substeps.hpp"
#include "taut/scene/locking.hpp"

namespace taut {

std::vector<SceneIssue> mesh_issues(const Scene& resolved)
{
    std::vector<SceneIssue> issues = locking_issues(resolved);
    for (const auto& more : {fabric_mesh_issues(resolved), few_substeps_issues(resolved)})
        issues.insert(issues.end(), more.begin(), more.end());
    return issues;
}

} // namespace taut
