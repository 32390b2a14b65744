#include "support/solid_stress.hpp"

#include "support/symmetric.hpp"

#include <glm/geometric.hpp>

namespace taut::conformance {

Eigen::Matrix<double, 9, 1> flat(const glm::dmat3& m)
{
    Eigen::Matrix<double, 9, 1> out;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            out[3 * c + r] = m[c][r];
    return out;
}

glm::dmat3 cofactor_of(const glm::dmat3& f)
{
    return {glm::cross(f[1], f[2]), glm::cross(f[2], f[0]), glm::cross(f[0], f[1])};
}

glm::dmat3 stress_of(const Elastic& m, const glm::dmat3& f)
{
    const double square = glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
    return m.mu * (1 - m.log / (square + 1)) * f +
           m.lambda * (glm::dot(f[0], glm::cross(f[1], f[2])) - m.rest) * cofactor_of(f);
}

Matrix9 stress_derivative(const Elastic& m, const glm::dmat3& f)
{
    const double square = glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
    const double push = m.lambda * (glm::dot(f[0], glm::cross(f[1], f[2])) - m.rest);
    const auto g = flat(cofactor_of(f)), own = flat(f);
    Matrix9 out = Matrix9::Identity() * (m.mu * (1 - m.log / (square + 1)));
    out += 2 * m.mu * m.log / ((square + 1) * (square + 1)) * own * own.transpose();
    out += m.lambda * g * g.transpose();
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
        {
            glm::dmat3 unit(0.0);
            unit[c][r] = 1;
            out.col(3 * c + r) += push / 2 * (flat(cofactor_of(f + unit)) - flat(cofactor_of(f - unit)));
        }
    return out;
}

Matrix9 turned_positive(const Matrix9& a)
{
    const Spectrum all = symmetric_spectrum(0.5 * (a + a.transpose()));
    return all.vectors * all.values.cwiseMax(-all.values / 16).asDiagonal() * all.vectors.transpose();
}

std::vector<double> state_of(const glm::dmat3& stress, const Matrix9& k)
{
    std::vector<double> out;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            out.push_back(stress[c][r]);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            for (int s = r; s < 3; ++s)
                out.push_back(k(3 * c + r, 3 * c + s));
    for (const auto& [c, d] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s)
                out.push_back(k(3 * c + r, 3 * d + s));
    return out;
}

} // namespace taut::conformance
