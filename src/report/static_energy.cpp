// Based on: Choi, Ko, Stable but Responsive Cloth, 2002 (the part of a compressed spring's Hessian that the
//   projection drops); Griewank, Walther, Evaluating Derivatives, 2008 (dual numbers for the hinges); Smith,
//   de Goes, Kim, Stable Neo-Hookean Flesh Simulation, 2018 (energy and derivative of the tetrahedra).
// Departures: a projected hinge keeps only the outer product of its gradient; a projected tetrahedron has the
//   eigenvalues of its 9 x 9 matrix that are negative set to zero.
#include "taut/report/static_energy.hpp"

#include "taut/report/added_stiffness.hpp"
#include "taut/report/positive_part.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace taut::reference {
namespace {

using Real33 = Eigen::Matrix<Real, 3, 3>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

Eigen::Matrix<Real, 3, 1> column(const Vec<Real>& a) { return {a.x, a.y, a.z}; }

Real33 cofactor(const Real33& f)
{
    Real33 out;
    out << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    return out;
}

Real33 inverse_rest(const SolidElement& e)
{
    Real33 out;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out(r, c) = e.inverse_rest[c][r];
    return out;
}

Real33 deformation(const SolidElement& e, const State& x)
{
    Real33 edges;
    for (int c = 0; c < 3; ++c)
        edges.col(c) = column(x[e.vertex[static_cast<std::size_t>(c) + 1]] - x[e.vertex[0]]);
    return edges * inverse_rest(e);
}

Real33 stress(const SolidElement& e, const Real33& f)
{
    const Real share = 1 - static_cast<Real>(e.log) / (f.squaredNorm() + 1);
    return static_cast<Real>(e.mu) * share * f +
           static_cast<Real>(e.lambda) * (f.determinant() - static_cast<Real>(e.rest)) * cofactor(f);
}

/// dP/dF by columns of F. The cofactor is quadratic in F, so half a central difference with a step of 1 is
/// its derivative.
Matrix9 stress_derivative(const SolidElement& e, const Real33& at)
{
    const Eigen::Matrix3d f = at.cast<double>();
    const auto flat = [](const Real33& m) {
        const Eigen::Matrix3d narrow = m.cast<double>();
        return Eigen::Matrix<double, 9, 1>(Eigen::Map<const Eigen::Matrix<double, 9, 1>>(narrow.data()));
    };
    const Eigen::Matrix<double, 9, 1> g = flat(cofactor(at)), own = flat(at);
    const double grown = f.squaredNorm() + 1, push = e.lambda * (f.determinant() - e.rest);
    Matrix9 out = Matrix9::Identity() * (e.mu * (1 - e.log / grown));
    out += 2 * e.mu * e.log / (grown * grown) * own * own.transpose() + e.lambda * g * g.transpose();
    for (int k = 0; k < 9; ++k)
    {
        Real33 unit = Real33::Zero();
        unit(k % 3, k / 3) = 1;
        out.col(k) += push / 2 * (flat(cofactor(at + unit)) - flat(cofactor(at - unit)));
    }
    return out;
}

Vec<double> narrow(const Vec<Real>& a)
{
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

Real length(const Vec<Real>& a)
{
    return std::sqrt(dot(a, a));
}

std::array<std::uint32_t, 4> vertices(const BendElement& h)
{
    return {h.edge0, h.edge1, h.wing0, h.wing1};
}

/// k (n n^T + (1 - L/l) (I - n n^T)); the second part is dropped in compression when projected.
Eigen::Matrix3d spring_block(const StretchElement& s, const Vec<double>& d, Curvature curvature)
{
    const Eigen::Vector3d v(d.x, d.y, d.z);
    const double l = v.norm(), k = 1 / s.compliance;
    if (!(l > 0))
        return k * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d along = v * v.transpose() / (l * l);
    double side = 1 - s.rest_length / l;
    if (curvature == Curvature::projected)
        side = std::max(side, 0.0);
    return k * (along + side * (Eigen::Matrix3d::Identity() - along));
}

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// dg/dx of the angle by dual numbers.
Matrix12 angle_hessian(const std::array<Vec<double>, 4>& x)
{
    std::array<Vec<Dual<12>>, 4> corner;
    for (std::size_t c = 0; c < 4; ++c)
    {
        corner[c] = {{x[c].x, {}}, {x[c].y, {}}, {x[c].z, {}}};
        corner[c].x.d[3 * c] = corner[c].y.d[3 * c + 1] = corner[c].z.d[3 * c + 2] = 1;
    }
    const auto hinge = hinge_angle(corner);
    Matrix12 out;
    for (std::size_t c = 0; c < 4; ++c)
    {
        const Dual<12>* parts[3] = {&hinge.gradient[c].x, &hinge.gradient[c].y, &hinge.gradient[c].z};
        for (std::size_t k = 0; k < 3; ++k)
            out.row(static_cast<Eigen::Index>(3 * c + k)) =
                Eigen::Map<const Eigen::Matrix<double, 1, 12>>(parts[k]->d.data());
    }
    return 0.5 * (out + out.transpose());
}

/// k (g g^T + (theta - theta0) dg/dx); projected: without the second part.
Matrix12 hinge_block(const BendElement& h, const State& x, Curvature curvature)
{
    const std::array<Vec<double>, 4> corner = {narrow(x[h.edge0]), narrow(x[h.edge1]), narrow(x[h.wing0]),
                                               narrow(x[h.wing1])};
    const auto hinge = hinge_angle(corner);
    if (!hinge.valid)
        return Matrix12::Zero();
    Eigen::Matrix<double, 12, 1> g;
    for (int c = 0; c < 4; ++c)
    {
        const Vec<double>& part = hinge.gradient[static_cast<std::size_t>(c)];
        g.segment<3>(3 * c) = Eigen::Vector3d(part.x, part.y, part.z);
    }
    Matrix12 out = g * g.transpose();
    if (curvature == Curvature::exact)
        out += angle_difference(hinge.angle, h.rest_angle) * angle_hessian(corner);
    return out / h.compliance;
}

/// By the chain rule from dP/dF to the corners.
Matrix12 solid_block(const SolidElement& e, const State& x, Curvature curvature)
{
    Matrix9 k = stress_derivative(e, deformation(e, x));
    if (curvature == Curvature::projected)
        k = positive_part(k);
    const Eigen::Matrix3d b = inverse_rest(e).cast<double>();
    Eigen::Matrix<double, 9, 12> chain = Eigen::Matrix<double, 9, 12>::Zero(); // dF by the corners
    for (int c = 0; c < 3; ++c)
        for (int corner = 0; corner < 3; ++corner)
        {
            chain.block<3, 3>(3 * c, 3 * corner + 3) = b(corner, c) * Eigen::Matrix3d::Identity();
            chain.block<3, 3>(3 * c, 0) -= b(corner, c) * Eigen::Matrix3d::Identity();
        }
    return e.rest_volume * chain.transpose() * k * chain;
}

/// Volumes beside springs as elements without shear stiffness: the same energy, V0 K/2 (J - 1)^2. F is of the
/// unit tetrahedron, so that no rest shape is needed: V = det(edges) / 6.
SolidElement volume_solid(const VolumeElement& v)
{
    SolidElement out;
    out.vertex = v.vertex;
    const double size = std::cbrt(6 * v.rest_volume);
    out.inverse_rest = glm::dmat3(1 / size);
    out.rest_volume = v.rest_volume;
    out.lambda = v.rest_volume / v.compliance;
    out.log = 0;
    return out;
}

std::vector<SolidElement> all_solids(const PhysicalModel& model)
{
    std::vector<SolidElement> out = model.solids;
    for (const VolumeElement& v : model.volumes)
        out.push_back(volume_solid(v));
    return out;
}

} // namespace

StaticEnergy::StaticEnergy(const PhysicalModel& model)
    : model_(model), solids_(all_solids(model)), unknown_(model.mass.size(), -1)
{
    for (std::size_t i = 0; i < unknown_.size(); ++i)
        if (!model.pinned[i])
        {
            unknown_[i] = unknowns_;
            unknowns_ += 3;
        }
}

Real StaticEnergy::value(const State& x) const
{
    Real sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        sum -= static_cast<Real>(model_.mass[i]) *
               (x[i].x * model_.gravity.x + x[i].y * model_.gravity.y + x[i].z * model_.gravity.z);
    for (const StretchElement& s : model_.springs)
    {
        const Real stretch = length(x[s.a] - x[s.b]) - static_cast<Real>(s.rest_length);
        sum += stretch * stretch / (2 * static_cast<Real>(s.compliance));
    }
    for (const BendElement& h : model_.hinges)
    {
        const auto hinge = hinge_angle<Real>({x[h.edge0], x[h.edge1], x[h.wing0], x[h.wing1]});
        const Real angle = hinge.valid ? angle_difference(hinge.angle, h.rest_angle) : 0;
        sum += angle * angle / (2 * static_cast<Real>(h.compliance));
    }
    for (const SolidElement& e : solids_)
    {
        const Real33 f = deformation(e, x);
        const Real square = f.squaredNorm(), volume = f.determinant() - static_cast<Real>(e.rest);
        const Real shape = square - 3 - static_cast<Real>(e.log) * std::log((square + 1) / 4);
        const Real at_rest = (1 - static_cast<Real>(e.rest)) * (1 - static_cast<Real>(e.rest));
        sum += static_cast<Real>(e.rest_volume) / 2 *
               (static_cast<Real>(e.mu) * shape + static_cast<Real>(e.lambda) * (volume * volume - at_rest));
    }
    return sum;
}

/// dE/dx; zero at pins.
State StaticEnergy::gradient(const State& x) const
{
    State g(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const Real m = -static_cast<Real>(model_.mass[i]);
        g[i] = {m * model_.gravity.x, m * model_.gravity.y, m * model_.gravity.z};
    }
    for (const StretchElement& s : model_.springs)
    {
        const Vec<Real> d = x[s.a] - x[s.b];
        const Real l = length(d);
        if (!(l > 0))
            continue;
        const Real tension = (l - static_cast<Real>(s.rest_length)) / (static_cast<Real>(s.compliance) * l);
        g[s.a] = g[s.a] + tension * d;
        g[s.b] = g[s.b] - tension * d;
    }
    for (const BendElement& h : model_.hinges)
    {
        const auto v = vertices(h);
        const auto hinge = hinge_angle<Real>({x[v[0]], x[v[1]], x[v[2]], x[v[3]]});
        if (!hinge.valid)
            continue;
        const Real torque =
            angle_difference(hinge.angle, h.rest_angle) / static_cast<Real>(h.compliance);
        for (std::size_t c = 0; c < 4; ++c)
            g[v[c]] = g[v[c]] + torque * hinge.gradient[c];
    }
    for (const SolidElement& e : solids_)
    {
        const Real33 pull = static_cast<Real>(e.rest_volume) * stress(e, deformation(e, x)) *
                           inverse_rest(e).transpose();
        for (int c = 0; c < 3; ++c)
        {
            const Vec<Real> part{pull(0, c), pull(1, c), pull(2, c)};
            const std::uint32_t v = e.vertex[static_cast<std::size_t>(c) + 1];
            g[v] = g[v] + part;
            g[e.vertex[0]] = g[e.vertex[0]] - part;
        }
    }
    for (std::size_t i = 0; i < x.size(); ++i)
        if (unknown_[i] < 0)
            g[i] = {};
    return g;
}

void StaticEnergy::elements(const std::function<void(std::span<const std::uint32_t>)>& visit) const
{
    for (const StretchElement& s : model_.springs)
        visit(std::array{s.a, s.b});
    for (const BendElement& h : model_.hinges)
        visit(vertices(h));
    for (const SolidElement& e : solids_)
        visit(e.vertex);
    for (const PlateHinge& h : model_.plates)
        visit(vertices(h.element));
    for (const AddedElement& e : model_.added)
        visit(std::span(e.vertex).first(e.kind->corners));
}

void StaticEnergy::blocks(const State& x, Curvature curvature, double shift, const Block& visit) const
{
    const auto visit_all = [&](std::span<const std::uint32_t> v, const auto& k) {
        for (std::size_t r = 0; r < v.size(); ++r)
            for (std::size_t c = 0; c < v.size(); ++c)
                visit(v[r], v[c],
                      k.template block<3, 3>(static_cast<int>(3 * r), static_cast<int>(3 * c)));
    };
    for (std::uint32_t i = 0; i < x.size(); ++i)
        visit(i, i, shift * model_.mass[i] * Eigen::Matrix3d::Identity());
    for (const StretchElement& s : model_.springs)
    {
        const Eigen::Matrix3d k = spring_block(s, narrow(x[s.a] - x[s.b]), curvature);
        visit(s.a, s.a, k);
        visit(s.b, s.b, k);
        visit(s.a, s.b, -k);
        visit(s.b, s.a, -k);
    }
    for (const BendElement& h : model_.hinges)
        visit_all(vertices(h), hinge_block(h, x, curvature));
    for (const SolidElement& e : solids_)
        visit_all(e.vertex, solid_block(e, x, curvature));
    for (const PlateHinge& h : model_.plates)
        visit_all(vertices(h.element), hinge_block(h.element, x, curvature));
    if (model_.added.empty())
        return;
    std::vector<glm::dvec3> at;
    for (const Vec<Real>& p : x)
        at.emplace_back(p.x, p.y, p.z);
    for (const AddedElement& e : model_.added)
    {
        const Eigen::MatrixXd k = added_stiffness(e, at);
        visit_all(std::span(e.vertex).first(e.kind->corners),
                  curvature == Curvature::projected ? positive_part(k) : k);
    }
}

Eigen::SparseMatrix<double> StaticEnergy::hessian(const State& x, Curvature curvature, double shift) const
{
    std::vector<Eigen::Triplet<double>> entries;
    const std::size_t of_four =
        model_.hinges.size() + solids_.size() + model_.plates.size() + model_.added.size();
    entries.reserve(model_.springs.size() * 36 + of_four * 144 + x.size() * 3);
    blocks(x, curvature, shift, [&](std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
        if (unknown_[b] >= 0 && unknown_[a] >= unknown_[b]) // the lower triangle
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    entries.emplace_back(unknown_[a] + r, unknown_[b] + c, block(r, c));
    });
    Eigen::SparseMatrix<double> out(unknowns_, unknowns_);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

double largest_component(const State& a)
{
    Real out = 0;
    for (const Vec<Real>& v : a)
        for (Real component : {v.x, v.y, v.z})
            out = component == component ? std::max(out, std::abs(component)) : INFINITY;
    return static_cast<double>(out);
}

} // namespace taut::reference
