// Based on: Smith, de Goes, Kim, Stable Neo-Hookean Flesh Simulation, 2018 (energy and derivative of the
//   tetrahedra).
// Departures: a projected tetrahedron has the eigenvalues of its 9 x 9 matrix that are negative set to zero.
#include "taut/report/static_solids.hpp"

#include "taut/report/positive_part.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

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

} // namespace

std::vector<SolidElement> all_solids(const PhysicalModel& model)
{
    std::vector<SolidElement> out = model.solids;
    for (const VolumeElement& v : model.volumes)
        out.push_back(volume_solid(v));
    return out;
}

Real solid_energy(const SolidElement& e, const State& x)
{
    const Real33 f = deformation(e, x);
    const Real square = f.squaredNorm(), volume = f.determinant() - static_cast<Real>(e.rest);
    const Real shape = square - 3 - static_cast<Real>(e.log) * std::log((square + 1) / 4);
    const Real at_rest = (1 - static_cast<Real>(e.rest)) * (1 - static_cast<Real>(e.rest));
    return static_cast<Real>(e.rest_volume) / 2 *
           (static_cast<Real>(e.mu) * shape + static_cast<Real>(e.lambda) * (volume * volume - at_rest));
}

void add_solid_gradient(const SolidElement& e, const State& x, State& g)
{
    const Real33 pull =
        static_cast<Real>(e.rest_volume) * stress(e, deformation(e, x)) * inverse_rest(e).transpose();
    for (int c = 0; c < 3; ++c)
    {
        const Vec<Real> part{pull(0, c), pull(1, c), pull(2, c)};
        const std::uint32_t v = e.vertex[static_cast<std::size_t>(c) + 1];
        g[v] = g[v] + part;
        g[e.vertex[0]] = g[e.vertex[0]] - part;
    }
}

/// By the chain rule from dP/dF to the corners.
Eigen::Matrix<double, 12, 12> solid_block(const SolidElement& e, const State& x, Curvature curvature)
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

} // namespace taut::reference
