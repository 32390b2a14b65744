#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <array>
#include <cstring>

using namespace taut;

namespace {

const EffectCost* effect_of(const Plan& plan)
{
    for (const EffectCost& cost : plan.effects)
        if (cost.name == "plasticity")
            return &cost;
    return nullptr;
}

Scene block(const std::string& method, const std::string& model)
{
    Scene scene;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 3;
    scene.bodies.resize(2);
    for (Body& body : scene.bodies)
    {
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = {2, 2, 2};
        body.material = solid_material();
        body.material.model = option_named<SolidModel>(model);
    }
    scene.bodies[1].material.plastic_yield = 0.1;
    return resolve(scene);
}

const PlanBuffer* buffer_of(const Plan& plan, std::string_view name)
{
    for (const PlanBuffer& buffer : plan.buffers)
        if (buffer.name == name)
            return &buffer;
    return nullptr;
}

} // namespace

TEST_CASE("plasticity costs a dispatch a substep for each kind of element, and nothing where nothing flows",
          "[plasticity]")
{
    for (const std::string method : {"xpbd", "vbd", "implicit_euler"})
        for (const std::string model : {"springs", "neo_hookean"})
        {
            CAPTURE(method, model);
            const Scene with = block(method, model);
            Scene without = with;
            without.bodies[1].material.plastic_yield = 0;
            const Plan plan = make_plan(with), plain = make_plan(without);
            CHECK(effect_of(plain) == nullptr);
            REQUIRE(effect_of(plan) != nullptr);
            CHECK(effect_of(plan)->dispatches_per_step == 3);
            CHECK(plan.passes.size() == plain.passes.size() + 3);
            CHECK(plan.bytes_allocated() == plain.bytes_allocated() + effect_of(plan)->bytes_allocated);
            CHECK(plan.kept.size() > plain.kept.size());
            // The first body's elements are not in the lists: half of all are.
            const std::size_t springs = model == "springs" ? (method == "vbd" ? 2 : 1) * 90 : 0;
            if (springs > 0)
                CHECK(buffer_of(plan, "springs that flow")->bytes == 4 * springs);
            else
                CHECK(buffer_of(plan, "tetrahedra that flow")->bytes == 32 * 40);
        }
}

TEST_CASE("under vbd every corner's record of a tetrahedron is found", "[plasticity]")
{
    Scene scene = block("vbd", "neo_hookean");
    Pin pin;
    pin.vertices = {0, 1, 2};
    scene.bodies[1].pins = {pin};
    const Plan plan = make_plan(scene);
    const PlanBuffer* table = buffer_of(plan, "tetrahedra that flow");
    const PlanBuffer* corners = buffer_of(plan, "corners of hinges and tetrahedra");
    REQUIRE(table != nullptr);
    REQUIRE(corners != nullptr);
    const auto word = [](const PlanBuffer& b, std::size_t k) {
        std::uint32_t out;
        std::memcpy(&out, b.initial.data() + 4 * k, 4);
        return out;
    };
    const std::size_t stride = 18; // words of a record in float: four corners, nine of B, five numbers
    std::size_t absent = 0;
    for (std::size_t t = 0; t < table->bytes / 32; ++t)
        for (std::size_t own = 0; own < 4; ++own)
        {
            const std::uint32_t record = word(*table, 8 * t + 4 + own);
            if (record == 0xffffffffu)
            {
                ++absent;
                continue;
            }
            // That corner stands second, and the others are those of the tetrahedron.
            CHECK(word(*corners, stride * record + 1) == word(*table, 8 * t + own));
            std::array<std::uint32_t, 4> a{}, b{};
            for (std::size_t c = 0; c < 4; ++c)
            {
                a[c] = word(*corners, stride * record + c);
                b[c] = word(*table, 8 * t + c);
            }
            std::sort(a.begin(), a.end());
            std::sort(b.begin(), b.end());
            CHECK(a == b);
        }
    CHECK(absent > 0); // held corners have no row
}

TEST_CASE("methods that keep no strain say which do, and tearing beside it is refused", "[plasticity]")
{
    for (const std::string method : {"pbd", "implicit_constraints", "acad"})
    {
        Scene scene = test::hanging(2);
        scene.method.type = option_named<MethodKind>(method);
        scene.bodies[0].material.plastic_yield = 0.1;
        CHECK_THROWS_WITH(make_plan(scene), Contains("bodies[0].material.plastic_yield") &&
                                                Contains("\"" + method + "\"") && Contains("\"vbd\""));
    }
    Scene scene = test::hanging(2);
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[0].material.plastic_yield = 0.1;
    scene.bodies[1].material.tear_strain = 0.1;
    CHECK_THROWS_WITH(make_plan(scene), Contains("bodies[0].material.plastic_yield") && Contains("tear"));
    scene.bodies[0].material.tear_strain = 0.1;
    CHECK_THROWS_WITH(make_plan(scene), Contains("plastic_yield") && Contains("tear_strain"));
}
