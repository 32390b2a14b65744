// Vertex block descent of springs, hinges and tetrahedra: rows of vertices by colour, and sweeps over them.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024.
// Departures: bodies are coloured on their own and colour k of every body shares a dispatch, so that a body
//   moves bitwise as it would alone; runs of small colours share one group; collisions with colliders
//   are solved in the step of a vertex (kernels/shared/vbd_contact.glsl) instead of a penalty, and what moves
//   a body as a whole is held to Coulomb's law (docs/methods/vbd.md).

#include "taut/plan/vbd.hpp"

#include "taut/kernels/vbd_accelerate.hpp"
#include "taut/kernels/vbd_progress.hpp"
#include "taut/kernels/vbd_solve.hpp"
#include "taut/plan/grouping.hpp"
#include "taut/plan/springs.hpp"
#include "taut/plan/vbd_rows.hpp"
#include "taut/plan/vertex_colouring.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr std::uint32_t kPlainVbdIterations = 3; ///< before the acceleration starts
constexpr std::uint32_t kFewIterations = 8;   ///< fewer are not accelerated

/// Of a generated box's vertices, in the order of the plan; nothing for other shapes.
std::vector<glm::uvec3> box_places(const PlanBuilder& b, std::size_t body)
{
    const Shape& shape = b.scene.bodies[body].shape;
    const glm::uvec3 n = shape.box_cells + 1u;
    const std::uint32_t first = b.plan.body_start[body], end = b.plan.body_start[body + 1];
    std::vector<glm::uvec3> out;
    if (shape.kind != ShapeKind::box || std::uint64_t(n.x) * n.y * n.z != end - first)
        return out;
    for (std::uint32_t v = first; v < end; ++v)
    {
        const std::uint32_t own = b.plan.original[v] - first;
        out.emplace_back(own % n.x, own / n.x % n.y, own / n.x / n.y);
    }
    return out;
}

std::uint32_t size_of(const std::vector<std::uint32_t>& colour)
{
    return static_cast<std::uint32_t>(colour.size());
}

/// Plan vertices that move, colour by colour; colour k of all bodies together.
std::vector<std::vector<std::uint32_t>> colours_of(const PlanBuilder& b, const BlockElements& elements)
{
    std::vector<std::vector<std::uint32_t>> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const std::uint32_t first = b.plan.body_start[body], end = b.plan.body_start[body + 1];
        std::vector<bool> free;
        for (std::uint32_t v = first; v < end; ++v)
            free.push_back(b.inverse_mass[v] > 0);
        VertexGraph graph(std::move(free));
        const auto add_corners = [&](const auto& corners) {
            std::vector<std::uint32_t> own;
            for (const std::uint32_t v : corners)
                own.push_back(v - first);
            if (own.front() < end - first) // unsigned: neither before nor behind the body
                graph.add(own, static_cast<std::uint32_t>(own.size()));
        };
        const auto add = [&](const auto& element) { add_corners(corners_of(element)); };
        std::for_each(elements.springs.begin(), elements.springs.end(), add);
        std::for_each(elements.hinges.begin(), elements.hinges.end(), add);
        std::for_each(elements.volumes.begin(), elements.volumes.end(), add);
        std::for_each(elements.solids.begin(), elements.solids.end(), add);
        for (const AddedSet& set : elements.added)
            for (std::size_t k = 0; k < set.count(); ++k)
                add_corners(std::span(set.vertices).subspan(k * set.kind->corners, set.kind->corners));
        graph.finish();
        const std::vector<glm::uvec3> places = box_places(b, body);
        const VertexColours found =
            places.empty() ? colour_vertices(graph, b.scene.bodies[body].mesh.grid_columns)
                           : colour_box(graph, places);
        out.resize(std::max<std::size_t>(out.size(), found.count));
        for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
            if (found.colour[v] != kNoColour)
                out[found.colour[v]].push_back(first + v);
    }
    std::erase_if(out, [](const auto& colour) { return colour.empty(); });
    return out;
}

/// Small colours in a row share a group, as far as its loops may go. A row costs as much as its elements.
std::vector<BlockBuffers::Run> runs_of(const PlanBuilder& b,
                                       const std::vector<std::vector<std::uint32_t>>& colours,
                                       std::uint32_t each, std::uint32_t most)
{
    // Added elements bring their part in passes before each colour's.
    const std::uint32_t limit = b.blocks->apart ? 0 : small_colour(b.traits) / std::max(each, 1u);
    std::vector<BlockBuffers::Run> runs;
    std::uint32_t row = 0;
    for (std::size_t c = 0; c < colours.size();)
    {
        std::uint64_t trips = 0, rows = 0;
        std::size_t end = c;
        while (end < colours.size() && size_of(colours[end]) <= limit)
        {
            const std::uint64_t more = (size_of(colours[end]) / kGroupSize + 1) * (std::uint64_t(most) + 2);
            if (trips + more >= kMaxLoopTrips)
                break;
            trips += more;
            rows += size_of(colours[end++]);
        }
        if (end - c < 2)
        {
            end = c + 1;
            rows = size_of(colours[c]);
        }
        runs.push_back({row, static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(end - c)});
        row += static_cast<std::uint32_t>(rows);
        c = end;
    }
    return runs;
}

void prepare_acceleration(PlanBuilder& b, BlockBuffers& f)
{
    if (f.omega.empty())
        return;
    const std::uint64_t bytes = std::uint64_t(b.plan.vertex_count) * 4 * b.real_size();
    f.newest = b.add_buffer("vbd_accelerate", "newest iterate", bytes);
    f.older = b.add_buffer("vbd_accelerate", "older iterate", bytes);
    f.body = b.add_buffer<std::uint32_t>("vbd_accelerate", "vertices of bodies", b.plan.body_start);
    f.progress = b.add_buffer("vbd_accelerate", "progress", b.scene.bodies.size() * 2 * b.real_size());
}

void record_acceleration(PlanBuilder& b, std::uint32_t iteration)
{
    const BlockBuffers& f = *b.blocks;
    const std::uint32_t n = b.plan.vertex_count;
    if (iteration > 0)
    {
        const auto bodies = static_cast<std::uint32_t>(b.scene.bodies.size());
        const kernels::vbd_progress::Bindings<Use> uses = {.start = {f.body, 2},
                                                           .position = {b.plan.position},
                                                           .delta = {b.plan.delta},
                                                           .newest = {f.newest},
                                                           .progress = {f.progress, 0}};
        b.dispatch("vbd_accelerate", "", uses, {bodies, iteration == 1}, bodies, n);
    }
    const kernels::vbd_accelerate::Bindings<Use> uses = {.delta = {b.plan.delta},
                                                         .newest = {f.newest},
                                                         .older = {f.older},
                                                         .support = {f.support},
                                                         .progress = {f.progress, 0}};
    b.dispatch("vbd_accelerate", "", uses, {n, f.omega[iteration]}, n);
}

} // namespace

void check_vbd(const Scene& scene, Refusals& out) { refuse_rigid(scene, out); }

std::vector<float> chebyshev_factors(double radius, std::uint32_t iterations)
{
    if (!(radius > 0) || iterations < kFewIterations)
        return {};
    const double most = 1 - 1.0 / (iterations - kPlainVbdIterations);
    const double square = std::min(radius, most) * std::min(radius, most);
    std::vector<float> out(iterations, 1.0f);
    double omega = 1;
    for (std::uint32_t i = kPlainVbdIterations + 1; i < iterations; ++i)
    {
        omega = i == kPlainVbdIterations + 1 ? 2 / (2 - square) : 4 / (4 - square * omega);
        out[i] = static_cast<float>(omega);
    }
    return out;
}

void prepare_vbd(PlanBuilder& b)
{
    b.blocks = std::make_shared<BlockBuffers>();
    BlockBuffers& f = *b.blocks;
    const BlockElements elements = elements_of(b);
    if (elements.empty())
        return;
    const auto colours = colours_of(b, elements);
    for (const auto& colour : colours)
        f.rows += size_of(colour);
    f.hinges = !elements.hinges.empty();
    f.damped = std::any_of(elements.springs.begin(), elements.springs.end(),
                           [](const StretchElement& e) { return e.damping > 0; });
    f.volumes = !elements.volumes.empty();
    f.apart = !elements.added.empty();
    f.elastic = !elements.solids.empty() || f.apart; // rows of that kind hold all others
    std::uint32_t most = 0;
    for (std::uint32_t v = 0; v < b.plan.vertex_count; ++v)
        most = std::max(most, elements.at(v));
    add_rows(b, f, elements, colours);
    f.runs = runs_of(b, colours, f.near(), most);
    f.omega = chebyshev_factors(b.scene.method.spectral_radius, b.plan.iterations);
    prepare_vbd_start(b, f);
    prepare_vbd_added(b, f, elements, colours);
    prepare_vbd_touch(b, f);
    prepare_acceleration(b, f);
    ConstraintSet set;
    set.kind = "vbd_solve";
    set.buffer = f.row;
    set.count = f.rows;
    set.colour_start.push_back(0);
    for (const auto& colour : colours)
        set.colour_start.push_back(set.colour_start.back() + size_of(colour));
    b.plan.constraints.push_back(set);
}

void record_vbd_solve(PlanBuilder& b, const Moment& moment)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0)
        return;
    if (!f.omega.empty())
        record_acceleration(b, moment.iteration);
    const std::uint32_t near = 1 + f.near();
    // With colliders there are plane and drag to read, too, and a reaction to write.
    Use guesses;
    if (!f.apart)
        guesses = f.surfaces ? Use{f.contacts, 2} : Use{b.plan.predicted, 1, true};
    kernels::vbd_solve::Bindings<Use> uses = {.row = {f.row, f.row_words()},
                                              .end = {f.ends, f.springs_each},
                                              .position = {b.plan.position, near},
                                              .predicted = guesses,
                                              .delta = {b.plan.delta, near},
                                              .events = {b.plan.events, 0}};
    if (f.corners != kNoBuffer)
        uses.corner = {f.corners, f.corners_each()};
    const bool damped = f.damped || f.elastic; // elastic rows have one variant, with dampers
    if (damped)
        uses.low = {b.plan.low, f.damped ? 1 + f.springs_each : 1};
    if (f.apart)
        uses.block = {f.block, 3, f.surfaces == 0};
    std::string kinds = f.apart     ? "added"
                        : f.elastic ? "elastic"
                        : f.volumes ? "volumes"
                        : f.hinges  ? "hinges"
                                    : "";
    if (damped && !f.elastic)
        kinds += kinds.empty() ? "damped" : "_damped";
    for (const BlockBuffers::Run& run : f.runs)
    {
        const std::string variant =
            std::string(run.grouped() ? "tail" : "") + (run.grouped() && !kinds.empty() ? "_" : "") + kinds;
        const kernels::vbd_solve::Params params{run.first, run.rows, moment.last,
                                                static_cast<float>(b.scene.method.relaxation), f.surfaces};
        record_vbd_added(b, run, moment.last);
        b.stands_for(run.colours);
        b.dispatch("vbd_solve", variant, uses, params, run.grouped() ? 1 : run.rows, run.rows);
    }
}

} // namespace taut
