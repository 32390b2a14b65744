// The references against closed forms and golden numbers (docs: methods, appendix A).
#include "support/catch.hpp"

#include "samples.hpp"
#include "taut/report/reference_static.hpp"

#include <glm/geometric.hpp>

using namespace taut;

TEST_CASE("a hanging chain of springs is longer by m g n (n+1) / (2 k)", "[reference]")
{
    const std::uint32_t n = GENERATE(10u, 100u);
    const PhysicalModel model = make_model(samples::spring_chain(n, 0.01, 1000));
    const StaticReference at_rest = solve_static(model, model.start);
    REQUIRE(at_rest.converged);
    CHECK(at_rest.stable);
    CHECK(at_rest.relative_residual <= 1e-12);
    const double extension = -at_rest.positions[n].y - 0.1 * n;
    CHECK(extension == Approx(n == 10 ? 0.0053955 : 0.495405).epsilon(1e-12));
}

TEST_CASE("a clamped stretched net sags as far and holds as much energy as published", "[reference]")
{
    struct Golden { std::uint32_t n; double sigma, sag, energy; };
    const auto golden = GENERATE(Golden{9, 0.2, 0.002997505219159, 2.5496697554575},
                                 Golden{9, 2, 0.028842835827001, 2.41850533803734},
                                 Golden{17, 0.2, 0.003024773044504, 2.40789469576611},
                                 Golden{17, 2, 0.029071613860554, 2.27180220327429});
    const PhysicalModel model = make_model(samples::stretched_net(golden.n, golden.sigma));
    const StaticReference at_rest = solve_static(model, model.start);
    REQUIRE(at_rest.converged);
    CHECK(at_rest.stable);
    CAPTURE(at_rest.relative_residual, at_rest.iterations);
    const double sag = -at_rest.positions[golden.n * golden.n / 2].z;
    CHECK(std::abs(sag - golden.sag) < 2e-15);
    CHECK(std::abs(at_rest.energy - golden.energy) < 1e-14);
    INFO("factorisations " << at_rest.iterations);
    CHECK(at_rest.iterations < 100);
}
