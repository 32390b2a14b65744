// taut_lanes_bench: ns per element of kernels with the line "//! lanes", one at a time and eight at a time.
// Prints the table of docs/lanes.md. Exit status 1 when the two ways differ in one bit.
//
// A native kernel is called for a range of elements, so no device is involved. Ranges of seven make no block
// of eight: all of it runs one at a time, with a seventh of a call more per element.

#include "taut/plan/plan.hpp"
#include "taut/scene/scene.hpp"
#include "taut/world/inputs.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace taut;

constexpr int kRuns = 60;

/// Level cloth that falls on two colliders.
Scene cloth(const std::string& method, ColliderKind first, ColliderKind second)
{
    Scene scene;
    Body body;
    body.shape.cells = {255, 255};
    body.shape.size = {2, 2};
    body.transform.translate = {0, 0.5, 0};
    body.material.bending_stiffness = 1e-5;
    body.material.strain_limit = 0.02;
    scene.bodies = {body};
    for (const ColliderKind kind : {first, second})
    {
        Collider collider;
        collider.kind = kind;
        collider.radius = 0.25;
        if (kind != ColliderKind::plane)
            collider.point = {0, 0.3, 0};
        scene.colliders.push_back(collider);
    }
    scene.damping = 0.5;
    scene.method.type = option_named<MethodKind>(method);
    return resolve(scene);
}

Scene solid(const std::string& method, const std::string& model)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {24, 24, 24};
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(method);
    return resolve(scene);
}

/// The buffers of a plan in plain memory, each on pages of its own and further into them than the one before.
class Memory
{
public:
    Memory(const Scene& scene, const Plan& plan)
    {
        for (const PlanBuffer& b : plan.buffers)
        {
            const std::size_t place = blocks_.size() * 1600 % 4096;
            blocks_.push_back(std::make_unique<std::byte[]>(b.bytes + 3 * 4096));
            const auto address = reinterpret_cast<std::uintptr_t>(blocks_.back().get());
            data_.push_back(blocks_.back().get() + (4096 - address % 4096) + place);
            bytes_.push_back(b.bytes);
            std::copy(b.initial.begin(), b.initial.end(), data_.back());
        }
        for (const InputWrite& w : step_inputs(scene, plan, {0, scene.timestep}))
            std::copy(w.bytes.begin(), w.bytes.end(), data_[w.buffer]);
    }

    std::vector<void*> of(const Dispatch& pass) const
    {
        std::vector<void*> out;
        for (const BufferRange& r : pass.bindings)
            out.push_back(data_[r.buffer] + r.offset);
        return out;
    }

    bool same_as(const Memory& other) const
    {
        for (std::size_t i = 0; i < data_.size(); ++i)
            if (std::memcmp(data_[i], other.data_[i], bytes_[i]) != 0)
                return false;
        return true;
    }

private:
    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    std::vector<std::byte*> data_;
    std::vector<std::uint64_t> bytes_;
};

void run(const Dispatch& pass, const Memory& memory, std::uint32_t at_once)
{
    const std::vector<void*> buffers = memory.of(pass);
    for (std::uint32_t begin = 0; begin < pass.count; begin += std::min(at_once, pass.count - begin))
        pass.kernel->native(pass.params.data(), buffers.data(), begin,
                            begin + std::min(at_once, pass.count - begin));
}

/// Least time of a pass, ns per element.
double least(const Dispatch& pass, const Memory& memory, std::uint32_t at_once)
{
    double best = 1e300;
    for (int i = 0; i < kRuns; ++i)
    {
        const auto from = std::chrono::steady_clock::now();
        run(pass, memory, at_once);
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - from;
        best = std::min(best, took.count());
    }
    return best / pass.count;
}

/// A step in both ways, which must agree, then the largest pass of every kernel that has not been seen yet.
void measure(const Scene& scene, const std::vector<std::string>& kernels)
{
    const Plan plan = make_plan(scene);
    const Memory single(scene, plan), lanes(scene, plan);
    std::map<std::string, const Dispatch*> largest;
    for (const Dispatch& pass : plan.passes)
    {
        run(pass, single, pass.kernel->group_kernel ? pass.count : 7);
        run(pass, lanes, pass.count);
        const Dispatch*& best = largest[std::string(pass.kernel->name)];
        if (!pass.kernel->group_kernel && (!best || best->count < pass.count))
            best = &pass;
    }
    if (!single.same_as(lanes))
        throw std::runtime_error("one at a time and several at a time give different bits");
    for (const std::string& name : kernels)
    {
        const Dispatch* pass = largest[name];
        if (!pass)
            throw std::runtime_error("the scene has no pass of " + name);
        std::printf("| %s | %u | %.2f | %.2f |\n", name.c_str(), pass->count, least(*pass, single, 7),
                    least(*pass, lanes, pass->count));
        std::fflush(stdout);
    }
}

} // namespace

int main()
try
{
    std::printf("| kernel | elements | one at a time | lanes |\n|---|---|---|---|\n");
    using enum ColliderKind;
    measure(cloth("xpbd", plane, sphere),
            {"xpbd_spring", "xpbd_hinge", "predict", "finish", "damping", "strain_limit", "collide_plane",
             "collide_sphere"});
    measure(cloth("xpbd", capsule, cuboid), {"collide_capsule", "collide_cuboid"});
    measure(cloth("pbd", plane, sphere), {"pbd_spring", "pbd_hinge"});
    measure(solid("xpbd", "springs"), {"xpbd_volume"});
    measure(solid("xpbd", "neo_hookean"), {"neo_hookean"});
    measure(solid("pbd", "springs"), {"pbd_volume"});
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_lanes_bench: %s\n", error.what());
    return 1;
}
