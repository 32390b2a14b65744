// Scenes with elements that the program has added: answers by hand, refusals, nothing where there are none.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/model.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/taut.hpp"

#include <cmath>

using namespace taut;
using namespace taut::elements_test;

namespace {

constexpr double kMass = 0.2, kGravity = 9.81;

/// A mass below a held vertex, 1 m apart, with nothing between them but what a test adds.
Scene hanging_mass(const std::string& precision = "float")
{
    Scene scene;
    scene.timestep = 1.0 / 60;
    scene.duration = 6;
    scene.damping = 4;
    scene.method.substeps = 20;
    scene.method.precision = option_named<Precision>(precision);
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 1;
    body.material.stretch_stiffness = 0;
    body.vertex_masses = {kMass, kMass};
    Pin pin;
    pin.corners = {"first"};
    body.pins.push_back(pin);
    scene.bodies.push_back(body);
    return scene;
}

void add_spring(Scene& scene, double compliance)
{
    scene.bodies[0].elements.push_back({"cubic_spring", {0, 1}, {1, compliance}});
}

std::string refusal(const Scene& scene)
{
    try
    {
        make_plan(resolve(scene));
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "nothing";
}

bool says(const std::string& text, const std::string& part)
{
    INFO(text);
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a mass hangs from a spring of a cubic law as far down as its weight and the law say")
{
    add_elements();
    const double compliance = 1e-3, stretch = std::cbrt(kMass * kGravity * compliance / 2);
    std::string first;
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        Scene scene = hanging_mass();
        add_spring(scene, compliance);
        World world(resolve(scene), test_device(selector));
        while (world.time() < scene.duration)
            world.step();
        CHECK(world.positions()[1].y == Approx(-1 - stretch).epsilon(1e-3));
        const StepReport report = measure(world);
        const double energy = std::pow(stretch, 4) / (2 * compliance) - kMass * kGravity * (1 + stretch);
        CHECK(report.potential_energy == Approx(energy).epsilon(1e-3));
        const std::string hash = std::to_string(report.position_hash);
        first = first.empty() ? hash : first;
        CHECK(hash == first);
    }
}

TEST_CASE("a triangle of a held area that is drawn out of it comes back, and its middle stays")
{
    add_elements();
    for (const std::string precision : {"float", "double"})
    {
        CAPTURE(precision);
        Scene scene = hanging_mass(precision);
        scene.gravity = glm::dvec3(0);
        Body& body = scene.bodies[0];
        body.pins.clear();
        body.shape.links = 2;
        body.vertex_masses = {kMass, kMass, kMass};
        body.start_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}};
        body.elements.push_back({"held_area", {0, 1, 2}, {0.5, 1e-4}});
        World world(resolve(scene), test_device("cpu:serial"));
        const double before = measure(world).potential_energy;
        CHECK(before == Approx(0.25 * 0.25 / 2e-4));
        while (world.time() < scene.duration)
            world.step();
        const auto x = world.positions();
        CHECK(glm::length(glm::cross(x[1] - x[0], x[2] - x[0])) / 2 == Approx(0.5).epsilon(1e-3));
        const glm::dvec3 middle = (x[0] + x[1] + x[2]) / 3.0;
        CHECK(glm::distance(middle, glm::dvec3(1, 1.5, 0) / 3.0) < 1e-5);
        CHECK(measure(world).potential_energy < 1e-4 * before);
    }
}

TEST_CASE("added elements have passes and buffers of their own name, and nothing where a scene has none")
{
    add_elements();
    Scene scene = hanging_mass();
    const Plan without = make_plan(resolve(scene));
    add_spring(scene, 1e-3);
    const Plan with = make_plan(resolve(scene));
    const auto count = [](const Plan& plan) {
        return std::count_if(plan.passes.begin(), plan.passes.end(),
                             [](const Dispatch& pass) { return pass.label == "cubic_spring"; });
    };
    CHECK(count(without) == 0);
    CHECK(count(with) == 20);
    CHECK(with.passes.size() == without.passes.size() + 20);
    CHECK(with.constraint_counts().at("cubic_spring") == 1);
}

TEST_CASE("references of scenes with added elements refuse and say why")
{
    add_elements();
    Scene scene = hanging_mass();
    add_spring(scene, 1e-3);
    const PhysicalModel model = make_model(resolve(scene));
    REQUIRE(model.added.size() == 1);
    CHECK(says(solve_dynamic(model).reason, "elements of its own"));
    CHECK(says(solve_static(model, model.start).reason, "elements of a program"));
}

TEST_CASE("what a scene says wrong of added elements is refused with the place and what would be right")
{
    add_elements();
    Scene scene = hanging_mass();
    add_spring(scene, 1e-3);
    Body::Elements& list = scene.bodies[0].elements[0];
    CHECK(refusal(scene) == "nothing");
    list.kind = "quartic";
    CHECK(says(refusal(scene), "bodies[0].elements[0].kind is \"quartic\""));
    CHECK(says(refusal(scene), "\"cubic_spring\", \"held_area\", \"thin_rod\""));
    list.kind = "cubic_spring";
    list.vertices = {0, 1, 1};
    CHECK(says(refusal(scene), ".vertices has 3 entries; \"cubic_spring\" takes 2"));
    list.vertices = {1, 1};
    CHECK(says(refusal(scene), "2 different vertices below 2"));
    list.vertices = {0, 1};
    list.values = {1};
    CHECK(says(refusal(scene), ".values has 1 entries"));
    list.values = {1, std::nan("")};
    CHECK(says(refusal(scene), ".values[1] (compliance) is not finite"));
    list.values = {1, 1e-3};
    scene.method.type = MethodKind::acad;
    CHECK(says(refusal(scene), "method \"acad\" has no kernels for elements \"cubic_spring\"; use \"xpbd\""));
    scene.method.type = MethodKind::mass_spring;
    scene.method.stability = StabilityRule::ignore;
    CHECK(refusal(scene) == "nothing");
    list.values = {1, 0};
    CHECK(says(refusal(scene), "element 0 has no finite energy where it starts"));
}

TEST_CASE("an element that is called as an effect is refused")
{
    add_elements();
    const std::span<const KernelInfo> good = find_element("cubic_spring")->kernels.front();
    static std::vector<KernelInfo> kernels(good.begin(), good.end());
    for (KernelInfo& kernel : kernels)
        kernel.name = "xpbd_distance";
    ElementKind kind = *find_element("cubic_spring");
    kind.kernels = {kernels};
    kind.name = "length";
    CHECK_THROWS_AS(add_element(kind), Error); // its kernels are another's
    kind.name = "distance";
    add_element(kind);
    Scene scene = hanging_mass();
    add_spring(scene, 1e-3);
    scene.bodies[0].elements[0].kind = "distance";
    CHECK(says(refusal(scene), "which an effect of Taut is called"));
}

TEST_CASE("an element that does not fit its kernels is not added")
{
    add_elements();
    const auto why = [](ElementKind kind) {
        try
        {
            add_element(kind);
        }
        catch (const Error& error)
        {
            return std::string(error.what());
        }
        return std::string("added");
    };
    const ElementKind good = *find_element("cubic_spring");
    CHECK(says(why(good), "there is one of this name"));
    ElementKind bad = good;
    bad.name = "other";
    bad.values = {"rest_length"};
    CHECK(says(why(bad), "takes 16 bytes"));
    bad = good;
    bad.name = "other";
    bad.energy = nullptr;
    CHECK(says(why(bad), "has no energy"));
    bad = good;
    bad.name = "other";
    bad.corners = 5;
    CHECK(says(why(bad), "it must be 2, 3 or 4"));
    CHECK(find_element("other") == nullptr);
}
