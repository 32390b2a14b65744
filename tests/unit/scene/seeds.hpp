#pragma once
// Small good files of every format: the ground that the fuzzers start from.

#include "support/solid_files.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace seeds {

struct Seed
{
    std::string extension; ///< "obj"
    std::string text;
};

inline void append(std::string& out, const void* bytes, std::size_t n)
{
    out.append(static_cast<const char*>(bytes), n);
}

/// Two triangles of a unit square as binary STL (little endian host).
inline std::string binary_stl()
{
    const float corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    std::string out(80, ' ');
    const std::uint32_t count = 2;
    append(out, &count, 4);
    for (const auto& triangle : corners)
    {
        const float normal[3] = {0, 0, 1};
        const std::uint16_t attribute = 0;
        append(out, normal, sizeof normal);
        append(out, triangle, sizeof triangle);
        append(out, &attribute, 2);
    }
    return out;
}

inline std::string binary_ply(bool big_endian)
{
    std::string out =
        "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
        "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const auto put = [&](const void* value, std::size_t n) {
        std::string bytes(static_cast<const char*>(value), n);
        if (big_endian)
            bytes.assign(bytes.rbegin(), bytes.rend());
        out += bytes;
    };
    const float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const auto& p : positions)
    {
        for (float c : p)
            put(&c, 4);
        out += '\x40';
    }
    const std::int32_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (const auto& f : faces)
    {
        out += '\x03';
        for (std::int32_t i : f)
            put(&i, 4);
    }
    return out;
}

inline std::vector<Seed> meshes()
{
    return {
        {"obj",
         "# square\nmtllib a.mtl\no sheet\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0\nvt 0 0\nvt 1 0\nvt 1 1\n"
         "vn 0 0 1\ng panel\nusemtl cotton\ns 1\nf 1/1/1 2/2/1 3/3/1\nf 1//1 3//1 4//1\n"},
        {"obj",
         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf -6 -5 -4 -3\nf 2 5 6 \\\n 3\nl 1 2\np 1\n"},
        {"off", "OFF\n# square\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3 0.5 0.5 0.5\n"},
        {"off", "OFF 5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 2\n4 0 1 2 3\n3 0 1 4\n"},
        {"ply",
         "ply\nformat ascii 1.0\ncomment square\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"},
        {"ply", binary_ply(false)},
        {"ply", binary_ply(true)},
        {"stl", "solid square\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   "
                "vertex 1 1 0\n"
                "  endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 1 0\n"
                "   vertex 0 1 0\n  endloop\n endfacet\nendsolid square\n"},
        {"stl", binary_stl()},
    };
}

/// Files of tetrahedra; "node" and "ele" are two halves of a pair.
inline std::vector<Seed> solids()
{
    using namespace solid_files;
    std::vector<Seed> all = {{"mesh", medit()},
                             {"node", node()},
                             {"ele", ele()},
                             {"msh", gmsh1()},
                             {"msh", gmsh2()},
                             {"msh", gmsh2_binary(false)},
                             {"msh", gmsh2_binary(true)},
                             {"msh", gmsh4()},
                             {"msh", gmsh4_binary(false)},
                             {"msh", gmsh4_binary(true)},
                             {"vtk", vtk()},
                             {"vtk", vtk_binary()},
                             {"vtk", vtk5(false)},
                             {"vtk", vtk5(true)}};
#if TAUT_HAS_EXPAT
    all.push_back({"vtu", vtu_text()});
    all.push_back({"vtu", vtu_binary(false, false)});
    all.push_back({"vtu", vtu_binary(true, true)});
#endif
    return all;
}

} // namespace seeds
