#include <cmath>
#include <cstdio>
#include <taut/elements/element.hpp>
#include <taut/kernels/cubic_spring.hpp>
#include <taut/taut.hpp>

namespace {

/// values: rest length m, compliance m^4/J.
double energy(std::span<const glm::dvec3> x, std::span<const double> values)
{
    return std::pow(glm::distance(x[0], x[1]) - values[0], 4) / (2 * values[1]);
}

} // namespace

int main()
{
    taut::add_element({"cubic_spring", 2, {"rest_length", "compliance"}, taut::kernels::cubic_spring::all(),
                       energy});
    taut::Scene scene = taut::parse_scene(R"({"taut": 1, "damping": 4, "method": {"substeps": 20},
        "bodies": [{"chain": {"links": 1}, "material": {"stretch_stiffness": 0}, "vertex_masses": [0.2, 0.2],
                    "pins": [{"corner": "first"}]}]})");
    scene.bodies[0].elements.push_back({"cubic_spring", {0, 1}, {1, 1e-3}});
    taut::World world(taut::resolve(scene), taut::Device::open("cpu:serial"));
    while (world.time() < 6)
        world.step();
    std::printf("height %.4f m, by hand %.4f m\n", world.positions()[1].y,
                -1 - std::cbrt(0.2 * 9.81 * 1e-3 / 2));
}
