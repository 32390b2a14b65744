// Whether this machine has the memory that generated bodies take.

#include "taut/scene/check_room.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace taut::scene_file {
namespace {

/// Bytes a vertex: no more than `taut plan` takes at its peak under xpbd, the least of the methods, of grids
/// of 800^2 cells (409) and boxes of 60^3 (1,563), so that nothing is refused that would fit. A run that is
/// judged takes up to five times that.
constexpr double kOfSurface = 400, kOfSolid = 1400;

/// Of bodies that are not read from files and have something to solve.
double bytes_of(const Body& body)
{
    const Shape& shape = body.shape;
    if (body.kinematic.used)
        return 0;
    const auto cube = [](const glm::uvec3& c) { return (c.x + 1.0) * (c.y + 1.0) * (c.z + 1.0); };
    switch (shape.kind)
    {
    case ShapeKind::grid: return kOfSurface * (shape.cells.x + 1.0) * (shape.cells.y + 1.0);
    case ShapeKind::box: return kOfSolid * cube(shape.box_cells);
    case ShapeKind::ball: return kOfSolid * cube(glm::uvec3(shape.ball_cells)); // a cube that is made round
    case ShapeKind::chain:
    case ShapeKind::mesh:
    case ShapeKind::tetrahedra: break;
    }
    return 0;
}

/// Of two digits, or whole: "1.4 GB", "1054 GB".
std::string gigabytes(double bytes)
{
    const double out = bytes / 1e9;
    return (out < 100 ? shown(out, 2) : shown(std::round(out), 15)) + " GB";
}

} // namespace

std::uint64_t host_memory()
{
    const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    std::uint64_t out =
        pages > 0 && bytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes) : 0;
    std::uint64_t group = 0; // "max" where there is no limit, which is no number
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> group && group > 0)
        out = out > 0 ? std::min(out, group) : group;
    return out;
}

void check_room(const Scene& scene, std::uint64_t memory)
{
    double bytes = 0, largest = -1;
    std::size_t at = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
        const double own = bytes_of(scene.bodies[b]);
        bytes += own;
        if (own > largest)
            largest = own, at = b;
    }
    if (memory > 0 && bytes > static_cast<double>(memory))
        throw Error(ErrorCode::out_of_memory,
                    "the bodies take about " + gigabytes(bytes) + ", and there are " +
                        gigabytes(static_cast<double>(memory)) +
                        " here; take fewer cells, of bodies[" + std::to_string(at) + "] first");
}

} // namespace taut::scene_file
