// Based on: Sederberg, Parry. Free-Form Deformation of Solid Geometric Models. SIGGRAPH 1986 (a lattice
//   carries what lies in it); Mueller, Gross. Interactive Virtual Materials. Graphics Interface 2004, section
//   4 (tetrahedra do, by barycentric weights).
// Departures: vertices outside of all tetrahedra hang on the nearest one, with negative weights.

#include "taut/scene/embedding.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kInside = -1e-12;     ///< least weight of a point that a tetrahedron holds: rounding
constexpr std::uint32_t kMost = 1024;  ///< cells of the grid along an axis

/// A tetrahedron as the search sees it.
struct Element
{
    glm::dvec3 origin;
    glm::dmat3 inverse; ///< of its edges from the origin
    glm::dvec3 low, high;
};

Element element_of(const Mesh& solid, const std::array<std::uint32_t, 4>& t)
{
    const std::vector<glm::dvec3>& x = solid.positions;
    Element out;
    out.origin = out.low = out.high = x[t[0]];
    out.inverse = glm::inverse(glm::dmat3(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]], x[t[3]] - x[t[0]]));
    for (const std::uint32_t v : t)
    {
        out.low = glm::min(out.low, x[v]);
        out.high = glm::max(out.high, x[v]);
    }
    return out;
}

glm::dvec4 weights_of(const Element& e, const glm::dvec3& p)
{
    const glm::dvec3 w = e.inverse * (p - e.origin);
    return {1 - (w.x + w.y + w.z), w.x, w.y, w.z};
}

double least(const glm::dvec4& w) { return std::min({w.x, w.y, w.z, w.w}); }

glm::dvec3 blend(const glm::dvec4& w, const std::array<std::uint32_t, 4>& t, std::span<const glm::dvec3> x)
{
    return w.x * x[t[0]] + w.y * x[t[1]] + w.z * x[t[2]] + w.w * x[t[3]];
}

double longest_edge(const std::array<std::uint32_t, 4>& t, std::span<const glm::dvec3> x)
{
    double out = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
            out = std::max(out, glm::distance(x[t[i]], x[t[j]]));
    return out;
}

/// What the search knows of a vertex.
struct Found
{
    std::uint32_t tetrahedron = 0;
    double distance = kInfinity; ///< 0: held
    glm::dvec4 weights{0};
};

/// Tetrahedra by the cells that their boxes touch. Cells are about as large as the boxes.
class Grid
{
public:
    explicit Grid(const Mesh& solid) : solid_(solid)
    {
        glm::dvec3 extents(0);
        low_ = glm::dvec3(kInfinity);
        high_ = -low_;
        for (const auto& t : solid.tetrahedra)
        {
            elements_.push_back(element_of(solid, t));
            low_ = glm::min(low_, elements_.back().low);
            high_ = glm::max(high_, elements_.back().high);
            extents += elements_.back().high - elements_.back().low;
        }
        extents /= static_cast<double>(elements_.size());
        const glm::dvec3 whole = high_ - low_;
        size_ = std::max({extents.x, extents.y, extents.z, std::max({whole.x, whole.y, whole.z}) / kMost});
        for (int axis = 0; axis < 3; ++axis)
            count_[axis] = static_cast<std::int64_t>(whole[axis] / size_) + 1;
        fill();
    }

    Found find(const glm::dvec3& p) const
    {
        Found best;
        const glm::dvec3 near = glm::clamp(p, low_, high_);
        const Cell centre = cell_of(near);
        const double away = glm::distance(p, near);
        const std::int64_t rings = std::max({count_[0], count_[1], count_[2]});
        for (std::int64_t ring = 0; ring <= rings; ++ring)
        {
            // Cells of this ring are at least so far from `near`, and the grid's box is convex.
            const double beyond = static_cast<double>(std::max<std::int64_t>(ring - 1, 0)) * size_;
            if (best.distance * best.distance <= away * away + beyond * beyond)
                break;
            visit_ring(centre, ring, [&](std::size_t cell) { look(cell, p, best); });
        }
        return best;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const glm::dvec3& p) const
    {
        Cell out;
        for (int axis = 0; axis < 3; ++axis)
            out[static_cast<std::size_t>(axis)] =
                std::clamp<std::int64_t>(static_cast<std::int64_t>((p[axis] - low_[axis]) / size_), 0,
                                         count_[static_cast<std::size_t>(axis)] - 1);
        return out;
    }

    std::size_t number(std::int64_t x, std::int64_t y, std::int64_t z) const
    {
        return static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
    }

    template <typename Visit>
    void each_cell(const Element& e, const Visit& visit) const
    {
        const Cell from = cell_of(e.low), to = cell_of(e.high);
        for (std::int64_t z = from[2]; z <= to[2]; ++z)
            for (std::int64_t y = from[1]; y <= to[1]; ++y)
                for (std::int64_t x = from[0]; x <= to[0]; ++x)
                    visit(number(x, y, z));
    }

    void fill()
    {
        start_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
        for (const Element& e : elements_)
            each_cell(e, [&](std::size_t cell) { ++start_[cell + 1]; });
        for (std::size_t k = 1; k < start_.size(); ++k)
            start_[k] += start_[k - 1];
        entries_.resize(start_.back());
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (std::uint32_t k = 0; k < elements_.size(); ++k)
            each_cell(elements_[k], [&](std::size_t cell) { entries_[next[cell]++] = k; });
    }

    template <typename Visit>
    void visit_ring(const Cell& centre, std::int64_t ring, const Visit& visit) const
    {
        const auto from = [&](std::size_t axis) { return std::max<std::int64_t>(centre[axis] - ring, 0); };
        const auto to = [&](std::size_t axis) { return std::min(centre[axis] + ring, count_[axis] - 1); };
        for (std::int64_t z = from(2); z <= to(2); ++z)
            for (std::int64_t y = from(1); y <= to(1); ++y)
            {
                const bool shell = std::abs(z - centre[2]) == ring || std::abs(y - centre[1]) == ring;
                const std::int64_t step = shell || ring == 0 ? 1 : 2 * ring; // only both ends of the row
                for (std::int64_t x = centre[0] - ring; x <= centre[0] + ring; x += step)
                    if (x >= 0 && x < count_[0])
                        visit(number(x, y, z));
            }
    }

    /// Of tetrahedra that hold p (on a face of two) the first in their order is taken.
    void look(std::size_t cell, const glm::dvec3& p, Found& best) const
    {
        for (std::size_t k = start_[cell]; k < start_[cell + 1]; ++k)
        {
            const std::uint32_t number = entries_[k];
            const glm::dvec4 w = weights_of(elements_[number], p);
            double distance = 0;
            if (least(w) < kInside)
            {
                const glm::dvec4 kept = glm::max(w, glm::dvec4(0));
                const double sum = kept.x + kept.y + kept.z + kept.w; // at least 1
                distance = glm::distance(p, blend(kept / sum, solid_.tetrahedra[number], solid_.positions));
            }
            if (distance < best.distance || (distance == best.distance && number < best.tetrahedron))
                best = {number, distance, w};
        }
    }

    const Mesh& solid_;
    std::vector<Element> elements_;
    glm::dvec3 low_{0}, high_{0};
    double size_ = 1; ///< of a cell, m
    Cell count_{1, 1, 1};
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> entries_;
};

} // namespace

Embedding embed(Mesh surface, const Mesh& solid, EmbeddingFindings* findings)
{
    const Grid grid(solid);
    Embedding out;
    EmbeddingFindings seen;
    for (std::uint32_t v = 0; v < surface.positions.size(); ++v)
    {
        const Found found = grid.find(surface.positions[v]);
        out.tetrahedron.push_back(found.tetrahedron);
        out.weights.push_back(found.weights);
        seen.outside += found.distance > 0;
        if (!(found.distance > longest_edge(solid.tetrahedra[found.tetrahedron], solid.positions)))
            continue;
        if (seen.far == 0)
        {
            seen.first_far = v;
            seen.first_distance = found.distance;
        }
        ++seen.far;
    }
    out.surface = std::move(surface);
    if (findings)
        *findings = seen;
    return out;
}

std::vector<glm::dvec3> carry(const Embedding& embedding, const Mesh& solid,
                              std::span<const glm::dvec3> positions)
{
    std::vector<glm::dvec3> out;
    out.reserve(embedding.weights.size());
    for (std::size_t v = 0; v < embedding.weights.size(); ++v)
        out.push_back(
            blend(embedding.weights[v], solid.tetrahedra[embedding.tetrahedron[v]], positions));
    return out;
}

bool any_embedding(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [](const Body& body) { return body.embedding.used(); });
}

Scene shown_scene(const Scene& resolved)
{
    Scene out = resolved;
    for (Body& body : out.bodies)
        if (body.embedding.used())
        {
            body.mesh = body.embedding.surface;
            body.embedding = {};
        }
    return out;
}

std::vector<glm::dvec3> shown_positions(const Scene& resolved, std::span<const glm::dvec3> positions)
{
    std::vector<glm::dvec3> out;
    std::size_t first = 0;
    for (const Body& body : resolved.bodies)
    {
        const auto own = positions.subspan(first, body.mesh.positions.size());
        first += own.size();
        if (!body.embedding.used())
        {
            out.insert(out.end(), own.begin(), own.end());
            continue;
        }
        const std::vector<glm::dvec3> carried = carry(body.embedding, body.mesh, own);
        out.insert(out.end(), carried.begin(), carried.end());
    }
    return out;
}

} // namespace taut
