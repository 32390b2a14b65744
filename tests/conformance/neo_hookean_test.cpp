#include "taut/kernels/neo_hookean.hpp"

#include "support/tetrahedra.hpp"

#include <Eigen/Dense>

using namespace taut;
using namespace taut::conformance;
using kernels::neo_hookean::Params;

namespace {

template <typename Real>
using Constraint = layout::SolidTetrahedron<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;
using Gradient = Eigen::Matrix<double, 12, 1>;

template <typename Real>
Eigen::Matrix3d inverse_rest(const Constraint<Real>& c)
{
    Eigen::Matrix3d b;
    b << static_cast<double>(c.b00), static_cast<double>(c.b01), static_cast<double>(c.b02),
        static_cast<double>(c.b10), static_cast<double>(c.b11), static_cast<double>(c.b12),
        static_cast<double>(c.b20), static_cast<double>(c.b21), static_cast<double>(c.b22);
    return b;
}

/// dG/dx of a scalar whose derivative by F is `by_f`.
Gradient gradient(const Eigen::Matrix3d& by_f, const Eigen::Matrix3d& b)
{
    const Eigen::Matrix3d columns = by_f * b.transpose();
    Gradient out;
    out << -columns.rowwise().sum(), columns.col(0), columns.col(1), columns.col(2);
    return out;
}

/// XPBD by definition, both constraints of a tetrahedron at once: (J W J^T + alpha) dlambda = -(C + alpha
/// lambda) by Cholesky, C = (|F|, det F - rest), alpha = (1/(mu q V h^2), 1/(lambda V h^2)), q = 1 -
/// log/(|F|^2 + 1).
template <typename Real>
void project(State& s, const Constraint<Real>& c, std::uint32_t k)
{
    const std::uint32_t vertex[4] = {c.a, c.b, c.c, c.d};
    Eigen::Matrix3d edges;
    double masses = 0, size = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        const glm::dvec3 e = s.at(vertex[v]) - s.at(vertex[0]);
        masses += s.position[vertex[v]].w;
        size = std::max(size, glm::length(e) + glm::length(glm::dvec3(s.delta[vertex[v]])));
        if (v > 0)
            edges.col(static_cast<int>(v) - 1) << e.x, e.y, e.z;
    }
    const Eigen::Matrix3d b = inverse_rest(c), f = edges * b;
    const double square = f.squaredNorm(), norm = std::sqrt(square);
    const bool keep = s.lambda && !s.first_iteration;
    Eigen::Vector2d before(keep ? s.multiplier[4 * k] : 0, keep ? s.multiplier[4 * k + 1] : 0);
    if (s.lambda)
        for (std::size_t j = 0; j < 4; ++j)
            s.multiplier[4 * k + j] = j < 2  ? before[static_cast<int>(j)]
                                      : keep ? s.multiplier[4 * k + j]
                                             : 0;
    Eigen::Matrix3d cofactor;
    cofactor << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    const bool collapsed = square < 1e-6 || cofactor.squaredNorm() < 1e-13 * square * square;
    s.events[TAUT_EVENT_DEGENERATE] += s.report && masses > 0 && collapsed ? 1 : 0;
    if (!(square > 1e-12))
        return;
    Eigen::Matrix<double, 12, 2> j;
    j << gradient(f / norm, b), gradient(cofactor, b);
    Gradient w;
    for (int v = 0; v < 4; ++v)
        w.segment<3>(3 * v).setConstant(s.position[vertex[v]].w);
    const double stiff = static_cast<double>(c.volume) / (s.inverse_substep * s.inverse_substep);
    const double share = 1 - static_cast<double>(c.log_term) / (square + 1);
    const Eigen::Vector2d soft(1 / (static_cast<double>(c.mu) * share * stiff),
                               1 / (static_cast<double>(c.lambda) * stiff));
    const Eigen::Vector2d value(norm, f.determinant() - static_cast<double>(c.rest));
    const Eigen::Matrix2d system =
        j.transpose() * w.asDiagonal() * j + Eigen::Matrix2d(soft.asDiagonal());
    const Eigen::Vector2d change = system.ldlt().solve(-(value + soft.cwiseProduct(before)));
    // Roundings of F go into all that follows, and the system's condition multiplies them.
    const double stretched = 1 + b.norm() * size, condition = stretched * stretched * stretched;
    const double spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(system).eigenvalues().minCoeff();
    const double terms = (value.norm() + soft.cwiseProduct(before).norm() + 1) * condition / spread +
                         change.norm() * condition * system.norm() / spread;
    for (int v = 0; v < 4; ++v)
    {
        const Eigen::Vector3d by = j.block<3, 2>(3 * v, 0) * change * s.position[vertex[v]].w;
        s.push(vertex[v], {by.x(), by.y(), by.z()},
               s.position[vertex[v]].w * terms * j.norm() * (1 + b.norm()));
    }
    if (!s.lambda)
        return;
    for (int m = 0; m < 2; ++m)
    {
        s.multiplier[4 * k + static_cast<std::size_t>(m)] = before[m] + change[m];
        s.multiplier_scale[4 * k + static_cast<std::size_t>(m)] = before.norm() + terms;
    }
}

template <typename Real>
Constraint<Real> record(const std::array<std::uint32_t, 4>& v, const TetrahedronCorners& rest, double modulus,
                        bool log)
{
    Eigen::Matrix3d edges;
    for (std::size_t k = 1; k < 4; ++k)
        for (int axis = 0; axis < 3; ++axis)
            edges(axis, static_cast<int>(k) - 1) = rest[k][axis] - rest[0][axis];
    const Eigen::Matrix3d b = edges.inverse();
    const auto at = [&](int row, int column) { return static_cast<Real>(b(row, column)); };
    return {v[0], v[1], v[2], v[3], at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0),
            at(2, 1), at(2, 2), static_cast<Real>(triple(rest) / 6), static_cast<Real>(modulus),
            static_cast<Real>(1.5 * modulus), static_cast<Real>(1 + (log ? 0.75 : 1.0) / 1.5),
            static_cast<Real>(log ? 1 : 0)};
}

constexpr double kModuli[] = {1, 1e2, 1e4, 1e6};

template <typename Real>
void add(Input<Real>& in, Random& random, std::uint32_t count)
{
    add_tetrahedra(in, random, count, 4, [&](const auto& v, const TetrahedronCorners& rest) {
        return record<Real>(v, rest, kModuli[random.below(4)], random.below(2) == 1);
    });
}

/// Flat, inverted, collapsed and held ones, where the colour has room.
template <typename Real>
void plant(Input<Real>& in, std::uint32_t colour)
{
    const std::uint32_t k = in.colour_start[colour];
    if (in.colour_start[colour + 1] - k < 6)
        return;
    const TetrahedronCorners upright = {glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::uint32_t i = 0; i < 6; ++i)
    {
        Constraint<Real>& c = in.constraint[k + i];
        c = record<Real>({c.a, c.b, c.c, c.d}, upright, 1e3, i % 2 == 0);
    }
    TetrahedronCorners flat = upright, inverted = upright, line = upright;
    flat[3] = {0.5, 0.5, 0};
    inverted[3] = {0, 0, -1.5};
    line[2] = {2, 0, 0};
    line[3] = {3, 0, 0};
    place(in, k, flat, {1, 1, 1, 1});
    place(in, k + 1, inverted, {1, 2, 3, 4});
    place(in, k + 2, line, {1, 1, 1, 1}); // counted, and moved along itself
    place(in, k + 3, TetrahedronCorners{}, {1, 1, 1, 1}); // a point: counted, skipped
    place(in, k + 4, TetrahedronCorners{}, {0, 0, 0, 0}); // held besides: not counted
    place(in, k + 5, upright, {0, 0, 0, 1});
}

} // namespace

TEMPLATE_TEST_CASE("a neo-Hookean tetrahedron moves its corners by the two constraints solved together", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    mode.report = GENERATE(true, false);
    CAPTURE(count, mode.variant(), mode.first_iteration, mode.report);
    Random random(1400 + count);
    Input<Real> in;
    for (const std::uint32_t n : {5u, count, 5u})
        add(in, random, n);
    in.groups = {{1, 2}};
    plant(in, 1);
    check_colours<Params>(kernels::neo_hookean::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE(
    "the tail of a colouring gives what one neo_hookean dispatch per colour gives, bit for bit", "", float,
    double)
{
    using Real = TestType;
    Mode mode;
    mode.lambda = GENERATE(false, true);
    Random random(1450);
    Input<Real> in;
    for (const std::uint32_t count : {5u, 64u, 1u, 65u})
        add(in, random, count);
    in.groups = {{1, 3}, {3, 4}};
    plant(in, 1);
    check_tail_equals_dispatches<Params>(kernels::neo_hookean::info, in, mode, precision_of<Real>());
    mode.tail = true;
    check_colours<Params>(kernels::neo_hookean::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("a neo-Hookean tetrahedron at rest stays where it is, soft or stiff", "", float, double)
{
    using Real = TestType;
    const double modulus = GENERATE(1.0, 1e3, 1e5);
    const bool log = GENERATE(false, true);
    CAPTURE(modulus, log);
    Random random(1470);
    Input<Real> in;
    add_tetrahedra(in, random, 100, 4, [&](const auto& v, const TetrahedronCorners& rest) {
        return record<Real>(v, rest, modulus, log);
    });
    for (std::uint32_t k = 0; k < in.constraint.size(); ++k)
    {
        const Eigen::Matrix3d edges = inverse_rest(in.constraint[k]).inverse();
        TetrahedronCorners x{};
        for (std::size_t c = 1; c < 4; ++c)
            for (int axis = 0; axis < 3; ++axis)
                x[c][axis] = edges(axis, static_cast<int>(c) - 1);
        place(in, k, x, {1, 1, 1, 1});
    }
    in.groups = {{0, 1}};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto launches =
            colour_launches<Params>(kernels::neo_hookean::info, precision_of<Real>(), Mode(), in);
        const Buffers out = run(*device, launches, in.buffers());
        const auto moved = values_of<Real>(out.at("delta"));
        double most = 0;
        for (const Real d : moved)
            most = std::max(most, std::abs(static_cast<double>(d)));
        CHECK(most < (sizeof(Real) == 4 ? 1e-5 : 1e-13));
    }
}
