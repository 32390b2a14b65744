#include <cstdio>
#include <taut/taut.hpp>

int main()
{
    const auto scene = taut::parse_scene(R"({"taut": 1, "timestep": 0.025,
        "bodies": [{"grid": {"cells": [8, 8], "size": [1, 1]}}]})");
    taut::World world(scene, taut::Device::open("cpu:serial"));
    for (int frame = 0; frame < 20; ++frame)
        world.step();
    std::printf("height %.4f m, taut %s\n", world.positions()[40].y, TAUT_VERSION);
}
