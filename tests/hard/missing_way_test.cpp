// What load_way says is missing against what is missing: random bodies at rest, swept too few times, beside
// the same ones in fp64 with 400 substeps.

#include "hard/cases.hpp"

#include "taut/report/load_residual.hpp"
#include "taut/report/residuals.hpp"

namespace taut::hard {
namespace {

using conformance::Random;

double power(Random& random, double low, double high) { return std::pow(10, random.uniform(low, high)); }

/// Cloth held by its upper edge, by one corner or by two.
void hang(Scene& scene, Random& random)
{
    Pin pin;
    const std::uint32_t way = random.below(3);
    if (way == 0)
        pin.edges = {"top"};
    else
        pin.corners = way == 1 ? std::vector<std::string>{"top_left"}
                               : std::vector<std::string>{"top_left", "top_right"};
    scene.bodies[0].pins = {pin};
    scene.bodies[0].material.bending_stiffness = power(random, -6, -3);
}

/// A strip that sticks out from its first row of cells, and bends by a hundredth of its length to all of it.
void stick_out(Scene& scene, Random& random, const char* bending_model)
{
    Body& body = scene.bodies[0];
    const double length = body.shape.size.x;
    body.shape.cells = {8, 2};
    body.shape.size.y = length / 4;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.material.bending_model = option_named<BendingModel>(bending_model);
    body.material.bending_stiffness =
        body.material.density * 9.81 * length * length * length * power(random, -2, 0.5);
    Pin pin;
    pin.use_box = true;
    pin.box_min = {-9, -9, -9};
    pin.box_max = {-0.35 * length, 9, 9};
    body.pins = {pin};
}

/// A fabric that hangs, or is spanned between two edges.
void weave(Scene& scene, Random& random)
{
    hang(scene, random);
    Body& body = scene.bodies[0];
    Fabric& fabric = body.material.fabric;
    fabric.used = true;
    fabric.warp = fabric.weft = power(random, 2.5, 4.5);
    fabric.shear = fabric.warp * random.uniform(0.02, 0.3);
    body.material.stretch_stiffness = 0;
    if (random.below(2) == 0)
    {
        body.pins[0] = {};
        body.pins[0].edges = {"left", "right"};
    }
}

/// A bar held by its left end.
void solid(Scene& scene, Random& random)
{
    Body& body = scene.bodies[0];
    const double length = body.shape.size.x;
    body.shape = {};
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {6, 2, 2};
    body.shape.box_size = {length, length / 3, length / 3};
    body.material = solid_material();
    body.material.youngs_modulus = power(random, 4, 7);
    body.material.poissons_ratio = 0.3;
    body.pins[0] = {};
    body.pins[0].faces = {"left"};
}

Scene random_scene(Random& random, std::uint32_t kind)
{
    Scene scene;
    Body body;
    const double size = power(random, -1.3, 0.5);
    body.shape.cells = {8, 8};
    body.shape.size = {size, size};
    body.material.density = 0.2;
    body.material.stretch_stiffness = power(random, 2.5, 5.5);
    body.pins.emplace_back();
    scene.bodies = {body};
    scene.damping = 5;
    scene.method.type = MethodKind::xpbd;
    switch (kind % 5)
    {
    case 0: hang(scene, random); break;
    case 1: stick_out(scene, random, "hinge"); break;
    case 2: stick_out(scene, random, "plate"); break;
    case 3: weave(scene, random); break;
    default: solid(scene, random);
    }
    return scene;
}

struct End
{
    StepReport report;
    std::vector<glm::dvec3> x;
};

End end_of(Scene scene, std::uint32_t substeps, const char* precision)
{
    scene.method.substeps = substeps;
    scene.method.precision = option_named<Precision>(precision);
    World world(resolve(scene), test_device("cpu:serial"));
    run(world, 240);
    End out{measure(world), world.positions()};
    judge_residuals(world.scene(), residuals_ahead(world), out.report);
    return out;
}

/// Mean distance over the diagonal of the box of `right`.
double missing(const std::vector<glm::dvec3>& x, const std::vector<glm::dvec3>& right)
{
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        low = glm::min(low, right[i]);
        high = glm::max(high, right[i]);
        sum += glm::distance(x[i], right[i]);
    }
    return sum / (static_cast<double>(x.size()) * glm::distance(low, high));
}

} // namespace

TEST_CASE("bodies that xpbd leaves too soft are named, and those that it does not are not [hard]")
{
    Random random(71);
    const std::uint32_t scenes = short_run() ? 10 : 100;
    std::uint32_t named = 0, far = 0;
    for (std::uint32_t k = 0; k < scenes; ++k)
    {
        const Scene scene = random_scene(random, k);
        const End right = end_of(scene, 400, "double");
        REQUIRE(right.report.status == Status::completed);
        for (const std::uint32_t substeps : {5u, 10u, 20u})
        {
            const End end = end_of(scene, substeps, "float");
            if (rank(end.report.status) > rank(Status::unconverged))
                continue; // blown up, and said to be
            const double off = missing(end.x, right.x);
            INFO("scene " << k << ", " << substeps << " substeps: " << off
                          << " of its size is missing, share " << end.report.load_residual << ", way "
                          << end.report.load_way << ", " << end.report.reason);
            const bool by_loads = end.report.reason.find("hold its loads") != std::string::npos;
            named += by_loads ? 1 : 0;
            far += off > 0.03 ? 1 : 0;
            CHECK((!by_loads || off > 0.0025)); // a quarter of what is accepted
            // Off by less than a quarter of what its loads move it is accepted, however soft the body.
            const bool accepted = end.report.load_residual < kLoadShare;
            CHECK((off < 0.03 || accepted || end.report.status == Status::unconverged));
        }
    }
    note("missing way", *test_device("cpu:serial"), "named by their loads", named);
    note("missing way", *test_device("cpu:serial"), "further off than 3 %", far);
    CHECK(named > scenes / 4);
}

TEST_CASE("a bar that sags too far by little beside its sag is said to be soft [hard]")
{
    Scene scene;
    Body& bar = scene.bodies.emplace_back();
    bar.shape.kind = ShapeKind::box;
    bar.shape.box_cells = {8, 2, 2};
    bar.shape.box_size = {0.5, 0.5 / 6, 0.5 / 6};
    bar.material = solid_material();
    bar.material.density = 1000;
    bar.material.youngs_modulus = 3e5;
    bar.material.poissons_ratio = 0.45;
    bar.pins.emplace_back().faces = {"left"};
    scene.damping = 5;
    const auto soft = [](const End& end) { return end.report.warnings.contains("soft"); };
    const End right = end_of(scene, 300, "double"), usual = end_of(scene, 0, "float");
    INFO("way " << usual.report.load_way << ", share " << usual.report.load_residual);
    CHECK(missing(usual.x, right.x) > 0.015);
    CHECK(usual.report.load_residual < kLoadShare); // little beside what its loads move
    CHECK(usual.report.status == Status::completed);
    CHECK(soft(usual));
    CHECK_FALSE(soft(right));
}

} // namespace taut::hard
