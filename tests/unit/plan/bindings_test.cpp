// Passes of a plan name their bindings; those that do not fit the variant are refused.

#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "taut/kernels/predict.hpp"
#include "taut/plan/builder.hpp"

#include <stdexcept>

using namespace taut;

namespace {

struct Fixture
{
    Scene scene = test::hanging(2);
    DeviceTraits traits; // the builder keeps references
    PlanOptions options;
    PlanBuilder builder{scene, traits, options};
    kernels::predict::Bindings<Use> uses;

    Fixture()
    {
        uses.position = uses.low = uses.velocity = uses.delta = add("places");
        uses.step_values = add("step values");
        uses.events = add("events");
    }

    Use add(std::string_view name) { return {builder.add_buffer("test", name, 256)}; }
    void dispatch(std::string_view variant) { builder.dispatch("test", variant, uses, {4}, 4); }
    void refuses(std::string_view variant, const std::string& kernel, const std::string& binding)
    {
        CHECK_THROWS_AS(dispatch(variant), std::logic_error);
        CHECK_THROWS_WITH(dispatch(variant), kernel + ": " + binding);
        CHECK(builder.plan.passes.empty());
    }
};

} // namespace

TEST_CASE("a pass binds each buffer at the slot of its name")
{
    Fixture f;
    f.uses.delta = f.add("delta");
    f.dispatch("");
    const Dispatch& pass = f.builder.plan.passes.at(0);
    REQUIRE(pass.bindings.size() == pass.kernel->bindings.size());
    for (const BindingInfo& binding : pass.kernel->bindings)
        CHECK((pass.bindings[binding.slot].buffer == f.uses.delta.buffer) == (binding.name == "delta"));
}

TEST_CASE("a pass with a binding missing, or one that its variant does not have, is refused by name")
{
    Fixture f;
    f.refuses("kept", "kernel \"predict\" (variant kept)", "binding \"predicted\" is not set");
    f.uses.predicted = f.add("predicted");
    f.refuses("", "kernel \"predict\"", "binding \"predicted\" is set, but there is no such binding");
    f.uses.low = {};
    f.refuses("kept", "kernel \"predict\" (variant kept)", "binding \"low\" is not set");
}
