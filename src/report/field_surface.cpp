// Based on: Doi, Koide. An efficient method of triangulating equi-valued surfaces by using tetrahedral cells.
//   IEICE Transactions 74, 1991 (marching tetrahedra; six of them round a cell's diagonal, as Kuhn cut the
//   cube).
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
        unsigned inside = 0; // a bit a corner
        for (unsigned corner = 0; corner < 8; ++corner)
            inside |= unsigned(field_.values[point(cell, corner)] < 0) << corner;
        if (inside != 0 && inside != 255)
            for (const auto& path : kPaths)
                march_tetrahedron(cell, path, inside);
    }

    /// `inside`: of the corners of the cell.
    void march_tetrahedron(std::size_t cell, const std::array<unsigned, 4>& path, unsigned inside)
    {
        std::array<std::size_t, 4> order{}; // those inside first
        std::size_t in = 0, out = 4;
        glm::dvec3 sum_in(0), sum_out(0);
        for (const unsigned corner : path)
        {
            const std::size_t p = point(cell, corner);
            const bool is_in = (inside >> corner & 1) != 0;
            order[is_in ? in++ : --out] = p;
            (is_in ? sum_in : sum_out) += place(p);
        }
        if (in == 0 || in == 4)
            return;
        const glm::dvec3 way_out = sum_out / double(4 - in) - sum_in / double(in);
        const auto cut = [&](std::size_t a, std::size_t b) { return vertex(order[a], order[b]); };
        if (in == 2)
        {
            const std::uint32_t a = cut(0, 2), b = cut(0, 3), c = cut(1, 3), d = cut(1, 2);
            add({a, b, c}, way_out);
            add({a, c, d}, way_out);
        }
        else if (in == 1)
            add({cut(0, 1), cut(0, 2), cut(0, 3)}, way_out);
        else
            add({cut(0, 3), cut(1, 3), cut(2, 3)}, way_out);
    }

    const DistanceField& field_;
    FieldSurface out_;
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> vertices_;
};

} // namespace

FieldSurface surface_of(const DistanceField& field) { return Marcher(field).march(); }

} // namespace taut
