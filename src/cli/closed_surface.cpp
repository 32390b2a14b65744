#include "taut/cli/closed_surface.hpp"

#include "taut/cli/output.hpp"
#include "taut/plan/surface.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <utility>

namespace taut::cli {

Mesh read_closed_surface(const std::string& file, double& volume)
{
    Mesh surface = read_mesh(file, 0);
    if (const std::size_t open = unpaired_edges(surface.triangles).size(); open > 0)
        throw Error(ErrorCode::bad_input,
                    file + ": it encloses no volume: " + counted(open, "edge is", "edges are") +
                        " not shared by triangles that are wound alike; close its holes first.");
    volume = enclosed_volume(surface.triangles, surface.positions);
    if (volume < 0)
        for (auto& triangle : surface.triangles)
            std::swap(triangle[1], triangle[2]);
    volume = std::abs(volume);
    if (!(volume > 0) || !std::isfinite(volume))
        throw Error(ErrorCode::bad_input,
                    file + ": it encloses a volume of " + shown(volume, 4) + "; it must be above 0.");
    return surface;
}

} // namespace taut::cli
