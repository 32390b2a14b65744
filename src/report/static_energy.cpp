// Based on: Choi, Ko, Stable but Responsive Cloth, 2002 (the part of a compressed spring's Hessian that the
//   projection drops); Griewank, Walther, Evaluating Derivatives, 2008 (dual numbers for the hinges).
// Departures: a projected hinge keeps only the outer product of its gradient.
#include "taut/report/static_energy.hpp"

#include "taut/report/added_stiffness.hpp"
#include "taut/report/positive_part.hpp"
#include "taut/report/static_membranes.hpp"
#include "taut/report/static_solids.hpp"

#include <algorithm>
#include <cmath>

namespace taut::reference {
namespace {

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

std::array<Vec<double>, 4> corners(const BendElement& h, const State& x)
{
    return {narrow(x[h.edge0]), narrow(x[h.edge1]), narrow(x[h.wing0]), narrow(x[h.wing1])};
}

/// k (g g^T + (theta - theta0) dg/dx); projected: without the second part.
Matrix12 hinge_block(const BendElement& h, const State& x, Curvature curvature)
{
    const std::array<Vec<double>, 4> corner = corners(h, x);
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

} // namespace

StaticEnergy::StaticEnergy(const PhysicalModel& model)
    : model_(model),
      plates_(model.plates),
      solids_(all_solids(model)),
      unknown_(model.mass.size(), -1)
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
        sum += solid_energy(e, x);
    for (const AddedElement& e : model_.added)
        if (is_membrane(e))
            sum += membrane_energy(e, x);
    return sum + plates_.energy(x);
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
        add_solid_gradient(e, x, g);
    for (const AddedElement& e : model_.added)
        if (is_membrane(e))
            add_membrane_gradient(e, x, g);
    plates_.add_gradient(x, g);
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

namespace {

/// The 3 x 3 parts of `k`, of the vertices `v`.
void visit_all(std::span<const std::uint32_t> v, const auto& k, const StaticEnergy::Block& visit)
{
    for (std::size_t r = 0; r < v.size(); ++r)
        for (std::size_t c = 0; c < v.size(); ++c)
            visit(v[r], v[c], k.template block<3, 3>(static_cast<int>(3 * r), static_cast<int>(3 * c)));
}

} // namespace

/// Of all but plates and added elements.
void StaticEnergy::elastic_blocks(const State& x, Curvature curvature, double shift, const Block& visit) const
{
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
        visit_all(vertices(h), hinge_block(h, x, curvature), visit);
    for (const SolidElement& e : solids_)
        visit_all(e.vertex, solid_block(e, x, curvature), visit);
}

void StaticEnergy::added_blocks(const State& x, Curvature curvature, const Block& visit) const
{
    if (model_.added.empty())
        return;
    std::vector<glm::dvec3> at;
    for (const Vec<Real>& p : x)
        at.emplace_back(p.x, p.y, p.z);
    for (const AddedElement& e : model_.added)
    {
        const Eigen::MatrixXd k = added_stiffness(e, at);
        visit_all(std::span(e.vertex).first(e.kind->corners),
                  curvature == Curvature::projected ? Eigen::MatrixXd(positive_part(k)) : k, visit);
    }
}

void StaticEnergy::blocks(const State& x, Curvature curvature, double shift, const Block& visit) const
{
    elastic_blocks(x, curvature, shift, visit);
    for (const PlateHinge& h : model_.plates)
        visit_all(vertices(h.element), hinge_block(h.element, x, curvature), visit);
    added_blocks(x, curvature, visit);
}

void StaticEnergy::add_lower(Entries& entries, std::uint32_t a, std::uint32_t b,
                             const Eigen::Matrix3d& block) const
{
    if (unknown_[b] >= 0 && unknown_[a] >= unknown_[b])
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                entries.emplace_back(unknown_[a] + r, unknown_[b] + c, block(r, c));
}

Eigen::SparseMatrix<double> StaticEnergy::hessian(const State& x, Curvature curvature, double shift) const
{
    Entries entries;
    const std::size_t of_four =
        model_.hinges.size() + solids_.size() + model_.plates.size() + model_.added.size();
    entries.reserve(model_.springs.size() * 36 + of_four * 144 + x.size() * 3);
    blocks(x, curvature, shift, [&](std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
        add_lower(entries, a, b, block);
    });
    Eigen::SparseMatrix<double> out(unknowns_, unknowns_);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

Eigen::SparseMatrix<double> StaticEnergy::system(const State& x, Curvature curvature, double shift) const
{
    Entries entries;
    const Block add = [&](std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
        add_lower(entries, a, b, block);
    };
    elastic_blocks(x, curvature, shift, add);
    const std::vector<Real> moments = plates_.moments(x);
    for (std::size_t k = 0; k < moments.size(); ++k) // zeros, too: the pattern stays
    {
        const auto corner = corners(model_.plates[k].element, x);
        const bool bends = curvature == Curvature::exact && hinge_angle(corner).valid;
        visit_all(vertices(model_.plates[k].element),
                  bends ? Matrix12(static_cast<double>(moments[k]) * angle_hessian(corner))
                        : Matrix12(Matrix12::Zero()),
                  add);
    }
    for (const AddedElement& e : model_.added)
        if (is_membrane(e))
        {
            const Eigen::MatrixXd k = membrane_stiffness(e, x);
            visit_all(std::span(e.vertex).first(3),
                      curvature == Curvature::projected ? Eigen::MatrixXd(positive_part(k)) : k, add);
        }
    plates_.add_rows(x, unknowns_, unknown_, entries);
    Eigen::SparseMatrix<double> out(unknowns_ + plate_hinges(), unknowns_ + plate_hinges());
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
