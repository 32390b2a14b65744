#include "taut/cli/mesh_sequence.hpp"

#include "taut/cli/output.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/obj_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

/// OBJ names end at white space.
std::string object_name(const Body& body, std::size_t index)
{
    std::string name = body.name.empty() ? "body_" + std::to_string(index) : body.name;
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= ' ')
            c = '_';
    return name;
}

/// Of a coordinate in a float run. Far from the origin the world keeps places by more digits than a float.
int digits_of(std::span<const glm::dvec3> positions)
{
    Extent all;
    for (const glm::dvec3& p : positions)
        all.take(p);
    double far = 0; // in sizes of the body
    for (int k = 0; k < 3 && all.size() > 0; ++k)
        far = std::max({far, std::abs(all.low[k]) / all.size(), std::abs(all.high[k]) / all.size()});
    const double more = far > 1 ? std::min(std::ceil(std::log10(far)), 99.0) : 0;
    return std::min(scene_file::kFloatDigits + static_cast<int>(more), scene_file::kDoubleDigits);
}

} // namespace

MeshSequence::MeshSequence(fs::path folder) : folder_(std::move(folder)) {}

void MeshSequence::set_scene(const Scene& resolved)
{
    faces_.clear();
    vertices_.clear();
    in_double_ = resolved.method.precision == Precision::float64;
    std::size_t first = 0;
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Embedding& embedding = resolved.bodies[b].embedding;
        const Mesh& mesh = embedding.used() ? embedding.surface : resolved.bodies[b].mesh;
        std::string text = "o " + object_name(resolved.bodies[b], b) + "\n";
        scene_file::append_elements(text, mesh, first);
        faces_.push_back(std::move(text));
        vertices_.push_back(mesh.positions.size());
        first += mesh.positions.size();
    }
}

fs::path MeshSequence::file_name(std::size_t index) const
{
    char name[32];
    std::snprintf(name, sizeof name, "mesh_%05zu.obj", index);
    return folder_ / name;
}

void MeshSequence::write(const std::vector<glm::dvec3>& positions, std::uint64_t frame, double time)
{
    std::string text =
        "# taut, frame " + std::to_string(frame) + ", time " + number(time, 9) + " s, metres\n";
    std::size_t vertex = 0;
    for (std::size_t body = 0; body < faces_.size(); ++body)
    {
        const std::size_t name_end = faces_[body].find('\n') + 1;
        text.append(faces_[body], 0, name_end);
        const auto own = std::span(positions).subspan(vertex, vertices_[body]);
        scene_file::append_vertices(text, own, in_double_ ? scene_file::kDoubleDigits : digits_of(own));
        vertex += vertices_[body];
        text.append(faces_[body], name_end);
    }
    write_file(file_name(count_), text);
    ++count_;
}

void MeshSequence::remove_older() const
{
    std::error_code ignored;
    for (std::size_t index = count_; fs::remove(file_name(index), ignored); ++index)
    {}
}

} // namespace taut::cli
