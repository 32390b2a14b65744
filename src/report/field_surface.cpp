// Based on: Doi, Koide. An efficient method of triangulating equi-valued surfaces by using tetrahedral cells.
// IEICE
//   Transactions 74, 1991 (marching tetrahedra; six of them round a cell's diagonal, as Kuhn cut the cube).
// Departures: none.

#include "taut/report/field_surface.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace taut {
namespace {

/// Corner c of a cell: bits 0, 1, 2 are the steps along x, y, z. Each path from 0 to 7 is a tetrahedron.
constexpr std::array<std::array<unsigned, 4>, 6> kPaths = {
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

class Marcher
{
public:
    explicit Marcher(const DistanceField& field) : field_(field) {}

    FieldSurface march()
    {
        for (std::size_t k = 0; k + 1 < field_.points[2]; ++k)
            for (std::size_t j = 0; j + 1 < field_.points[1]; ++j)
                for (std::size_t i = 0; i + 1 < field_.points[0]; ++i)
                    march_cell(i, j, k);
        return std::move(out_);
    }

private:
    std::size_t point(std::size_t cell, unsigned corner) const
    {
        const std::size_t row = field_.points[0];
        return cell + (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * row * field_.points[1];
    }

    glm::dvec3 place(std::size_t point) const
    {
        const std::size_t row = field_.points[0], layer = row * field_.points[1];
        return field_.place(point % row, point % layer / row, point / layer);
    }

    /// Of the edge between a point inside and one outside.
    std::uint32_t vertex(std::size_t inside, std::size_t outside)
    {
        const auto next = static_cast<std::uint32_t>(out_.positions.size());
        const auto [found, is_new] = vertices_.emplace(std::minmax(inside, outside), next);
        if (is_new)
        {
            const double a = field_.values[inside], b = field_.values[outside];
            out_.positions.push_back(glm::mix(place(inside), place(outside), a / (a - b)));
        }
        return found->second;
    }

    void add(std::array<std::uint32_t, 3> t, const glm::dvec3& way_out)
    {
        const auto& x = out_.positions;
        if (glm::dot(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), way_out) < 0)
            std::swap(t[1], t[2]);
        out_.triangles.push_back(t);
    }

    void march_cell(std::size_t i, std::size_t j, std::size_t k)
    {
        const std::size_t cell = field_.index(i, j, k);
        for (const auto& path : kPaths)
        {
            std::vector<std::size_t> inside, outside;
            for (const unsigned corner : path)
                (field_.values[point(cell, corner)] < 0 ? inside : outside).push_back(point(cell, corner));
            if (!inside.empty() && !outside.empty())
                march_tetrahedron(inside, outside);
        }
    }

    void march_tetrahedron(const std::vector<std::size_t>& inside, const std::vector<std::size_t>& outside)
    {
        glm::dvec3 way_out(0);
        for (const std::size_t p : outside)
            way_out += place(p) / double(outside.size());
        for (const std::size_t p : inside)
            way_out -= place(p) / double(inside.size());
        if (inside.size() == 2)
        {
            const std::uint32_t a = vertex(inside[0], outside[0]), b = vertex(inside[0], outside[1]),
                                c = vertex(inside[1], outside[1]), d = vertex(inside[1], outside[0]);
            add({a, b, c}, way_out);
            add({a, c, d}, way_out);
            return;
        }
        std::array<std::uint32_t, 3> t{};
        for (std::size_t n = 0; n < 3; ++n)
            t[n] = inside.size() == 1 ? vertex(inside[0], outside[n]) : vertex(inside[n], outside[0]);
        add(t, way_out);
    }

    const DistanceField& field_;
    FieldSurface out_;
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> vertices_;
};

} // namespace

FieldSurface surface_of(const DistanceField& field) { return Marcher(field).march(); }

} // namespace taut
