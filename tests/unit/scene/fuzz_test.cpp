// Thousands of damaged files. Each must end in a mesh or scene that keeps its promises, or in Error.

#include "child.hpp"
#include "mutate.hpp"
#include "seeds.hpp"
#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/raw_solid.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/weld.hpp"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

using namespace taut;

#if defined(TAUT_TEST_ASAN)
// No small file may ask for much memory; without sanitizers the address-space limit says the same.
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=256"; }
#endif

namespace {

void require(bool good, const char* promise)
{
    if (!good)
        throw std::logic_error(promise);
}

void require_sound(const Mesh& mesh, const MeshFindings& findings)
{
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
        {
            require(corner < mesh.positions.size(), "an index is out of range");
            used[corner] = true;
        }
    for (const auto& triangle : mesh.triangles)
        require(triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0],
                "a triangle repeats a corner");
    for (std::size_t v = 0; v < used.size(); ++v)
    {
        require(used[v], "a vertex belongs to no triangle");
        for (int c = 0; c < 3; ++c)
            require(std::isfinite(mesh.positions[v][c]), "a coordinate is not finite");
    }
    for (const auto& edge : findings.non_manifold_edges)
        require(edge[0] < edge[1] && edge[1] < mesh.positions.size(), "a named edge does not exist");
}

bool read_damaged(const seeds::Seed& file, std::uint64_t seed)
{
    const double weld[] = {0, 0.05, -1};
    MeshFindings findings;
    try
    {
        const std::string text = seed == 0 ? file.text : mutate::damage(file.text, seed);
        require_sound(scene_file::parse_mesh(text, "." + file.extension, "damaged", weld[seed % 3], findings),
                      findings);
        return true;
    }
    catch (const Error& error)
    {
        require(error.code() == ErrorCode::bad_input, "another code than bad_input");
        require(std::string(error.what()).starts_with("damaged: "),
                "the message does not start with the file");
        return false;
    }
}

void require_sound_solid(const Mesh& mesh)
{
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& corners : mesh.tetrahedra)
    {
        for (const std::uint32_t corner : corners)
        {
            require(corner < mesh.positions.size(), "an index is out of range");
            used[corner] = true;
        }
        require(six_volumes(mesh.positions, corners) > 0, "a tetrahedron is not right-handed");
    }
    for (std::size_t v = 0; v < used.size(); ++v)
    {
        require(used[v], "a vertex belongs to no tetrahedron");
        for (int c = 0; c < 3; ++c)
            require(std::isfinite(mesh.positions[v][c]), "a coordinate is not finite");
    }
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            require(corner < mesh.positions.size(), "an index of the surface is out of range");
}

Mesh parse_solid(const seeds::Seed& file, const std::string& text)
{
    const std::string name = "damaged",
                      sound = file.extension == "node" ? seeds::solids()[2].text : seeds::solids()[1].text;
    MeshFindings findings;
    if (file.extension == "node")
        return scene_file::parse_tetgen({text, name}, {sound, name}, findings);
    if (file.extension == "ele")
        return scene_file::parse_tetgen({sound, name}, {text, name}, findings);
    return scene_file::parse_tetrahedra(text, "." + file.extension, name, findings);
}

bool read_damaged_solid(const seeds::Seed& file, std::uint64_t seed)
{
    try
    {
        require_sound_solid(parse_solid(file, seed == 0 ? file.text : mutate::damage(file.text, seed)));
        return true;
    }
    catch (const Error& error)
    {
        require(error.code() == ErrorCode::bad_input || error.code() == ErrorCode::degenerate_rest,
                "another code than bad_input or degenerate_rest");
        require(std::string(error.what()).starts_with("damaged: "),
                "the message does not start with the file");
        return false;
    }
}

/// More with TAUT_FUZZ_SEEDS=100000 in the environment.
std::uint64_t seed_count(std::uint64_t usual)
{
    const char* text = std::getenv("TAUT_FUZZ_SEEDS");
    return text ? std::strtoull(text, nullptr, 10) : usual;
}

std::string text_of(const std::string& path)
{
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

const char* const kFullScene = R"({
  "taut": 1, "name": "all", "timestep": 0.01, "duration": 1, "gravity": [0, -9.81, 0], "damping": 0.1,
  "max_speed": 50, "depenetration_speed": 0.5, "external_forces": false,
  "method": {"type": "xpbd", "substeps": 4, "iterations": 2, "precision": "double"},
  "bodies": [
    {"name": "a", "grid": {"cells": [3, 2], "size": [1, 2], "diagonals": "uniform"},
     "material": {"density": 0.1, "stretch_stiffness": "rigid", "bending_stiffness": 1e-4, "thickness": 0.01},
     "transform": {"translate": [0, 1, 0], "rotate": {"axis": [1, 0, 0], "degrees": 90}, "scale": 2},
     "velocity": [0, 0, 1],
     "pins": [{"corners": ["top_left"], "motion": [{"time": 0}, {"time": 1, "translate": [1, 0, 0],
               "rotate": {"axis": [0, 1, 0], "degrees": 90, "centre": [0, 0, 0]}}]},
              {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}, {"edge": "bottom"}, {"vertices": [1, 2]}],
     "springs": [{"a": 0, "b": 5, "rest_length": 1.5, "compliance": 1e-6}]},
    {"chain": {"links": 2, "length": 1, "width": 0.02}, "pins": [{"corner": "first"}],
     "vertex_masses": [1, 1, 2], "start_positions": [[0, 0, 0], [0, 1, 0], [0, 2, 0]]}],
  "colliders": [{"name": "p", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.5},
                {"name": "s", "sphere": {"centre": [0, 0, 0], "radius": 1}, "motion": [{"time": 0}]}]
})";

bool parse_damaged(const std::string& text, std::uint64_t seed)
{
    try
    {
        const Scene scene = parse_scene(seed == 0 ? text : mutate::damage(text, seed), "nowhere", "damaged");
        bool small = true; // a grid of millions is a fair wish, but not here
        for (const Body& body : scene.bodies)
            small =
                small && double(body.shape.cells.x) * body.shape.cells.y < 1e4 && body.shape.links < 10000;
        if (check(scene).empty() && small)
            resolve(scene);
        return true;
    }
    catch (const Error& error)
    {
        require(error.what()[0] != '\0', "an error without a message");
        return false;
    }
}

} // namespace

TEST_CASE("no damaged mesh file crashes, hangs or fills the memory")
{
    for (const seeds::Seed& file : seeds::meshes())
    {
        const auto outcome =
            child::run(seed_count(4000), [&](std::uint64_t seed) { return read_damaged(file, seed); });
        INFO(file.extension << " from\n" << file.text.substr(0, 60));
        CHECK(outcome.failures == "");
        // Damage that is never refused, or always, would test nothing.
        CHECK(outcome.accepted > 0);
        CHECK(outcome.refused > 0);
    }
}

TEST_CASE("no damaged file of tetrahedra crashes, hangs or fills the memory")
{
    for (const seeds::Seed& file : seeds::solids())
    {
        const auto outcome =
            child::run(seed_count(4000), [&](std::uint64_t seed) { return read_damaged_solid(file, seed); });
        INFO(file.extension << " from\n" << file.text.substr(0, 60));
        CHECK(outcome.failures == "");
        CHECK(outcome.accepted > 0);
        CHECK(outcome.refused > 0);
    }
}

TEST_CASE("no damaged scene file crashes, hangs or fills the memory")
{
    const std::string drape = text_of(TAUT_SOURCE_DIR "/examples/scenes/drape.json");
    REQUIRE(!drape.empty());
    for (const std::string& text : {std::string(kFullScene), drape})
    {
        const auto outcome =
            child::run(seed_count(8000), [&](std::uint64_t seed) { return parse_damaged(text, seed); });
        CHECK(outcome.failures == "");
        CHECK(outcome.accepted > 0);
        CHECK(outcome.refused > 0);
    }
}

TEST_CASE("the fuzzer sees a crash, a hang, a broken promise and an absurd allocation")
{
    const auto crash = child::run(3, [](std::uint64_t seed) -> bool {
        if (seed == 1)
            raise(SIGSEGV);
        return true;
    });
    CHECK(crash.accepted == 2);
    CHECK(crash.failures.find("seed 1: ") == 0);
    const auto hang = child::run(1,
                                 [](std::uint64_t) -> bool {
                                     volatile bool on = true;
                                     while (on)
                                     {}
                                     return on;
                                 },
                                 {.cpu_seconds = 1});
    CHECK(hang.failures.find("seed 0: signal") == 0);
    const auto promise = child::run(1, [](std::uint64_t) -> bool { throw std::logic_error("broken"); });
    CHECK(promise.failures == "seed 0: exit 1 broken\n");
#if !defined(TAUT_TEST_ASAN)
    const auto memory = child::run(1, [](std::uint64_t) -> bool {
        const std::string much(std::size_t(1) << 31, 'x');
        const volatile char* const seen = much.data(); // or a compiler leaves the string out
        return seen[much.size() - 1] == 'x';
    });
    CHECK(memory.failures.find("seed 0: exit 1") == 0);
#endif
}
