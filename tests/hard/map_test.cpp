// F8: every hard case under every method: it passes, is refused in words, or says that it misses.

#include "hard/map.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>

namespace taut::hard {
namespace {

void look(const World& world, Journey& out)
{
    const StepReport report = measure(world);
    out.highest_energy = std::max(out.highest_energy, energy(report));
    out.fastest = std::max(out.fastest, report.max_speed);
    out.stretch = std::max(out.stretch, report.max_stretch);
    out.deepest = std::max(out.deepest, report.penetration);
    out.volume = std::max(out.volume, std::abs(report.volume.ratio - 1));
    out.last = report;
}

/// What energies are compared with: a fall through the body's own size, and what is there at the start.
double energy_scale(const World& world, const StepReport& first)
{
    const PhysicalModel model = make_model(world.scene());
    const double elastic = first.potential_energy - gravity_energy(model, world.positions());
    const double scale = total_weight(model) * model.diameter + first.kinetic_energy + std::max(elastic, 0.0);
    return scale > 0 ? scale : 1;
}

/// "FAIL: ..." for a state that must not be; empty else.
std::string unsound(const World& world, const StepReport& report)
{
    if (!finite(world.positions()) || !finite(world.velocities()))
        return "FAIL: a value that is not finite";
    if (report.status == Status::completed)
        return {};
    return "stops: " + std::string(to_string(report.status));
}

/// The kinematic bound of what may be reported: a projection moves a vertex by about what is violated, a
/// body's size, and nothing by ten of them in a substep.
Missed bounded(const Journey& j, const Missed& missed)
{
    const PhysicalModel model = make_model(j.world.scene());
    glm::dvec3 low(kInfinity), high(-kInfinity);
    for (const glm::dvec3& x : j.start)
    {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const double size = std::max(model.diameter, j.start.empty() ? 0 : glm::distance(low, high));
    const double substep = j.world.plan().timestep / j.world.plan().substeps;
    if (missed.words.empty() || j.fastest * substep <= 10 * size)
        return missed;
    return missed.words + ", and " + shown(j.fastest, 3) + " m/s";
}

} // namespace

void set_method(Scene& scene, MethodKind method)
{
    MethodSettings& m = scene.method;
    m.type = kMethodNames[static_cast<std::size_t>(method)];
    m.iterations = 1;
    m.substeps = 10;
    switch (method)
    {
    case MethodKind::implicit_euler: m.substeps = 4, m.iterations = 2; break;
    case MethodKind::implicit_constraints:
        m.substeps = 5, m.iterations = 2, m.linear_operator = "matrix_free";
        break;
    case MethodKind::pbd: m.iterations = 2; break;
    case MethodKind::vbd: m.substeps = 5, m.iterations = 4; break;
    case MethodKind::mass_spring: // as many substeps as they need: what they refuse then is out of reach
    case MethodKind::acad: m.stability = "substep"; break;
    case MethodKind::xpbd: break;
    }
    for (Body& body : scene.bodies)
    {
        if (!find_method(method).elastic && is_solid(body.shape.kind))
            body.material.model = "springs";
        if (!find_method(method).volumes && body.material.volume != "surface")
            body.material.volume_stiffness = 0;
    }
}

namespace {

/// Runs a world of the case and looks at it on the way.
Missed judged_run(const MapCase& hard_case, const Scene& scene, const std::shared_ptr<Device>& device,
                  int steps, bool judged)
{
    World world(scene, device);
    Journey journey{world, world.positions(), measure(world), {}};
    journey.scale = energy_scale(world, journey.first);
    journey.highest_energy = energy(journey.first);
    const int every = steps > 5000 ? 1000 : 10;
    for (int k = 0; k < steps; ++k)
    {
        if (hard_case.before_step)
            hard_case.before_step(world, k);
        world.step();
        if (k < 5 || k % every == every - 1 || k + 1 == steps)
            look(world, journey);
    }
    const std::string wrong = unsound(world, journey.last);
    if (!wrong.empty())
        return wrong;
    return judged ? bounded(journey, hard_case.judge(journey)) : Missed("sound so far");
}

bool is_verdict(const std::string& text)
{
    return text.rfind("FAIL", 0) == 0 || text.rfind("stops", 0) == 0 || text.rfind("sound", 0) == 0;
}

} // namespace

std::string verdict(const MapCase& hard_case, MethodKind method, const std::shared_ptr<Device>& device,
                    bool whole)
{
    Scene scene = hard_case.scene;
    set_method(scene, method);
    const int all = short_run() && hard_case.short_steps > 0 ? hard_case.short_steps : hard_case.steps;
    try
    {
        const Missed missed =
            hard_case.check
                ? hard_case.check(scene, device, whole ? all : std::min(all, kStepsElsewhere))
                : judged_run(hard_case, scene, device,
                             whole ? all : std::min(all, short_run() ? kStepsShort : kStepsSound), whole);
        if (missed.words.empty())
            return "pass";
        if (is_verdict(missed.words))
            return missed.words;
        const bool may = (hard_case.may_report & only(method)) != 0 && missed.value <= missed.worst;
        return (may ? "reports: " : "FAIL: ") + missed.words;
    }
    catch (const Error& error)
    {
        return "refuses: " + std::string(to_string(error.code()));
    }
}

namespace {

using Table = std::vector<std::vector<std::string>>;

/// How many cells of each method begin with each word.
std::string counts(const Table& table)
{
    std::string text = "| cells | pass | refuses | stops | reports |\n|---|---:|---:|---:|---:|\n";
    for (std::size_t m = 0; m < kMethodNames.size(); ++m)
    {
        text += "| " + std::string(kMethodNames[m]) + " |";
        for (const char* word : {"pass", "refuses", "stops", "reports"})
            text +=
                " " +
                std::to_string(std::count_if(table.begin(), table.end(),
                                             [&](const auto& row) { return row[m].rfind(word, 0) == 0; })) +
                " |";
        text += "\n";
    }
    return text;
}

/// The page, in Markdown: one row a case, one column a method.
std::string page(const std::vector<MapCase>& cases, const Table& table)
{
    std::string text = "| case | what |";
    for (const std::string_view name : kMethodNames)
        text += " " + std::string(name) + " |";
    text += "\n|---|---|";
    for (std::size_t m = 0; m < kMethodNames.size(); ++m)
        text += "---|";
    text += "\n";
    for (std::size_t c = 0; c < cases.size(); ++c)
    {
        text += "| " + cases[c].id + " | " + cases[c].what + " |";
        for (const std::string& cell : table[c])
            text += " " + cell + " |";
        text += "\n";
    }
    return text + "\n" + counts(table);
}

} // namespace

namespace {

/// So little work that it is run whole, and judged, on the processor's other executors too.
bool cheap(const MapCase& c)
{
    std::size_t vertices = 0;
    for (const Body& body : c.scene.bodies)
        vertices += body.mesh.positions.size();
    return vertices * static_cast<std::size_t>(c.steps) <= (short_run() ? 2000 : 20000);
}

bool compares_bits(const MapCase& c) { return c.check && (c.id[0] == 'G' || c.id == "C04"); }

} // namespace

TEST_CASE("F8: the robustness map has no FAIL [hard]")
{
    std::vector<MapCase> cases = map_cases();
    if (const char* id = std::getenv("TAUT_MAP_ONLY")) // rows of one case, for whoever works on it
        std::erase_if(cases, [&](const MapCase& c) { return c.id != id; });
    for (const std::string& selector : test_devices())
    {
        if (short_run() && selector.starts_with("opengl"))
            continue;
        const bool only_checks = short_run() && !selector.starts_with("cpu");
        const auto device = test_device(selector);
        const bool serial = selector == "cpu:serial";
        Table table(cases.size());
        for (std::size_t c = 0; c < cases.size(); ++c)
            for (std::size_t m = 0; m < kMethodNames.size(); ++m)
            {
                if (only_checks && !compares_bits(cases[c]))
                    continue;
                const bool here = serial || (selector.starts_with("cpu") && cheap(cases[c]));
                const bool whole = here && !(short_run() && cases[c].short_steps < 0);
                if (short_run() && !serial && cases[c].short_steps != 0)
                    continue;
                const auto method = static_cast<MethodKind>(m);
                table[c].push_back(verdict(cases[c], method, device, whole));
                INFO(selector << ", " << kMethodNames[m] << ", " << cases[c].id << " " << cases[c].what);
                CHECK(table[c].back().rfind("FAIL", 0) != 0);
                if (table[c].back().rfind("FAIL", 0) == 0)
                    WARN(selector << ", " << kMethodNames[m] << ", " << cases[c].id << ": "
                                  << table[c].back());
            }
        if (const char* file = std::getenv("TAUT_MAP"); file && serial)
            write_file(file, page(cases, table));
        CHECK(device->counters().validation_messages == 0);
    }
}

} // namespace taut::hard
