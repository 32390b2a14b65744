#pragma once
// Scene texts for the tests of the program.

#include <string>

namespace scenes {

/// 81 vertices, pinned by two corners, nothing else.
inline std::string cloth(const std::string& timestep = "0.016666666666666666")
{
    return R"({"taut": 1, "timestep": )" + timestep + R"(, "duration": 0.5,
        "bodies": [{"grid": {"cells": [8, 8], "size": [1, 1]},
                    "pins": [{"corners": ["top_left", "top_right"]}]}]})";
}

/// The same with a box of springs and volumes that falls on a floor beside it.
inline std::string cloth_and_box()
{
    return R"({"taut": 1, "duration": 0.5,
        "bodies": [{"grid": {"cells": [8, 8], "size": [1, 1]}, "transform": {"translate": [0, 0.7, 0]},
                    "pins": [{"corners": ["top_left", "top_right"]}]},
                   {"box": {"cells": [2, 2, 2], "size": [0.3, 0.3, 0.3]}, "material": {"model": "springs"},
                    "transform": {"translate": [2, 0.2, 0]}}],
        "colliders": [{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}]})";
}

/// 9 and 4 vertices; one body has a name, with a space in it.
inline std::string two_bodies()
{
    return R"({"taut": 1, "bodies": [
        {"name": "upper cloth", "grid": {"cells": [2, 2], "size": [1, 1]}},
        {"chain": {"links": 3, "length": 1}, "transform": {"translate": [0, 2, 0]}}]})";
}

/// 25 vertices, drawn apart by 2 m/s until they tear.
inline std::string tearing_cloth()
{
    return R"({"taut": 1, "gravity": [0, 0, 0],
        "bodies": [{"grid": {"cells": [4, 4], "size": [1, 1]},
                    "material": {"stretch_stiffness": 200, "tear_strain": 0.2},
                    "pins": [{"edges": ["left"]},
                             {"edges": ["right"],
                              "motion": [{"time": 0}, {"time": 1, "translate": [2, 0, 0]}]}]}]})";
}

/// So far away that it counts as diverged, while every number stays finite.
inline std::string lost_cloth()
{
    return R"({"taut": 1, "bodies": [{"grid": {"cells": [2, 2], "size": [1, 1]},
                                      "transform": {"translate": [1e13, 0, 0]}}]})";
}

} // namespace scenes
