#pragma once
// Frames that a program wrote: a folder of OBJ files, or a PC2 file with the mesh that it moves.

#include "taut/judge/surface.hpp"

#include <glm/vec3.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace taut::judging {

/// Frames in order, one at a time in memory.
class Sequence
{
public:
    virtual ~Sequence() = default;
    virtual std::size_t frames() const = 0;
    virtual const std::vector<Triangle>& triangles() const = 0;
    /// Positions of a frame, m. Throws Error{io} and Error{bad_input} naming the file and what is wrong.
    virtual std::vector<glm::dvec3> positions(std::size_t frame) = 0;
    /// What messages and reports call a frame: its file, or its number.
    virtual std::string name(std::size_t frame) const = 0;
};

/// The .obj files of a folder in natural order (mesh_2 before mesh_10). Each must have the faces of the
/// first. Throws Error{io} where the folder cannot be read, Error{bad_input} where it has no .obj.
std::unique_ptr<Sequence> open_folder(const std::filesystem::path& folder);

/// A point cache ("POINTCACHE2", version 1, float coordinates, little endian) of the vertices of `mesh`, an
/// OBJ, PLY, OFF or STL file. Throws Error{io} and Error{bad_input}: no such file, another version, cut
/// short, another number of vertices.
std::unique_ptr<Sequence> open_point_cache(const std::filesystem::path& cache,
                                           const std::filesystem::path& mesh);

} // namespace taut::judging
