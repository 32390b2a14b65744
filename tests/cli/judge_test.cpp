// taut judge: scenes, folders and point caches, and what it refuses.

#include "cli/program.hpp"
#include "support/catch.hpp"
#include "unit/scene/point_cache.hpp"

using program::Folder;
using program::Result;

namespace {

/// Two sheets of 4 x 4 cells, the upper one `height` above the lower; nothing keeps them apart.
std::string falling_sheet(double height)
{
    const std::string flat = R"("rotate": {"axis": [1, 0, 0], "degrees": -90})";
    return R"({"taut": 1, "timestep": 0.02, "duration": 1, "bodies": [
        {"grid": {"cells": [4, 4], "size": [1, 1]}, "transform": {)" +
           flat + R"(},
         "pins": [{"corners": ["top_left", "top_right", "bottom_left", "bottom_right"]}]},
        {"grid": {"cells": [3, 3], "size": [0.4, 0.4]}, "velocity": [0, -2, 0],
         "transform": {"translate": [0.1, )" +
           std::to_string(height) + ", 0.1], " + flat + "}}]}";
}

std::string triangle_at(double z)
{
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 " + std::to_string(z) + "\nv 0.3 0.2 " +
           std::to_string(z + 1) + "\nv 0.2 0.3 " + std::to_string(z + 1) + "\nf 1 2 3\nf 4 5 6\n";
}

} // namespace

TEST_CASE("a folder of frames is judged: exit status 1 from where a triangle is pierced")
{
    const Folder folder;
    folder.file("f_1.obj", triangle_at(0.5));
    folder.file("f_2.obj", triangle_at(0.25));
    const Result clean = folder.taut({"judge", ".", "--json"});
    CHECK(clean.status == 0);
    const auto before = program::parse(clean.out);
    CHECK(before["frames"] == 2);
    CHECK(before["frames_with_crossings"] == 0);
    CHECK(before["judged"][1]["min_distance"] == Approx(0.25));
    CHECK(before["judged"][1]["min_distance_of_parts"] == Approx(0.25));
    folder.file("f_10.obj", triangle_at(-0.25));
    const Result pierced = folder.taut({"judge", ".", "--json"});
    CHECK(pierced.status == 1);
    const auto after = program::parse(pierced.out);
    CHECK(after["frames_with_crossings"] == 1);
    CHECK(after["judged"][2]["intersecting_pairs"] == 1);
    CHECK(after["judged"][2]["first_pairs"][0] == nlohmann::json({0, 1}));
    const Result text = folder.taut({"judge", "."});
    CHECK(text.status == 1);
    CHECK_THAT(text.out, Contains("f_10.obj: triangles 0/1") && Contains("In 1 of 3 frames"));
}

TEST_CASE("a scene is run and judged: one sheet falls through another")
{
    const Folder folder;
    folder.file("scene.json", falling_sheet(0.3));
    const Result result = folder.taut({"judge", "scene.json", "--device", "cpu:serial", "--json"});
    CHECK(result.status == 1);
    const auto json = program::parse(result.out);
    CHECK(json["frames"] == 51);
    CHECK(json["judged"][0]["intersecting_pairs"] == 0);
    CHECK(json["frames_with_crossings"] > 0);
    const Result few = folder.taut({"judge", "scene.json", "--device", "cpu:serial", "--frames", "3"});
    CHECK(few.status == 0);
    CHECK_THAT(few.out, Contains("Nothing passes through anything in 4 frames."));
}

TEST_CASE("a run whose surfaces were to meet and cross is unconverged, and says which")
{
    const Folder folder;
    const std::string crossed = R"({"taut": 1, "duration": 0.1,
        "contact": {"thickness": 0.005}, "bodies": [
        {"name": "wall", "grid": {"cells": [4, 4], "size": [1, 1]}, "pins": [{"edges": ["top", "bottom"]}]},
        {"name": "sheet", "grid": {"cells": [3, 3], "size": [0.4, 0.4]},
         "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}, "translate": [0.03, 0.06, 0.05]}}]})";
    folder.file("crossed.json", crossed);
    const Result result =
        folder.taut({"run", "crossed.json", "--device", "cpu:serial", "--no-picture", "--json"});
    CHECK(result.status == 1);
    const auto json = program::parse(result.out);
    CHECK(json["status"] == "unconverged");
    CHECK_THAT(json["reason"].get<std::string>(),
               Contains("bodies[0] (\"wall\") and bodies[1] (\"sheet\")") && Contains("at the start"));
    CHECK_THAT(json["messages"].dump(), Contains("at the start"));
    // Nobody asked them to meet.
    const std::size_t begin = crossed.find("\"contact\""), end = crossed.find("\"bodies\"");
    folder.file("ghosts.json", crossed.substr(0, begin) + crossed.substr(end));
    CHECK(folder.taut({"run", "ghosts.json", "--device", "cpu:serial", "--no-picture"}).status == 0);
    CHECK(folder.taut({"judge", "ghosts.json", "--device", "cpu:serial", "--frames", "1"}).status == 1);
    // Somebody asked them not to.
    std::string passing = crossed;
    passing.insert(passing.find("\"name\": \"sheet\""),
                   R"("contact": {"group": "sheet", "passes": ["default"]}, )");
    folder.file("passing.json", passing);
    CHECK(folder.taut({"run", "passing.json", "--device", "cpu:serial", "--no-picture"}).status == 0);
    CHECK(folder.taut({"judge", "passing.json", "--device", "cpu:serial", "--frames", "1"}).status == 0);
    CHECK_THAT(folder.taut({"check", "crossed.json"}).out, Contains("at the start"));
    CHECK_THAT(folder.taut({"check", "passing.json"}).out,
               Contains("all bodies pass through") && Contains("is a sound scene"));
    std::string separate = crossed;
    separate.insert(separate.find("\"thickness\": 0.005"), "\"start\": \"separate\", ");
    folder.file("separate.json", separate);
    CHECK_THAT(folder.taut({"check", "separate.json"}).out,
               Contains("contact.start: takes surfaces apart") && Contains("of bodies[0] (\"wall\") and") &&
                   Contains("no vertex moves further than"));
    CHECK(folder.taut({"run", "separate.json", "--device", "cpu:serial", "--no-picture"}).status == 0);
    CHECK(folder.taut({"judge", "separate.json", "--device", "cpu:serial", "--frames", "1"}).status == 0);
    passing.replace(passing.find("[\"default\"]"), 11, "[\"defualt\"]");
    folder.file("wrong.json", passing);
    CHECK_THAT(folder.taut({"check", "wrong.json"}).out,
               Contains("bodies[1].contact.passes[0]: is \"defualt\"") &&
                   Contains("did you mean \"default\""));
}

TEST_CASE("cloth that comes apart touches itself there and is sound; what goes through it is seen")
{
    const Folder folder;
    const auto end = [&](double height, double speed) {
        nlohmann::json scene = nlohmann::json::parse(R"({"taut": 1, "duration": 0.8,
            "method": {"type": "xpbd", "substeps": 40}, "contact": {"friction": 0.3, "sweeps": 6}, "bodies": [
            {"grid": {"cells": [12, 12], "size": [0.4, 0.4]}, "contact": {"self": true},
             "material": {"density": 0.2, "stretch_stiffness": 300, "bending_stiffness": 1e-5,
                          "thickness": 0.003, "tear_strain": 0.2},
             "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}}, "pins": [
             {"edges": ["left"], "motion": [{"time": 0}, {"time": 1, "translate": [-0.08, -0.02, 0]}]},
             {"edges": ["right"], "motion": [{"time": 0}, {"time": 1, "translate": [0.08, -0.02, 0]}]}]},
            {"grid": {"cells": [6, 6], "size": [0.15, 0.15]},
             "material": {"density": 0.2, "thickness": 0.003, "bending_stiffness": 1e-5},
             "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}}}]})");
        scene["bodies"][1]["transform"]["translate"] = {0, height, 0};
        scene["bodies"][1]["velocity"] = {0, -speed, 0};
        folder.file("torn.json", scene.dump());
        return program::parse(
            folder.taut({"run", "torn.json", "--device", "cpu:serial", "--no-picture", "--json"}).out);
    };
    const auto lies = end(0.02, 0);
    CHECK(lies["torn"].get<int>() > 10);
    CHECK(lies["status"] == "completed");
    const auto shot = end(33, 60); // arrives when it has been torn
    CHECK(shot["torn"].get<int>() > 10);
    CHECK(shot["status"] == "unconverged");
    CHECK_THAT(shot["reason"].get<std::string>(), Contains("through each other"));
}

TEST_CASE("a sheet that is through another one within a frame is seen, though no frame shows it")
{
    const Folder folder;
    std::string fast = falling_sheet(0.3);
    fast.replace(fast.find("[0, -2, 0]"), 10, "[0, -200, 0]");
    fast.replace(fast.find("\"duration\": 1"), 13, "\"duration\": 0.1, \"contact\": {\"thickness\": 0.003}");
    folder.file("fast.json", fast);
    const Result result =
        folder.taut({"run", "fast.json", "--device", "cpu:serial", "--no-picture", "--json"});
    CHECK(result.status == 1);
    const auto json = program::parse(result.out);
    CHECK_THAT(json["reason"].get<std::string>(), Contains("passed through each other"));
    CHECK(!json["contacts"].contains("filtered"));
    const Result guarded = folder.taut({"run", "fast.json", "--device", "cpu:serial", "--no-picture", "--set",
                                        "contact.guarantee=no_crossing", "--json"});
    CHECK(guarded.status == 0);
    const auto contacts = program::parse(guarded.out)["contacts"];
    CHECK(contacts["filtered"] > 0);
    CHECK(contacts["pinched"] == 0);
    CHECK(contacts["held"] == 0);
}

TEST_CASE("what cannot be judged is refused by name")
{
    const Folder folder;
    folder.file("a.obj", triangle_at(1));
    folder.file("note.txt", "");
    folder.file("a.pc2", "");
    const auto refusal = [&](const std::vector<std::string>& arguments) {
        const Result result = folder.taut(arguments);
        CHECK(result.status == 2);
        CHECK(result.out.empty());
        return result.err;
    };
    CHECK_THAT(refusal({"judge", "note.txt"}), Contains("note.txt is not judged; name a scene"));
    CHECK_THAT(refusal({"judge", "none.json"}), Contains("none.json"));
    CHECK_THAT(refusal({"judge", "a.pc2"}), Contains("needs --mesh"));
    CHECK_THAT(refusal({"judge", ".", "--mesh", "a.obj"}), Contains("--mesh goes with a point cache"));
    CHECK_THAT(refusal({"judge", "gone"}), Contains("there is no gone"));
    CHECK_THAT(refusal({"judge", ".", "--set", "duration=1"}),
               Contains("--set and --device go with a scene"));
    CHECK_THAT(refusal({"judge", ".", "--every", "0"}), Contains("--every"));
    folder.file("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK_THAT(refusal({"judge", "."}), Contains("b.obj: its faces are not those of"));
}

TEST_CASE("judge warns of lines of an OBJ that it does not read: of a folder, a cache's mesh and a scene")
{
    const Folder folder;
    const std::string obj = triangle_at(0.5) + "stitch 1 4\nstitch 2 5\n";
    const std::string has = "has 2 lines \"stitch\", which are not read";
    const auto warned = [&](std::vector<std::string> arguments, const std::string& subject) {
        arguments.insert(arguments.begin(), "judge");
        const Result text = folder.taut(arguments);
        CHECK(text.status == 0);
        CHECK(text.err == "taut: warning: " + subject + has + "\n");
        arguments.emplace_back("--json");
        const Result json = folder.taut(arguments);
        CHECK(json.err == text.err);
        CHECK(program::parse(json.out)["messages"] == nlohmann::json({subject + has}));
    };
    std::filesystem::create_directory(folder / "frames");
    folder.file("frames/f_1.obj", obj);
    folder.file("frames/f_2.obj", obj);
    warned({"frames"}, "frames/f_1.obj ");
    std::vector<float> places{0, 0, 0, 1, 0, 0, 0, 1, 0}; // a triangle, and another above it
    for (int k = 0; k < 9; ++k)
        places.push_back(places[std::size_t(k)] + (k % 3 == 2 ? 0.5f : 0));
    folder.file("walk.pc2", point_cache(6, 1, places));
    warned({"walk.pc2", "--mesh", "frames/f_1.obj"}, "frames/f_1.obj ");
    folder.file("scene.json", R"({"taut": 1, "bodies": [{"mesh": "frames/f_1.obj"}]})");
    warned({"scene.json", "--device", "cpu:serial", "--frames", "1"}, "bodies[0].mesh: ");
    const Result run = folder.taut({"run", "scene.json", "--device", "cpu:serial", "--frames", "1",
                                    "--no-picture", "--json"}); // the same words
    CHECK_THAT(program::parse(run.out)["messages"].dump(), Contains("bodies[0].mesh: has 2 lines"));
}
