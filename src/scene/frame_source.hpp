#pragma once
// Frames that a program wrote: a folder of OBJ files, or a PC2 file with the mesh that it moves.

#include "taut/scene/mesh.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace taut {

/// Frames in order, one at a time in memory. One thread at a time.
class FrameSource
{
public:
    virtual ~FrameSource() = default;
    virtual std::size_t frames() const = 0;
    virtual const std::vector<std::array<std::uint32_t, 3>>& triangles() const = 0;
    /// Positions of a frame, in the order of its file, m. Throws Error{io} and Error{bad_input} naming the
    /// file and what is wrong.
    virtual std::vector<glm::dvec3> positions(std::size_t frame) = 0;
    /// What messages and reports call a frame: its file, or its number.
    virtual std::string name(std::size_t frame) const = 0;
    /// What is doubtful of what the frames came from, a sentence each: lines of its mesh (of a folder, of its
    /// first file) that are not read.
    virtual std::vector<std::string> messages() const { return {}; }
};

/// The .obj files of a folder in natural order (mesh_2 before mesh_10). Each must have the faces of the
/// first. Throws Error{io} where the folder cannot be read, Error{bad_input} where it has no .obj.
std::unique_ptr<FrameSource> open_frame_folder(const std::filesystem::path& folder);

/// A point cache ("POINTCACHE2", version 1, float coordinates, little endian) of the vertices of `mesh`, an
/// OBJ, PLY, OFF or STL file. Throws Error{io} and Error{bad_input}: no such file, another version, cut
/// short, another number of vertices.
std::unique_ptr<FrameSource> open_point_cache(const std::filesystem::path& cache,
                                              const std::filesystem::path& mesh);

/// The same of so many vertices, which have these triangles; `mesh`: what messages call what has them.
std::unique_ptr<FrameSource> open_point_cache(const std::filesystem::path& cache, std::size_t vertices,
                                              std::vector<std::array<std::uint32_t, 3>> triangles,
                                              const std::string& mesh);

} // namespace taut
