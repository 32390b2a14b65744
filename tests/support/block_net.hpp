#pragma once
// Rows of vertex block descent with springs, hinges and tetrahedra, and the step of each by the formulas.

#include "support/hinge_net.hpp"
#include "support/tetrahedra.hpp"

#include <Eigen/Dense>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace taut::conformance {

enum class Solids
{
    none,
    volumes,
    elastic
};

/// Corner b is the row's own vertex.
template <typename Real>
struct BlockTetrahedron
{
    bool held_volume = false;
    layout::SolidTetrahedron<Real> solid;
    layout::BendingConstraint<Real> volume; ///< V0 for the angle
};

template <typename Real>
layout::SolidTetrahedron<Real> solid_test_record(const std::array<std::uint32_t, 4>& v,
                                                 const TetrahedronCorners& rest, double modulus, double log)
{
    Eigen::Matrix3d edges;
    for (std::size_t k = 1; k < 4; ++k)
        for (int axis = 0; axis < 3; ++axis)
            edges(axis, static_cast<int>(k) - 1) = rest[k][axis] - rest[0][axis];
    const Eigen::Matrix3d b = edges.inverse();
    const auto at = [&](int row, int column) { return static_cast<Real>(b(row, column)); };
    return {v[0],
            v[1],
            v[2],
            v[3],
            at(0, 0),
            at(0, 1),
            at(0, 2),
            at(1, 0),
            at(1, 1),
            at(1, 2),
            at(2, 0),
            at(2, 1),
            at(2, 2),
            static_cast<Real>(triple(rest) / 6),
            static_cast<Real>(modulus),
            static_cast<Real>(1.5 * modulus),
            static_cast<Real>(1 + (1 - 0.25 * log) / 1.5),
            static_cast<Real>(log)};
}

/// Rows of one colour: vertices that share elements only with others. 40 vertices stand before the rows, the
/// hinges' own behind them.
template <typename Real>
struct BlockNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<Vec> position, low, delta, predicted;
    std::vector<std::uint32_t> row;
    std::vector<layout::Spring<Real>> end;
    std::vector<layout::BendingConstraint<Real>> corner;
    std::vector<std::uint32_t> first_tetrahedron; ///< by row, and the end of the last
    std::vector<BlockTetrahedron<Real>> tetrahedra;
    std::uint32_t moved = ~0u; ///< a vertex that stands further by `move`
    glm::dvec3 move{0};

    glm::dvec3 before(std::uint32_t v) const { return glm::dvec3(position[v]); }
    glm::dvec3 place(std::uint32_t v) const
    {
        return before(v) + glm::dvec3(delta[v]) + (v == moved ? move : glm::dvec3(0));
    }
    double size(std::uint32_t v) const { return glm::length(before(v)) + glm::length(glm::dvec3(delta[v])); }
    bool held(std::uint32_t v) const { return !(position[v].w > 0); }

    std::uint32_t add_vertex(const glm::dvec3& x, Random& random, Real w)
    {
        position.push_back(Vec(glm::vec<3, Real>(x), w));
        low.push_back(random.vec4<Real>(0x1p-26, Real(0)));
        delta.push_back(random.vec4<Real>(1e-2, Real(1e-3)));
        predicted.push_back(random.vec4<Real>(1e-2, w > Real(0) ? Real(360000) / w : Real(0)));
        return static_cast<std::uint32_t>(position.size() - 1);
    }
};

constexpr std::uint32_t kBefore = 40;

template <typename Real>
void add_hinge(BlockNet<Real>& net, Random& random, std::uint32_t v, bool flat)
{
    const auto own = hinge_net<Real>(random, 1);
    const auto corner = random.below(4);
    const auto ids = own.corners(0);
    const glm::dvec3 shift = net.before(v) - glm::dvec3(own.position[ids[corner]]);
    std::uint32_t vertex[4];
    for (std::uint32_t k = 0; k < 4; ++k)
        vertex[k] = k == corner ? v
                                : net.add_vertex(glm::dvec3(own.position[ids[k]]) + shift, random,
                                                 random.inverse_mass<Real>());
    auto hinge = own.hinge[0];
    if (flat) // a wing on the edge
    {
        const std::uint32_t end = corner == 0 ? 1 : 0, wing = corner == 2 ? 3 : 2;
        net.position[vertex[wing]] = typename BlockNet<Real>::Vec(
            glm::vec<3, Real>(net.position[vertex[end]]), net.position[vertex[wing]].w);
        net.delta[vertex[wing]] = net.delta[vertex[end]];
    }
    hinge.edge0 = vertex[0];
    hinge.edge1 = vertex[1];
    hinge.wing0 = vertex[2];
    hinge.wing1 = vertex[3];
    // The displacements turned it: not near half a turn from rest.
    HingeCorners x;
    for (std::size_t k = 0; k < 4; ++k)
        x[k] = net.place(vertex[k]);
    if (!flat)
        hinge.rest_angle = static_cast<Real>(
            std::remainder(dual_angle(x).value + random.uniform(-2.8, 2.8), 2 * std::numbers::pi));
    net.corner.push_back(hinge);
}

/// A tetrahedron of which v is the second corner; flat, all in one point or on a line, or inverted ones among
/// them.
template <typename Real>
void add_tetrahedron(BlockNet<Real>& net, Random& random, std::uint32_t v, Solids solids)
{
    const TetrahedronCorners rest = random_tetrahedron(random);
    TetrahedronCorners x = rest;
    const std::uint32_t planted = random.below(12);
    for (glm::dvec3& corner : x)
        corner += 0.2 * glm::dvec3(random.vec4<double>(1, 0));
    if (planted == 0)
        x[3] = 0.5 * (x[0] + x[2]);
    if (planted == 1)
        x = {x[1], x[1], x[1], x[1]};
    if (planted == 2)
        std::swap(x[0], x[2]);
    std::array<std::uint32_t, 4> vertex{};
    for (std::uint32_t k = 0; k < 4; ++k)
        vertex[k] =
            k == 1 ? v : net.add_vertex(x[k] - x[1] + net.before(v), random, random.inverse_mass<Real>());
    for (std::uint32_t k = 0; k < 4 && planted == 1; ++k)
    {
        net.position[vertex[k]] = net.position[v];
        net.delta[vertex[k]] = net.delta[v];
    }
    for (std::uint32_t k = 0; k < 4 && planted == 3; ++k)
    {
        net.position[vertex[k]].y = net.position[v].y, net.position[vertex[k]].z = net.position[v].z;
        net.delta[vertex[k]].y = net.delta[v].y, net.delta[vertex[k]].z = net.delta[v].z;
    }
    const double modulus = std::pow(10.0, random.uniform(0, 6)), log = random.below(2);
    BlockTetrahedron<Real> t;
    t.held_volume = solids == Solids::volumes || random.below(4) == 0;
    t.solid = solid_test_record<Real>(vertex, rest, modulus, log);
    t.volume = {vertex[0], vertex[1],      vertex[2],
                vertex[3], t.solid.volume, t.solid.volume / static_cast<Real>(modulus)};
    if (t.held_volume && solids == Solids::elastic) // the same by the words of an elastic one
    {
        t.solid.mu = t.solid.log_term = t.solid.b00 = t.solid.b01 = t.solid.b02 = Real(0);
        t.solid.b10 = t.solid.b11 = t.solid.b12 = t.solid.b20 = t.solid.b21 = t.solid.b22 = Real(0);
        t.solid.lambda = t.volume.rest_angle / t.volume.compliance;
        t.solid.rest = Real(1);
    }
    net.tetrahedra.push_back(t);
}

template <typename Real>
BlockNet<Real> block_net(Random& random, std::uint32_t rows, bool hinges, Solids solids = Solids::none)
{
    BlockNet<Real> net;
    for (std::uint32_t i = 0; i < kBefore; ++i)
        net.add_vertex(glm::dvec3(random.vec4<double>(1, 0)), random, random.inverse_mass<Real>());
    for (std::uint32_t i = 0; i < rows; ++i)
        net.add_vertex(glm::dvec3(random.vec4<double>(1, 0)), random,
                       static_cast<Real>(std::pow(10.0, random.uniform(-1, 2))));
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        const std::uint32_t v = kBefore + i;
        net.row.insert(net.row.end(), {v, static_cast<std::uint32_t>(net.end.size()),
                                       static_cast<std::uint32_t>(net.corner.size()), rows});
        net.first_tetrahedron.push_back(static_cast<std::uint32_t>(net.tetrahedra.size()));
        for (std::uint32_t k = solids == Solids::none ? 0 : random.below(6); k > 0; --k)
            add_tetrahedron(net, random, v, solids);
        for (std::uint32_t k = random.below(13); k > 0; --k)
        {
            const double stiffness = std::pow(10.0, random.uniform(0, 7));
            net.end.push_back({v, random.below(kBefore), random.uniform<Real>(0, 1.5),
                               static_cast<Real>(stiffness),
                               static_cast<Real>(stiffness * random.uniform(0, 1e-2)), 0});
        }
        if (i == 3) // no direction: counted only where the other end is held, else at its own row
            for (const std::uint32_t other : {5u, 6u})
            {
                net.position[other] = net.position[v];
                net.position[other].w = other == 5 ? Real(0) : Real(1);
                net.delta[other] = net.delta[v];
                net.end.push_back({v, other, Real(0.5), Real(100), Real(1), 0});
                net.end.push_back({v, other, Real(0), Real(100), Real(1), 0});
            }
        for (std::uint32_t k = hinges ? random.below(4) : 0; k > 0; --k)
            add_hinge(net, random, v, i % 17 == 5);
    }
    net.row.insert(net.row.end(), {0, static_cast<std::uint32_t>(net.end.size()),
                                   static_cast<std::uint32_t>(net.corner.size()), rows});
    net.first_tetrahedron.push_back(static_cast<std::uint32_t>(net.tetrahedra.size()));
    if (net.end.empty())
        net.end.push_back({});
    return net;
}

/// J, and the sizes of its terms.
template <typename Real>
std::pair<double, double> tetrahedron_energy(const BlockNet<Real>& net, const BlockTetrahedron<Real>& tet)
{
    const layout::SolidTetrahedron<Real>& t = tet.solid;
    Eigen::Matrix3d e, b;
    const std::uint32_t vertex[3] = {t.b, t.c, t.d};
    for (int k = 0; k < 3; ++k)
    {
        const glm::dvec3 edge = net.place(vertex[k]) - net.place(t.a);
        e.col(k) << edge.x, edge.y, edge.z;
    }
    if (tet.held_volume)
    {
        const double away = e.determinant() / 6 - double(tet.volume.rest_angle);
        const double value = away * away / (2 * double(tet.volume.compliance));
        return {value, value};
    }
    b << double(t.b00), double(t.b01), double(t.b02), double(t.b10), double(t.b11), double(t.b12),
        double(t.b20), double(t.b21), double(t.b22);
    const Eigen::Matrix3d f = e * b;
    const double square = f.squaredNorm(), away = f.determinant() - double(t.rest);
    const double shape = 0.5 * double(t.mu) * (square - double(t.log_term) * std::log(square + 1));
    const double bulk = 0.5 * double(t.lambda) * away * away;
    return {double(t.volume) * (shape + bulk), double(t.volume) * (std::abs(shape) + bulk)};
}

/// Newton's step of the vertex' own energy by the formulas of methods 5.1 and 5.8, and how far rounding may
/// take it: |H^-1| (what was added to f + what was added to H times the step).
template <typename Real>
struct Block
{
    glm::dvec3 f{0};
    glm::dmat3 h{0};
    double f_scale = 0, h_scale = 0;
    std::uint32_t degenerate = 0;

    void outer(const glm::dvec3& a, const glm::dvec3& b, double k) { h += k * glm::outerProduct(a, b); }

    void spring(const BlockNet<Real>& net, const layout::Spring<Real>& s, bool damped, double inverse_substep)
    {
        const double k = double(s.stiffness), rest = double(s.rest_length);
        const glm::dvec3 d = net.place(s.a) - net.place(s.b);
        const double length = glm::length(d), size = net.size(s.a) + net.size(s.b);
        if (length == 0)
        {
            degenerate += rest > 0 && (s.a < s.b || net.held(s.b)) ? 1 : 0;
            return;
        }
        const glm::dvec3 n = d / length;
        // The damper's potential is c/2 (length - first)^2 / h: it pulls as a spring of the first length.
        const glm::dvec3 change = (glm::dvec3(net.delta[s.a]) - glm::dvec3(net.low[s.a])) -
                                  (glm::dvec3(net.delta[s.b]) - glm::dvec3(net.low[s.b]));
        const double c = damped ? double(s.damping) * inverse_substep : 0;
        const double first = glm::length(d - change), both = length + first;
        const double grown = both > 0 ? glm::dot(change, d + (d - change)) / both : 0;
        const double pull = k * (length - rest) + c * grown, turn = size / length;
        const double across = std::min(std::abs(pull) / length, k + c);
        f -= pull * n;
        h += across * glm::dmat3(1);
        outer(n, n, k + c - across);
        f_scale += k * (size + rest) + std::abs(pull) * (1 + turn);
        h_scale += k * (1 + turn) * (1 + rest / length) + c * (1 + turn) * (1 + first / length);
        f_scale += c * (glm::length(glm::dvec3(net.delta[s.a])) + glm::length(glm::dvec3(net.delta[s.b]))) *
                   (1 + turn) * (1 + size / std::max(both, 1e-30));
    }

    void hinge(const BlockNet<Real>& net, const layout::BendingConstraint<Real>& c, std::uint32_t v)
    {
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        HingeCorners x;
        double size = 0;
        std::size_t corner = 0, first = 4;
        for (std::size_t k = 0; k < 4; ++k)
        {
            x[k] = net.place(vertex[k]);
            size += net.size(vertex[k]);
            corner = vertex[k] == v ? k : corner;
            first = first == 4 && !net.held(vertex[k]) ? k : first;
        }
        const HingeTerm term = hinge_term(c, x, size, corner);
        if (!term.shaped)
        {
            degenerate += corner == first ? 1 : 0;
            return;
        }
        const double stiff = 1 / double(c.compliance), slope = glm::length(term.gradient);
        f -= stiff * term.value * term.gradient;
        outer(term.gradient, term.gradient, stiff);
        f_scale += stiff * (std::abs(term.value) * term.gradient_scale + slope * term.value_scale);
        h_scale += stiff * slope * term.gradient_scale;
    }

    /// Textbook formulas with all of F: P = mu q F + lambda (J - a) cof F, force -V P b.
    void tetrahedron(const BlockNet<Real>& net, const BlockTetrahedron<Real>& tet)
    {
        const layout::SolidTetrahedron<Real>& t = tet.solid;
        const std::uint32_t vertex[4] = {t.a, t.b, t.c, t.d};
        Eigen::Matrix3d e;
        double rounded = 0, longest = 0;
        for (int k = 0; k < 4; ++k)
        {
            const glm::dvec3 edge = net.place(vertex[k]) - net.place(vertex[0]);
            rounded += net.size(vertex[k]);
            longest = std::max(longest, glm::length(edge));
            if (k > 0)
                e.col(k - 1) << edge.x, edge.y, edge.z;
        }
        const double area = (longest * longest + 2 * longest * rounded) / 6;  // of the gradient of V
        const double space = longest * longest * (longest + 3 * rounded) / 6; // and of V
        if (tet.held_volume)
        {
            const Eigen::Vector3d g = e.col(1).cross(e.col(2)) / 6;
            const double stiff = 1 / double(tet.volume.compliance), rest = double(tet.volume.rest_angle);
            const double value = e.determinant() / 6 - rest;
            add(-stiff * value * g, stiff * g * g.transpose());
            f_scale += stiff * (area * std::abs(value) + g.norm() * (space + rest));
            h_scale += stiff * g.norm() * area;
            return;
        }
        Eigen::Matrix3d b;
        b << double(t.b00), double(t.b01), double(t.b02), double(t.b10), double(t.b11), double(t.b12),
            double(t.b20), double(t.b21), double(t.b22);
        const Eigen::Matrix3d stretched = e * b;
        Eigen::Matrix3d cofactor;
        cofactor << stretched.col(1).cross(stretched.col(2)), stretched.col(2).cross(stretched.col(0)),
            stretched.col(0).cross(stretched.col(1));
        const Eigen::Vector3d own = b.row(0).transpose(), pulled = stretched * own, g = cofactor * own;
        const double v = double(t.volume), mu = v * double(t.mu), lambda = v * double(t.lambda);
        const double log = double(t.log_term), beyond = stretched.squaredNorm() + 1, share = 1 - log / beyond;
        const double value = stretched.determinant() - double(t.rest);
        add(-mu * share * pulled - lambda * value * g,
            mu * std::max(share, 9.0 / 16) * own.squaredNorm() * Eigen::Matrix3d::Identity() +
                lambda * g * g.transpose() + 2 * mu * log / (beyond * beyond) * pulled * pulled.transpose());
        bool first = true;
        for (const std::uint32_t other : {t.a, t.c, t.d})
            first = first && (t.b < other || net.held(other));
        const double square = stretched.squaredNorm();
        degenerate += first && (square < 1e-6 || cofactor.squaredNorm() < 1e-13 * square * square) ? 1 : 0;
        const double turned = stretched.norm() + b.norm() * rounded;
        f_scale += mu * own.norm() * turned * (1 + stretched.norm()) +
                   lambda * (area / v * std::abs(value) + g.norm() * (space / v + double(t.rest)));
        h_scale += mu * own.squaredNorm() * (1 + turned) + lambda * g.norm() * area / v;
    }

    void add(const Eigen::Vector3d& force, const Eigen::Matrix3d& block)
    {
        f += glm::dvec3(force.x(), force.y(), force.z());
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                h[i][j] += block(j, i);
    }
};

} // namespace taut::conformance
