// taut_cores_bench [TURNS]: steps of four scenes on `cpu:serial` and on `cpu` in turns of six, 20 turns
// unless told otherwise. Prints CSV: the conditions, then of each scene the median step of either (ms), and
// the ratio of the two. tests/bench/second_core.sh runs it in many processes: where the system puts the
// threads is decided once a process.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/world/world.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace {

using namespace taut;

constexpr int kWarmUp = 2; // turns

Scene step_of(Body body)
{
    Scene scene;
    scene.bodies = {std::move(body)};
    scene.method.substeps = 10;
    scene.method.iterations = 1;
    return resolve(scene);
}

/// Edges, diagonals and second neighbours; hangs by two corners.
Scene cloth(std::uint32_t side)
{
    Body body;
    body.shape.cells = {side - 1, side - 1};
    body.shape.size = {2, 2};
    body.shape.network = {true, 5000, 2500, 500};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    return step_of(std::move(body));
}

/// 16^3 cells of five tetrahedra, springs and volumes; hangs by its top.
Scene box()
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {16, 16, 16};
    body.material = solid_material();
    body.material.model = SolidModel::springs;
    body.material.youngs_modulus = 1e6;
    Pin pin;
    pin.faces = {"top"};
    body.pins = {pin};
    return step_of(std::move(body));
}

void measure(const char* name, const Scene& scene, int turns)
{
    World serial(scene, Device::open("cpu:serial")), parallel(scene, Device::open("cpu"));
    const auto step = [](World& world) {
        return [&world] {
            world.step();
            world.device().wait();
        };
    };
    std::vector<bench::Rival> rivals = {{"serial", step(serial)}, {"parallel", step(parallel)}};
    bench::take_turns_rested(rivals, turns, kWarmUp);
    if (serial.positions() != parallel.positions())
        throw std::runtime_error(std::string(name) + ": the two executors differ");
    std::printf("%s,%.4f,%.4f,%.3f\n", name, rivals[0].median(), rivals[1].median(),
                rivals[1].median() / rivals[0].median());
}

} // namespace

int main(int argc, char** argv)
{
    try
    {
        const int turns = argc > 1 ? std::atoi(argv[1]) : 20;
        if (turns < 1)
            throw std::runtime_error("turns: a number of 1 or more");
        std::printf("# %s\nscene,serial_ms,parallel_ms,ratio\n",
                    bench::conditions("taut_cores_bench", argc, argv).c_str());
        for (const std::uint32_t side : {64u, 128u, 256u})
            measure(("hanging cloth " + std::to_string(side) + " x " + std::to_string(side)).c_str(),
                    cloth(side), turns);
        measure("hanging box of 20480 tetrahedra", box(), turns);
        return 0;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "taut_cores_bench: %s\n", error.what());
        return 1;
    }
}
