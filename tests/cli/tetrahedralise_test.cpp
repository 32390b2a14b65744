// taut tetrahedralise, with small scripts in the place of TetGen and Gmsh.

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <csignal>
#include <cstdlib>

using program::Folder;
using program::Result;

namespace {

/// PATH for as long as it lives.
class Path
{
public:
    explicit Path(const std::filesystem::path& folder) : before_(std::getenv("PATH"))
    {
        setenv("PATH", folder.c_str(), 1);
    }
    ~Path() { setenv("PATH", before_.c_str(), 1); }
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

private:
    std::string before_;
};

const char* const kCube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                          "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Six tetrahedra round the diagonal from 1 to 7, one of them left-handed.
const char* const kNode = "8 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n";
const char* const kEle = "6 4 0\n1 1 2 3 7\n2 1 3 4 7\n3 1 4 8 7\n4 1 8 5 7\n5 1 5 6 7\n6 1 2 6 7\n";

/// A script for the shell's own words: `writes` files with these contents, then ends as `last` says.
std::string script(const std::vector<std::pair<std::string, std::string>>& writes, const std::string& last)
{
    std::string text = "#!/bin/sh\nprintf '%s\\n' \"$@\" > \"$TAUT_TEST_WORDS\"\n";
    for (const auto& [file, contents] : writes)
        text += "printf '%s' '" + contents + "' > " + file + "\n";
    return text + last + "\n";
}

struct Workshop
{
    Folder folder;
    Path path;

    Workshop() : path((std::filesystem::create_directory(folder / "bin"), folder / "bin"))
    {
        setenv("TAUT_TEST_WORDS", (folder / "words.txt").c_str(), 1);
        std::filesystem::create_directory(folder / "tmp");
        setenv("TMPDIR", (folder / "tmp").c_str(), 1);
    }
    ~Workshop() { unsetenv("TMPDIR"); }

    void install(const std::string& name, const std::string& text) const
    {
        using std::filesystem::perms;
        std::filesystem::permissions(folder.file("bin/" + name, text), perms::owner_all);
    }
};

std::string tetgen() { return script({{"surface.1.node", kNode}, {"surface.1.ele", kEle}}, "exit 0"); }

void failed(const Workshop& shop, const Result& result, int status, const std::string& message)
{
    INFO(result.err);
    CHECK(result.status == status);
    CHECK_THAT(result.err, Contains(message));
    CHECK(result.out.empty());
    CHECK_FALSE(std::filesystem::exists(shop.folder / "cube.mesh"));
    CHECK(shop.folder.list("tmp").empty());
}

} // namespace

TEST_CASE("tetrahedralise runs TetGen, checks what it made and writes a Medit file")
{
    const Workshop shop;
    shop.install("tetgen", tetgen());
    const std::string cube = shop.folder.file("a $(touch no) ;b.obj", kCube);
    const Result result =
        shop.folder.taut({"tetrahedralise", cube, "--out", shop.folder / "cube.mesh", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto json = program::parse(result.out);
    CHECK(json["vertices"] == 8);
    CHECK(json["tetrahedra"] == 6);
    CHECK(json["surface_triangles"] == 12);
    CHECK(json["turned_tetrahedra"] == 1);
    CHECK(json["volume"].get<double>() == Approx(1));
    CHECK(json["surface_volume"].get<double>() == Approx(1));
    CHECK(json["largest_volume"].get<double>() == Approx(1.0 / 6));
    CHECK(program::read(shop.folder / "words.txt") == "-pq\nsurface.off\n");
    CHECK_THAT(program::read(shop.folder / "cube.mesh"),
               Contains("Vertices\n8\n") && Contains("Tetrahedra\n6\n1 2 3 7 0\n"));
    CHECK(shop.folder.list("tmp").empty());
    CHECK_FALSE(std::filesystem::exists(shop.folder / "no"));

    const std::string scene =
        shop.folder.file("scene.json", R"({"taut": 1, "timestep": 0.01, "duration": 0.02,
        "bodies": [{"tetrahedra": "cube.mesh"}]})");
    CHECK(shop.folder.taut({"check", scene}).status == 0);
}

TEST_CASE("tetrahedralise takes the program that is named, and a largest volume")
{
    const Workshop shop;
    shop.install("tetgen", tetgen());
    const std::string cube = shop.folder.file("cube.obj", kCube);
    const Result small = shop.folder.taut({"tetrahedralise", cube, "--max-volume", "0.25"});
    INFO(small.err);
    CHECK(small.status == 0);
    CHECK(small.err.empty());
    CHECK(program::read(shop.folder / "words.txt") == "-pqa0.25\nsurface.off\n");
    CHECK(std::filesystem::exists(shop.folder / "cube.mesh"));
    const Result large = shop.folder.taut({"tetrahedralise", cube, "--max-volume", "0.125"});
    CHECK(large.status == 0);
    CHECK_THAT(large.err, Contains("volume of 0.1667, above --max-volume 0.125"));
    const std::string seams = shop.folder.file("seams.obj", std::string(kCube) + "seam 1 2\nseam 2 3\n");
    const Result both = shop.folder.taut({"tetrahedralise", seams, "--max-volume", "0.125", "--json"});
    CHECK(both.status == 0);
    const auto said = program::parse(both.out)["messages"].get<std::vector<std::string>>();
    REQUIRE(said.size() == 2);
    CHECK(said[0] == seams + " has 2 lines \"seam\", which are not read");
    CHECK(both.err == "taut: warning: " + said[0] + "\ntaut: warning: " + said[1] + "\n");

    shop.install("gmsh",
                 script({{"volume.msh", "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n$ELM\n1\n"
                                        "1 4 0 1 4 1 2 3 4\n$ENDELM\n"}},
                        "exit 0"));
    const std::string corner =
        shop.folder.file("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                       "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"); // inside out
    const Result gmsh = shop.folder.taut({"tetrahedralise", corner, "--program", "gmsh"});
    INFO(gmsh.err);
    CHECK(gmsh.status == 0);
    CHECK_THAT(gmsh.out, Contains("corner.mesh: 4 vertices, 1 tetrahedra by gmsh, volume 0.1667 of 0.1667"));
    CHECK_THAT(program::read(shop.folder / "words.txt"), Contains("-3\n") && Contains("volume.geo\n"));
}

TEST_CASE("what a mesher made is refused with 1 when it is not sound, and nothing is written")
{
    const Workshop shop;
    const std::string cube = shop.folder.file("cube.obj", kCube);
    const auto run = [&](const std::string& text) {
        shop.install("tetgen", text);
        return shop.folder.taut({"tetrahedralise", cube});
    };
    failed(shop, run(script({}, "echo the facets cut each other; exit 3")), 1,
           "tetgen ended with status 3; it said: the facets cut each other");
    failed(shop, run(script({}, "kill -9 $$")), 1, "tetgen ended with signal 9");
    failed(shop, run(script({}, "exit 0")), 1, "tetgen left no surface.1.ele");
    failed(shop, run(script({{"surface.1.node", "no"}, {"surface.1.ele", "sense"}}, "exit 0")), 1,
           "the result of tetgen is not sound: ");
    const std::string half = std::string(kEle).substr(0, std::string(kEle).find("4 1 8"));
    failed(shop, run(script({{"surface.1.node", kNode}, {"surface.1.ele", "3" + half.substr(1)}}, "exit 0")),
           1, "the result of tetgen fills 0.5, the surface encloses 1; they may differ by 1 %");
    failed(shop, run(script({{"surface.1.node", kNode}, {"surface.1.ele", "1 4 0\n1 1 2 3 4\n"}}, "exit 0")),
           1, "has no volume");
    CHECK(shop.folder.list("").size() == 6); // bin, the cube, two streams, tmp, words.txt
}

TEST_CASE("an interrupt ends the mesher too")
{
    const Workshop shop;
    shop.install("tetgen", script({}, "exec /bin/sleep 600"));
    const std::string cube = shop.folder.file("cube.obj", kCube);
    bool sent = false;
    const Result result = shop.folder.taut({"tetrahedralise", cube}, [&](int process) {
        // The script runs once its words are there, and the program waits for it then.
        if (!sent && !program::read(shop.folder / "words.txt").empty())
            sent = kill(process, SIGTERM) == 0;
    });
    failed(shop, result, 1, "taut: interrupted; nothing was written.");
}

TEST_CASE("tetrahedralise says what to install, and which surfaces and names it takes")
{
    const Workshop shop;
    const std::string cube = shop.folder.file("cube.obj", kCube);
    failed(shop, shop.folder.taut({"tetrahedralise", "none.obj"}), 2, "none.obj: there is no such file");
    failed(shop, shop.folder.taut({"tetrahedralise", cube}), 2,
           "there is no program tetgen or gmsh in the folders of PATH; install one (Debian, Ubuntu: apt "
           "install");
    shop.folder.file("bin/tetgen", "not to be executed");
    failed(shop, shop.folder.taut({"tetrahedralise", cube}), 2, "there is no program tetgen or gmsh");
    shop.install("tetgen", tetgen());
    failed(shop, shop.folder.taut({"tetrahedralise", cube, "--program", "gmsh"}), 2,
           "there is no program gmsh");
    failed(shop, shop.folder.taut({"tetrahedralise", cube, "--program", "sh"}), 2, "--program");
    failed(shop, shop.folder.taut({"tetrahedralise", cube, "--max-volume", "0"}), 2,
           "--max-volume is \"0\"; it must be a number above 0");
    failed(shop, shop.folder.taut({"tetrahedralise", cube, "--out", "cube.obj"}), 2, "must end in .mesh");
    failed(shop, shop.folder.taut({"tetrahedralise", cube, "--out", "no/cube.mesh"}), 2,
           "cannot write no/cube.mesh");
    failed(shop, shop.folder.taut({"tetrahedralise", "none.obj"}), 2, "none.obj: there is no such file");
    const std::string text = kCube;
    const std::string open = shop.folder.file("open.obj", text.substr(0, text.rfind("f ")));
    failed(shop, shop.folder.taut({"tetrahedralise", open}), 2,
           "open.obj: it encloses no volume: 4 edges are not");
    const std::string turned =
        shop.folder.file("turned.obj", text.substr(0, text.rfind("f ")) + "f 8 5 1 4\n");
    failed(shop, shop.folder.taut({"tetrahedralise", turned}), 2, "it encloses no volume: 4 edges are not");
    CHECK(program::read(shop.folder / "cube.obj") == kCube);
    CHECK_FALSE(std::filesystem::exists(shop.folder / "words.txt")); // no program was started
}
