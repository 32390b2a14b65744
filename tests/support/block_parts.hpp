#pragma once
// The kinds of rows of vertex block descent, their buffers, and bodies dealt to groups as the plan does it.

#include "support/block_net.hpp"

#include "taut/kernels/shared/vbd_parts.h"

namespace taut::conformance {

struct Kinds
{
    bool hinges = false, damped = false;
    Solids solids = Solids::none;
    std::uint32_t words() const { return solids == Solids::none ? 4 : 5; }
    std::string variant(bool tail) const
    {
        std::string word = tail ? "tail" : "";
        const bool held = solids == Solids::volumes, elastic = solids == Solids::elastic;
        for (const auto& [on, name] : {std::pair{elastic, "elastic"}, std::pair{held, "volumes"},
                                       std::pair{hinges && !held && !elastic, "hinges"},
                                       std::pair{damped && !elastic, "damped"}})
            if (on)
                word += (word.empty() ? "" : "_") + std::string(name);
        return word;
    }
};

/// Rows of four or five words.
template <typename Real>
std::vector<std::uint32_t> rows_of(const BlockNet<Real>& net, const Kinds& kinds)
{
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; 4 * i < net.row.size(); ++i)
    {
        out.insert(out.end(), net.row.begin() + static_cast<std::ptrdiff_t>(4 * i),
                   net.row.begin() + static_cast<std::ptrdiff_t>(4 * i + 4));
        if (kinds.words() == 5)
            out.push_back(static_cast<std::uint32_t>(net.corner.size()) + net.first_tetrahedron[i]);
    }
    return out;
}

/// Hinges of all rows, then the tetrahedra.
template <typename Real>
std::vector<std::byte> corners_of(const BlockNet<Real>& net, const Kinds& kinds)
{
    auto plain = net.corner;
    std::vector<layout::SolidTetrahedron<Real>> solid;
    for (const auto& c : net.corner)
        solid.push_back({c.edge0, c.edge1, c.wing0, c.wing1, c.rest_angle, c.compliance, 0, 0, 0, 0, 0, 0, 0,
                         0, 0, 0, 0, 0});
    for (const BlockTetrahedron<Real>& t : net.tetrahedra)
    {
        plain.push_back(t.volume);
        solid.push_back(t.solid);
    }
    plain.push_back({}); // a buffer is not empty
    solid.push_back({});
    return kinds.solids == Solids::elastic ? bytes_of(solid) : bytes_of(plain);
}

template <typename Real>
Buffers buffers_of(const BlockNet<Real>& net, const Kinds& kinds)
{
    return {{"row", bytes_of(rows_of(net, kinds))}, {"end", bytes_of(net.end)},
            {"position", bytes_of(net.position)},   {"predicted", bytes_of(net.predicted)},
            {"delta", bytes_of(net.delta)},         {"corner", corners_of(net, kinds)},
            {"low", bytes_of(net.low)},             {"events", no_events()}};
}

/// Three vectors a vertex, as kernels/methods/vbd/vbd.comp leaves them.
template <typename Real>
std::vector<glm::vec<4, Real>> random_blocks(Random& random, const std::vector<glm::vec<4, Real>>& predicted)
{
    std::vector<glm::vec<4, Real>> out;
    for (const auto& y : predicted)
    {
        const glm::vec<4, Real> f = random.vec4<Real>(10, 0);
        out.emplace_back(f.x, f.y, f.z, y.w);
        for (const double size : {1.0, 0.2})
        {
            const auto part = [&] { return y.w * random.uniform<Real>(0.5 * size, size); };
            const Real x = part(), mid = part(), z = part();
            out.emplace_back(x, mid, z, Real(0));
        }
    }
    return out;
}

/// Of row i; `known`: what added elements bring, three vectors a vertex.
template <typename Real>
Block<Real> block_of_row(const BlockNet<Real>& net, const Kinds& kinds, std::uint32_t i,
                         const std::vector<glm::vec<4, Real>>* known)
{
    const std::uint32_t v = net.row[4 * i];
    const double inertia = double(net.predicted[v].w);
    Block<Real> block;
    const glm::dvec3 y(net.predicted[v]), d(net.delta[v]);
    block.f = inertia * (y - d);
    block.f_scale = inertia * (glm::length(y) + glm::length(d));
    block.h = glm::dmat3(inertia);
    block.h_scale = inertia;
    if (known)
    {
        const glm::dvec3 own((*known)[3 * v + 1]), beside((*known)[3 * v + 2]);
        block.f = glm::dvec3((*known)[3 * v]);
        block.f_scale = glm::length(block.f);
        block.h +=
            glm::dmat3(own.x, beside.x, beside.y, beside.x, own.y, beside.z, beside.y, beside.z, own.z);
        block.h_scale += glm::length(own) + glm::length(beside);
    }
    for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
        block.spring(net, net.end[k], kinds.damped, std::sqrt(inertia * double(net.position[v].w)));
    for (std::uint32_t k = net.row[4 * i + 2]; kinds.hinges && k < net.row[4 * i + 6]; ++k)
        block.hinge(net, net.corner[k], v);
    for (std::uint32_t k = net.first_tetrahedron[i]; k < net.first_tetrahedron[i + 1]; ++k)
        block.tetrahedron(net, net.tetrahedra[k]);
    return block;
}

/// Rows 0 .. count - 1 as bodies of several sizes, every other one with something held.
struct BodyParts
{
    struct Part
    {
        std::uint32_t base = 0, first = 0, end = 0, from = 0, to = 0;
        bool held = false;
    };
    std::vector<Part> parts;
    std::vector<std::uint32_t> order; ///< rows
    std::uint32_t groups = 0;

    std::vector<std::uint32_t> behind(std::vector<std::uint32_t> row) const
    {
        for (const Part& p : parts)
            row.insert(row.end(), {p.base, p.first, p.end, p.from, p.to, p.held ? 1u : 0u});
        row.insert(row.end(), order.begin(), order.end());
        return row;
    }

    /// Words of rows of which only the vertex is read, row k that of vertex `first + k`.
    std::vector<std::uint32_t> plain_rows(std::uint32_t words, std::uint32_t first) const
    {
        std::vector<std::uint32_t> row(words * (order.size() + 1), 0u);
        for (std::uint32_t k = 0; k < order.size(); ++k)
            row[words * k] = first + k;
        return row;
    }
};

inline BodyParts deal_parts(std::uint32_t rows)
{
    BodyParts out;
    for (std::uint32_t k = 0; k < rows; ++k)
        out.order.push_back(rows - 1 - k); // any order
    constexpr std::uint32_t sizes[] = {1, 63, 64, 130, 7, 200};
    for (std::uint32_t first = 0, body = 0; first < rows; ++body)
    {
        const std::uint32_t end = std::min(rows, first + sizes[body % 6]);
        const std::uint32_t from = out.groups, to = from + (end - first + 39) / 40;
        for (std::uint32_t g = from; g < to; ++g)
            out.parts.push_back({out.order[first], first + 40 * (g - from),
                                 std::min(end, first + 40 * (g - from + 1)), from, to, body % 2 == 1});
        out.groups = to;
        first = end;
    }
    return out;
}

} // namespace taut::conformance
