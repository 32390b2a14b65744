#include "taut/kernels/stencil7.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct Box
{
    std::uint32_t nx, ny, nz, groups;
    std::uint32_t count() const { return nx * ny * nz; }
    /// As make_grid of src/linear/grid.hpp.
    std::uint32_t chunk() const { return ((count() + groups - 1) / groups + 127) / 128 * 128; }
};

std::ostream& operator<<(std::ostream& out, const Box& box)
{
    return out << box.nx << " x " << box.ny << " x " << box.nz << " in " << box.groups << " groups";
}

const Box kBoxes[] = {{1, 1, 1, 1},   {63, 1, 1, 1},  {1, 64, 1, 1},    {1, 1, 65, 1},  {2, 1, 1, 1},
                      {127, 1, 2, 2}, {16, 8, 1, 1},  {129, 1, 1, 2},   {10, 10, 10, 8}, {3, 5, 7, 1},
                      {1, 9, 30, 3},  {300, 3, 2, 4}, {128, 4, 4, 16}, {7, 11, 13, 3}};

/// A x in `Wide`, and the size of the terms of each row.
template <typename Wide>
struct Product
{
    std::vector<Wide> value, size;
};

template <typename Wide>
Product<Wide> multiply(const Box& box, double scale, const std::vector<Wide>& x)
{
    Product<Wide> out;
    const auto at = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        const bool inside = i >= 0 && j >= 0 && k >= 0 && i < box.nx && j < box.ny && k < box.nz;
        return inside ? x[static_cast<std::size_t>((k * box.ny + j) * box.nx + i)] : Wide(0);
    };
    for (std::int64_t k = 0; k < box.nz; ++k)
        for (std::int64_t j = 0; j < box.ny; ++j)
            for (std::int64_t i = 0; i < box.nx; ++i)
            {
                Wide value = 6 * at(i, j, k), size = std::abs(value);
                for (const Wide beside : {at(i - 1, j, k), at(i + 1, j, k), at(i, j - 1, k), at(i, j + 1, k),
                                          at(i, j, k - 1), at(i, j, k + 1)})
                {
                    value -= beside;
                    size += std::abs(beside);
                }
                out.value.push_back(scale * value);
                out.size.push_back(scale * size);
            }
    return out;
}

/// partials[g] = sum of a_i b_i over the rows of group g.
Field partial_sums(const Box& box, const std::vector<double>& terms, const std::vector<double>& sizes)
{
    Field field;
    for (std::uint32_t g = 0; g < box.groups; ++g)
    {
        double sum = 0, size = 0;
        const std::size_t begin = std::size_t{g} * box.chunk();
        for (std::size_t i = begin; i < std::min(terms.size(), begin + box.chunk()); ++i)
        {
            sum += terms[i];
            size += sizes[i];
        }
        field.add(sum, size);
    }
    return field;
}

template <typename Real>
Bytes garbage(std::size_t n)
{
    return bytes_of(std::vector<Real>(n, Real(-77)));
}

template <typename Real>
Launch launch_of(std::string_view variant, const Box& box, float scale)
{
    // One group more than needed: on some devices counts are rounded up.
    return make_launch(kernels::stencil7::info(variant, precision_of<Real>()),
                       kernels::stencil7::Params{box.nx, box.ny, box.nz, box.chunk(), box.groups, scale},
                       box.groups + 1);
}

template <typename Real>
std::vector<Real> random_vector(Random& random, std::size_t n)
{
    std::vector<Real> out;
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(random.chance(0.05) ? Real(0) : random.uniform<Real>(-10, 10));
    return out;
}

template <typename Real>
std::vector<double> wide(const std::vector<Real>& values)
{
    return {values.begin(), values.end()};
}

} // namespace

TEMPLATE_TEST_CASE("stencil7 is the 7-point Laplacian with zero values around", "", float, double)
{
    using Real = TestType;
    const Box box = GENERATE(from_range(std::begin(kBoxes), std::end(kBoxes)));
    const std::string variant = GENERATE("", "dot", "curvature", "residual");
    const float scale = variant == "" ? 1.f : 0.375f;
    const bool plant = variant == "dot" && box.count() > 100;
    CAPTURE(box, variant);
    Random random(700 + box.count());
    std::vector<Real> x = random_vector<Real>(random, box.count());
    const std::vector<Real> b = random_vector<Real>(random, box.count());
    if (plant)
        x[box.count() / 2] = std::numeric_limits<Real>::quiet_NaN(); // spoils its neighbours and no other row

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"x", bytes_of(x)}, {"y", garbage<Real>(box.count())}, {"b", bytes_of(b)},
            {"partials", garbage<Real>(box.groups)}};
    c.launches = {launch_of<Real>(variant, box, scale)};
    const Product<double> product = multiply<double>(box, scale, wide(x));
    std::vector<double> terms, sizes;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        terms.push_back(static_cast<double>(x[i]) * product.value[i]);
        sizes.push_back(std::abs(static_cast<double>(x[i])) * product.size[i]);
        const double right = static_cast<double>(b[i]);
        if (variant == "residual")
            c.expected["y"].add(right - product.value[i], std::abs(right) + product.size[i]);
        else if (variant != "curvature")
            c.expected["y"].add(product.value[i], product.size[i]);
    }
    if (variant == "dot" || variant == "curvature")
        c.expected["partials"] = partial_sums(box, terms, sizes);
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("stencil7 forms the residual of pairs in twice the digits", "", float, double)
{
    using Real = TestType;
    const Box box = GENERATE(from_range(std::begin(kBoxes), std::end(kBoxes)));
    const float scale = 0.75f;
    CAPTURE(box);
    Random random(800 + box.count());
    const auto split = [](std::vector<Real>& pairs, long double value) {
        const Real high = static_cast<Real>(value);
        pairs.push_back(high);
        pairs.push_back(static_cast<Real>(value - static_cast<long double>(high)));
    };
    std::vector<Real> x, b;
    std::vector<long double> exact, right;
    for (std::uint32_t i = 0; i < box.count(); ++i)
    {
        split(x, random.uniform(-10, 10) * (1 + 0x1p-30L * random.uniform(-1, 1)));
        exact.push_back(static_cast<long double>(x[2 * i]) + static_cast<long double>(x[2 * i + 1]));
    }
    const Product<long double> product = multiply<long double>(box, static_cast<double>(scale), exact);
    for (std::uint32_t i = 0; i < box.count(); ++i) // what is left is far below what one real could tell
    {
        split(b, product.value[i] + (sizeof(Real) == 4 ? 0x1p-20L : 0x1p-45L) * random.uniform(-1, 1));
        right.push_back(static_cast<long double>(b[2 * i]) + static_cast<long double>(b[2 * i + 1]));
    }

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"x", bytes_of(x)}, {"y", garbage<Real>(box.count())}, {"b", bytes_of(b)}};
    c.launches = {launch_of<Real>("residual_pairs", box, scale)};
    const double beyond = sizeof(Real) == 4 ? 0x1p-20 : 0x1p-8; // the reference itself has 64 bits
    for (std::uint32_t i = 0; i < box.count(); ++i)
    {
        const double want = static_cast<double>(right[i] - product.value[i]);
        c.expected["y"].add(want, std::abs(want) + beyond * static_cast<double>(product.size[i]));
    }
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("stencil7 steps as cg_step does, with the product formed again", "", float, double)
{
    using Real = TestType;
    const Box box = GENERATE(from_range(std::begin(kBoxes), std::end(kBoxes)));
    CAPTURE(box);
    Random random(900 + box.count());
    const std::vector<Real> p = random_vector<Real>(random, box.count());
    const std::vector<Real> r = random_vector<Real>(random, box.count());
    layout::CgState<Real> state{};
    state.epsilon = std::numeric_limits<Real>::epsilon() / 2;
    state.rz = 3;
    state.pmp = 3;
    state.iteration = 7;

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"x", bytes_of(p)}, {"residual", bytes_of(r)},
            {"curvatures", bytes_of(std::vector<Real>(box.groups, Real(12) / static_cast<Real>(box.groups)))},
            {"partials", garbage<Real>(2 * box.groups)}, {"before", bytes_of(std::vector{state})},
            {"after", bytes_of(std::vector<layout::CgState<Real>>(1))}};
    c.launches = {launch_of<Real>("step", box, 1)};
    c.slack = 2; // squares of what was rounded
    const Product<double> product = multiply<double>(box, 1, wide(p));
    const double step = 0.25; // rz over the curvature, up to a rounding where groups do not divide 12
    std::vector<double> terms, sizes;
    for (std::size_t i = 0; i < p.size(); ++i)
    {
        const double old = static_cast<double>(r[i]);
        const double now = old - step * product.value[i];
        const double size = std::abs(old) + step * product.size[i];
        c.expected["residual"].add(now, size);
        terms.push_back(now * now);
        sizes.push_back(size * size);
    }
    const Field sums = partial_sums(box, terms, sizes);
    c.expected["partials"] = sums;
    for (std::size_t g = 0; g < box.groups; ++g) // z = r: both halves alike
        c.expected["partials"].add(sums.value[g], sums.scale[g]);
    check_on_every_device(c);

    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, c.precision))
            continue;
        const Buffers out = run(*device, c.launches, c.in);
        const auto after = values_of<layout::CgState<Real>>(out.at("after")).front();
        INFO(selector);
        CHECK(std::abs(static_cast<double>(after.step) - step) <= 4 * static_cast<double>(state.epsilon));
        CHECK(after.iteration == 7);
        CHECK(after.status == TAUT_CG_RUNNING);
    }
}

TEST_CASE("stencil7 takes no step along a direction without curvature")
{
    layout::CgState<float> state{};
    state.epsilon = 0x1p-24f;
    state.rz = state.pmp = state.steepest = 1;
    const Box box{5, 4, 3, 1};
    const std::vector<float> r(box.count(), 2.f);
    Case c;
    c.in = {{"x", bytes_of(std::vector<float>(box.count(), 1.f))}, {"residual", bytes_of(r)},
            {"curvatures", bytes_of(std::vector<float>{0})}, {"partials", garbage<float>(2)},
            {"before", bytes_of(std::vector{state})}, {"after", bytes_of(std::vector{state})}};
    c.launches = {launch_of<float>("step", box, 1)};
    for (const float value : r)
        c.expected["residual"].add(static_cast<double>(value), 0);
    c.expected["partials"].add(4.0 * box.count(), 0);
    c.expected["partials"].add(4.0 * box.count(), 0);
    check_on_every_device(c);
}
