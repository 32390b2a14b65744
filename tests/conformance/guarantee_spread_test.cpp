#include "taut/kernels/guarantee_spread.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("guarantee_spread asks whoever would leave the plane that an asked neighbour keeps to", "",
                   float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool last = GENERATE(false, true);
    CAPTURE(count, last);
    Random random(3600 + count);
    const auto net = contact_net<Real>(60, random, 0.01);
    const auto vertices = static_cast<std::uint32_t>(net.position.size());
    const auto pairs = some_pairs(net, count + 2, random);
    const auto low = random.vec4s<Real>(vertices, 1e-8, 0, 1);
    std::vector<std::uint32_t> asked(vertices, 0), next(vertices + 1, 0);
    for (std::uint32_t v = 0; v < vertices; ++v)
        asked[v] = random.chance(0.3) ? 1 + random.below(3) : 0;
    std::vector<Vec> row;
    std::uint32_t wrongs = 0, asks = 0;
    for (std::uint32_t k = 0; k < count + 2; ++k)
    {
        const bool edges = pairs[k].kind == TAUT_CONTACT_EDGES;
        const glm::dvec3 n = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
        row.emplace_back(glm::vec<3, Real>(n), Real(edges ? -1e-7 : 1e-7));
        Vec room(0);
        const std::uint32_t ids[] = {pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d};
        const bool any = asked[ids[0]] + asked[ids[1]] + asked[ids[2]] + asked[ids[3]] > 0;
        bool wrong_pair = false;
        for (int c = 0; c < 4; ++c)
        {
            const std::uint32_t v = ids[c];
            const double side = c == 0 || (c == 1 && edges) ? 1 : -1;
            const double taken =
                -side * glm::dot(glm::dvec3(glm::vec<3, Real>(n)), net.d(v) - glm::dvec3(low[v]));
            // Clearly more room than is taken, or clearly less.
            const bool wrong = random.chance(0.2);
            room[c] = static_cast<Real>(taken + (wrong ? -1e-3 : 1e-3) * random.uniform(0.1, 1));
            if (k >= count || !any)
                continue;
            const bool new_one = wrong && asked[v] == 0;
            next[v] += asked[v] > 0 || new_one ? 1 : 0;
            wrong_pair = wrong_pair || new_one;
        }
        wrongs += wrong_pair ? 1 : 0;
        asks += k < count && any ? 1 : 0;
        row.push_back(room);
    }
    next[vertices] = last ? wrongs : 0;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pairs)},
            {"low", bytes_of(low)},
            {"delta", bytes_of(net.delta)},
            {"control", bytes_of(control_of(count))},
            {"row", bytes_of(row)},
            {"asked", bytes_of(asked)},
            {"next", bytes_of(std::vector<std::uint32_t>(vertices + 1, 0))}};
    c.launches = {make_launch(kernels::guarantee_spread::info(last ? "last" : "", c.precision),
                              kernels::guarantee_spread::Params{count + 2, vertices}, count + 2)};
    look_on_every_device(c, [&](const Buffers& out) { CHECK(words_of(out, "next") == next); });
    CHECK((count < 60 || (wrongs > 0 && asks > wrongs)));
}
