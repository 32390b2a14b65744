#pragma once
// One scene under every method that is there.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"

#include "taut/plan/methods.hpp"
#include "taut/plan/plan.hpp"
#include "taut/scene/scene.hpp"

#include <string>
#include <vector>

namespace taut::test {

/// The scene under another method. Explicit ones take as many substeps as they need; pbd has no dampers.
inline Scene under(Scene scene, const std::string& method)
{
    scene.method.type = option_named<MethodKind>(method);
    scene.method.stability = StabilityRule::substep;
    for (Body& body : scene.bodies)
        if (method == "pbd")
            body.material.stretch_damping = 0;
    return scene;
}

/// The words of all methods. Not acad: it holds strain by itself, so what the effects' tests ask of soft
/// cloth does not hold under it.
inline std::vector<std::string> methods()
{
    std::vector<std::string> out(kWords<MethodKind>.begin(), kWords<MethodKind>.end());
    std::erase(out, "acad");
    return out;
}

/// Calls f(scene under a method, device): every method on cpu:serial, xpbd on every executor.
template <typename F>
void on_methods_and_devices(const Scene& scene, F&& f)
{
    for (const std::string& selector : test_devices())
        for (const std::string& method : methods())
            if (selector == "cpu:serial" || method == "xpbd")
            {
                CAPTURE(selector, method);
                f(under(scene, method), test_device(selector));
                CHECK(test_device(selector)->counters().validation_messages == 0);
            }
}

} // namespace taut::test
