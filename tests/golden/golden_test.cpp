// Hashes of all position bits after 60 steps. golden.csv holds those of cpu:serial.
//
// They change only when results are meant to change. Then run
//   TAUT_UPDATE_GOLDEN=1 test_golden
// which rewrites tests/golden/golden.csv, and say in the commit why.

#include "golden/scenes.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/report/report.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace taut;

namespace {

constexpr int kSteps = 60;
const std::filesystem::path kFile = TAUT_SOURCE_DIR "/tests/golden/golden.csv";

std::vector<std::string> names()
{
    std::vector<std::string> list;
    for (const auto& [name, scene] : golden::scenes())
        list.push_back(name);
    return list;
}

/// Hash of the positions after so many steps, as 16 hexadecimal digits.
std::string hash_on(const std::shared_ptr<Device>& device, const std::string& name,
                    const WorldOptions& options = {}, int steps = kSteps)
{
    World world(golden::scenes().at(name), device, options);
    for (int i = 0; i < steps; ++i)
        world.step();
    const StepReport report = measure(world);
    CAPTURE(name, report.reason);
    REQUIRE(rank(report.status) < rank(Status::diverged)); // bits are judged here, not solutions
    CHECK(report.max_speed > 0.01);                        // a scene at rest would be no witness
    std::ostringstream text;
    text << std::hex;
    text.width(16);
    text.fill('0');
    text << report.position_hash;
    return text.str();
}

/// Set by ctest: each scene runs on one of the drivers, half of them on Vulkan, a quarter by each of OpenGL's
/// two ways to a shader; alone, all on all.
bool short_run() { return std::getenv("TAUT_GOLDEN_SHORT") != nullptr; }

bool is_run(const std::string& selector, std::size_t scene)
{
    const std::vector<std::string>& all = test_devices();
    const auto has = [&](const char* one) { return std::find(all.begin(), all.end(), one) != all.end(); };
    const bool every = has("vulkan") && has("opengl") && has("opengl:spirv");
    if (!short_run() || !every || selector.starts_with("cpu"))
        return true;
    return selector == "vulkan" ? scene % 2 == 1 : scene % 4 == (selector == "opengl" ? 0 : 2);
}

/// In a short run a third on software drivers for what solves linear systems: hundreds of dispatches a step.
int steps_on(const Device& device, const std::string& name)
{
    const MethodKind method = golden::scenes().at(name).method.type; // of a map that goes with the line
    const bool solves = method == MethodKind::implicit_euler || method == MethodKind::implicit_constraints ||
                        method == MethodKind::acad;
    const bool software = !device.info().executor.starts_with("cpu") && !device.info().hardware_gpu;
    return short_run() && solves && software ? kSteps / 3 : kSteps;
}

/// The hash of cpu:serial, computed once per scene and count of steps.
const std::string& serial_hash(const std::string& name, int steps = kSteps)
{
    static std::map<std::pair<std::string, int>, std::string> known;
    std::string& hash = known[{name, steps}];
    if (hash.empty())
        hash = hash_on(test_device("cpu:serial"), name, {}, steps);
    return hash;
}

std::map<std::string, std::string> committed()
{
    std::map<std::string, std::string> table;
    std::ifstream file(kFile);
    std::string line;
    std::getline(file, line); // scene,steps,hash
    while (std::getline(file, line))
    {
        const auto first = line.find(','), last = line.rfind(',');
        table[line.substr(0, first)] = line.substr(last + 1);
    }
    return table;
}

void rewrite()
{
    const std::filesystem::path temporary = kFile.string() + ".new";
    {
        std::ofstream file(temporary);
        file << "scene,steps,hash\n";
        for (const std::string& name : names())
            file << name << ',' << kSteps << ',' << serial_hash(name) << '\n';
    }
    std::filesystem::rename(temporary, kFile);
}

bool can_run(const Device& device, const std::string& name)
{
    return device.limits().float64 || golden::scenes().at(name).method.precision == Precision::float32;
}

} // namespace

TEST_CASE("sixty steps on the serial processor end at the committed bits")
{
    if (const char* update = std::getenv("TAUT_UPDATE_GOLDEN"); update && std::string(update) == "1")
    {
        rewrite();
        WARN("rewrote " << kFile);
    }
    const auto table = committed();
    CHECK(table.size() == names().size());
    for (const std::string& name : names())
    {
        CAPTURE(name);
        REQUIRE(table.count(name) == 1);
        CHECK(serial_hash(name) == table.at(name));
    }
}

TEST_CASE("the star has a hub, the drape friction and bending, and both precisions are there")
{
    const auto device = test_device("cpu:serial");
    const auto plan_of = [&](const std::string& name) {
        return World(golden::scenes().at(name), device).plan();
    };
    const auto runs = [](const Plan& plan, const std::string& kernel, const std::string& variant) {
        for (const Dispatch& pass : plan.passes)
            if (pass.kernel->name == kernel && pass.kernel->variant == variant)
                return true;
        return false;
    };
    CHECK(runs(plan_of("star"), "xpbd_hub_spring", ""));
    CHECK(runs(plan_of("drape"), "collide_sphere", "friction"));
    CHECK(runs(plan_of("busy"), "collide_sphere", "friction_kept"));
    CHECK(runs(plan_of("busy"), "collide_plane", "friction_kept"));
    CHECK(runs(plan_of("busy"), "pin_motion", ""));
    CHECK(plan_of("busy").constraint_counts().at("bending") > 0);
    CHECK(plan_of("drape_double").precision == Precision::float64);
    CHECK(plan_of("drape").precision == Precision::float32);
}

TEST_CASE("cloth tears and constraints act where the golden scenes are about that")
{
    const auto device = test_device("cpu:serial");
    const auto after = [&](const std::string& name) {
        World world(golden::scenes().at(name), device);
        for (int i = 0; i < kSteps; ++i)
            world.step();
        return world;
    };
    CHECK(after("tear").torn() > 0);
    World folds(golden::scenes().at("contact"), device);
    std::size_t steps_met = 0;
    for (int i = 0; i < kSteps; ++i)
    {
        folds.step();
        steps_met += folds.contacts().pairs > 0 ? 1 : 0;
    }
    CAPTURE(steps_met);
    CHECK(steps_met > kSteps / 2);
    CHECK(after("guarded").contacts().filtered > 0);
    for (const std::string name : {"acad", "acad_compress"})
    {
        CAPTURE(name);
        World world(golden::scenes().at(name), device);
        double least = 1, most = 0;
        for (int i = 0; i < kSteps; ++i)
        {
            world.step();
            least = std::min(least, world.active_share());
            most = std::max(most, world.active_share());
        }
        CHECK(least < most);
        CHECK(most > 0.01);
    }
}

TEST_CASE("every kernel of a step is dispatched by a golden scene")
{
    const auto device = test_device("cpu:serial");
    std::set<std::string> seen, missing;
    // Of `taut solve`: no step has them.
    const std::set<std::string> others{"cg_small",   "chebyshev", "coo_carry", "spmv_coo", "spmv_csr_long",
                                       "spmv_dense", "spmv_ell",  "spmv_sell", "stencil7"};
    for (const std::string& name : names())
    {
        const World world(golden::scenes().at(name), device);
        for (const Dispatch& pass : world.plan().passes)
            seen.insert(std::string(pass.kernel->name));
    }
    for (const KernelInfo* kernel : all_kernels())
        if (seen.count(std::string(kernel->name)) + others.count(std::string(kernel->name)) == 0)
            missing.insert(std::string(kernel->name));
    std::string list;
    for (const std::string& name : missing)
        list += name + " ";
    CHECK(list == "");
}

TEST_CASE("every buffer of a plan is bound by a dispatch of its step")
{
    const auto device = test_device("cpu:serial");
    for (const std::string& name : names())
    {
        const World world(golden::scenes().at(name), device);
        const Plan& plan = world.plan();
        std::vector<bool> bound(plan.buffers.size());
        for (const Dispatch& pass : plan.passes)
        {
            for (const BufferRange& range : pass.bindings)
                bound[range.buffer] = true;
            if (pass.indirect.buffer != kNoBuffer)
                bound[pass.indirect.buffer] = true;
        }
        std::string idle;
        for (std::size_t k = 0; k < bound.size(); ++k)
            idle += bound[k] ? "" : plan.buffers[k].effect + " \"" + plan.buffers[k].name + "\" ";
        CAPTURE(name);
        CHECK(idle == "");
    }
}

TEST_CASE("every scene of the golden table ends somewhere else")
{
    std::set<std::string> hashes;
    for (const std::string& name : names())
        hashes.insert(serial_hash(name));
    CHECK(hashes.size() == names().size());
}

TEST_CASE("every executor that rounds as C++ does ends at the same bits, and every other one repeats itself")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto device = test_device(selector);
    std::size_t scene = 0;
    for (const std::string& name : names())
    {
        if (!is_run(selector, scene++) || !can_run(*device, name))
            continue;
        CAPTURE(selector, name);
        const int steps = steps_on(*device, name);
        const std::string hash = hash_on(device, name, {}, steps);
        if (device->info().hardware_gpu)
            CHECK(hash_on(device, name, {}, steps) == hash);
        else
            CHECK(hash == serial_hash(name, steps));
    }
}

TEST_CASE("the order of elements within a pass has no say, whatever the seed of the shuffle")
{
    for (const std::uint64_t seed : {2u, 3u, 77u})
    {
        OpenOptions options;
        options.seed = seed;
        const auto device = Device::open("cpu:shuffled", options);
        for (const std::string name : {"busy", "chain", "drape_double"})
        {
            CAPTURE(seed, name);
            CHECK(hash_on(device, name) == serial_hash(name));
        }
    }
}

TEST_CASE("the number of threads has no say")
{
    for (const unsigned threads : {1u, 2u, 5u})
    {
        OpenOptions options;
        options.threads = threads;
        const auto device = Device::open("cpu", options);
        for (const std::string name : {"busy", "drape"})
        {
            CAPTURE(threads, name);
            CHECK(hash_on(device, name) == serial_hash(name));
        }
    }
}

TEST_CASE("running small bodies in one group, or a dispatch a colour, is a choice of speed alone")
{
    const auto device = test_device("cpu:serial");
    WorldOptions always, never;
    always.plan.small_bodies = PlanOptions::SmallBodies::always;
    never.plan.small_bodies = PlanOptions::SmallBodies::never;
    for (const std::string& name : names())
    {
        CAPTURE(name);
        const Scene scene = golden::scenes().at(name);
        const auto passes = [&](const WorldOptions& options) {
            return World(scene, device, options).plan().passes.size();
        };
        // A hub needs dispatches of its own; the colours of small solids share one group anyway.
        if (scene.method.type == MethodKind::xpbd && name != "star" && name != "jelly" &&
            !name.starts_with("cube"))
            CHECK(passes(always) < passes(never));
        CHECK(hash_on(device, name, always) == serial_hash(name));
        CHECK(hash_on(device, name, never) == serial_hash(name));
    }
}

TEST_CASE("keeping multipliers for the residuals does not change the motion")
{
    const auto device = test_device("cpu:serial");
    for (const std::string& name : names())
    {
        CAPTURE(name);
        WorldOptions options;
        options.plan.residuals = true;
        CHECK(hash_on(device, name, options) == serial_hash(name));
    }
}
