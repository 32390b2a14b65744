// Reference R2: minimises the energy of a model.
// Based on: Nocedal, Wright, Numerical Optimization, 2006 (modified Newton, Armijo line search).
// Departures: the shift is sigma M, so that a step is one linearised implicit Euler step of length
//   1/sqrt(sigma) from rest: far away the search walks as a heavily damped cloth would and stays in its
//   valley; sigma falls to a floor at the end.
#include "taut/report/reference_static.hpp"

#include "taut/report/static_energy.hpp"
#include "taut/report/static_membranes.hpp"

#include <Eigen/SparseCholesky>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>

namespace taut {
namespace {

using reference::Curvature;
using reference::Real;
using reference::State;
using reference::Vec;
using reference::largest_component;
using Cholesky = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

constexpr double kShiftStart = 3600;   // 1/s^2: steps of 1/60 s
constexpr double kShiftFloor = 3.6e-6; // far below any pendulum mode, yet finite for slack parts
constexpr double kShiftStable = 3.6e-3; // instabilities that grow slower than exp(0.06 t) do not count
constexpr int kEscapes = 4;

Vec<double> narrow(const Vec<Real>& a)
{
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

double distance(const Vec<Real>& a, const Vec<Real>& b)
{
    return static_cast<double>(std::sqrt(reference::dot(a - b, a - b)));
}

class Newton
{
public:
    Newton(const PhysicalModel& model, const std::vector<glm::dvec3>& start, const StaticOptions& options);
    StaticReference run();

private:
    bool factor(Curvature curvature, double shift);
    Eigen::VectorXd force(const State& g) const;
    Eigen::VectorXd solve(const State& g) const;
    bool step(const State& g);
    bool stagnates(const State& g);
    bool resolved(const State& g);
    bool search(const State& g, const Eigen::VectorXd& direction);
    void polish(const State& g);
    bool leave_saddle();
    StaticReference result() const;

    const PhysicalModel& model_;
    reference::StaticEnergy energy_;
    StaticOptions options_;
    State x_, start_;
    double correction_ = 0; // m, what a further step would move where rounding ended the search
    double scale_ = 0; // N, what the residual is relative to
    double shift_ = kShiftStart;
    double max_move_ = 0;
    std::uint32_t factorisations_ = 0;
    int escapes_ = 0;
    double moved_ = 0;     // m, largest move of the last step
    int idle_ = 0;         // steps since the residual or the cloth last moved
    double lowest_ = HUGE_VAL; // N, residual
    Cholesky cholesky_;
};

Newton::Newton(const PhysicalModel& model, const std::vector<glm::dvec3>& start, const StaticOptions& options)
    : model_(model), energy_(model), options_(options), max_move_(0.1 * model.diameter)
{
    for (const glm::dvec3& x : start)
        x_.push_back({x.x, x.y, x.z});
    start_ = x_;
    scale_ = total_weight(model);
    if (!(scale_ > 0))
        scale_ = largest_component(energy_.gradient(x_));
}

/// False unless the shifted Hessian is positive definite (Sylvester: the signs of D; those of the moments of
/// plates are negative).
bool Newton::factor(Curvature curvature, double shift)
{
    ++factorisations_;
    const auto lower = energy_.system(x_, curvature, shift);
    if (factorisations_ == 1)
        cholesky_.analyzePattern(lower); // the pattern never changes
    cholesky_.factorize(lower);
    return cholesky_.info() == Eigen::Success &&
           (cholesky_.vectorD().array() > 0).count() == energy_.unknowns();
}

/// By how much a Newton step moves each coordinate, m.
Eigen::VectorXd Newton::solve(const State& g) const
{
    Eigen::VectorXd right = Eigen::VectorXd::Zero(energy_.unknowns() + energy_.plate_hinges());
    right.head(energy_.unknowns()) = force(g);
    return cholesky_.solve(right).eval().head(energy_.unknowns());
}

/// Takes the longest of the halved steps that lowers the energy enough; near the end, where the energy
/// no longer resolves it, one that lowers the largest force.
bool Newton::search(const State& g, const Eigen::VectorXd& direction)
{
    Real slope = 0;
    double move = 0;
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (const int u = energy_.unknown(i); u >= 0)
        {
            slope += g[i].x * direction[u] + g[i].y * direction[u + 1] + g[i].z * direction[u + 2];
            move = std::max(move, direction.segment<3>(u).norm());
        }
    if (!(slope < 0) || !std::isfinite(move))
        return false;
    const Real before = energy_.value(x_);
    const double force = largest_component(g);
    double length = move > max_move_ ? max_move_ / move : 1;
    for (int tries = 0; tries < 24; ++tries, length *= 0.5)
    {
        State next = x_;
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (const int u = energy_.unknown(i); u >= 0)
                next[i] = next[i] + static_cast<Real>(length) *
                                        Vec<Real>{direction[u], direction[u + 1], direction[u + 2]};
        const bool lower = energy_.value(next) <= before + static_cast<Real>(1e-4 * length) * slope;
        moved_ = length * move;
        if (lower || largest_component(energy_.gradient(next)) < 0.9 * force * (tries == 0 && length == 1))
        {
            x_ = std::move(next);
            shift_ *= length == 1 ? 0.25 : (tries > 1 ? 4.0 : 1.0);
            shift_ = std::clamp(shift_, kShiftFloor, 1e18);
            return true;
        }
    }
    return false;
}

Eigen::VectorXd Newton::force(const State& g) const
{
    Eigen::VectorXd out(energy_.unknowns());
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (const int u = energy_.unknown(i); u >= 0)
        {
            const Vec<double> f = narrow(g[i]);
            out.segment<3>(u) = -Eigen::Vector3d(f.x, f.y, f.z);
        }
    return out;
}

bool Newton::step(const State& g)
{
    for (int tries = 0; tries < 40; ++tries)
    {
        if ((factor(Curvature::exact, shift_) || factor(Curvature::projected, shift_)) && search(g, solve(g)))
            return true;
        shift_ *= 16;
        if (shift_ > 1e18)
            break;
    }
    return false;
}

/// True after ten steps that neither moved anything nor lowered the residual: the number format is used up.
bool Newton::stagnates(const State& g)
{
    const double residual = largest_component(g);
    const bool idle = moved_ < 1e-12 * model_.diameter && residual > 0.9 * lowest_;
    idle_ = idle ? idle_ + 1 : 0;
    lowest_ = std::min(lowest_, residual);
    return idle_ == 10;
}

/// Where forces are so large that rounding hides the weight (1e11 N/m at 1 m: 1e-8 N), the places may still
/// be known: true if a whole Newton step would move nothing by more than `resolution`.
bool Newton::resolved(const State& g)
{
    if (!(options_.resolution > 0) || !factor(Curvature::exact, kShiftFloor))
        return false;
    const Eigen::VectorXd further = solve(g);
    double come = 0;
    for (std::size_t i = 0; i < x_.size(); ++i)
        come = std::max(come, distance(x_[i], start_[i]));
    correction_ = further.lpNorm<Eigen::Infinity>();
    return correction_ <= options_.resolution * come;
}

/// One more step: from the tolerance to what the number format resolves.
void Newton::polish(const State& g)
{
    const State before = x_;
    shift_ = kShiftFloor;
    if (!step(g) || largest_component(energy_.gradient(x_)) > largest_component(g))
        x_ = before;
}

/// At a saddle: a nudge of a fixed random pattern, 1e-4 of the size; larger at every further saddle.
bool Newton::leave_saddle()
{
    if (!options_.leave_saddles || escapes_ == kEscapes)
        return false;
    std::mt19937 random(12345u + static_cast<unsigned>(escapes_));
    const double size = 1e-4 * model_.diameter * std::pow(3, escapes_++);
    const auto draw = [&]() -> Real { return size * (static_cast<double>(random()) / 2147483648.0 - 1); };
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (energy_.unknown(i) >= 0)
            x_[i] = x_[i] + Vec<Real>{draw(), draw(), draw()};
    shift_ = kShiftStart;
    lowest_ = HUGE_VAL;
    return true;
}

StaticReference Newton::result() const
{
    StaticReference out;
    for (const Vec<Real>& a : x_)
    {
        const Vec<double> p = narrow(a);
        out.positions.emplace_back(p.x, p.y, p.z);
    }
    out.residual = largest_component(energy_.gradient(x_));
    out.relative_residual = scale_ > 0 ? out.residual / scale_ : 0;
    out.energy = static_cast<double>(energy_.value(x_));
    out.correction = correction_;
    out.iterations = factorisations_;
    bool first = true;
    for (const StretchElement& s : model_.springs)
        if (s.rest_length > 0)
        {
            const double strain = distance(x_[s.a], x_[s.b]) / s.rest_length - 1;
            out.largest_stretch = first ? strain : std::max(out.largest_stretch, strain);
            first = false;
        }
    for (const AddedElement& e : model_.added)
        if (const auto both = e.stretches(out.positions))
        {
            out.largest_stretch = first ? (*both)[1] : std::max(out.largest_stretch, (*both)[1]);
            first = false;
        }
    return out;
}

StaticReference Newton::run()
{
    std::string reason;
    bool converged = false, stable = false;
    while (energy_.unknowns() > 0)
    {
        const State g = energy_.gradient(x_);
        converged = largest_component(g) <= options_.tolerance * scale_;
        if (converged)
        {
            stable = factor(Curvature::exact, kShiftStable);
            if (stable)
                polish(g);
            if (stable || !leave_saddle())
                break;
        }
        else if (factorisations_ >= options_.iterations)
        {
            reason = "not converged after " + std::to_string(factorisations_) + " factorisations";
            break;
        }
        else if (stagnates(g))
        {
            converged = resolved(g);
            stable = converged && factor(Curvature::exact, kShiftStable);
            if (converged)
                break;
            reason = "rounding: the residual cannot fall further, the forces are too large beside the weight";
            break;
        }
        else if (!step(g))
        {
            reason = "no step lowers the energy any more";
            break;
        }
    }
    StaticReference out = result();
    out.converged = converged || energy_.unknowns() == 0;
    out.stable = stable || energy_.unknowns() == 0;
    out.reason = !reason.empty() ? reason : out.stable ? "" : "the equilibrium is a saddle of the energy";
    return out;
}

/// True if elements link every moving vertex to a pin.
bool all_held(const PhysicalModel& model)
{
    std::vector<std::uint32_t> parent(model.mass.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v)
    {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const StretchElement& s : model.springs)
        parent[root(s.a)] = root(s.b);
    for (const BendElement& h : model.hinges)
        for (std::uint32_t v : {h.edge1, h.wing0, h.wing1})
            parent[root(v)] = root(h.edge0);
    for (const PlateHinge& h : model.plates)
        for (std::uint32_t v : {h.element.edge1, h.element.wing0, h.element.wing1})
            parent[root(v)] = root(h.element.edge0);
    for (const AddedElement& e : model.added)
        for (const std::uint32_t v : std::span(e.vertex).first(e.kind->corners))
            parent[root(v)] = root(e.vertex[0]);
    for (const VolumeElement& e : model.volumes)
        for (const std::uint32_t v : e.vertex)
            parent[root(v)] = root(e.vertex[0]);
    for (const SolidElement& e : model.solids)
        for (const std::uint32_t v : e.vertex)
            parent[root(v)] = root(e.vertex[0]);
    std::vector<bool> held(parent.size(), false);
    for (const ModelPin& pin : model.pins)
        held[root(pin.vertex)] = true;
    for (std::uint32_t v = 0; v < parent.size(); ++v)
        if (!held[root(v)])
            return false;
    return true;
}

std::string refusal(const PhysicalModel& model, const std::vector<glm::dvec3>& start)
{
    if (start.size() != model.mass.size())
        return "the start has " + std::to_string(start.size()) + " positions for " +
               std::to_string(model.mass.size()) + " vertices";
    if (const std::size_t rigid = rigid_element_count(model); rigid > 0)
        return std::to_string(rigid) + " elements are rigid (compliance 0): they have no energy to minimise";
    if (!std::all_of(model.added.begin(), model.added.end(), reference::is_membrane))
        return "there are elements of a program's own, whose energy is written in fp64 alone";
    if (!reference::StaticPlates(model.plates).is_sound())
        return "a triangle of a plate is so thin that rounding leaves its bending no inverse";
    if (!model.surfaces.empty())
        return "the volume within a surface is held: the static reference does not model it";
    if (!model.gases.empty())
        return "a gas presses on a surface: the static reference does not model it";
    if (!model.colliders.empty())
        return "the scene has colliders: the static reference knows no contact";
    if (glm::length(model.gravity) > 0 && !all_held(model))
        return "a part of the scene is not held by any pin and falls";
    return {};
}

} // namespace

StaticReference solve_static(const PhysicalModel& model, const std::vector<glm::dvec3>& start,
                             const StaticOptions& options)
{
    if (std::string reason = refusal(model, start); !reason.empty())
    {
        StaticReference out;
        out.reason = std::move(reason);
        out.positions = start;
        return out;
    }
    return Newton(model, start, options).run();
}

} // namespace taut
