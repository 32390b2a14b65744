#include "taut/kernels/vbd_drift.hpp"

#include "support/vbd_feet.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE(
    "vbd_drift sums what bodies that nothing holds lack of momentum, their moments, and their feet", "",
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
    const std::uint32_t surfaces = n, frame = TAUT_VBD_PARTS * parts.groups + 3;
    const auto contacts = random_surfaces<Real>(random, surfaces, predicted);
    std::vector<Real> sums(frame, Real(7));
    const auto carriers = add_frames(sums, parts, random);
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))}, {"predicted", bytes_of(predicted)},
            {"delta", bytes_of(delta)},           {"sums", bytes_of(sums)},
            {"position", bytes_of(position)},     {"push", bytes_of(push)},
            {"contacts", bytes_of(contacts)}};
    const kernels::vbd_drift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words,
                                            surfaces, frame};
    c.launches = {
        make_launch(kernels::vbd_drift::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    for (std::size_t g = 0; g < parts.groups; ++g)
    {
        const RigidSums own = rigid_sums(parts, parts.parts[g], 3, position, predicted, delta);
        for (std::size_t k = 0; k < TAUT_VBD_DRIFT; ++k)
            field.add(own.value[k], own.size[k]);
        FeetSums feet;
        feet.value.fill(7);
        if (contact)
            feet = feet_sums(parts, g, 3, position, predicted, delta, push, contacts, surfaces, carriers);
        for (std::size_t k = 0; k < feet.value.size(); ++k)
            field.add(feet.value[k], feet.size[k]);
    }
    for (std::size_t k = field.value.size(); k < sums.size(); ++k)
        field.add(double(sums[k]), 0);
    check_on_every_device(c);
}
