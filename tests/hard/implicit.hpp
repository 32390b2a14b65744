#pragma once
// What the hard cases of implicit Euler share.

#include "hard/cases.hpp"

namespace taut::hard {

inline Scene implicit(Scene scene, std::uint32_t substeps = 1, std::uint32_t newton = 1)
{
    scene.method = {};
    scene.method.type = MethodKind::implicit_euler;
    scene.method.substeps = substeps;
    scene.method.iterations = newton;
    return scene;
}

inline Scene in_double(Scene scene)
{
    scene.method.precision = Precision::float64;
    scene.method.linear_tolerance = 1e-10;
    scene.method.linear_iterations = 300;
    return scene;
}

/// Sound, whatever the linear solves counted.
inline StepReport check_solved(const World& world, const Words& also = {})
{
    StepReport report = measure(world);
    Words allowed = also;
    for (const char* word : {"iteration_limit", "solve_failed"})
        if (report.warnings.count(word) > 0)
            allowed.insert(word);
    return check_sound(world, allowed);
}

} // namespace taut::hard
