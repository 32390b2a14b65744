// What vertex block descent puts into a plan for solids: colours, lists, and nothing without need.

#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "taut/plan/plan.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/vec4.hpp>

#include <cstring>
#include <limits>
#include <set>

using namespace taut;

namespace {

Scene solid(const std::string& model, const std::string& split, const glm::uvec3& cells = {4, 4, 4})
{
    Scene scene;
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = 2;
    scene.method.iterations = 3;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = cells;
    body.shape.split = option_named<BoxSplit>(split);
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    scene.bodies = {body};
    return resolve(scene);
}

DeviceTraits apart()
{
    DeviceTraits traits;
    traits.dispatch_ns = 0;
    return traits;
}

const PlanBuffer* find_buffer(const Plan& plan, const std::string& name)
{
    for (const PlanBuffer& b : plan.buffers)
        if (b.name == name)
            return &b;
    return nullptr;
}

std::vector<std::uint32_t> words_of(const PlanBuffer& buffer)
{
    std::vector<std::uint32_t> out(buffer.initial.size() / 4);
    std::memcpy(out.data(), buffer.initial.data(), buffer.initial.size());
    return out;
}

std::vector<std::string> kernels_of(const Plan& plan)
{
    for (const EffectCost& effect : plan.effects)
        if (effect.name == "vbd_solve")
            return effect.kernel_names();
    return {};
}

} // namespace

TEST_CASE("generated boxes take four vertex colours, whatever the split and the model")
{
    for (const std::string model : {"neo_hookean", "neo_hookean_simple", "springs"})
        for (const std::string split : {"five", "six"})
            for (const glm::uvec3& cells : {glm::uvec3(4, 4, 4), glm::uvec3(5, 3, 2), glm::uvec3(7, 1, 1)})
            {
                CAPTURE(model, split, cells.x);
                const Scene scene = solid(model, split, cells);
                const Plan plan = make_plan(scene, apart());
                CHECK(plan.colour_counts().at("vbd_solve") == 4);
                CHECK(plan.constraint_counts().at("vbd_solve") == scene.bodies[0].mesh.positions.size());
            }
}

TEST_CASE("every tetrahedron stands once in the list of each corner, that corner second, and right-handed")
{
    for (const std::string model : {"neo_hookean", "springs"})
    {
        Scene scene = solid(model, "five", {3, 2, 4});
        scene.bodies[0].pins = {Pin()};
        scene.bodies[0].pins[0].vertices = {0, 1, 2};
        const Plan plan = make_plan(scene, apart());
        const auto row = words_of(*find_buffer(plan, "rows"));
        const PlanBuffer* list = find_buffer(plan, "corners of hinges and tetrahedra");
        REQUIRE(list != nullptr);
        const std::size_t each = model == "springs" ? 6 : 18; // words of a record
        const auto words = words_of(*list);
        std::set<std::pair<std::uint32_t, std::set<std::uint32_t>>> seen;
        std::size_t records = 0;
        for (std::size_t k = 0; k < plan.vertex_count - 3; ++k) // rows of vertices that move
            for (std::uint32_t j = row[5 * k + 4]; j < row[5 * k + 9]; ++j, ++records)
            {
                const std::uint32_t* v = &words[each * j];
                CHECK(v[1] == row[5 * k]);
                seen.insert({v[1], {v[0], v[1], v[2], v[3]}});
                const auto at = [&](std::uint32_t plan_vertex) {
                    return scene.bodies[0].mesh.positions[plan.original[plan_vertex]];
                };
                const std::vector<glm::dvec3> x = {at(v[0]), at(v[1]), at(v[2]), at(v[3])};
                CHECK(six_volumes(x, {0, 1, 2, 3}) > 0);
            }
        std::set<std::pair<std::uint32_t, std::set<std::uint32_t>>> right;
        std::vector<std::uint32_t> number(plan.vertex_count);
        for (std::uint32_t v = 0; v < plan.vertex_count; ++v)
            number[plan.original[v]] = v;
        for (const auto& t : scene.bodies[0].mesh.tetrahedra)
            for (const std::uint32_t own : t)
                if (own > 2)
                    right.insert({number[own], {number[t[0]], number[t[1]], number[t[2]], number[t[3]]}});
        CHECK(seen == right);
        CHECK(records == right.size());
    }
}

TEST_CASE("solids take one variant of the sweep, and scenes without them bind nothing more")
{
    Scene scene = solid("neo_hookean", "six");
    CHECK(kernels_of(make_plan(scene, apart())) == std::vector<std::string>{"vbd_solve:elastic"});
    // Guard, limit and momentum of two each.
    CHECK(make_plan(scene, apart()).passes.size() == 2 * (2 + 6 + 3 * 4 + 2 + 2));
    Scene springs = solid("springs", "six");
    CHECK(kernels_of(make_plan(springs, apart())) == std::vector<std::string>{"vbd_solve:volumes"});
    springs.bodies[0].material.stretch_damping = 1;
    CHECK(kernels_of(make_plan(springs, apart())) == std::vector<std::string>{"vbd_solve:volumes_damped"});
    springs.bodies[0].material.stretch_damping = 0;
    scene.bodies.push_back(springs.bodies[0]); // both
    CHECK(kernels_of(make_plan(scene, apart())) == std::vector<std::string>{"vbd_solve:elastic"});
    springs.bodies[0].material.volume_stiffness = 0; // springs alone
    const Plan plain = make_plan(springs, apart());
    CHECK(kernels_of(plain) == std::vector<std::string>{"vbd_solve"});
    CHECK(find_buffer(plain, "corners of hinges and tetrahedra") == nullptr);
    const auto row = find_buffer(plain, "rows");
    springs.bodies[0].material.volume_stiffness = -1; // a word a row more
    CHECK(find_buffer(make_plan(springs, apart()), "rows")->bytes == row->bytes + 4 * (125 + 1));
}

TEST_CASE("rigid volumes are refused as rigid springs are, with the word that would do")
{
    Scene scene = solid("springs", "five");
    scene.bodies[0].material.volume_stiffness = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(make_plan(scene), Contains("volume_stiffness is infinite") && Contains("xpbd"));
    scene.method.type = MethodKind::xpbd;
    CHECK_NOTHROW(make_plan(scene));
}
