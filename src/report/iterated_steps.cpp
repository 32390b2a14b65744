// Based on: the preconditioned conjugate gradients of rigid_gradients.cpp; Golub, Meurant. Matrices, Moments
//   and Quadrature II. BIT 37, 1997 (the error of an iterate by what later iterations add to it).
// Departures: what later iterations add is measured as motion by mass, as residuals are, and not in energy:
//   most of that lies in stiff directions and moves nothing. What is still to come follows from the last two
//   looks as a geometric series.

#include "taut/report/iterated_steps.hpp"

#include "taut/report/rigid_gradients.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut {
namespace {

using reference::BlockMatrix;
using reference::Columns;
using reference::Curvature;
using reference::State;
using Motion = std::vector<glm::dvec3>;

constexpr std::uint32_t kHeld = 0xffffffffu;
constexpr std::uint32_t kGroup = 100; ///< vertices that are to move as one rigid body
/// Groups, which are then larger: the small system is factored. That of solids fills more.
constexpr std::uint32_t kMostGroups = 4000, kMostOfSolids = 2000;

/// The vertices that move, and their rows.
struct Rows
{
    std::vector<std::uint32_t> row, vertex; ///< kHeld: none
    std::vector<std::uint32_t> body_start;  ///< first row of each body, and their number

    Columns columns(std::span<const glm::dvec3> of) const
    {
        Columns out(3, static_cast<Eigen::Index>(vertex.size()));
        for (std::size_t r = 0; r < vertex.size(); ++r)
            out.col(static_cast<Eigen::Index>(r)) << of[vertex[r]].x, of[vertex[r]].y, of[vertex[r]].z;
        return out;
    }
};

Rows rows_of(const PhysicalModel& model, const Leftover& left)
{
    Rows out;
    out.row.assign(model.mass.size(), kHeld);
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
    {
        out.body_start.push_back(static_cast<std::uint32_t>(out.vertex.size()));
        for (std::uint32_t i = model.body_start[b]; i < model.body_start[b + 1]; ++i)
            if (!model.pinned[i] && !left.touches[i])
            {
                out.row[i] = static_cast<std::uint32_t>(out.vertex.size());
                out.vertex.push_back(i);
            }
    }
    out.body_start.push_back(static_cast<std::uint32_t>(out.vertex.size()));
    return out;
}

BlockMatrix stiffness_of(const reference::StaticEnergy& energy, std::span<const glm::dvec3> x, double time,
                         const Rows& rows)
{
    BlockMatrix out(static_cast<std::uint32_t>(rows.vertex.size()), [&](const BlockMatrix::Pair& pair) {
        energy.elements([&](std::span<const std::uint32_t> v) {
            for (std::size_t a = 0; a < v.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    if (rows.row[v[a]] != kHeld && rows.row[v[b]] != kHeld)
                        pair(rows.row[v[a]], rows.row[v[b]]);
        });
    });
    State at;
    at.reserve(x.size());
    for (const glm::dvec3& p : x)
        at.push_back({p.x, p.y, p.z});
    energy.blocks(at, Curvature::projected, 1 / (time * time),
                  [&](std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
                      if (rows.row[a] != kHeld && rows.row[b] != kHeld)
                          out.add(rows.row[a], rows.row[b], block);
                  });
    return out;
}

/// kg m, a body: sum m |d|.
std::vector<double> moved_of(const PhysicalModel& model, const Rows& rows, const Columns& d)
{
    std::vector<double> out;
    for (std::size_t b = 0; b + 1 < rows.body_start.size(); ++b)
    {
        double sum = 0;
        for (std::uint32_t r = rows.body_start[b]; r < rows.body_start[b + 1]; ++r)
            sum += model.mass[rows.vertex[r]] * d.col(r).norm();
        out.push_back(sum);
    }
    return out;
}

/// Looks at iterates.
class NearEnough
{
public:
    /// `floor` [kg m], a body: what may be left of it in any case.
    NearEnough(const PhysicalModel& model, const Rows& rows, std::vector<double> floor)
        : model_(model),
          rows_(rows),
          floor_(std::move(floor))
    {}

    bool operator()(const Columns& x)
    {
        if (before_.size() == 0)
            before_ = Columns::Zero(3, x.cols());
        const std::vector<double> moved = moved_of(model_, rows_, x);
        const std::vector<double> came = moved_of(model_, rows_, x - before_);
        bool near = !came_.empty(); // nothing has come yet
        for (std::size_t b = 0; b < moved.size(); ++b)
        {
            const double ratio = came_.empty() ? 1 : std::max(kLeastRatio, came[b] / came_[b]);
            const double rest = ratio < 1 ? came[b] * ratio / (1 - ratio) : came[b] > 0 ? HUGE_VAL : 0;
            near = near && rest <= std::max(kStepError * moved[b], floor_[b]);
        }
        before_ = x;
        came_ = came;
        return near;
    }

private:
    static constexpr double kLeastRatio = 0.5; ///< one good look does not make a series

    const PhysicalModel& model_;
    const Rows& rows_;
    std::vector<double> floor_, came_;
    Columns before_;
};

} // namespace

std::vector<Motion> iterated_steps(const PhysicalModel& model, const reference::StaticEnergy& energy,
                                   std::span<const glm::dvec3> x, const Leftover& left,
                                   const std::vector<Motion>& forces)
{
    const Rows rows = rows_of(model, left);
    std::vector<Motion> out(forces.size(), Motion(x.size(), glm::dvec3(0)));
    if (rows.vertex.empty())
        return out;
    const BlockMatrix stiffness = stiffness_of(energy, x, left.time, rows);
    const bool solids = !model.solids.empty() || !model.volumes.empty();
    const std::uint32_t size = std::max(kGroup, stiffness.rows() / (solids ? kMostOfSolids : kMostGroups));
    const reference::RigidGradients gradients(stiffness, rows.columns(x), size);
    std::vector<double> loads(rows.body_start.size() - 1, 0.0);
    for (std::size_t b = 0; b < loads.size() && forces.size() == 1; ++b)
        for (std::uint32_t r = rows.body_start[b]; r < rows.body_start[b + 1]; ++r)
            loads[b] += left.load[rows.vertex[r]] * left.time * left.time;
    for (std::size_t f = forces.size(); f-- > 0;) // what is left after what the loads move
    {
        std::vector<double> floor(loads.size(), 0.0);
        for (std::size_t b = 0; b < floor.size() && f == 0; ++b)
            floor[b] = kStepFloor * loads[b];
        const Columns d =
            gradients.solve(rows.columns(forces[f]), NearEnough(model, rows, floor), kMostStepIterations);
        const std::vector<double> moved = moved_of(model, rows, d);
        for (std::size_t b = 0; b < moved.size() && f > 0; ++b)
            loads[b] = std::max(loads[b], moved[b]);
        for (std::size_t r = 0; r < rows.vertex.size(); ++r)
            for (int c = 0; c < 3; ++c)
                out[f][rows.vertex[r]][c] = d(c, static_cast<Eigen::Index>(r));
    }
    return out;
}

} // namespace taut
