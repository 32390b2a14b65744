// Based on: M. Movania. OpenCloth, OpenCloth_PositionBasedDynamics (BSD), from a description of its numbers
//   and formulas, not from its text.
//   Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. 2006, section 3.5: rigid-mode damping.
//   Kelager, Niebe, Erleben. A Triangle Bending Constraint Model for Position-Based Dynamics. 2010.
// Departures: where the description is silent: the sheet starts level at a height of 5 m, its first row at
//   z = 0; the ellipsoid stands at (0, 2, 0), turned about x; a particle in it goes to its surface along the
//   ray from its middle.

#include "opencloth.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace plain {
namespace {

constexpr std::uint32_t kSide = 21;
constexpr float kSize = 4, kHeight = 5, kStep = 1.0f / 60;
constexpr float kStretch = 0.25f, kBend = 0.5f, kGlobalDamping = 0.98f, kRigidDamping = 0.00125f;
constexpr float kBendOffset = 0.0098f;
constexpr int kIterations = 2;
const glm::vec3 kWeight(0, -0.00981f, 0); // N a particle: v += h w f

float share(float k) { return 1 - std::pow(1 - k, 1.0f / kIterations); }

std::uint32_t at(std::uint32_t column, std::uint32_t row) { return row * kSide + column; }

} // namespace

Opencloth::Opencloth()
{
    for (std::uint32_t row = 0; row < kSide; ++row)
        for (std::uint32_t column = 0; column < kSide; ++column)
            x_.emplace_back(kSize * (static_cast<float>(column) / (kSide - 1) - 0.5f), kHeight,
                            kSize * static_cast<float>(row) / (kSide - 1));
    p_ = x_;
    v_.assign(x_.size(), glm::vec3(0));
    w_.assign(x_.size(), static_cast<float>(kSide * kSide));
    w_[at(0, 0)] = w_[at(kSide - 1, 0)] = 0;
    for (std::uint32_t row = 0; row < kSide; ++row)
        for (std::uint32_t column = 0; column + 1 < kSide; ++column)
            add_spring(at(column, row), at(column + 1, row));
    for (std::uint32_t column = 0; column < kSide; ++column)
        for (std::uint32_t row = 0; row + 1 < kSide; ++row)
            add_spring(at(column, row), at(column, row + 1));
    structural_ = springs_.size();
    for (std::uint32_t row = 0; row + 1 < kSide; ++row)
        for (std::uint32_t column = 0; column + 1 < kSide; ++column)
        {
            add_spring(at(column, row), at(column + 1, row + 1));
            add_spring(at(column + 1, row), at(column, row + 1));
        }
    for (std::uint32_t row = 0; row < kSide; ++row)
        for (std::uint32_t column = 0; column + 2 < kSide; ++column)
            add_bend(at(column, row), at(column + 1, row), at(column + 2, row));
    for (std::uint32_t column = 0; column < kSide; ++column)
        for (std::uint32_t row = 0; row + 2 < kSide; ++row)
            add_bend(at(column, row), at(column, row + 1), at(column, row + 2));
    ellipsoid_ = glm::translate(glm::mat4(1), glm::vec3(0, 2, 0));
    ellipsoid_ = glm::rotate(ellipsoid_, glm::radians(45.0f), glm::vec3(1, 0, 0));
    ellipsoid_ = glm::scale(ellipsoid_, glm::vec3(1, 1, 0.5f));
    into_ellipsoid_ = glm::inverse(ellipsoid_);
}

void Opencloth::add_spring(std::uint32_t a, std::uint32_t b)
{
    springs_.push_back({a, b, glm::distance(x_[a], x_[b])});
}

/// The end of three particles in a row is the one that the constraint moves most, not the middle.
void Opencloth::add_bend(std::uint32_t a, std::uint32_t b, std::uint32_t p)
{
    bends_.push_back({a, b, p, glm::distance(x_[p], (x_[a] + x_[b] + x_[p]) / 3.0f)});
}

void Opencloth::step()
{
    for (std::size_t i = 0; i < x_.size(); ++i)
    {
        v_[i] *= kGlobalDamping;
        if (w_[i] > 0)
            v_[i] += kWeight * (w_[i] * kStep);
    }
    damp();
    for (std::size_t i = 0; i < x_.size(); ++i)
        p_[i] = w_[i] > 0 ? x_[i] + v_[i] * kStep : x_[i];
    for (int n = 0; n < kIterations; ++n)
    {
        project_springs();
        project_bends();
        for (glm::vec3& p : p_) // the floor
            p.y = std::max(p.y, 0.0f);
    }
    collide();
    for (std::size_t i = 0; i < x_.size(); ++i)
    {
        v_[i] = (p_[i] - x_[i]) / kStep;
        x_[i] = p_[i];
    }
}

/// Pulls velocities towards those of the sheet as a rigid body.
void Opencloth::damp()
{
    glm::vec3 centre(0), mean(0), spin(0);
    float mass = 0;
    const auto mass_of = [&](std::size_t i) { return w_[i] > 0 ? 1 / w_[i] : 1.0f / (kSide * kSide); };
    for (std::size_t i = 0; i < x_.size(); ++i)
    {
        centre += x_[i] * mass_of(i);
        mean += v_[i] * mass_of(i);
        mass += mass_of(i);
    }
    centre /= mass;
    mean /= mass;
    glm::mat3 inertia(0);
    for (std::size_t i = 0; i < x_.size(); ++i)
    {
        const glm::vec3 r = x_[i] - centre;
        spin += glm::cross(r, v_[i] * mass_of(i));
        inertia += mass_of(i) * (glm::dot(r, r) * glm::mat3(1) - glm::outerProduct(r, r));
    }
    const glm::vec3 turn = glm::inverse(inertia) * spin;
    for (std::size_t i = 0; i < x_.size(); ++i)
        v_[i] += kRigidDamping * (mean + glm::cross(turn, x_[i] - centre) - v_[i]);
}

void Opencloth::project_springs()
{
    const float k = share(kStretch);
    for (const Spring& s : springs_)
    {
        const glm::vec3 d = p_[s.a] - p_[s.b];
        const float length = glm::length(d), weight = w_[s.a] + w_[s.b];
        if (!(length > 0) || !(weight > 0))
            continue;
        const glm::vec3 push = d / length * (k * (length - s.rest) / weight);
        p_[s.a] -= push * w_[s.a];
        p_[s.b] += push * w_[s.b];
    }
}

void Opencloth::project_bends()
{
    const float k = share(kBend);
    for (const Bend& c : bends_)
    {
        const glm::vec3 d = p_[c.p] - (p_[c.a] + p_[c.b] + p_[c.p]) / 3.0f;
        const float length = glm::length(d), weight = w_[c.a] + w_[c.b] + 2 * w_[c.p];
        if (!(length > 0) || !(weight > 0))
            continue;
        const glm::vec3 push = d * ((1 - (kBendOffset + c.rest) / length) * k / weight);
        p_[c.a] += 2 * w_[c.a] * push;
        p_[c.b] += 2 * w_[c.b] * push;
        p_[c.p] -= 4 * w_[c.p] * push;
    }
}

void Opencloth::collide()
{
    for (std::size_t i = 0; i < p_.size(); ++i)
    {
        const glm::vec3 own(into_ellipsoid_ * glm::vec4(p_[i], 1));
        const float far = glm::length(own);
        if (w_[i] > 0 && far > 0 && far < 1)
            p_[i] = glm::vec3(ellipsoid_ * glm::vec4(own / far, 1));
    }
}

float Opencloth::largest_stretch() const
{
    float worst = 0;
    for (std::size_t k = 0; k < structural_; ++k)
        worst = std::max(worst, glm::distance(x_[springs_[k].a], x_[springs_[k].b]) - springs_[k].rest);
    return worst;
}

float Opencloth::deepest_in_ellipsoid() const
{
    float deepest = -1;
    for (const glm::vec3& x : x_)
        deepest = std::max(deepest, 1 - glm::length(glm::vec3(into_ellipsoid_ * glm::vec4(x, 1))));
    return deepest;
}

} // namespace plain
