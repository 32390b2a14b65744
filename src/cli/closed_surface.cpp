#include "taut/cli/closed_surface.hpp"

#include "taut/cli/output.hpp"
#include "taut/plan/surface.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <utility>

namespace taut::cli {

ClosedSurface read_closed_surface(const std::string& file)
{
    ClosedSurface out;
    MeshFindings findings;
    out.mesh = read_mesh(file, 0, &findings);
    Mesh& surface = out.mesh;
    for (const std::string& text : skipped_texts(findings.skipped))
    {
        out.messages.push_back(file + ' ' + text);
        warn(out.messages.back());
    }
    if (const std::size_t open = unpaired_edges(surface.triangles).size(); open > 0)
        throw Error(ErrorCode::bad_input,
                    file + ": it encloses no volume: " + counted(open, "edge is", "edges are") +
                        " not shared by triangles that are wound alike; close its holes first.");
    const double signed_volume = enclosed_volume(surface.triangles, surface.positions);
    if (signed_volume < 0)
        for (auto& triangle : surface.triangles)
            std::swap(triangle[1], triangle[2]);
    out.volume = std::abs(signed_volume);
    if (!(out.volume > 0) || !std::isfinite(out.volume))
        throw Error(ErrorCode::bad_input,
                    file + ": it encloses a volume of " + shown(out.volume, 4) + "; it must be above 0.");
    return out;
}

} // namespace taut::cli
