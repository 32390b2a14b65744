// What an exact Newton step would still move where a solver ended.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed., 2006, section 3.3 (the Newton step measures
//   the distance to a minimum in the variables; the gradient does so in forces, which say little where
//   directions differ in stiffness).
// Departures: taken relative to the motion that the loads alone make, by mass; under methods of one sweep in
//   many small substeps, whose leftovers add up over them, to what the loads move in a long time. A sweep
//   carries a load over one link: where too few are taken, what is left is small beside the springs' own
//   forces, and yet the body hangs in the air. Roundings of stiff springs are large forces that move nothing.
//   A body that is far from where it should be is led on by Newton's method with a line search (section 3.4).

#include "taut/report/load_residual.hpp"

#include "taut/report/iterated_steps.hpp"
#include "taut/report/rolling.hpp"
#include "taut/report/static_energy.hpp"
#include "taut/scene/extent.hpp"

#include <Eigen/SparseCholesky>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace taut {
namespace {

using reference::Curvature;
using reference::State;
using reference::StaticEnergy;
using Matrix = Eigen::SparseMatrix<double>; // the lower triangle

/// Unknowns; solids fill more.
struct FactoredSize
{
    int cloth, solids;
};
constexpr FactoredSize kMostFactored{30000, 6000};
/// Of the steps that follow a body, which need not be exact (docs/decisions.md, 72).
constexpr FactoredSize kMostFactoredOnTheWay{3000, 1500};
constexpr double kHeldWeight = 1e9; // times the diagonal
constexpr double kTouching = 0.5;   // right runs leave more where vertices are held that a contact may let go

using Motion = std::vector<glm::dvec3>; ///< a vertex: N, or m

State state_of(std::span<const glm::dvec3> x)
{
    State out;
    out.reserve(x.size());
    for (const glm::dvec3& p : x)
        out.push_back({p.x, p.y, p.z});
    return out;
}

/// m, for each of `forces`; vertices that touch are held.
std::vector<Motion> factored_steps(const StaticEnergy& energy, std::span<const glm::dvec3> x,
                                   const Leftover& left, const std::vector<Motion>& forces)
{
    Matrix stiffness = energy.hessian(state_of(x), Curvature::projected, 1 / (left.time * left.time));
    Eigen::MatrixXd force =
        Eigen::MatrixXd::Zero(energy.unknowns(), static_cast<Eigen::Index>(forces.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int c = 0; c < 3 && energy.unknown(i) >= 0; ++c)
        {
            const int u = energy.unknown(i) + c;
            if (left.touches[i])
                stiffness.coeffRef(u, u) *= kHeldWeight;
            for (std::size_t f = 0; f < forces.size() && !left.touches[i]; ++f)
                force(u, static_cast<Eigen::Index>(f)) = forces[f][i][c];
        }
    const Eigen::SimplicialLDLT<Matrix> factors(stiffness);
    if (factors.info() != Eigen::Success)
        return {};
    const Eigen::MatrixXd step = factors.solve(force);
    std::vector<Motion> out(forces.size(), Motion(x.size(), glm::dvec3(0)));
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t f = 0; f < forces.size() && energy.unknown(i) >= 0; ++f)
            for (int c = 0; c < 3; ++c)
                out[f][i][c] = step(energy.unknown(i) + c, static_cast<Eigen::Index>(f));
    return out;
}

/// m, of each vertex: the Newton step, and what the loads move along gravity, or along each axis without, and
/// what gases move.
struct Steps
{
    Motion left;
    std::vector<Motion> loads;
};

/// Which way loads may pull.
std::vector<glm::dvec3> pulls_of(const PhysicalModel& model)
{
    if (model.gravity == glm::dvec3(0))
        return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return {glm::normalize(model.gravity)};
}

/// Of the vertices from `first` to before `last`: whether most of those that move touch, or lie beside some.
bool mostly_touches(const PhysicalModel& model, const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    std::uint32_t free = 0, touched = 0;
    for (std::uint32_t i = first; i < last; ++i)
    {
        free += model.pinned[i] ? 0 : 1;
        touched += !model.pinned[i] && (left.touches[i] || left.is_beside(i)) ? 1 : 0;
    }
    return 2 * touched > free;
}

/// N: what is left, and the loads on each way that they may pull.
std::vector<Motion> forces_of(const PhysicalModel& model, const Leftover& left)
{
    std::vector<Motion> out{left.force};
    for (glm::dvec3& f : out[0])
        f = -f;
    if (!left.against_response) // in whose long time a push is followed
        for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
        {
            const std::uint32_t first = model.body_start[b], last = model.body_start[b + 1];
            const bool mostly = mostly_touches(model, left, first, last);
            for (std::uint32_t i = first; i < last && !mostly; ++i)
                out[0][i] = left.is_beside(i) ? glm::dvec3(0) : out[0][i];
        }
    if (left.against_response)
        for (const glm::dvec3& pull : pulls_of(model))
        {
            Motion& loads = out.emplace_back();
            for (const double load : left.load)
                loads.push_back(load * pull);
        }
    if (left.against_response && !left.gas.empty())
        out.push_back(left.gas);
    return out;
}

/// m, for each of `forces`.
std::vector<Motion> newton_steps(const PhysicalModel& model, std::span<const glm::dvec3> x,
                                 const Leftover& left, const std::vector<Motion>& forces,
                                 const FactoredSize& most)
{
    const StaticEnergy energy(model);
    const bool solids = !model.solids.empty() || !model.volumes.empty();
    std::vector<Motion> steps;
    if (energy.unknowns() <= (solids ? most.solids : most.cloth))
        steps = factored_steps(energy, x, left, forces);
    return steps.empty() ? iterated_steps(model, energy, x, left, forces) : steps;
}

Steps first_steps(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left,
                  const std::vector<Motion>& forces)
{
    std::vector<Motion> steps = newton_steps(model, x, left, forces, kMostFactored);
    Steps out{std::move(steps[0]), {}};
    out.loads.assign(std::make_move_iterator(steps.begin() + 1), std::make_move_iterator(steps.end()));
    return out;
}

/// m: of the vertices from `first` to before `last`, under `against_response` without rolling about what
/// touches, which a body that a pin holds does not.
Motion own_motion(const PhysicalModel& model, std::span<const glm::dvec3> x, const Motion& way,
                  const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    const std::uint32_t count = last - first;
    const std::span<const glm::dvec3> all = std::span(way).subspan(first, count);
    const auto pinned = model.pinned.begin();
    if (!left.against_response || std::find(pinned + first, pinned + last, true) != pinned + last)
        return {all.begin(), all.end()};
    return without_rolling({x.subspan(first, count),
                            all,
                            std::span(model.mass).subspan(first, count),
                            {left.touches.begin() + first, left.touches.begin() + last}});
}

/// kg m: what the loads move of the vertices from `first` to before `last`, the way on which that is most.
double largest_response(const PhysicalModel& model, std::span<const glm::dvec3> x, const Steps& step,
                        const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    double most = 0;
    for (const Motion& moved : step.loads)
    {
        const Motion own = own_motion(model, x, moved, left, first, last);
        double sum = 0;
        for (std::uint32_t i = first; i < last; ++i)
            sum += model.pinned[i] ? 0 : model.mass[i] * glm::length(own[i - first]);
        most = std::max(most, sum);
    }
    return most;
}

/// Of the vertices from `first` to before `last`.
LoadResidual residual_of(const PhysicalModel& model, std::span<const glm::dvec3> x, const Steps& step,
                         const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    const auto begin = left.touches.begin();
    const bool touches = std::find(begin + first, begin + last, true) != begin + last;
    const bool mostly = touches && mostly_touches(model, left, first, last);
    if (mostly && model.gravity == glm::dvec3(0))
        return {}; // no way on which contacts have no part
    const glm::dvec3 down = mostly ? glm::normalize(model.gravity) : glm::dvec3(0);
    const double counted = touches ? kTouching : 1;
    const Motion own = own_motion(model, x, step.left, left, first, last);
    double moved = 0, loads = 0, mass = 0, carried = 0;
    for (std::uint32_t i = first; i < last && !left.carried.empty(); ++i)
        carried = std::max(carried, left.carried[i]);
    Extent body;
    for (const glm::dvec3& p : x.subspan(first, last - first))
        body.take(p);
    for (std::uint32_t i = first; i < last; ++i)
        if (!model.pinned[i])
        {
            moved += counted * model.mass[i] *
                     (mostly ? std::max(0.0, glm::dot(own[i - first], down)) : glm::length(own[i - first]));
            mass += model.mass[i];
            loads += left.load[i] * left.time * left.time + model.mass[i] * carried;
        }
    if (left.against_response)
        loads = largest_response(model, x, step, left, first, last);
    if (!(loads > 0))
        return {};
    // A body of one vertex has no size by which somebody could see that it is elsewhere.
    const double share = moved / loads, way = body.size() > 0 ? moved / (mass * body.size()) : 0;
    return {std::isfinite(share) ? share : HUGE_VAL, std::isfinite(way) ? way : HUGE_VAL};
}

/// Newton's method from x down the potential of a long step in which what is left acts on and on.
class Descent
{
public:
    /// `force`: N, what acts at x.
    Descent(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left,
            const Motion& force)
        : model_(model), left_(left), x_(x.begin(), x.end()), y_(x_), push_(force)
    {
        left_.load.assign(x.size(), 0); // iterated_steps() then ends by what a step itself moves
        model_.gases.clear(); // they act at x, as weight does
        model_.gravity = glm::dvec3(0);
        const Motion elastic = elastic_forces(x_);
        for (std::size_t i = 0; i < push_.size(); ++i)
            push_[i] -= elastic[i];
    }

    /// m: the way, of kLeast steps or until they add little, and on until `decided` of it.
    template <typename Decided>
    Motion run(const Decided& decided)
    {
        constexpr int kLeast = 8, kMost = 40; // where springs are far stiffer than bending steps are short
        constexpr double kLittle = 0.02;      // of the way so far
        for (int i = 1; i <= kMost && step() > kLittle; ++i)
            if (i >= kLeast && decided(way()))
                break;
        return way();
    }

private:
    Motion way() const
    {
        Motion out = y_;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] -= x_[i];
        return out;
    }

    Motion elastic_forces(const Motion& y) const
    {
        Motion out(y.size(), glm::dvec3(0));
        add_forces(model_, y, out);
        return out;
    }

    bool moves(std::size_t i) const { return !model_.pinned[i] && !left_.touches[i]; }
    double stiffness(std::size_t i) const { return model_.mass[i] / (left_.time * left_.time); }

    /// J.
    double potential(const Motion& y) const
    {
        double out = elastic_energy(model_, y);
        for (std::size_t i = 0; i < y.size(); ++i)
            if (const glm::dvec3 way = y[i] - x_[i]; moves(i))
                out += 0.5 * stiffness(i) * glm::dot(way, way) - glm::dot(push_[i], way);
        return out;
    }

    /// N: minus its gradient.
    Motion force() const
    {
        Motion out = elastic_forces(y_);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = moves(i) ? out[i] + push_[i] - stiffness(i) * (y_[i] - x_[i]) : glm::dvec3(0);
        return out;
    }

    /// What a step has added to the way, as a share of it; 0 where none goes down.
    double step()
    {
        const Motion pull = force(),
                     way = newton_steps(model_, y_, left_, {pull}, kMostFactoredOnTheWay)[0];
        double slope = 0;
        for (std::size_t i = 0; i < way.size(); ++i)
            slope += moves(i) ? glm::dot(pull[i], way[i]) : 0;
        const double before = potential(y_);
        for (double share = 1; share > 1e-3; share /= 2)
        {
            Motion next = y_;
            for (std::size_t i = 0; i < next.size(); ++i)
                next[i] += moves(i) ? share * way[i] : glm::dvec3(0);
            if (!(potential(next) <= before - 1e-4 * share * slope))
                continue;
            double added = 0, all = 0;
            for (std::size_t i = 0; i < next.size(); ++i)
            {
                added += model_.mass[i] * glm::distance(next[i], y_[i]);
                all += model_.mass[i] * glm::distance(next[i], x_[i]);
            }
            y_ = next;
            return all > 0 ? added / all : 0;
        }
        return 0;
    }

    PhysicalModel model_;
    Leftover left_;
    Motion x_, y_; ///< m
    Motion push_;  ///< N, at every y: what acts at x but for elements
};

} // namespace

LoadResidual load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const std::vector<Motion> forces = forces_of(model, left);
    Steps step = first_steps(model, x, left, forces);
    std::vector<LoadResidual> bodies;
    const auto of_body = [&](std::size_t b) {
        return residual_of(model, x, step, left, model.body_start[b], model.body_start[b + 1]);
    };
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
        bodies.push_back(of_body(b));
    const auto is_followed = [&](const LoadResidual& r) {
        return left.against_response && r.share > left.followed && r.way <= kSeenWay;
    };
    const std::vector<LoadResidual> first = bodies;
    const auto take = [&](const Motion& way) { // whether some body is told to be far off
        step.left = way;
        bool seen = false;
        for (std::size_t b = 0; b < bodies.size(); ++b)
            if (is_followed(first[b]))
            {
                bodies[b].way = std::max(first[b].way, of_body(b).way);
                seen = seen || bodies[b].way > kSeenWay;
            }
        return seen;
    };
    if (std::any_of(first.begin(), first.end(), is_followed))
        take(Descent(model, x, left, forces[0]).run(take));
    const auto key = [](const LoadResidual& r) { return std::pair(r.way > kSeenWay, r.share); };
    LoadResidual worst;
    for (const LoadResidual& next : bodies)
        worst = key(next) > key(worst) ? next : worst;
    return worst;
}

} // namespace taut
