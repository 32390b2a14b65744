#include "taut/scene/frame_source.hpp"

#include "point_cache.hpp"
#include "support/catch.hpp"
#include "taut/runtime/base/error.hpp"
#include "temporary.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>

using namespace taut;

namespace fs = std::filesystem;

namespace {

std::string obj(double z, const std::string& face = "f 1 2 3")
{
    return "v 0 0 " + std::to_string(z) + "\nv 1 0 0\nv 0 1 0\n" + face + "\n";
}

std::string refusal(const auto& act)
{
    try
    {
        act();
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("a folder gives its frames in the order of their numbers")
{
    const Temporary folder;
    for (const int k : {10, 2, 1})
        folder.write("mesh_" + std::to_string(k) + ".obj", obj(k));
    folder.write("notes.txt", "no frame");
    const auto frames = open_frame_folder(folder.path);
    REQUIRE(frames->frames() == 3);
    CHECK(frames->triangles() == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK(frames->positions(0)[0].z == 1);
    CHECK(frames->positions(1)[0].z == 2);
    CHECK(frames->positions(2)[0].z == 10);
    folder.write("mesh_2.obj", obj(2, "f 1 3 2"));
    CHECK_THAT(refusal([&] { frames->positions(1); }), Contains("mesh_2.obj: its faces are not those of"));
}

TEST_CASE("a folder that is missing or has no frames is refused by name")
{
    const Temporary folder;
    CHECK_THAT(refusal([&] { open_frame_folder(folder.path); }), Contains("has no file that ends in .obj"));
    CHECK_THAT(refusal([&] { open_frame_folder(folder.path / "gone"); }), Contains("gone cannot be read"));
}

TEST_CASE("a point cache gives the frames of its mesh")
{
    const Temporary folder;
    const fs::path mesh = folder.write("mesh.obj", obj(0));
    std::vector<float> values;
    for (int k = 0; k < 18; ++k)
        values.push_back(0.5f * static_cast<float>(k));
    const auto frames = open_point_cache(folder.write("a.pc2", point_cache(3, 2, values)), mesh);
    REQUIRE(frames->frames() == 2);
    CHECK(frames->positions(1)[0] == glm::dvec3(4.5, 5, 5.5));
    CHECK(frames->positions(0)[2] == glm::dvec3(3, 3.5, 4));
    const auto refused = [&](const std::string& bytes) {
        return refusal([&] { open_point_cache(folder.write("b.pc2", bytes), mesh); });
    };
    CHECK_THAT(refused(point_cache(4, 1, values)), Contains("moves 4 vertices; ") && Contains("has 3"));
    CHECK_THAT(refused(point_cache(3, 3, values)), Contains("has 104 bytes; 3 frames take 140"));
    CHECK_THAT(refused(point_cache(3, 2, values, 2)), Contains("is no point cache"));
    CHECK_THAT(refused("POINT"), Contains("is no point cache"));
    CHECK_THAT(refused(point_cache(3, 0, {})), Contains("there must be one"));
    CHECK_THAT(refusal([&] { open_point_cache(folder.path / "none.pc2", mesh); }),
               Contains("cannot be read"));
}

TEST_CASE("frames say which lines of their mesh are not read: of a folder, of its first file")
{
    const Temporary folder;
    const fs::path first = folder.write("mesh_1.obj", obj(1) + "seam 1 2\n");
    folder.write("mesh_2.obj", obj(2) + "stitch 1 2\n");
    const std::vector<std::string> said{first.string() + " has 1 line \"seam\", which is not read"};
    CHECK(open_frame_folder(folder.path)->messages() == said);
    const fs::path cache = folder.write("a.pc2", point_cache(3, 1, std::vector<float>(9)));
    CHECK(open_point_cache(cache, first)->messages() == said);
    CHECK(open_point_cache(cache, folder.write("clean.obj", obj(0)))->messages().empty());
}
