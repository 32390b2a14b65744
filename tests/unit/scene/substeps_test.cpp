#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace taut;

TEST_CASE("methods that sweep take the substeps that mesh and weight ask for, others ten", "[substeps]")
{
    Scene scene = test::hanging(32);
    const auto substeps = [&](const char* method) {
        scene.method.type = method;
        scene.method.substeps = 0;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t sweeps = substeps("xpbd");
    CHECK(sweeps > 40);
    CHECK(substeps("vbd") == sweeps);
    CHECK(substeps("pbd") == sweeps);
    CHECK(substeps("implicit_euler") == 10);
    CHECK(substeps("mass_spring") == 10);
    scene.method.iterations = 4;
    CHECK(substeps("vbd") <= sweeps / 2 + 1);
}
