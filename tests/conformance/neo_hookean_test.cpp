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

/// The first of the two rows: C, the share of Psi that it has, C times its gradient by F; the lambda of the
/// second.
struct Shape
{
    double square = 0, energy = 0;
    Eigen::Matrix3d by_f;
    double lambda = 0;
};

Eigen::Matrix3d cofactor_of(const Eigen::Matrix3d& f)
{
    Eigen::Matrix3d c;
    c << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    return c;
}

/// Psi = mu/2 (|F|^2 - 3 - log ln((|F|^2 + 1)/4)) - mu slope/2 (J - 1) + lambda/2 (J - 1)^2 without
/// lambda_H/2 (J - 1)^2, over mu/2. x - ln(1 + x) of x = (|F|^2 - 3)/4 is x^2 (3 + x) / (6 + 6 x + x^2); near
/// rest and where the gradient is small C is bounded by it.
Shape shape_of(const Eigen::Matrix3d& f, double mu, double lambda, double log)
{
    Shape out;
    const double slope = log > 0 ? 1.5 : 2, hard = lambda / mu, most = log > 0 ? 0.625 : 1;
    const double curve = std::min(hard, most), j = f.determinant() - 1, square = f.squaredNorm();
    const double x = (square - 3) / 4, bow = x * x * (3 + x) / (6 + 6 * x + x * x);
    const double rest = 2 * x - slope * j + curve * j * j + (log > 0 ? x : 2 * x);
    out.lambda = (hard - curve) * mu;
    out.by_f = (1 - log / (square + 1)) * f + (curve * j - slope / 2) * cofactor_of(f);
    const double steep = out.by_f.squaredNorm(), size = std::max(1.0, j * j);
    out.energy = rest + log * bow;
    out.square = steep < 1e-3 * size ? steep / slope : std::min(out.energy, steep);
    return out;
}

/// Of a step that moves the corners by `way`: F changes by no more than it is, or by sqrt 3.
double share_of(const Eigen::Matrix3d& f, const Gradient& way, const Eigen::Matrix3d& b)
{
    Eigen::Matrix3d edges;
    for (int v = 0; v < 3; ++v)
        edges.col(v) = way.segment<3>(3 * v + 3) - way.head<3>();
    return std::min(1.0, std::max(f.norm(), std::sqrt(3.0)) / (edges * b).norm());
}

/// XPBD by definition, both constraints of a tetrahedron at once: (J W J^T + alpha) dlambda = -(C + alpha
/// lambda), C = (shape_of, det F - 1), alpha = (1/(mu V h^2), 1/(lambda_H V h^2)); the step and the
/// multipliers times share_of.
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
    const Eigen::Matrix3d b = inverse_rest(c), f = edges * b, cofactor = cofactor_of(f);
    const double square = f.squaredNorm();
    const bool keep = s.lambda && !s.first_iteration;
    const Eigen::Vector2d before(keep ? s.multiplier[4 * k] : 0, keep ? s.multiplier[4 * k + 1] : 0);
    if (s.lambda)
        for (std::size_t j = 0; j < 4; ++j)
            s.multiplier[4 * k + j] = j < 2  ? before[static_cast<int>(j)]
                                      : keep ? s.multiplier[4 * k + j]
                                             : 0;
    const bool collapsed = square < 1e-6 || cofactor.squaredNorm() < 1e-13 * square * square;
    s.events[TAUT_EVENT_DEGENERATE] += s.report && masses > 0 && collapsed ? 1 : 0;
    const Shape shape = shape_of(f, static_cast<double>(c.mu), static_cast<double>(c.lambda),
                                static_cast<double>(c.log_term));
    const bool acts = shape.square > 1e-24; // not at rest, not in a point
    const double norm = acts ? std::sqrt(shape.square) : 0;
    Eigen::Matrix<double, 12, 2> j;
    j << (acts ? gradient(shape.by_f / norm, b) : Gradient::Zero().eval()), gradient(cofactor, b);
    Gradient w;
    for (int v = 0; v < 4; ++v)
        w.segment<3>(3 * v).setConstant(s.position[vertex[v]].w);
    // In terms of 1 / alpha, which may be 0: (J W J^T / alpha + 1) dlambda = -(C / alpha + lambda).
    const double stiff = static_cast<double>(c.volume) / (s.inverse_substep * s.inverse_substep);
    const Eigen::Vector2d grip(acts ? static_cast<double>(c.mu) * stiff : 0, shape.lambda * stiff);
    const Eigen::Vector2d value(norm, f.determinant() - 1);
    const Eigen::Matrix2d weight = j.transpose() * w.asDiagonal() * j;
    const Eigen::Matrix2d system = grip.asDiagonal() * weight + Eigen::Matrix2d::Identity();
    const Eigen::Vector2d pull = grip.cwiseProduct(value) + before;
    Eigen::Vector2d change = -system.partialPivLu().solve(pull);
    change[0] = acts ? change[0] : 0;
    change *= share_of(f, (w.asDiagonal() * j * change).eval(), b);
    // Roundings of F go into all that follows, those of C times its gradient are those of its two terms, and
    // the system's condition multiplies them.
    const double stretched = 1 + b.norm() * size, condition = stretched * stretched * stretched;
    const double blur = 1 + (acts ? (f.norm() + cofactor.norm()) / shape.by_f.norm() : 0);
    const double back = system.inverse().norm() * blur * condition;
    const double terms = back * (pull.norm() + grip.norm() + back * system.norm() * pull.norm());
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
                        double hard, bool log)
{
    Eigen::Matrix3d edges;
    for (std::size_t k = 1; k < 4; ++k)
        for (int axis = 0; axis < 3; ++axis)
            edges(axis, static_cast<int>(k) - 1) = rest[k][axis] - rest[0][axis];
    const Eigen::Matrix3d b = edges.inverse();
    const auto at = [&](int row, int column) { return static_cast<Real>(b(row, column)); };
    return {v[0], v[1], v[2], v[3], at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0),
            at(2, 1), at(2, 2), static_cast<Real>(triple(rest) / 6), static_cast<Real>(modulus),
            static_cast<Real>(hard * modulus), static_cast<Real>(1 + (log ? 0.75 : 1.0) / hard),
            static_cast<Real>(log ? 1 : 0)};
}

constexpr double kModuli[] = {1, 1e2, 1e4, 1e6};
/// lambda over mu: Poisson's ratios of 0 without and with the logarithm, of less, and of more.
constexpr double kHard[] = {1, 0.625, 0.4, 1.5, 60};

template <typename Real>
void add(Input<Real>& in, Random& random, std::uint32_t count)
{
    add_tetrahedra(in, random, count, 4, [&](const auto& v, const TetrahedronCorners& rest) {
        return record<Real>(v, rest, kModuli[random.below(4)], kHard[random.below(5)], random.below(2) == 1);
    });
}

/// Flat, inverted, collapsed, held and squashed ones, where the colour has room; the steps of the last two
/// are shortened (share_of).
template <typename Real>
void plant(Input<Real>& in, std::uint32_t colour)
{
    const std::uint32_t k = in.colour_start[colour];
    constexpr std::uint32_t kPlanted = 8;
    if (in.colour_start[colour + 1] - k < kPlanted)
        return;
    const TetrahedronCorners upright = {glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::uint32_t i = 0; i < kPlanted; ++i)
    {
        Constraint<Real>& c = in.constraint[k + i];
        c = record<Real>({c.a, c.b, c.c, c.d}, upright, i < 6 ? 1e3 : 1e6, 1.5, i % 2 == 0);
    }
    TetrahedronCorners flat = upright, inverted = upright, line = upright, squashed = upright;
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
    squashed[2] = {0, 0.1, 0};
    squashed[3] = {0, 0, 0.1};
    place(in, k + 6, squashed, {1, 1, 1, 1});
    squashed[3] = {0, 0, -0.1};
    place(in, k + 7, squashed, {1, 1, 1, 1});
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
        return record<Real>(v, rest, modulus, 1.5, log);
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

TEST_CASE("the two constraints of a neo-Hookean tetrahedron are its energy, the first for every F")
{
    Random random(1480);
    const double log = GENERATE(0.0, 1.0), size = GENERATE(1e-3, 1.0, 30.0);
    const double hard = GENERATE(1.0, 1.5, 600.0) * (log > 0 ? 0.625 : 1);
    CAPTURE(log, size, hard);
    const double rest = 1 + (log > 0 ? 0.75 : 1) / hard;
    for (int k = 0; k < 2000; ++k)
    {
        Eigen::Matrix3d f = size < 1 ? Eigen::Matrix3d::Identity().eval() : Eigen::Matrix3d::Zero().eval();
        for (int i = 0; i < 9; ++i)
            f(i) += size * random.uniform(-1, 1);
        const double square = f.squaredNorm(), j = f.determinant(), flow = std::log((square + 1) / 4);
        const double far = j - rest, at_rest = 1 - rest;
        const double energy = square - 3 - log * flow + hard * (far * far - at_rest * at_rest);
        const Shape shape = shape_of(f, 1, hard, log);
        const double x = (square - 3) / 4, bow = x * x * (3 + x) / (6 + 6 * x + x * x);
        const double exact = shape.energy + log * (x - flow - bow);
        INFO(f);
        const double both = exact + shape.lambda * (j - 1) * (j - 1);
        CHECK(std::abs(both - energy) <= 1e-12 * (std::abs(energy) + square + hard));
        CHECK(exact > 0);
        CHECK(shape.energy > 0);
        CHECK(std::abs(shape.energy / exact - 1) < 0.05);
    }
}
