#pragma once
// The motion as a whole that kernels/shared/vbd_wrench.glsl allows a body on its feet, in fp64: from the sums
// of vbd_drift, with tensors as matrices.

#include "support/vbd_feet.hpp"

#include <Eigen/Dense>

#include <span>

namespace taut::conformance {

struct RigidShift
{
    glm::dvec3 way{0}, centre{0}, turn{0};
};

/// Sums of a body from which its motion follows.
class Standing
{
public:
    explicit Standing(std::span<const double, TAUT_VBD_PARTS> sums) : sums_(sums) {}

    double mass() const { return sums_[0]; } ///< the sum of the inertia, N/m
    bool stands() const { return sums_[TAUT_VBD_DRIFT + TAUT_VBD_SIZE] > 0; }
    glm::dvec3 pushed() const { return own(TAUT_VBD_DRIFT + TAUT_VBD_PUSHED); }
    RigidShift free() const
    {
        return {lack(), middle(), turn_of(own_moments(), lack_turn() - glm::cross(middle(), lack()))};
    }
    RigidShift on_its_feet() const;
    /// J over the mass that a shift brings; `fall`: the way of gravity.
    double energy(const RigidShift& s, const glm::dvec3& fall) const
    {
        const glm::dvec3 momentum = moved_turn() - glm::cross(middle(), moved());
        const double spin = glm::dot(s.turn, tensor(own_moments()) * s.turn);
        return glm::dot(s.way, moved() - fall) + glm::dot(s.turn, momentum) +
               0.5 * (glm::dot(s.way, s.way) + spin);
    }

private:
    /// Second moments about the mean place, m^2.
    using Moments = glm::dmat3;

    glm::dvec3 own(std::size_t k) const { return {sums_[k], sums_[k + 1], sums_[k + 2]}; }
    glm::dvec3 mean(std::size_t k) const { return own(k) / mass(); }
    glm::dvec3 touch(std::size_t k) const { return own(TAUT_VBD_DRIFT + k); }
    glm::dvec3 rubbed(std::size_t k) const { return own(TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + k); }
    double size() const { return sums_[TAUT_VBD_DRIFT + TAUT_VBD_SIZE]; }
    double raised() const { return sums_[TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + TAUT_VBD_HEIGHT]; }
    double count() const { return sums_[TAUT_VBD_DRIFT + TAUT_VBD_COUNT]; }
    glm::dvec3 lack() const { return mean(TAUT_VBD_LACK); }
    glm::dvec3 lack_turn() const { return mean(TAUT_VBD_TURN); }
    glm::dvec3 middle() const { return mean(TAUT_VBD_PLACE); }
    glm::dvec3 moved() const { return rubbed(TAUT_VBD_MOVED) / mass(); }
    glm::dvec3 moved_turn() const { return rubbed(TAUT_VBD_MOVED_TURN) / mass(); }
    static Moments moments(const glm::dvec3& square, const glm::dvec3& mixed, const glm::dvec3& middle)
    {
        const Moments of_places(square.x, mixed.z, mixed.y, mixed.z, square.y, mixed.x, mixed.y, mixed.x,
                                square.z);
        return of_places - glm::outerProduct(middle, middle);
    }
    Moments own_moments() const { return moments(mean(TAUT_VBD_SQUARE), mean(TAUT_VBD_MIXED), middle()); }
    glm::dvec3 foot() const { return touch(TAUT_VBD_FEET) / count(); }
    Moments foot_moments() const
    {
        return moments(touch(TAUT_VBD_FEET_SQUARE) / count(), touch(TAUT_VBD_FEET_MIXED) / count(), foot());
    }
    static double trace(const Moments& m) { return m[0][0] + m[1][1] + m[2][2]; }
    static glm::dmat3 tensor(const Moments& m) { return glm::dmat3(trace(m)) - m; }
    static glm::dvec3 turn_of(const Moments& m, const glm::dvec3& angular)
    {
        return rigid_turn_of(angular, glm::dvec3(0), {m[0][0], m[1][1], m[2][2]},
                             {m[2][1], m[2][0], m[1][0]});
    }

    std::span<const double, TAUT_VBD_PARTS> sums_;
};

namespace standing {

inline glm::dvec3 within(const glm::dvec3& v, double most)
{
    const double size = glm::length(v);
    return size > most ? v * (most / size) : v;
}

inline glm::dvec3 unit(const glm::dvec3& v) { return v == glm::dvec3(0) ? v : glm::normalize(v); }

/// How much of a slip the whole body takes part in, along the rub.
inline double room(const glm::dvec3& slip, const glm::dvec3& moved, const glm::dvec3& rub)
{
    const double agrees = glm::dot(slip, moved), square = glm::dot(slip, slip);
    const double share = agrees > 0 && square > 0 ? std::min(agrees / square, 1.0) : 0;
    return std::max(share * glm::dot(slip, unit(rub)), 0.0);
}

/// What friction leaves: `rub` is taken, `hold` may be in any direction, a slip does not turn around.
inline glm::dvec3 left(const glm::dvec3& lack, const glm::dvec3& rub, double hold, double room)
{
    const glm::dvec3 taken = rub + within(lack - rub, hold), rest = lack - taken;
    return rest + unit(rub) * std::max(-glm::dot(rest, unit(rub)) - room, 0.0);
}

/// What an even load on the rectangle of these moments cannot bear of an angular momentum across n.
inline glm::dvec3 tips(const glm::dmat3& feet, const glm::dvec3& n, const glm::dvec3& tip, double carried)
{
    const glm::dvec3 t =
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 w = glm::cross(n, t), lever = glm::cross(n, tip);
    Eigen::Matrix2d flat;
    flat << glm::dot(t, feet * t), glm::dot(t, feet * w), glm::dot(w, feet * t), glm::dot(w, feet * w);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(flat);
    glm::dvec3 beyond(0);
    for (int k = 0; k < 2; ++k)
    {
        const glm::dvec3 u = t * axes.eigenvectors()(0, k) + w * axes.eigenvectors()(1, k);
        const double half = carried * std::sqrt(3 * std::max(axes.eigenvalues()(k), 0.0));
        const double arm = glm::dot(lever, u);
        beyond += u * (arm - std::clamp(arm, -half, half));
    }
    return glm::cross(beyond, n);
}

} // namespace standing

inline RigidShift Standing::on_its_feet() const
{
    using namespace standing;
    RigidShift out{glm::dvec3(0), middle(), glm::dvec3(0)};
    const double pushes = glm::length(touch(TAUT_VBD_PUSH));
    if (pushes < 0.9 * size())
        return out;
    const glm::dvec3 n = touch(TAUT_VBD_PUSH) / pushes, arm = foot() - middle(), down = n * glm::dot(arm, n);
    const auto along = [&](const glm::dvec3& v) { return v - n * glm::dot(v, n); };
    const glm::dvec3 aside = glm::cross(arm, n);
    // The feet stay on the surface: a turn t moves the centre of mass by -t . aside along n.
    const glm::dmat3 added = glm::dmat3(0.5 * glm::dot(aside, aside)) - glm::outerProduct(aside, aside);
    const Moments resting = own_moments() + added;
    const double away = -glm::dot(lack(), n), height = raised() / size();
    const double fall = std::clamp(away, 0.0, height), stopped = std::max(away - fall, 0.0);
    const glm::dvec3 about_feet = lack_turn() - glm::cross(foot(), lack());
    const glm::dvec3 tip = along(about_feet + glm::cross(arm, along(lack())));
    const glm::dvec3 first = tips(foot_moments(), n, tip, stopped), turns = turn_of(resting, first);
    const double carried = std::max(stopped - glm::dot(turns, aside), 0.0), scale = carried / pushes;
    const double hold = sums_[TAUT_VBD_DRIFT + TAUT_VBD_HOLD] * scale;
    const glm::dvec3 rub = along(rubbed(TAUT_VBD_RUB)) * scale;
    const glm::dvec3 turning = turn_of(own_moments(), moved_turn() - glm::cross(middle(), moved()));
    const double free = tip == glm::dvec3(0) ? 0 : glm::length(first) / glm::length(tip);
    const glm::dvec3 u = unit(rub + along(lack()));
    const double gives = glm::dot(u, glm::cross(turn_of(resting, glm::cross(arm, u)), down));
    const double light = 1 + free * std::max(gives, 0.0);
    const glm::dvec3 ends = (along(lack()) + glm::cross(turns, down)) / light;
    const glm::dvec3 slip = rubbed(TAUT_VBD_SLIP) / size();
    const double slack = room(along(slip), moved() + glm::cross(turning, arm), rub) / light;
    const glm::dvec3 way = along(lack()) - ends + left(ends, rub, hold, slack);
    const glm::dvec3 turn = about_feet + glm::cross(arm, way);
    // About n: angular momenta, where along it were ways.
    const double round = std::sqrt(std::max(trace(foot_moments()) - glm::dot(n, foot_moments() * n), 0.0));
    const auto about = [&](const glm::dvec3& v) { return n * glm::dot(v, n); };
    const glm::dvec3 slip_turn = rubbed(TAUT_VBD_SLIP_TURN) / size() - glm::cross(foot(), slip);
    const glm::dvec3 rub_turn = rubbed(TAUT_VBD_RUB_TURN) - glm::cross(foot(), rubbed(TAUT_VBD_RUB));
    const glm::dvec3 spin = round > 0 ? about(slip_turn) / (round * round) : glm::dvec3(0);
    const double inertia = glm::dot(n, tensor(own_moments()) * n);
    const glm::dvec3 spins = left(about(turn), about(rub_turn) * scale, hold * round,
                                  room(spin, about(turning), about(rub_turn)) * inertia);
    out.turn = turn_of(resting, tips(foot_moments(), n, along(turn), carried) + spins);
    out.way = way + n * (std::max(-away, 0.0) - fall - glm::dot(out.turn, aside));
    return out;
}

} // namespace taut::conformance
