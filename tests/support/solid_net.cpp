#include "support/solid_net.hpp"

#include "support/solid_stress.hpp"

namespace taut::conformance {

template <typename Real>
void make_solid_table(SolidNet<Real>& in)
{
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < in.solids.size(); ++k)
        for (const std::uint32_t v : in.corners(k))
            corners.push_back(v);
    const std::set<std::uint32_t> used(corners.begin(), corners.end());
    Net<Real>& net = in.net;
    net.held.clear();
    for (std::uint32_t v = 0; v < net.count; ++v)
        net.held.insert(net.held.end(), 3, net.position[v].w > 0 && used.count(v) > 0 ? 0u : 1u);
    net.blocks.clear();
    std::set<Place> met;
    in.table = make_table(net, corners, 4, met, true);
}

template <typename Real>
SolidNet<Real> random_solids(std::uint32_t count, std::uint32_t shapes, std::uint64_t seed)
{
    SolidNet<Real> out;
    out.net = random_net<Real>(count, seed);
    out.net.springs.clear();
    out.net.hinges.clear();
    Random random(seed + 7);
    for (std::uint32_t k = 0; count >= 4 && k < shapes; ++k)
    {
        std::array<std::uint32_t, 4> v{};
        TetrahedronCorners x;
        for (int attempt = 0; attempt < 400; ++attempt)
        {
            for (std::size_t c = 0; c < 4;)
            {
                v[c] = random.below(count);
                c += std::count(v.begin(), v.begin() + static_cast<long>(c), v[c]) == 0 ? 1 : 0;
            }
            for (std::size_t c = 0; c < 4; ++c)
                x[c] = out.net.between(v[0], v[c]);
            if (thinness(x) > 0.2)
                break;
        }
        const glm::dmat3 now(x[1], x[2], x[3]);
        const auto wild = [&](double far) {
            glm::dmat3 m(1);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    m[i][j] += random.uniform(-far, far);
            return m;
        };
        glm::dmat3 f = wild(0.5);
        const std::uint32_t kind = k % 8;
        if (kind == 1)
            f = glm::dmat3(1);
        if (kind == 2)
            f = f * glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1);
        if (kind == 3)
            f = f * glm::dmat3(0.3, 0, 0, 0, 0.4, 0, 0, 0, 0.5);
        // now * B = f, so that the deformation is what was asked for.
        const glm::dmat3 b = glm::inverse(now) * f;
        layout::SolidTetrahedron<Real> t{};
        t.a = v[0], t.b = v[1], t.c = v[2], t.d = v[3];
        t.b00 = Real(b[0][0]), t.b01 = Real(b[1][0]), t.b02 = Real(b[2][0]);
        t.b10 = Real(b[0][1]), t.b11 = Real(b[1][1]), t.b12 = Real(b[2][1]);
        t.b20 = Real(b[0][2]), t.b21 = Real(b[1][2]), t.b22 = Real(b[2][2]);
        t.volume = random.uniform<Real>(0.1, 1);
        t.mu = kind == 4 ? Real(0) : random.uniform<Real>(100, 1000);
        t.lambda = random.uniform<Real>(100, 5000);
        t.log_term = Real(kind % 2);
        t.rest = kind == 4 ? Real(1) : Real(1) + t.mu / t.lambda * (t.log_term > 0 ? Real(0.75) : Real(1));
        if (kind == 6)
            t.b02 = t.b12 = t.b22 = Real(0); // flat: F has a column of zeros
        if (kind == 7 && k > 8)
            t.b00 = t.b01 = t.b02 = t.b10 = t.b11 = t.b12 = t.b20 = t.b21 = t.b22 = Real(0); // a point
        out.solids.push_back(t);
    }
    make_solid_table(out);
    return out;
}

namespace {

/// Back from what state_of() makes.
template <typename Real>
Matrix9 matrix_of(const Real* state)
{
    Matrix9 k;
    std::size_t at = 9;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            for (int s = r; s < 3; ++s)
                k(3 * c + r, 3 * c + s) = k(3 * c + s, 3 * c + r) = double(state[at++]);
    for (const auto& [c, d] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s)
                k(3 * c + r, 3 * d + s) = k(3 * d + s, 3 * c + r) = double(state[at++]);
    return k;
}

} // namespace

template <typename Real>
std::map<Place, SizedBlock> solid_system(const SolidNet<Real>& in, const std::vector<Real>& state)
{
    std::map<Place, SizedBlock> out;
    for (std::size_t t = 0; t < in.solids.size(); ++t)
    {
        const Matrix9 k = matrix_of(&state[TAUT_SOLID_STATE * t]);
        const auto v = in.corners(t);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
            {
                if (!in.net.solved(v[i]) || !in.net.solved(v[j]) || (v[i] != v[j] && in.net.diagonal_only))
                    continue;
                const glm::dvec3 row = row_of(in.solids[t], i), column = row_of(in.solids[t], j);
                Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
                double size = 0;
                for (int c = 0; c < 3; ++c)
                    for (int d = 0; d < 3; ++d)
                    {
                        block += row[c] * column[d] * k.block<3, 3>(3 * c, 3 * d);
                        size += std::abs(row[c] * column[d]) * k.block<3, 3>(3 * c, 3 * d).norm();
                    }
                glm::dmat3 value(0.0);
                for (int c = 0; c < 3; ++c)
                    for (int r = 0; r < 3; ++r)
                        value[c][r] = block(r, c);
                // The first corner's row is a sum of the others', which may cancel.
                const double whole = glm::length(inverse_rest(in.solids[t])[0]) +
                                     glm::length(inverse_rest(in.solids[t])[1]) +
                                     glm::length(inverse_rest(in.solids[t])[2]);
                out[{v[i], v[j]}].add(value, std::max(size, whole * whole * k.norm()));
            }
    }
    return out;
}

#define TAUT_SOLID_NET_OF(Real)                                                                              \
    template void make_solid_table(SolidNet<Real>&);                                                         \
    template SolidNet<Real> random_solids(std::uint32_t, std::uint32_t, std::uint64_t);                      \
    template std::map<Place, SizedBlock> solid_system(const SolidNet<Real>&, const std::vector<Real>&);
TAUT_SOLID_NET_OF(float)
TAUT_SOLID_NET_OF(double)

} // namespace taut::conformance
