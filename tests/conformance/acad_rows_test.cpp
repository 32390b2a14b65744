#include "taut/kernels/acad_rows.hpp"

#include "conformance/tolerances.hpp"
#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr double kFar = 0.02; ///< beyond what a row aims at, over that: it is softened

/// A row as numbers, to be compared with what the kernel wrote.
struct Wanted
{
    double rest_length, stiffness, inverse;
    bool same = true; ///< a copy, to the last bit
};

template <typename Real>
Wanted wanted(const layout::Spring<Real>& r, const layout::Spring<Real>& own, bool pressed,
              const RowNet<Real>& net)
{
    const double rest = double(own.rest_length), above = double(r.rest_length);
    const double aim = pressed ? 2 * rest - above : above, rate = double(net.step.inverse_substep),
                 k = double(own.stiffness);
    const double weight = double(net.position[r.a].w) + double(net.position[r.b].w);
    const double length = glm::distance(wide3(net.position[r.a]), wide3(net.position[r.b]));
    const double over = (pressed ? aim / std::max(length, 1e-6 * aim) : length / aim) - 1;
    if (over <= kFar || weight == 0)
        return {aim, double(r.stiffness), double(own.damping)};
    const double share = std::min(std::sqrt(k * weight) / rate, 1.0);
    const double give = 0.5 * own.kind * share * weight * (over + 0.2);
    double soft = 1 / (k / (rate * rate * share) + 1 / give);
    if (r.stiffness > 0)
        soft = std::max(soft, rate * rate / double(r.stiffness));
    const double compliance = soft / (rate * rate);
    return {length - share * (length - aim) - k * (aim - rest) * compliance, 1 / compliance,
            1 / (weight + soft / (1 + double(r.damping) * rate * compliance)), false};
}

bool is_pressed(std::uint32_t spring) { return spring % 2 == 1; }

/// Pairs of records: near and far rows, none at the boundary between, where rounding would choose.
template <typename Real>
std::vector<layout::Spring<Real>> candidates(Random& random, RowNet<Real>& net)
{
    std::vector<layout::Spring<Real>> out;
    for (std::uint32_t s = 0; s < net.rows(); ++s)
    {
        layout::Spring<Real> row = net.row[s], own = row;
        const double length = glm::distance(wide3(net.position[row.a]), wide3(net.position[row.b]));
        constexpr double kOver[] = {-0.5, 0, 0.9 * kFar, 1.1 * kFar, 0.3, 2, 100};
        const double far = 1 + kOver[s % 7], size = std::max(length, 1e-3);
        const double rest = is_pressed(s) ? size * far / 0.95 : size / far / 1.05;
        own.rest_length = static_cast<Real>(rest);
        row.rest_length = static_cast<Real>(1.05 * rest);
        own.stiffness = static_cast<Real>(std::pow(10.0, random.uniform(-3, 6)));
        own.damping = random.uniform<Real>(1, 2);
        own.kind = 1 + random.below(14);
        out.push_back(row);
        out.push_back(own);
    }
    return out;
}

template <typename Real>
bool close(Real value, double expected, double size)
{
    return std::abs(double(value) - expected) <=
           tolerance_of("acad_rows") * double(std::numeric_limits<Real>::epsilon()) * size;
}

} // namespace

TEMPLATE_TEST_CASE("acad_rows sets the rows of a list side by side, softened where they are far off", "",
                   float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const double share = GENERATE(0.0, 0.4, 1.0);
    const std::uint32_t further = GENERATE(0u, 1u);
    CAPTURE(dealt.count, dealt.groups, share, further);
    Random random(130 + dealt.count);
    RowNet<Real> net = random_row_net<Real>(random, dealt.count);
    net.step.inverse_substep = Real(600);
    const auto pairs = candidates(random, net);
    const std::vector<Real> multiplier = random_reals<Real>(random, dealt.count);
    const auto rows = static_cast<std::uint32_t>(share * dealt.count);
    std::vector<std::uint32_t> list = {rows};
    for (const std::uint32_t s : random.shuffled(dealt.count))
        list.push_back(2 * s + (is_pressed(s) ? 1 : 0));
    const auto other = spring_record<Real>(9, 9, 9, 9, 9, 9);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row_list", bytes_of(list)},
            {"candidate", bytes_of(pairs)},
            {"multiplier", bytes_of(multiplier)},
            {"row", bytes_of(std::vector(dealt.count, other))},
            {"x", bytes_of(std::vector<Real>(dealt.count, Real(9)))},
            {"inverse", bytes_of(std::vector<Real>(dealt.count, Real(9)))},
            {"position", bytes_of(net.position)},
            {"step_values", bytes_of(std::vector{net.step})}};
    c.launches = {make_launch(kernels::acad_rows::info("", c.precision),
                              kernels::acad_rows::Params{dealt.count, dealt.chunk(), further},
                              dealt.dispatched())};
    look_on_every_device(c, [&](const Buffers& out) {
        const auto row = values_of<layout::Spring<Real>>(out.at("row"));
        const auto x = values_of<Real>(out.at("x")), inverse = values_of<Real>(out.at("inverse"));
        std::uint32_t wrong = 0; // said in a word: which of a thousand tells nobody much
        for (std::uint32_t r = 0; r < dealt.count; ++r)
        {
            if (r >= rows)
            {
                wrong += !(row[r].a == other.a && row[r].stiffness == other.stiffness && x[r] == 9 &&
                           inverse[r] == 9);
                continue;
            }
            const std::uint32_t s = list[r + 1] / 2;
            const auto &from = pairs[2 * s], &own = pairs[2 * s + 1];
            const Wanted w = wanted(from, own, is_pressed(s), net);
            const bool copied = row[r].a == from.a && row[r].b == from.b && row[r].damping == from.damping &&
                                row[r].kind == from.kind && x[r] == (further != 0 ? Real(0) : multiplier[s]);
            const double length = double(from.rest_length) * 101 + 3,
                         pull = double(own.stiffness) / w.stiffness;
            const bool whole = is_pressed(s) ? close(row[r].rest_length, w.rest_length, w.rest_length)
                                             : row[r].rest_length == from.rest_length;
            const bool right = w.same
                                   ? whole && row[r].stiffness == from.stiffness && inverse[r] == own.damping
                                   : close(row[r].rest_length, w.rest_length, length * (1 + pull)) &&
                                         close(row[r].stiffness, w.stiffness, w.stiffness) &&
                                         close(inverse[r], w.inverse, w.inverse);
            wrong += !(copied && right);
        }
        CHECK(wrong == 0);
    });
}
