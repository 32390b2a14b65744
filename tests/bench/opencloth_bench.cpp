// opencloth's position-based scene: the serial program as described, and the nearest scene of ours.

#include "bench.hpp"
#include "opencloth.hpp"

#include "taut/scene/scene.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace bench {
namespace {

/// The largest l - L over the springs along rows and columns, m.
double stretch(const taut::World& world)
{
    const auto x = world.positions();
    double worst = 0;
    for (const taut::Body::Spring& s : world.scene().bodies[0].springs)
        if (s.kind == taut::SpringKind::structural)
            worst = std::max(worst, glm::distance(x[s.a], x[s.b]) - s.rest_length);
    return worst;
}

} // namespace

std::vector<Row> opencloth_rows()
{
    const taut::Scene scene =
        taut::resolve(taut::load_scene(TAUT_SOURCE_DIR "/examples/scenes/opencloth.json"));
    taut::World serial(scene, taut::Device::open("cpu:serial")), parallel(scene, taut::Device::open("cpu"));
    plain::Opencloth plain;
    std::vector<Rival> rivals = {{"opencloth's scene, plain serial loop", [&] { plain.step(); }},
                                 {"opencloth's scene, native serial",
                                  [&] {
                                      serial.step();
                                      serial.device().wait();
                                  }},
                                 {"opencloth's scene, native parallel", [&] {
                                      parallel.step();
                                      parallel.device().wait();
                                  }}};
    take_turns(rivals, 597);
    const double theirs = static_cast<double>(plain.largest_stretch());
    const double errors[] = {theirs, stretch(serial), stretch(parallel)};
    std::vector<Row> rows;
    for (std::size_t i = 0; i < rivals.size(); ++i)
        rows.push_back({rivals[i].name, rivals[i].median(), rivals[i].best(), errors[i],
                        rivals[i].median() / rivals[0].median(), i == 0 ? "" : rivals[0].name, 0});
    return rows;
}

} // namespace bench
