// Based on: Roache, Verification and Validation in Computational Science and Engineering, 1998, 5.4 to 5.10
//   (observed order, Richardson's extrapolation, the error that it estimates).
// Departures: one order for all vertices, of mass-weighted norms; the own error is all of the last
//   correction.
#include "taut/report/continuum.hpp"

#include "taut/report/cost_reference.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace taut {
namespace {

constexpr double kLeastOrder = 0.7, kMostOrder = 4.3;
constexpr std::uint32_t kMostCells = 1u << 24; ///< of a shape, so that four times are a number
constexpr std::uint32_t kMostSteps = 400; ///< of Newton's method on each mesh; cloth that buckles takes more
/// Of the mesh's error that its own may be: with one finer mesh that of order 0.7.
constexpr double kShare = 0.65;

/// A scene with `up` / `down` times the cells of its shapes; empty where these are not whole.
std::optional<Scene> refined(const Scene& scene, std::uint32_t up, std::uint32_t down)
{
    Scene out = scene;
    bool whole = true;
    const auto scale = [&](std::uint32_t& cells) {
        whole = whole && cells % down == 0 && cells < kMostCells;
        cells = cells / down * up;
    };
    for (Body& body : out.bodies)
    {
        Shape& shape = body.shape;
        if (shape.kind == ShapeKind::chain)
            scale(shape.links);
        else if (shape.kind == ShapeKind::ball)
            scale(shape.ball_cells);
        for (int axis = 0; axis < 3 && shape.kind == ShapeKind::box; ++axis)
            scale(shape.box_cells[axis]);
        for (int axis = 0; axis < 2 && shape.kind == ShapeKind::grid; ++axis)
            scale(shape.cells[axis]);
    }
    return whole ? std::optional(out) : std::nullopt;
}

/// Of the meshes that resolve() makes, without making them.
double vertex_count(const Scene& scene)
{
    double out = 0;
    for (const Body& body : scene.bodies)
    {
        const Shape& shape = body.shape;
        const auto along = [](std::uint32_t cells) { return cells + 1.0; };
        if (shape.kind == ShapeKind::chain)
            out += along(shape.links);
        else if (shape.kind == ShapeKind::ball)
            out += std::pow(along(shape.ball_cells), 3);
        else if (shape.kind == ShapeKind::box)
            out += along(shape.box_cells.x) * along(shape.box_cells.y) * along(shape.box_cells.z);
        else
            out += along(shape.cells.x) * along(shape.cells.y);
    }
    return out;
}

/// Why a body has no finer mesh; empty where it has one.
std::string not_refinable(const Body& body)
{
    if (!body.mesh.positions.empty())
        return "is resolved already: pass the scene as it was loaded";
    if (body.shape.kind == ShapeKind::mesh || body.shape.kind == ShapeKind::tetrahedra)
        return "has a mesh from a file, which has no finer one: take a grid, a chain, a box or a ball";
    if (!body.vertex_masses.empty() || !body.start_positions.empty() || !body.springs.empty() ||
        !body.elements.empty())
        return "says masses, places, springs or elements of single vertices, which a finer mesh does not "
               "have";
    if (std::any_of(body.pins.begin(), body.pins.end(), [](const Pin& pin) { return !pin.vertices.empty(); }))
        return "has pins that name vertices, which are others in a finer mesh: name edges, corners, faces or "
               "a box";
    return "";
}

/// A scene on one of its meshes, at rest.
struct Level
{
    PhysicalModel model;
    ErrorWeights weights;
    std::vector<glm::dvec3> rest;
};

/// For each vertex of `coarse` the one of `fine` that starts in the same place of the same body; empty where
/// one has none.
std::vector<std::size_t> same_places(const PhysicalModel& coarse, const PhysicalModel& fine)
{
    const double near = 1e-9 * coarse.diameter;
    std::vector<std::size_t> out;
    for (std::size_t body = 0; body + 1 < coarse.body_start.size(); ++body)
    {
        std::vector<std::size_t> by_x(fine.body_start[body + 1] - fine.body_start[body]);
        for (std::size_t k = 0; k < by_x.size(); ++k)
            by_x[k] = fine.body_start[body] + k;
        const auto x_of = [&](std::size_t v) { return fine.start[v].x; };
        std::sort(by_x.begin(), by_x.end(), [&](auto a, auto b) { return x_of(a) < x_of(b); });
        for (std::size_t v = coarse.body_start[body]; v < coarse.body_start[body + 1]; ++v)
        {
            const glm::dvec3& place = coarse.start[v];
            auto at = std::lower_bound(by_x.begin(), by_x.end(), place.x - near,
                                       [&](std::size_t k, double x) { return x_of(k) < x; });
            while (at != by_x.end() && x_of(*at) <= place.x + near &&
                   glm::distance(fine.start[*at], place) > near)
                ++at;
            if (at == by_x.end() || x_of(*at) > place.x + near)
                return {};
            out.push_back(*at);
        }
    }
    return out;
}

std::vector<glm::dvec3> restricted(const Level& fine, const std::vector<std::size_t>& vertices)
{
    std::vector<glm::dvec3> out;
    for (const std::size_t v : vertices)
        out.push_back(fine.rest[v]);
    return out;
}

class Richardson
{
public:
    explicit Richardson(const Scene& scene) : scene_(scene) {}

    ContinuumReference run()
    {
        for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
            if (const std::string why = not_refinable(scene_.bodies[b]); !why.empty())
                return refusal("bodies[" + std::to_string(b) + "] " + why);
        if (const std::string why = cost::unmodelled(scene_); !why.empty())
            return refusal(why);
        if (!held_still(scene_))
            return refusal("pins move, or a body has none: nothing comes to rest");
        if (const std::string why = solve_levels(); !why.empty())
            return refusal(why);
        return extrapolated();
    }

private:
    ContinuumReference refusal(const std::string& why)
    {
        out_.reason = why;
        return out_;
    }

    /// Fills levels_ and own_; empty, or why not.
    std::string solve_levels()
    {
        const std::string most = std::to_string(kMostContinuumVertices);
        using Factor = std::array<std::uint32_t, 2>;
        constexpr std::array<std::array<Factor, 3>, 2> kChoices{
            {{Factor{1, 1}, Factor{2, 1}, Factor{4, 1}}, {Factor{1, 2}, Factor{1, 1}, Factor{2, 1}}}};
        for (std::size_t choice = 0; choice < kChoices.size(); ++choice)
        {
            std::vector<Scene> scenes;
            for (const Factor& f : kChoices[choice])
                if (const auto scene = refined(scene_, f[0], f[1]))
                    scenes.push_back(*scene);
            if (scenes.size() < 3)
                return "four times the cells make more than " + most +
                       " vertices, and a count of cells is odd, so that no mesh has half of them: take fewer "
                       "cells, or even "
                       "counts";
            if (vertex_count(scenes.back()) > static_cast<double>(kMostContinuumVertices))
                continue;
            own_ = choice;
            return solve(scenes);
        }
        return "twice the cells make more than " + most + " vertices: take fewer cells";
    }

    std::string solve(const std::vector<Scene>& scenes)
    {
        StaticOptions options;
        options.iterations = kMostSteps;
        for (const Scene& scene : scenes)
        {
            Level level{make_model(resolve(scene)), {}, {}};
            level.weights = error_weights(level.model);
            const StaticReference found = solve_static(level.model, level.model.start, options);
            const std::string on = std::to_string(level.model.mass.size()) + " vertices";
            if (!found.converged || !found.stable)
                return "on a mesh of " + on + ": " + found.reason;
            level.rest = found.positions;
            out_.vertices.push_back(level.model.mass.size());
            levels_.push_back(std::move(level));
        }
        return "";
    }

    ContinuumReference extrapolated()
    {
        const Level &coarse = levels_[0], &middle = levels_[1], &fine = levels_[2], &own = levels_[own_];
        const auto coarse_middle = same_places(coarse.model, middle.model);
        const auto coarse_fine = same_places(coarse.model, fine.model);
        const auto own_middle = same_places(own.model, middle.model);
        const auto own_fine = same_places(own.model, fine.model);
        if (coarse_middle.empty() || coarse_fine.empty() || own_middle.empty() || own_fine.empty())
            return refusal("finer meshes do not have the vertices of the coarser ones");
        const auto first = restricted(middle, coarse_middle), second = restricted(fine, coarse_fine);
        const double before = distance_by_mass(coarse.weights, coarse.rest, first);
        const double after = distance_by_mass(coarse.weights, first, second);
        out_.order = std::log2(before / after);
        if (!(out_.order >= kLeastOrder && out_.order <= kMostOrder))
            return refusal("twice the cells change the place of rest by " + shown(before, 3) +
                           ", twice as many again by " + shown(after, 3) +
                           " (m kg^1/2): that is no order of convergence from 0.7 to 4.3");
        const double gain = 1 / (std::exp2(out_.order) - 1);
        const auto last = restricted(fine, own_fine), before_last = restricted(middle, own_middle);
        out_.positions = last;
        for (std::size_t v = 0; v < last.size(); ++v)
            out_.positions[v] += gain * (last[v] - before_last[v]);
        const auto off = [&](const std::vector<glm::dvec3>& x) {
            return displacement_error(own.weights, x, out_.positions, own.model.start).value_or(0);
        };
        out_.own = own.rest;
        out_.error = off(last);
        out_.mesh_error = off(own.rest);
        if (!(out_.error <= kShare * out_.mesh_error))
            return refusal("its own error, " + shown_percent(out_.error) + ", is too near to the mesh's, " +
                           shown_percent(out_.mesh_error));
        out_.text = "Newton in fp64 on meshes of " + std::to_string(out_.vertices[0]) + ", " +
                    std::to_string(out_.vertices[1]) + " and " + std::to_string(out_.vertices[2]) +
                    " vertices, extrapolated; observed order " + shown(out_.order, 3) + ", own error " +
                    shown_percent(out_.error);
        return out_;
    }

    const Scene& scene_;
    std::vector<Level> levels_;
    std::size_t own_ = 0; ///< which of them is the scene's own
    ContinuumReference out_;
};

} // namespace

ContinuumReference continuum_reference(const Scene& scene) { return Richardson(scene).run(); }

} // namespace taut
