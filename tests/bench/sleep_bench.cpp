// taut_sleep_bench [FILE.csv]: a thousand bodies of which all but one sleep, against that one alone. Prints
// the table of docs/sleep.md.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/sleep.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>

namespace {

using namespace taut;

/// Blocks on a plane; the first hangs by its upper face in the air and swings.
Scene blocks(int count)
{
    Scene scene;
    for (int k = 0; k < count; ++k)
    {
        Body body;
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = {4, 4, 4};
        body.material = solid_material();
        body.transform.translate = {2.0 * (k % 40), k == 0 ? 3 : 0.502, 2.0 * (k / 40)};
        if (k == 0)
        {
            Pin pin;
            pin.faces = {"top"};
            pin.motion = {{0, {0, 0, 0}}, {1e6, {1e5, 0, 0}}};
            body.pins = {pin};
        }
        scene.bodies.push_back(body);
    }
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    scene.damping = 5;
    return resolve(scene);
}

} // namespace

int main(int argc, char** argv)
try
{
    const auto device = Device::open("cpu:serial");
    constexpr int kSettle = 600;
    SleepWorld many(blocks(1000), device);
    World one(blocks(1), device);
    for (int k = 0; k < kSettle; ++k)
    {
        many.step();
        one.step();
    }
    device->wait();
    if (many.asleep() != 999)
        throw Error(ErrorCode::unsupported,
                    std::to_string(many.asleep()) + " of 999 bodies sleep; nothing is timed");
    const auto here = many.positions(), alone = one.positions();
    double error = 0;
    for (std::size_t v = 0; v < alone.size(); ++v)
        error = std::max(error, std::abs(here[v].x - alone[v].x) + std::abs(here[v].y - alone[v].y));
    std::vector<bench::Rival> rivals = {{"one body alone",
                                         [&] {
                                             for (int k = 0; k < 10; ++k)
                                                 one.step();
                                             device->wait();
                                         }},
                                        {"1,000 bodies, 999 asleep", [&] {
                                             for (int k = 0; k < 10; ++k)
                                                 many.step();
                                             device->wait();
                                         }}};
    bench::take_turns(rivals, 40, 3);
    std::string text = "| ten steps of | median ms | best | ratio | dispatches a step | error m | target |\n"
                       "|---|---:|---:|---:|---:|---:|---:|\n";
    std::string csv = "# " + bench::conditions("taut_sleep_bench", argc, argv) +
                      "\nwhat,median_ms,best_ms,ratio,dispatches,error_m,target\n";
    for (std::size_t k = 0; k < 2; ++k)
    {
        const double ratio = rivals[k].median() / rivals[0].median();
        const std::size_t passes = k == 0 ? one.plan().passes.size() : many.awake().plan().passes.size();
        char line[200];
        std::snprintf(line, sizeof line, "| %s | %.3f | %.3f | %.2f | %zu | %.1g | %s |\n",
                      rivals[k].name.c_str(), rivals[k].median(), rivals[k].best(), ratio, passes,
                      k == 0 ? 0.0 : error, k == 0 ? "" : "1.1");
        text += line;
        csv += '"' + rivals[k].name + "\"," + shown(rivals[k].median(), 5) + ',' +
               shown(rivals[k].best(), 5) + ',' + shown(ratio, 4) + ',' + std::to_string(passes) + ',' +
               shown(k == 0 ? 0.0 : error, 3) + (k == 0 ? ",\n" : ",1.1\n");
    }
    std::printf("%s", text.c_str());
    if (argc > 1)
        taut::write_file(argv[1], csv);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_sleep_bench: %s\n", error.what());
    return 1;
}
