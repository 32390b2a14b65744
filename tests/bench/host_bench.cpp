// What the host does besides stepping, as CSV: taut_host_bench
// Work that must grow no faster than what it is given, for a size and for four times as much: reading and
// checking a scene with a list of springs, and setting the force on each vertex of a cloth before a step. In
// seconds of processor time, which neighbours on the machine hardly change; `growth` is the time over that of
// a quarter.

#include "conditions.hpp"

#include "taut/scene/scene.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace taut;

constexpr int kTurns = 3; // the least of them counts

double seconds_of(const std::function<void()>& work)
{
    double least = 1e9;
    for (int turn = 0; turn < kTurns; ++turn)
    {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

/// A grid of 1,024 x 1,024 vertices with so many further springs, as the text of a scene file.
std::string scene_of(std::uint32_t springs)
{
    std::string text = R"({"taut": 1, "bodies": [{"grid": {"cells": [1023, 1023]}, "springs": [)";
    for (std::uint32_t k = 0; k < springs; ++k)
        text += (k == 0 ? "" : ", ") + std::string(R"({"a": )") + std::to_string(k) + R"(, "b": )" +
                std::to_string((k + 7919) % (1024 * 1024)) + R"(, "rest_length": 0.5, "compliance": 1e-5})";
    return text + "]}]}";
}

double read_alone(std::uint32_t springs)
{
    const std::string text = scene_of(springs);
    return seconds_of([&] {
        if (parse_scene(text).bodies.at(0).springs.size() != springs)
            throw std::runtime_error("the scene has not the springs that were written");
    });
}

double read_and_check(std::uint32_t springs)
{
    const std::string text = scene_of(springs);
    return seconds_of([&] {
        if (resolve(parse_scene(text)).bodies.at(0).springs.size() != springs)
            throw std::runtime_error("the scene has not the springs that were written");
    });
}

/// Of `side`² vertices, each by a call of its own; a step between, which is not timed.
double set_each(std::uint32_t side)
{
    Scene scene;
    Body body;
    body.shape.cells = {side - 1, side - 1};
    scene.bodies = {body};
    scene.external_forces = true;
    World world(resolve(scene), Device::open("cpu:serial"));
    std::mt19937 random(1);
    std::vector<std::uint32_t> order(world.plan().vertex_count);
    for (std::uint32_t v = 0; v < order.size(); ++v)
        order[v] = v;
    std::shuffle(order.begin(), order.end(), random);
    double least = 1e9;
    for (int turn = 0; turn < kTurns; ++turn)
    {
        world.step();
        least = std::min(least, seconds_of([&] {
                             for (const std::uint32_t v : order)
                                 world.set_force(v, {0, 1e-3 * turn, 0});
                         }));
    }
    return least;
}

void rows(const char* what, const std::function<double(std::uint32_t)>& measure,
          const std::function<std::uint32_t(std::uint32_t)>& count, std::uint32_t size,
          std::uint32_t fourfold)
{
    const double quarter = measure(size), whole = measure(fourfold);
    std::printf("%s,%u,%.3g,%.3g,\n", what, count(size), quarter, 1e9 * quarter / count(size));
    std::printf("%s,%u,%.3g,%.3g,%.2f\n", what, count(fourfold), whole, 1e9 * whole / count(fourfold),
                whole / quarter);
}

} // namespace

int main(int argc, char** argv)
{
    try
    {
        std::printf("# %s\nwhat,count,s,ns each,growth\n",
                    bench::conditions("taut_host_bench", argc, argv).c_str());
        const auto itself = [](std::uint32_t n) { return n; };
        rows("read springs", read_alone, itself, 250000, 1000000);
        rows("read and check springs", read_and_check, itself, 250000, 1000000);
        rows(
            "set_force of each vertex", set_each, [](std::uint32_t side) { return side * side; }, 128, 256);
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "taut_host_bench: %s\n", error.what());
        return 1;
    }
}
