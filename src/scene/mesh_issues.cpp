#include "taut/scene/mesh_issues.hpp"

#include "taut/scene/fabric_mesh.hpp"
#include "taut/scene/locking.hpp"

#include <utility>

namespace taut {

std::vector<SceneIssue> mesh_issues(const Scene& resolved)
{
    std::vector<SceneIssue> issues = locking_issues(resolved);
    for (SceneIssue& issue : fabric_mesh_issues(resolved))
        issues.push_back(std::move(issue));
    return issues;
}

} // namespace taut
