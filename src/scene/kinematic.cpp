// Bodies that are led: their keys, and the pins that they become.

#include "taut/scene/kinematic.hpp"

#include "taut/scene/checker.hpp"
#include "taut/scene/frame_source.hpp"
#include "taut/scene/pose.hpp"
#include "taut/scene/weld.hpp"

#include <numeric>

namespace taut::scene_file {
namespace {

/// The frames of a body's sequence, and which of their vertices are those of its mesh.
struct OpenSequence
{
    std::unique_ptr<FrameSource> frames;
    std::vector<std::uint32_t> kept;
    std::size_t vertices = 0; ///< of a frame
};

void require_faces(const FrameSource& frames, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const std::string& mesh)
{
    if (frames.triangles() != triangles)
        throw Error(ErrorCode::bad_input, frames.name(0) + ": its faces are not those of " + mesh +
                                              "; a sequence moves the vertices of the body's own mesh");
}

OpenSequence open_sequence(const Body& body, const std::filesystem::path& directory)
{
    const std::filesystem::path file = directory / body.kinematic.sequence.file;
    const bool of_file = body.shape.kind == ShapeKind::mesh;
    RawMesh raw;
    OpenSequence out;
    if (of_file)
    {
        raw = read_raw_mesh(directory / body.shape.file);
        MeshFindings ignored;
        clean(raw, body.shape.weld_distance, ignored, &out.kept);
    }
    else
    {
        raw.positions = body.mesh.positions;
        raw.triangles = body.mesh.triangles;
        out.kept.resize(raw.positions.size());
        std::iota(out.kept.begin(), out.kept.end(), 0u);
    }
    const std::string mesh = of_file ? (directory / body.shape.file).string() : "the body's mesh";
    out.vertices = raw.positions.size();
    if (std::filesystem::is_directory(file))
    {
        out.frames = open_frame_folder(file);
        require_faces(*out.frames, raw.triangles, mesh);
    }
    else if (file.extension() == ".pc2")
        out.frames = open_point_cache(file, out.vertices, std::move(raw.triangles), mesh);
    else
        throw Error(std::filesystem::exists(file) ? ErrorCode::bad_input : ErrorCode::io,
                    file.string() + " is no sequence that is read; name a point cache (.pc2) or a folder of "
                                    ".obj files");
    return out;
}

void require_vertices(std::size_t count, std::size_t wanted, const std::string& name)
{
    if (count != wanted)
        throw Error(ErrorCode::bad_input, name + " has " + std::to_string(count) +
                                              " vertices; the body's mesh has " + std::to_string(wanted));
}

std::shared_ptr<const SequencePlaces> read_sequence(const Body& body, const std::filesystem::path& directory)
{
    OpenSequence from = open_sequence(body, directory);
    auto out = std::make_shared<SequencePlaces>();
    out->rate = body.kinematic.sequence.rate;
    out->start = body.kinematic.sequence.start;
    for (std::size_t f = 0; f < from.frames->frames(); ++f)
    {
        const std::vector<glm::dvec3> frame = from.frames->positions(f);
        require_vertices(frame.size(), from.vertices, from.frames->name(f));
        std::vector<glm::dvec3>& places = out->frames.emplace_back();
        places.reserve(from.kept.size());
        for (const std::uint32_t v : from.kept)
            places.push_back(frame[v]);
        apply(body.transform, places);
        check_coordinates(places, from.frames->name(f) + ", by the body's transform");
    }
    return out;
}

/// Nothing of it stretches, bends, tears or catches the wind. Of solids the defaults: without tetrahedra they
/// mean nothing.
Material led_material(const Body& body)
{
    Material out = is_solid(body.shape.kind) ? solid_material() : Material{};
    out.density = body.material.density;
    out.thickness = body.material.thickness;
    out.stretch_stiffness = 0;
    return out;
}

/// A body starts where its motion has it at time 0, without a jump in the first substep.
void start_at_first_pose(Body& body, const std::vector<Keyframe>& motion)
{
    std::vector<glm::dvec3> start;
    for (const glm::dvec3& x : body.mesh.positions)
        start.push_back(pose(motion, 0, x));
    check_coordinates(start, "kinematic.motion at time 0");
    if (start != body.mesh.positions)
        body.start_positions = std::move(start);
}

} // namespace

void resolve_kinematic(Body& body, const std::filesystem::path& directory)
{
    Pin pin;
    pin.vertices.resize(body.mesh.positions.size());
    std::iota(pin.vertices.begin(), pin.vertices.end(), 0u);
    pin.motion = body.kinematic.motion;
    pin.moved_by_program = body.kinematic.moved_by_program;
    if (!body.kinematic.sequence.file.empty())
    {
        pin.places = read_sequence(body, directory);
        body.start_positions.resize(pin.vertices.size());
        for (const std::uint32_t v : pin.vertices)
            body.start_positions[v] = place_at(*pin.places, 0, v);
    }
    else if (!pin.motion.empty())
        start_at_first_pose(body, pin.motion);
    body.pins = {std::move(pin)};
    body.material = led_material(body);
    body.mesh.tetrahedra.clear();
    body.elements.clear(); // those of its fabric
}

void check_kinematic(const Kinematic& kinematic, const Checker& out)
{
    const int led = int(!kinematic.motion.empty()) + int(!kinematic.sequence.file.empty()) +
                    int(kinematic.moved_by_program);
    if (led > 1)
        out.error("", "has more than one of motion, sequence and moved_by_program; leave one, or none for a "
                      "body that stands still");
}

void check_kinematic_body(const Body& body, const Checker& out)
{
    const auto refuse = [&](bool there, std::string_view key, std::string_view why) {
        if (there)
            out.error(key,
                      "stands beside kinematic, which " + std::string(why) + "; leave one of the two out");
    };
    refuse(!body.pins.empty(), "pins", "leads all vertices");
    refuse(!body.springs.empty(), "springs", "nothing pulls at");
    refuse(!body.elements.empty(), "elements", "nothing pulls at");
    refuse(!body.start_positions.empty(), "start_positions", "says where the vertices start");
    refuse(!body.vertex_masses.empty(), "vertex_masses", "nothing moves");
    refuse(body.velocity != glm::dvec3(0), "velocity", "says how the vertices move");
    refuse(!body.embedded_file.empty(), "embedded", "keeps the surface of a solid alone");
    refuse(body.contact.self, "contact.self", "cannot be pushed off itself");
    if (body.shape.kind == ShapeKind::chain)
        out.error("kinematic", "stands beside a chain, which has no surface that others could meet; take a "
                               "grid, a mesh, a box, a ball or tetrahedra");
}

} // namespace taut::scene_file
