#include "taut/kernels/plastic_solid.hpp"

#include "support/solid_net.hpp"

#include <Eigen/Eigenvalues>

using namespace taut;
using namespace taut::conformance;

namespace {

using Matrix3 = Eigen::Matrix3d;

constexpr std::uint32_t kNone = 0xffffffffu;

struct Eigen3
{
    Eigen::Vector3d value;
    Matrix3 vector;
};

Eigen3 eigen_of(const Matrix3& m)
{
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(m);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

double strain_of(const Eigen::Vector3d& s)
{
    return std::sqrt((s - Eigen::Vector3d::Ones()).squaredNorm() * 2 / 3);
}

Eigen::Vector3d of_shape(const Eigen::Vector3d& s)
{
    return s / std::cbrt(s.prod());
}

Matrix3 symmetric(const Eigen::Vector3d& value, const Matrix3& vector)
{
    return vector * value.asDiagonal() * vector.transpose();
}

struct Rule
{
    double yield, creep, limit;
};

/// P after a substep of length h, where F is what it is without P; by library decompositions.
Matrix3 flowed(const Matrix3& f, const Matrix3& p, const Rule& rule, double h)
{
    const Matrix3 e = f * p;
    const double grown = e.determinant();
    if (!(grown > 1e-3 && grown < 1e3))
        return p;
    const Eigen3 elastic = eigen_of(e.transpose() * e);
    const Eigen::Vector3d s = of_shape(elastic.value.cwiseMax(0).cwiseSqrt());
    const double strain = strain_of(s);
    if (!(strain > rule.yield))
        return p;
    const double x = std::min(rule.creep * h, 1e6), more = x + x * x / 2 + x * x * x / 6;
    const double flow = more / (1 + more) * (strain - rule.yield) / strain;
    const Eigen::Vector3d one = Eigen::Vector3d::Ones();
    const Eigen::Vector3d d = of_shape(one + (s - one) * flow);
    const Matrix3 a = p * symmetric(d.cwiseInverse(), elastic.vector);
    const Eigen3 plastic = eigen_of(a * a.transpose());
    Eigen::Vector3d stretch = of_shape(plastic.value.cwiseSqrt().cwiseInverse());
    stretch = of_shape(one + (stretch - one) * std::min(1.0, rule.limit / strain_of(stretch)));
    return symmetric(stretch.cwiseInverse(), plastic.vector);
}

template <typename Real>
struct Input
{
    std::vector<glm::vec<4, Real>> position, low;
    std::vector<layout::SolidTetrahedron<Real>> solid;
    std::vector<std::uint32_t> table;
    std::vector<Real> rule, state;
    layout::StepValues<Real> step{};
    std::vector<Matrix3> f, p, b; ///< without P; P; B at first
    std::vector<Rule> rules;
};

Matrix3 wild(Random& random, double far)
{
    Matrix3 m = Matrix3::Identity();
    for (int k = 0; k < 9; ++k)
        m(k / 3, k % 3) += random.uniform(-far, far);
    return m;
}

/// The records of a tetrahedron as vertex block descent has them, each corner second; some are not there.
template <typename Real>
void add_records(Input<Real>& in, Random& random, const std::array<std::uint32_t, 4>& v)
{
    constexpr std::uint32_t kOrders[4][4] = {{3, 0, 2, 1}, {0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}};
    in.table.insert(in.table.end(), v.begin(), v.end());
    for (const auto& order : kOrders)
    {
        if (random.chance(0.2))
        {
            in.table.push_back(kNone);
            continue;
        }
        in.table.push_back(static_cast<std::uint32_t>(in.solid.size()));
        layout::SolidTetrahedron<Real> t{};
        t.a = v[order[0]], t.b = v[order[1]], t.c = v[order[2]], t.d = v[order[3]];
        t.volume = Real(0.25), t.mu = Real(100), t.lambda = Real(300), t.rest = Real(1.3);
        t.b00 = t.b11 = t.b22 = Real(-7); // what it has if nothing flows
        in.solid.push_back(t);
    }
}

template <typename Real>
Input<Real> make_input(Random& random, std::uint32_t count)
{
    static constexpr double kCreeps[] = {1, 10, 100, 1e30};
    Input<Real> in;
    in.step.substep = Real(0.004);
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const TetrahedronCorners rest = random_tetrahedron(random);
        const std::uint32_t kind = k % 6;
        Matrix3 f = wild(random, kind == 1 ? 0.02 : 0.3);
        if (kind == 2)
            f.col(2) = -f.col(2); // inverted
        if (kind == 3)
            f.col(1) *= 1e-5; // flat
        if (kind == 4)
            f *= random.uniform(0.5, 2); // a change of volume is elastic
        std::array<std::uint32_t, 4> v{};
        for (std::uint32_t c = 0; c < 4; ++c)
        {
            v[c] = static_cast<std::uint32_t>(in.position.size());
            const Eigen::Vector3d x(rest[c].x, rest[c].y, rest[c].z), y = f * x;
            in.position.push_back({Real(y[0]), Real(y[1]), Real(y[2]), Real(1)});
            in.low.push_back(random.vec4<Real>(1e-8, Real(0)));
        }
        Matrix3 edges;
        for (int e = 0; e < 3; ++e)
            for (int r = 0; r < 3; ++r)
                edges(r, e) = rest[static_cast<std::size_t>(e) + 1][r] - rest[0][r];
        const Matrix3 inverse = edges.inverse();
        Matrix3 kept;
        for (int e = 0; e < 9; ++e)
        {
            in.rule.push_back(static_cast<Real>(inverse(e / 3, e % 3)));
            kept(e / 3, e % 3) = static_cast<double>(in.rule.back());
        }
        const Rule rule{random.uniform(0.02, 0.3), kCreeps[random.below(4)], random.uniform(0.05, 0.4)};
        in.rules.push_back({static_cast<double>(static_cast<Real>(rule.yield)),
                            static_cast<double>(static_cast<Real>(rule.creep)),
                            static_cast<double>(static_cast<Real>(rule.limit))});
        for (const double value : {rule.yield, rule.creep, rule.limit})
            in.rule.push_back(static_cast<Real>(value));
        Matrix3 p = Matrix3::Identity();
        if (kind == 5)
        {
            const Matrix3 w = wild(random, 0.1);
            const Eigen3 e = eigen_of(w * w.transpose());
            p = symmetric(of_shape(e.value.cwiseSqrt()), e.vector);
        }
        const double six[6] = {p(0, 0), p(1, 1), p(2, 2), p(1, 2), p(0, 2), p(0, 1)};
        for (const double value : six)
            in.state.push_back(static_cast<Real>(value));
        const auto at = [&](std::size_t n) { return static_cast<double>(in.state[6 * std::size_t(k) + n]); };
        p << at(0), at(5), at(4), at(5), at(1), at(3), at(4), at(3), at(2);
        Matrix3 now;
        for (int e = 0; e < 3; ++e)
            for (int r = 0; r < 3; ++r)
            {
                const std::uint32_t a = v[0], b = v[static_cast<std::size_t>(e) + 1];
                now(r, e) = (double(in.position[b][r]) - double(in.position[a][r])) +
                            (double(in.low[b][r]) - double(in.low[a][r]));
            }
        in.b.push_back(kept);
        in.p.push_back(p);
        in.f.push_back(now * kept);
        add_records(in, random, v);
    }
    return in;
}

} // namespace

TEMPLATE_TEST_CASE("plastic_solid lets the shape flow beyond the yield, and never the volume", "[plasticity]",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 129u, 1000u);
    CAPTURE(count);
    Random random(2700 + count);
    const Input<Real> in = make_input<Real>(random, count);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(in.table)},       {"rule", bytes_of(in.rule)},
            {"state", bytes_of(in.state)},       {"solid", bytes_of(in.solid)},
            {"position", bytes_of(in.position)}, {"low", bytes_of(in.low)},
            {"step_values", bytes_of(std::vector{in.step})}};
    c.launches = {make_launch(kernels::plastic_solid::info("", c.precision),
                              kernels::plastic_solid::Params{count}, count)};
    std::vector<Matrix3> expected;
    std::size_t flowing = 0;
    Field& state = c.expected["state"];
    for (std::uint32_t k = 0; k < count; ++k)
    {
        expected.push_back(
            flowed(in.f[k], in.p[k], in.rules[k], static_cast<double>(in.step.substep)));
        const Matrix3& p = expected.back();
        const bool flows = p != in.p[k];
        flowing += flows;
        // Edges and rows of some size make F: their rounding is that of the largest.
        const double scale = flows ? in.b[k].norm() * (in.f[k].norm() + 1) : 0;
        const double six[6] = {p(0, 0), p(1, 1), p(2, 2), p(1, 2), p(0, 2), p(0, 1)};
        for (const double value : six)
            state.add(value, scale);
    }
    if (count > 60)
    {
        CHECK(flowing > count / 4);
        CHECK(flowing < count - count / 4);
    }
    const double eps = sizeof(Real) == 8 ? 0x1p-52 : 0x1p-23;
    const auto look = [&](const Buffers& out) {
        const auto after = values_of<Real>(out.at("state"));
        const auto solid = values_of<layout::SolidTetrahedron<Real>>(out.at("solid"));
        double volume = 0, rows = 0;
        std::size_t strange = 0;
        for (std::uint32_t k = 0; k < count; ++k)
        {
            const auto at = [&](std::size_t n) { return static_cast<double>(after[6 * std::size_t(k) + n]); };
            Matrix3 p;
            p << at(0), at(5), at(4), at(5), at(1), at(3), at(4), at(3), at(2);
            const bool flows = expected[k] != in.p[k];
            if (flows)
                volume = std::max(volume, std::abs(p.determinant() - 1));
            const Matrix3 b = in.b[k] * p;
            for (std::uint32_t own = 0; own < 4; ++own)
            {
                const std::uint32_t record = in.table[8 * std::size_t(k) + 4 + own];
                if (record == kNone)
                    continue;
                if (!flows)
                {
                    strange += std::memcmp(&solid[record], &in.solid[record], sizeof solid[record]) != 0;
                    continue;
                }
                // F must be what it is whichever corner comes second.
                const auto& t = solid[record];
                const std::uint32_t corner[] = {t.a, t.b, t.c, t.d};
                Matrix3 edges, own_b;
                for (int e = 0; e < 3; ++e)
                    for (int r = 0; r < 3; ++r)
                        edges(r, e) =
                            double(in.position[corner[e + 1]][r]) - double(in.position[corner[0]][r]);
                own_b << double(t.b00), double(t.b01), double(t.b02), double(t.b10), double(t.b11),
                    double(t.b12), double(t.b20), double(t.b21), double(t.b22);
                const Matrix3 want = in.f[k] * p;
                rows = std::max(rows, (edges * own_b - want).norm() / (1 + b.norm()));
            }
        }
        CHECK(strange == 0);
        CHECK(volume < 32 * eps);
        CHECK(rows < 64 * eps + 1e-7); // `low` is left out of the edges here
    };
    // Not to the last bit: drivers reassociate within the rotations (implicit_solids_test.cpp). Demanded,
    // it failed on Mesa's Vulkan and OpenGL from SPIR-V, in float and double; OpenGL from GLSL agreed.
    look_on_every_device(c, look, false);
}
