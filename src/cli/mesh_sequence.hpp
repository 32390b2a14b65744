#pragma once
// The meshes of a run: one Wavefront OBJ a picture in time, every body in it under its own name.

#include "taut/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

class MeshSequence
{
public:
    /// Files go to folder/mesh_00000.obj and on; the folder exists.
    explicit MeshSequence(std::filesystem::path folder);

    /// From now on the bodies are those of this scene, by the surfaces that they carry along where they do:
    /// before the first write(), and again when cloth has torn.
    void set_scene(const Scene& resolved);

    /// Positions of shown vertices (scene/embedding.hpp), m. Throws Error{io}.
    void write(const std::vector<glm::dvec3>& positions, std::uint64_t frame, double time);

    std::size_t count() const { return count_; }

    /// Removes the mesh files that a longer run left in the folder, so that it holds one run.
    void remove_older() const;

private:
    std::filesystem::path file_name(std::size_t index) const;

    std::filesystem::path folder_;
    std::vector<std::string> faces_;    ///< per body: its name, faces and links, ready to write
    std::vector<std::size_t> vertices_; ///< per body
    bool in_double_ = false;
    std::size_t count_ = 0;
};

} // namespace taut::cli
