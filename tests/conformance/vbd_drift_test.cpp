#include "taut/kernels/vbd_drift.hpp"

#include "support/rigid_sums.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_drift sums what bodies that nothing holds lack of momentum, and their moments", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    const bool contact = GENERATE(false, true);
    CAPTURE(count, words, contact);
    Random random(1440 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3);
    const auto push = random.vec4s<Real>(contact ? n : 0, 1e-3, 0, 0);
    auto predicted = random.vec4s<Real>(n, 1e-2, 0, 0);
    for (auto& y : predicted)
        y.w = random.uniform<Real>(1, 1000);
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"predicted", bytes_of(predicted)},
            {"delta", bytes_of(delta)},
            {"sums", bytes_of(std::vector<Real>(TAUT_VBD_DRIFT * parts.groups + 3, Real(7)))},
            {"position", bytes_of(position)},
            {"push", bytes_of(push)}};
    const kernels::vbd_drift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {
        make_launch(kernels::vbd_drift::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    for (const BodyParts::Part& part : parts.parts)
    {
        const RigidSums sums = rigid_sums(parts, part, 3, position, predicted, delta, push);
        for (std::size_t k = 0; k < TAUT_VBD_DRIFT; ++k)
            field.add(sums.value[k], sums.size[k]);
    }
    for (int k = 0; k < 3; ++k)
        field.add(7, 0);
    check_on_every_device(c);
}
