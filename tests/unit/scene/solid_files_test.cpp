// Files of tetrahedra in every format: what they say is read, what is wrong with them is said.

#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/solid_files.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/raw_solid.hpp"

#include <algorithm>

using namespace taut;

namespace {

struct Sample
{
    std::string extension, text;
};

/// The same solid in every format of one file.
std::vector<Sample> samples()
{
    using namespace solid_files;
    std::vector<Sample> all = {{".mesh", medit()},
                               {".msh", gmsh1()},
                               {".msh", gmsh2()},
                               {".msh", gmsh2_binary(false)},
                               {".MSH", gmsh2_binary(true)},
                               {".msh", gmsh4()},
                               {".msh", gmsh4_binary(false)},
                               {".msh", gmsh4_binary(true)},
                               {".vtk", vtk()},
                               {".vtk", vtk_binary()},
                               {".vtk", vtk5(false)},
                               {".vtk", vtk5(true)}};
#if TAUT_HAS_EXPAT
    all.push_back({".vtu", vtu_text()});
    for (const bool big : {false, true})
        for (const bool apart : {false, true})
            all.push_back({".vtu", vtu_binary(big, apart)});
#endif
    return all;
}

void check_two(const Mesh& mesh, const MeshFindings& findings)
{
    const std::vector<glm::dvec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    CHECK(mesh.positions == corners);
    REQUIRE(mesh.tetrahedra.size() == 2);
    CHECK(mesh.tetrahedra[0] == std::array<std::uint32_t, 4>{0, 1, 2, 3});
    CHECK(mesh.tetrahedra[1] == std::array<std::uint32_t, 4>{0, 2, 1, 4});
    CHECK(mesh.triangles.size() == 6);
    CHECK(findings.unused_vertices == 1);
    CHECK(findings.turned_tetrahedra == 0);
}

void refused(const std::string& extension, const std::string& text, const std::string& message)
{
    MeshFindings findings;
    INFO(text);
    try
    {
        scene_file::parse_tetrahedra(text, extension, "f" + extension, findings);
        FAIL_CHECK("taken; it should say: " << message);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK_THAT(error.what(), Contains(message));
    }
}

/// `text` with the first `from` replaced, which must be there.
std::string with(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("the same solid is read from every format")
{
    for (const Sample& sample : samples())
    {
        INFO(sample.extension << "\n" << sample.text.substr(0, 200));
        MeshFindings findings;
        check_two(scene_file::parse_tetrahedra(sample.text, sample.extension, "f", findings), findings);
    }
}

TEST_CASE("a Gmsh version may have more digits than it needs")
{
    for (const Sample& sample : samples())
        for (const auto& [from, to] : {std::pair{"\n2.2 0 8", "\n2.200000 0 8"}, {"\n4.1 0 8", "\n4.10 0 8"}})
            if (sample.text.find(from) != std::string::npos)
            {
                MeshFindings findings;
                const std::string text = with(sample.text, from, to);
                check_two(scene_file::parse_tetrahedra(text, sample.extension, "f", findings), findings);
            }
}

TEST_CASE("either file of a TetGen pair names the other")
{
    const Temporary folder;
    const auto node = folder.write("two.node", solid_files::node());
    const auto ele = folder.write("two.ele", solid_files::ele());
    for (const auto& file : {node, ele})
    {
        MeshFindings findings;
        check_two(read_tetrahedra(file, &findings), findings);
    }
    folder.write("UP.NODE", solid_files::node());
    MeshFindings findings;
    check_two(read_tetrahedra(folder.write("UP.ELE", solid_files::ele()), &findings), findings);
    const auto alone = folder.write("alone.ele", solid_files::ele());
    try
    {
        read_tetrahedra(alone);
        FAIL("an .ele file without its .node was taken");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::io);
        CHECK_THAT(error.what(), Contains("alone.ele: there is no ") && Contains("alone.node beside it"));
    }
}

TEST_CASE("TetGen's files are refused by file, line and what would be right")
{
    const auto wrong = [](const std::string& node, const std::string& ele, const std::string& message) {
        MeshFindings findings;
        const std::string names[] = {"a.node", "a.ele"};
        CHECK_THROWS_WITH(scene_file::parse_tetgen({node, names[0]}, {ele, names[1]}, findings),
                          Contains(message));
    };
    const std::string node = solid_files::node(), ele = solid_files::ele();
    wrong("", ele, "a.node: line 1: the file is empty; its first line must announce vertices");
    wrong(with(node, "6 3", "6 2"), ele, "a.node: line 2: vertices have 2 coordinates; they must have 3");
    wrong(with(node, "6 3", "7 3"), ele, "a.node: line 10: the file ends after 6 vertices; it announces 7");
    wrong(with(node, "6 3", "5 3"), ele,
          "a.node: line 8: there is \"15\" after the last of the announced vertices");
    wrong(with(node, "6 3", "600 3"), ele, "the file announces 600 vertices, more than it holds");
    wrong(with(node, "11 1", "10 1"), ele, "two vertices have the number 10; each must have its own");
    wrong(with(node, "11 1", "11 one"), ele, "a.node: line 4: x is \"one\"; it must be a finite number");
    wrong(node, with(ele, "2 4", "2 10"),
          "a.ele: line 1: tetrahedra have 10 vertices; they must have 4 (run TetGen");
    wrong(node, with(ele, "11 12 14", "11 12 16"),
          "a.ele: line 2: tetrahedron 10 names vertex 16; there are 6, numbered from 10 to 15");
    wrong(node, with(ele, "11 12 14", "11 12 12"), "tetrahedron 10 names a vertex twice");
    wrong(node, with(ele, "11 12 14 3", "11 12"),
          "corner of a tetrahedron is nothing; it must be a whole number");
}

TEST_CASE("Gmsh files are refused by line and what would be right")
{
    using namespace solid_files;
    refused(".msh", "7", "f.msh: line 1: there is \"7\" where a section ($Nodes, $Elements) must begin");
    refused(".msh", "$Nodes\n1\n", "\"$Nodes\" stands before \"$MeshFormat\"");
    refused(".msh", with(gmsh2(), "2.2 0", "4.0 0"),
            "line 2: the version is \"4.0\"; 2.0 to 2.2 and 4.1 are read, and 1.0, whose files have no "
            "$MeshFormat");
    refused(".msh", with(gmsh2(), "2.2 0", "2.2 2"),
            "the file type is \"2\"; it must be 0 (text) or 1 (binary)");
    refused(".msh", with(gmsh2(), "0 8", "0 4"), "the data size is \"4\"; it must be 8");
    refused(".msh", with(gmsh2(), "$EndPhysicalNames", ""), "\"$EndPhysicalNames\" must stand behind it");
    refused(".msh", with(gmsh2(), "$Nodes\n6", "$Nodes\n6000"), "the file announces 6000 vertices; the");
    refused(".msh", with(gmsh2(), "$Nodes\n6", "$Nodes\n5"),
            "there is \"18\" where \"$EndNodes\" must stand");
    refused(".msh", with(gmsh2(), "9 1 0 0", "2 1 0 0"), "two vertices have the number 2");
    refused(".msh", with(gmsh2(), "2 9 5 17", "2 9 5 16"),
            "tetrahedron 2 names vertex 16; there are 6, numbered from 2 to 100 with gaps");
    refused(".msh", with(gmsh2(), "2 4 2", "2 40 2"), "an element has the type 40; the types 1 to 31");
    refused(".msh", with(gmsh2(), "2 4 2", "2 4 -1"), "an element has -1 tags");
    refused(".msh", with(gmsh2(), "$Elements\n3", "$Elements\n2"), "there is \"7\" where \"$EndElements\"");
    refused(".msh", with(gmsh1(), "2 4 0 1 4", "2 4 0 1 5"), "of type 4 has 5 vertices; it must have 4");
    refused(".msh", with(gmsh1(), "$NOD", "$PARA"), "the section \"$PARA\" has no end");
    refused(".msh", "$ELM\n0\n$ENDELM\n", "the elements stand before the vertices");
    refused(".msh", gmsh1() + gmsh1(), "there is a second section of vertices");
    refused(".msh", with(gmsh4(), "2 6 2 100", "2 7 2 100"),
            "the blocks end 1 vertices before the announced");
    refused(".msh", with(gmsh4(), "2 6 2 100", "2 5 2 100"),
            "a block has 3 vertices; 2 of the announced ones");
    refused(".msh", with(gmsh4(), "2 1 1 3", "5 1 1 3"), "a block has the dimension 5 and the mark 1");
    refused(".msh", with(gmsh4(), "2 3 1 7", "2 4 1 7"), "the blocks end 1 elements before the announced");
    refused(".msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 11 0 0 10 1 1 1 1 1 1 1 1 1 1\n$ENDELM\n",
            "it has 1 tetrahedra of ten vertices; they must have 4 (in Gmsh: set order 1)");
    refused(".msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 15 0 0 1 1\n$ENDELM\n",
            "f.msh: it has 1 vertices and no tetrahedron");
}

TEST_CASE("binary Gmsh files are refused by byte")
{
    using namespace solid_files;
    const auto cut = [](const std::string& text, std::size_t bytes) {
        return text.substr(0, text.size() - bytes);
    };
    refused(".msh", with(gmsh2_binary(false), bytes(std::int32_t(1), false), "abcd"),
            "byte 24: the bytes behind the format must be the number 1 in either byte order");
    refused(".msh", cut(gmsh2_binary(false), 30), "the file ends in the middle of its values");
    refused(".msh", cut(gmsh4_binary(true), 60), "the file ends in the middle of its values");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused(".msh", with(gmsh2_binary(true), bytes(7.0, true), bytes(nan, true)),
            "a coordinate is not finite; every number must be");
    refused(
        ".msh",
        with(gmsh2_binary(false), list<std::int32_t>({4, 2, 1}, false), list<std::int32_t>({4, 3, 1}, false)),
        "a block has 3 elements; 2 of the announced ones are left");
    refused(
        ".msh",
        with(gmsh2_binary(false), list<std::int32_t>({4, 2, 1}, false), list<std::int32_t>({4, 0, 1}, false)),
        "a block has 0 elements");
    refused(".msh",
            with(gmsh4_binary(false), list<std::uint64_t>({2, 6, 2}, false),
                 list<std::uint64_t>({2, std::uint64_t(1) << 62, 2}, false)),
            "the file announces 4611686018427387904 vertices; the ");
}

TEST_CASE("legacy VTK files are refused by line and what would be right")
{
    using namespace solid_files;
    refused(".vtk", "<VTKFile>", "does not start with \"# vtk DataFile Version \"");
    refused(".vtk", with(vtk(), "ASCII", "TEXT"),
            "line 3: there is \"TEXT\" where ASCII or BINARY must stand");
    refused(".vtk", with(vtk(), "UNSTRUCTURED_GRID", "POLYDATA"), "the data set is \"POLYDATA\"");
    refused(".vtk", with(vtk(), "6 double", "6 int"),
            "points have the type \"int\"; it must be float or double");
    refused(".vtk", with(vtk(), "POINTS 6", "POINTS 600"), "the file announces 600 points; the");
    refused(".vtk", with(vtk(), "POINTS 6", "POINTS 5"), "there is \"0\" where POINTS, CELLS, CELL_TYPES");
    refused(".vtk", with(vtk(), "CELLS 3 14", "CELLS 3 13"), "cell 2 has 4 points; the announced numbers");
    refused(".vtk", with(vtk(), "4 0 1 2 4", "4 0 1 2 6"),
            "tetrahedron 1 names vertex 6; there are 6, numbered from 0 to 5");
    refused(".vtk", with(vtk(), "4 0 1 2 4", "4 0 1 2 2"), "tetrahedron 1 names a vertex twice");
    refused(".vtk", with(vtk(), "CELL_TYPES 3\n5\n", "CELL_TYPES 2\n"),
            "there are 3 cells and 2 types of cells");
    refused(".vtk", with(vtk(), "\n5\n10\n", "\n10\n10\n"), "cell 0 is a tetrahedron (type 10) of 3 points");
    refused(".vtk", with(vtk(), "\n5\n10\n", "\n5\n24\n"), "cell 1 is a tetrahedron of ten points (type 24)");
    refused(".vtk", with(vtk(), "1 1 double", "1 1 string"), "the type \"string\" is not known");
    refused(".vtk", with(vtk5(false), "0 3 7 11", "0 8 7 11"), "cell 1 ends at 7; it must be from 8 to 11");
    refused(".vtk", with(vtk5(false), "0 3 7 11", "1 3 7 11"), "the first offset is 1; it must be 0");
    refused(".vtk", vtk_binary().substr(0, 120), "the file announces 6 points; the ");
    refused(".vtk", with(vtk5(true), "CONNECTIVITY vtktypeint64", "CONNECTIVITY vtktypeint32"), "there is ");
}

TEST_CASE("VTU files are refused by line and what would be right")
{
    using namespace solid_files;
#if TAUT_HAS_EXPAT
    refused(".vtu", "no", "f.vtu: line 1: this is not XML: ");
    refused(".vtu", "<a/>", "the file starts with the element \"a\"; it must be VTKFile");
    refused(".vtu", "<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>", "the file declares a document type");
    refused(".vtu", with(vtu_text(), "\"UnstructuredGrid\"", "\"PolyData\""),
            "is \"PolyData\"; it must be UnstructuredGrid");
    refused(".vtu", with(vtu_text(), "NumberOfPoints=\"6\"", "NumberOfPoints=\"six\""),
            "line 4: NumberOfPoints is \"six\"; it must be a whole number");
    refused(".vtu", with(vtu_text(), "NumberOfPoints=\"6\"", "NumberOfPoints=\"1000000\""),
            "NumberOfPoints is 1000000, more than the array of points holds");
    refused(".vtu", with(vtu_text(), "NumberOfPoints=\"6\"", "NumberOfPoints=\"5\""),
            "line 8: there is \"0\" behind the 15 numbers of the array of points");
    refused(".vtu", with(vtu_text(), "\"3\" format=\"ascii\"", "\"3\" format=\"appended\""),
            "has the format \"appended\"; ascii and binary are read");
    refused(".vtu", with(vtu_text(), "Components=\"3\"", "Components=\"2\""), "points have \"2\" components");
    refused(".vtu", with(vtu_text(), "Float64", "Int32"), "it must be Float32 or Float64");
    refused(".vtu", with(vtu_text(), "Name=\"offsets\"", "Name=\"ends\""), "the piece has no array offsets");
    refused(".vtu", with(vtu_text(), "0 1 2 4", "0 1 2 6"), "a cell names point 6; the piece has 6");
    refused(".vtu", with(vtu_text(), "3 7 11", "3 -7 11"), "an offset is -7; offsets must be 0 or more");
    refused(".vtu", with(vtu_text(), "3 7 11", "3 6 11"), "cell 1 is a tetrahedron (type 10) of 3 points");
    refused(".vtu",
            with(vtu_binary(false, false), "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order"),
            "arrays are compressed (\"vtkZLibDataCompressor\"); save the file as text");
    refused(".vtu", with(vtu_binary(false, false), "\"LittleEndian\"", "\"Middle\""),
            "the byte order is \"Middle\"");
    refused(".vtu", with(vtu_binary(false, false), "=\"UInt8\" Name", "=\"UInt16\" Name"),
            "the array types has");
    refused(".vtu", with(vtu_binary(false, false), ">\n", ">\n?"), "this is not XML");
#else
    MeshFindings findings;
    CHECK_THROWS_WITH(scene_file::parse_tetrahedra(vtu_text(), ".vtu", "f.vtu", findings),
                      Contains("libexpat1-dev") && Contains(".msh"));
#endif
    refused(".step", "",
            "the extension \".step\" is not read; it must be .node or .ele (TetGen), .msh (Gmsh), .vtk");
}

TEST_CASE("every solid of the data folder has the counts of its README")
{
    struct Known
    {
        const char* file;
        std::size_t vertices, tetrahedra, triangles, unused;
    };
    const Known all[] = {{"armadillo_4k.node", 1180, 3717, 2102, 0},
                         {"armadillo_4k.ele", 1180, 3717, 2102, 0},
                         {"bunny0.msh", 1869, 7356, 2152, 0},
                         {"ball.msh", 1647, 7056, 1568, 0},
                         {"link.msh", 491, 1499, 796, 0},
                         {"dolphin5K.msh", 8111, 36304, 10000, 0},
                         {"cow_head.msh", 1328, 5029, 1986, 0},
                         {"monkey8K.msh", 12448, 52864, 16000, 0},
                         {"Armadillo2.5K.vtk", 2542, 9199, 4000, 0},
                         {"Armadillo13K.vtk", 13230, 54985, 17296, 0},
                         {"liver.msh", 181, 596, 276, 0},
                         {"liver2.msh", 507, 1493, 860, 0},
                         {"Bunny_sofa.vtu", 1911, 5897, 3806, 0},
                         {"Armadillo_Tetra_4406.vtu", 1446, 4406, 2532, 0},
                         {"spot_tet.mesh", 2304, 8103, 3318, 0},
                         {"armadillo_74k.mesh", 18319, 74040, 21264, 0},
                         {"bunny_slivers.vtk", 6308, 26096, 8116, 0},
                         {"elbow.mesh", 1823, 8161, 1678, 0},
                         {"cylinder.mesh", 354, 1348, 440, 0},
                         {"unit_ball.mesh", 362, 1110, 602, 1}};
    for (const Known& known : all)
    {
        const auto file = find_data(std::string("tets/") + known.file);
#if !TAUT_HAS_EXPAT
        if (file && file->extension() == ".vtu")
            continue;
#endif
        if (!file)
            continue;
        INFO(known.file);
        MeshFindings findings;
        const Mesh mesh = read_tetrahedra(*file, &findings);
        CHECK(mesh.positions.size() == known.vertices);
        CHECK(mesh.tetrahedra.size() == known.tetrahedra);
        CHECK(mesh.triangles.size() == known.triangles);
        CHECK(findings.unused_vertices == known.unused);
        CHECK(findings.turned_tetrahedra == 0);
    }
}
