// Based on: Kabsch. A solution for the best rotation to relate two sets of vectors. Acta Crystallographica
//   A32, 1976.
// Departures: about a place that stays, or about a line, where the best angle has a closed form.

#include "taut/report/rolling.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace taut {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of the body's size about the patch, both root mean squares: what stands on a narrower one may roll about
/// it. A ball of four cells stands on up to a quarter, a cube on 0.4, a column of four thirds of its width on
/// a third.
constexpr double kApart = 1.0 / 3;

Vector3d vector_of(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// How the held vertices are spread.
struct Hold
{
    Vector3d middle = Vector3d::Zero(); ///< m
    Vector3d spread = Vector3d::Zero(); ///< m, root mean square along `axes`, least first
    Matrix3d axes = Matrix3d::Identity();
};

Hold hold_of(const BodyWay& body)
{
    Hold out;
    double count = 0;
    for (std::size_t i = 0; i < body.place.size(); ++i)
        if (body.held[i])
        {
            out.middle += vector_of(body.place[i]);
            count += 1;
        }
    out.middle /= count;
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t i = 0; i < body.place.size(); ++i)
        if (const Vector3d arm = vector_of(body.place[i]) - out.middle; body.held[i])
            sum += arm * arm.transpose() / count;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(sum);
    out.spread = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    out.axes = solver.eigenvectors();
    return out;
}

/// m: root mean square of the vertices' distances from a place.
double size_about(const BodyWay& body, const Vector3d& middle)
{
    double sum = 0;
    for (const glm::dvec3& p : body.place)
        sum += (vector_of(p) - middle).squaredNorm();
    return std::sqrt(sum / static_cast<double>(body.place.size()));
}

/// kg m^2: sum m (place + way) place^T, about the middle of what is held.
Matrix3d moments(const BodyWay& body, const Vector3d& middle)
{
    Matrix3d out = Matrix3d::Zero();
    for (std::size_t i = 0; i < body.place.size(); ++i)
    {
        const Vector3d arm = vector_of(body.place[i]) - middle;
        out += body.mass[i] * (arm + vector_of(body.way[i])) * arm.transpose();
    }
    return out;
}

Matrix3d turn_about_place(const Matrix3d& moments)
{
    const Eigen::JacobiSVD<Matrix3d> parts(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix3d& u = parts.matrixU();
    const Matrix3d& v = parts.matrixV();
    const Vector3d signs(1, 1, (u * v.transpose()).determinant());
    return u * signs.asDiagonal() * v.transpose();
}

Matrix3d turn_about_line(const Matrix3d& moments, const Vector3d& line)
{
    // sum m n . (p x q) over sum m (p . q - (n . p) (n . q)), p before and q after.
    const Vector3d across(moments(2, 1) - moments(1, 2), moments(0, 2) - moments(2, 0),
                          moments(1, 0) - moments(0, 1));
    const double along = moments.trace() - line.dot(moments * line);
    return Eigen::AngleAxisd(std::atan2(line.dot(across), along), line).toRotationMatrix();
}

} // namespace

std::vector<glm::dvec3> without_rolling(const BodyWay& body)
{
    std::vector<glm::dvec3> out(body.way.begin(), body.way.end());
    if (std::find(body.held.begin(), body.held.end(), true) == body.held.end())
        return out;
    const Hold hold = hold_of(body);
    const double near = kApart * size_about(body, hold.middle);
    const Matrix3d m = moments(body, hold.middle);
    if (!m.allFinite() || hold.spread[1] > near)
        return out;
    const Matrix3d turn = hold.spread[2] > near ? turn_about_line(m, hold.axes.col(2)) : turn_about_place(m);
    for (std::size_t i = 0; i < out.size(); ++i)
    {
        const Vector3d arm = vector_of(body.place[i]) - hold.middle, rolled = turn * arm - arm;
        out[i] -= glm::dvec3(rolled.x(), rolled.y(), rolled.z());
    }
    return out;
}

} // namespace taut
