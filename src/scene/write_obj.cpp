#include "taut/runtime/base/atomic_file.hpp"
#include "taut/scene/mesh.hpp"
#include "taut/scene/obj_text.hpp"

namespace taut {

void write_obj(const std::filesystem::path& file, const Mesh& mesh)
{
    std::string text;
    text.reserve(48 * mesh.positions.size() + 24 * mesh.triangles.size());
    scene_file::append_vertices(text, mesh.positions);
    scene_file::append_elements(text, mesh, 0);
    write_file(file, text);
}

} // namespace taut
