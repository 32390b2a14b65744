// taut_sleep_bench [FILE.csv]: bodies of which all but one sleep, against that one alone; those that do not
// meet, and piles. Prints the table of docs/sleep.md.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/sleep.hpp"

#include <glm/geometric.hpp>

#include <cstdio>
#include <exception>
#include <memory>

namespace {

using namespace taut;

Body block(const glm::dvec3& middle)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.material = solid_material();
    body.material.thickness = 0.01;
    body.transform.translate = middle;
    return body;
}

/// Hangs by its upper face in the air and is drawn on for ever.
Body led_block()
{
    Body body = block({0, 3, 0});
    Pin pin;
    pin.faces = {"top"};
    pin.motion = {{0, {0, 0, 0}}, {1e6, {1e5, 0, 0}}};
    body.pins = {pin};
    return body;
}

/// The led one and blocks on a plane, so many in all; they do not meet each other.
Scene blocks(int count)
{
    Scene scene;
    scene.bodies = {led_block()};
    for (int k = 1; k < count; ++k)
        scene.bodies.push_back(block({2.0 * (k % 40), 0.502, 2.0 * (k / 40)}));
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    scene.damping = 5;
    return resolve(scene);
}

/// The led one over a mesh on which blocks lie in piles of two; all meet each other.
Scene piles(int count)
{
    Scene scene;
    Body floor;
    floor.shape.cells = {10, 10};
    floor.shape.size = {40, 40};
    floor.material.thickness = 0.01;
    floor.transform.rotate_axis = {1, 0, 0};
    floor.transform.rotate_degrees = -90;
    floor.kinematic.used = true;
    scene.bodies = {led_block(), floor};
    for (int k = 0; k < count; ++k)
        for (int level = 0; level < 2; ++level)
            scene.bodies.push_back(block({4.0 + 2.0 * (k % 7), 0.525 + 1.025 * level, 2.0 * (k / 7)}));
    scene.contact.between = true;
    scene.contact.friction = 0.5;
    scene.damping = 5;
    return resolve(scene);
}

struct Row
{
    std::string name;
    double median = 0, best = 0, ratio = 1;
    std::size_t dispatches = 0;
    double error = 0;
    bool target = false;
};

/// Ten steps of what moves alone, and of it beside those of which so many have to sleep.
std::vector<Row> compare(const std::string& alone, const Scene& few, const std::string& beside,
                         const Scene& all, std::size_t sleepers)
{
    const auto device = Device::open("cpu:serial");
    SleepWorld many(all, device);
    World one(few, device);
    for (int k = 0; k < 600 && many.asleep() < sleepers; ++k)
    {
        many.step();
        one.step();
    }
    device->wait();
    if (many.asleep() != sleepers)
        throw Error(ErrorCode::unsupported, std::to_string(many.asleep()) + " of " +
                                                std::to_string(sleepers) + " bodies sleep; nothing is timed");
    const auto here = many.positions(), there = one.positions();
    double error = 0;
    for (std::size_t v = 0; v < there.size(); ++v)
        error = std::max(error, glm::distance(here[v], there[v]));
    const auto ten = [&](auto& world) {
        for (int k = 0; k < 10; ++k)
            world.step();
        device->wait();
    };
    std::vector<bench::Rival> rivals = {{alone, [&] { ten(one); }}, {beside, [&] { ten(many); }}};
    bench::take_turns(rivals, 40, 3);
    return {{alone, rivals[0].median(), rivals[0].best(), 1, one.plan().passes.size(), 0, false},
            {beside, rivals[1].median(), rivals[1].best(), rivals[1].median() / rivals[0].median(),
             many.awake().plan().passes.size(), error, true}};
}

} // namespace

int main(int argc, char** argv)
try
{
    std::vector<Row> rows =
        compare("one body alone", blocks(1), "1,000 bodies, 999 asleep", blocks(1000), 999);
    for (const Row& row :
         compare("one body over a mesh", piles(0), "49 piles of two as well, all asleep", piles(49), 98))
        rows.push_back(row);
    std::string text = "| ten steps of | median ms | best | ratio | dispatches a step | error m | target |\n"
                       "|---|---:|---:|---:|---:|---:|---:|\n";
    std::string csv = "# " + bench::conditions("taut_sleep_bench", argc, argv) +
                      "\nwhat,median_ms,best_ms,ratio,dispatches,error_m,target\n";
    for (const Row& row : rows)
    {
        char line[200];
        std::snprintf(line, sizeof line, "| %s | %.3f | %.3f | %.2f | %zu | %.1g | %s |\n", row.name.c_str(),
                      row.median, row.best, row.ratio, row.dispatches, row.error, row.target ? "1.1" : "");
        text += line;
        csv += '"' + row.name + "\"," + shown(row.median, 5) + ',' + shown(row.best, 5) + ',' +
               shown(row.ratio, 4) + ',' + std::to_string(row.dispatches) + ',' + shown(row.error, 3) +
               (row.target ? ",1.1\n" : ",\n");
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
