#include "taut/kernels/plate_rest.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

#include "taut/kernels/shared/plate_rule.h"

#include <cmath>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kRule = TAUT_PLATE_RULE;

template <typename Real>
void check_rest_angles(std::uint32_t count)
{
    Random random(4200 + count);
    std::vector<std::uint32_t> record, neighbour;
    std::vector<layout::BendingConstraint<Real>> hinge;
    std::vector<Real> rule, turn;
    for (std::uint32_t k = 0; k < 2 * count; ++k)
        hinge.push_back({k, k + 1, k + 2, k + 3, random.uniform<Real>(-3, 3), Real(2)});
    for (const std::uint32_t k : random.shuffled(count))
        record.push_back(2 * k);
    for (std::uint32_t k = 0; k < 4 * count; ++k)
        neighbour.push_back(random.below(2 * count));
    for (std::uint32_t k = 0; k < kRule * count; ++k)
        rule.push_back(random.uniform<Real>(-1, 1));
    for (std::uint32_t k = 0; k < 2 * count; ++k)
        turn.push_back(random.uniform<Real>(-3, 3));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"record", bytes_of(record)}, {"neighbour", bytes_of(neighbour)},
            {"rule", bytes_of(rule)},     {"turn", bytes_of(turn)},
            {"hinge", bytes_of(hinge)},   {"pull", bytes_of(std::vector<Real>(2 * count, Real(7)))}};
    c.launches = {
        make_launch(kernels::plate_rest::info("", c.precision), kernels::plate_rest::Params{count}, count)};
    std::vector<double> angle(hinge.size()), angle_scale(hinge.size(), 0);
    for (std::size_t k = 0; k < hinge.size(); ++k)
        angle[k] = hinge[k].rest_angle;
    Field& pull = c.expected["pull"];
    for (std::uint32_t i = 0; i < count; ++i)
    {
        angle[record[i]] = rule[kRule * i];
        angle_scale[record[i]] = std::abs(rule[kRule * i]);
        for (std::uint32_t side = 0; side < 2; ++side)
        {
            const std::uint32_t own[3] = {2 * i + side, neighbour[4 * i + 2 * side],
                                          neighbour[4 * i + 2 * side + 1]};
            double sum = 0, size = 0;
            for (std::uint32_t j = 0; j < 3; ++j)
            {
                const double term = double(rule[kRule * i + 2 + 3 * side + j]) * double(turn[own[j]]);
                sum += term;
                size += std::abs(term);
            }
            pull.add(sum, size);
            angle[record[i]] += sum;
            angle_scale[record[i]] += size;
        }
    }
    std::size_t looked = 0;
    look_on_every_device(c, [&](const Buffers& out) {
        const auto after = values_of<layout::BendingConstraint<Real>>(out.at("hinge"));
        Field field{angle, angle_scale};
        std::vector<double> have;
        for (std::size_t k = 0; k < after.size(); ++k)
        {
            have.push_back(after[k].rest_angle);
            CHECK((after[k].edge0 == hinge[k].edge0 && after[k].compliance == hinge[k].compliance));
        }
        CHECK(first_difference(field, have, 8 * (sizeof(Real) == 8 ? 0x1p-52 : 0x1p-23)) == "");
        ++looked;
    });
    CHECK(looked > 0);
}

} // namespace

TEMPLATE_TEST_CASE("plate_rest moves rest angles to where the sides of hinges would go", "[plate]", float,
                   double)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    check_rest_angles<TestType>(count);
}
