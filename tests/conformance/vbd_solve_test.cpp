#include "taut/kernels/vbd_solve.hpp"

#include "support/block_parts.hpp"
#include "support/kernel_run.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// Every variant but those of tails.
std::vector<Kinds> all_kinds()
{
    std::vector<Kinds> out;
    for (const bool hinges : {false, true})
        for (const bool damped : {false, true})
            out.push_back({hinges, damped, Solids::none});
    out.push_back({true, false, Solids::volumes});
    out.push_back({true, true, Solids::volumes});
    out.push_back({true, true, Solids::elastic});
    return out;
}

/// Those, and what added elements bring to elastic ones.
std::vector<std::pair<Kinds, bool>> all_kinds_and_added()
{
    std::vector<std::pair<Kinds, bool>> out;
    for (const Kinds& kinds : all_kinds())
        out.emplace_back(kinds, false);
    out.emplace_back(all_kinds().back(), true);
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("vbd_solve takes Newton's step of each vertex' own energy", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const auto [kinds, added] = GENERATE(from_range(all_kinds_and_added()));
    const std::string variant = added ? "added" : kinds.variant(false);
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 1300 + count;
    CAPTURE(count, variant, report, seed);
    Random random(seed);
    const auto net = block_net<Real>(random, count, kinds.hinges, kinds.solids);
    const float relaxation = report != 0 ? 1.0f : 0.75f;
    Case c;
    c.precision = precision_of<Real>();
    c.in = buffers_of(net, kinds);
    const auto known = random_blocks(random, net.predicted);
    c.in["block"] = bytes_of(known);
    c.launches = {make_launch(kernels::vbd_solve::info(variant, c.precision),
                              kernels::vbd_solve::Params{0, count, report, relaxation}, count)};
    std::vector<glm::dvec3> step(net.delta.size(), glm::dvec3(0));
    std::vector<double> scale(net.delta.size(), 0.0);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const std::uint32_t v = net.row[4 * i];
        const Block<Real> block = block_of_row(net, kinds, i, added ? &known : nullptr);
        const glm::dmat3 inverse = glm::inverse(block.h);
        step[v] = double(relaxation) * (inverse * block.f);
        const double norm = std::sqrt(glm::dot(inverse[0], inverse[0]) + glm::dot(inverse[1], inverse[1]) +
                                      glm::dot(inverse[2], inverse[2]));
        scale[v] = norm * (block.f_scale + block.h_scale * glm::length(step[v])) +
                   glm::length(glm::dvec3(net.delta[v]));
        c.events[TAUT_EVENT_DEGENERATE] += report != 0 ? block.degenerate : 0;
    }
    Field& field = c.expected["delta"];
    for (std::uint32_t v = 0; v < net.delta.size(); ++v)
        for (int k = 0; k < 4; ++k)
            field.add(double(net.delta[v][k]) + (k < 3 ? step[v][k] : 0), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("several colours in one group give what a dispatch a colour gives, bit for bit", "", float,
                   double)
{
    using Real = TestType;
    const Kinds kinds = GENERATE(from_range(all_kinds()));
    CAPTURE(kinds.variant(true));
    Random random(1350);
    constexpr std::uint32_t rows = 300;
    auto net = block_net<Real>(random, rows, kinds.hinges, kinds.solids);
    // The same rows cut into colours, whose springs now join rows of different colours.
    const std::uint32_t ends[] = {64, 65, 130, 193, 300};
    std::uint32_t colour = 0;
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        while (i >= ends[colour])
            ++colour;
        net.row[4 * i + 3] = ends[colour];
        const std::uint32_t begin = colour == 0 ? 0 : ends[colour - 1];
        for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
        {
            const std::uint32_t other = random.below(rows);
            if ((other < begin || other >= ends[colour]) && i != 3)
                net.end[k].b = kBefore + other;
        }
    }
    const Precision precision = precision_of<Real>();
    const Buffers in = buffers_of(net, kinds);
    std::vector<Launch> each;
    for (std::uint32_t c = 0, begin = 0; c < 5; begin = ends[c++])
        each.push_back(make_launch(kernels::vbd_solve::info(kinds.variant(false), precision),
                                   kernels::vbd_solve::Params{begin, ends[c] - begin, 1, 1.0f},
                                   ends[c] - begin));
    const std::vector<Launch> grouped = {make_launch(kernels::vbd_solve::info(kinds.variant(true), precision),
                                                     kernels::vbd_solve::Params{0, rows, 1, 1.0f}, 1)};
    const Buffers serial = run(*test_device("cpu:serial"), each, in);
    CHECK(serial.at("delta") != in.at("delta"));
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision) || !bitwise_equal_expected(device->info()))
            continue;
        CAPTURE(selector);
        CHECK(differing_buffers(serial, run(*device, grouped, in)) == "");
        CHECK(differing_buffers(serial, run(*device, each, in)) == "");
    }
}

TEMPLATE_TEST_CASE("a step that is no number is not taken, and counted", "", float, double)
{
    using Real = TestType;
    Random random(1360);
    auto net = block_net<Real>(random, 9, false);

    const Real inf = std::numeric_limits<Real>::infinity();
    net.predicted[kBefore].x = inf;
    const Precision precision = precision_of<Real>();
    const std::vector<Launch> launches = {
        make_launch(kernels::vbd_solve::info("", precision), kernels::vbd_solve::Params{0, 9, 0, 1.0f}, 9)};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, launches, buffers_of(net, Kinds()));
        const auto delta = values_of<glm::vec<4, Real>>(out.at("delta"));
        CHECK(delta[kBefore] == net.delta[kBefore]);
        CHECK(delta[kBefore + 1] != net.delta[kBefore + 1]);
        CHECK(values_of<std::uint32_t>(out.at("events"))[TAUT_EVENT_NON_FINITE] == 1);
    }
}

TEMPLATE_TEST_CASE("no step raises the energy of a vertex' tetrahedra, however they lie", "", float, double)
{
    using Real = TestType;
    const Kinds kinds = {true, true, Solids::elastic};
    constexpr std::uint32_t rows = 2000;
    Random random(1370);
    auto net = block_net<Real>(random, rows, false, kinds.solids);
    for (std::size_t i = 0; i < rows; ++i) // tetrahedra alone; far from rest, and light enough to go far
    {
        net.row[4 * i + 1] = net.row[4 * i + 5] = 0;
        const std::uint32_t v = net.row[4 * i];
        net.delta[v] += random.vec4<Real>(std::pow(10.0, random.uniform(-2, 1)), 0);
        net.predicted[v].w *= static_cast<Real>(std::pow(10.0, random.uniform(-6, 0)));
    }
    const auto energy = [&](std::uint32_t i, double& size) {
        const std::uint32_t v = net.row[4 * i];
        const glm::dvec3 away = glm::dvec3(net.delta[v]) - glm::dvec3(net.predicted[v]);
        double sum = 0.5 * double(net.predicted[v].w) * glm::dot(away, away);
        size = sum;
        for (std::uint32_t k = net.first_tetrahedron[i]; k < net.first_tetrahedron[i + 1]; ++k)
        {
            const auto [value, terms] = tetrahedron_energy(net, net.tetrahedra[k]);
            sum += value;
            size += terms;
        }
        return sum;
    };
    std::vector<double> before(rows), size(rows);
    for (std::uint32_t i = 0; i < rows; ++i)
        before[i] = energy(i, size[i]);
    const Precision precision = precision_of<Real>();
    const std::vector<Launch> launches = {
        make_launch(kernels::vbd_solve::info(kinds.variant(false), precision),
                    kernels::vbd_solve::Params{0, rows, 0, 1.0f}, rows)};
    const Buffers out = run(*test_device("cpu:serial"), launches, buffers_of(net, kinds));
    net.delta = values_of<glm::vec<4, Real>>(out.at("delta"));
    std::uint32_t risen = 0, fallen = 0;
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        double unused = 0;
        const double after = energy(i, unused);
        risen += after > before[i] + 1e3 * double(std::numeric_limits<Real>::epsilon()) * size[i];
        fallen += after < 0.9 * before[i];
    }
    CHECK(risen == 0);
    CHECK(fallen > rows / 2);
}
