#include "taut/kernels/vbd_limit.hpp"

#include "support/vbd_carrier.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_limit takes the share of a way that makes no more energy than was lost", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    const bool contact = GENERATE(false, true);
    CAPTURE(count, words, contact);
    Random random(1480 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3), low = random.vec4s<Real>(n, 1e-8, 0, 1e-3);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (std::uint32_t k = 0; k < TAUT_VBD_SUMS; ++k)
            sums.push_back(k >= 10            ? Real(0.01 * (k + part.from)) // of the body
                           : k == 1           ? random.uniform<Real>(1, 3)
                           : k == 8 || k == 9 ? random.uniform<Real>(4, 9)
                                              : random.uniform<Real>(-1, 1));
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    sums.resize(TAUT_VBD_PARTS * parts.groups + TAUT_VBD_FALL + 2, Real(7));
    const std::uint32_t frame = contact ? static_cast<std::uint32_t>(sums.size()) : 0;
    const std::vector<Carrier> carriers = add_frames(sums, parts, random);
    // Of a body, by group: nothing, some of what is there or more, a debt, one of more than is there.
    constexpr double range[4][2] = {{0, 0}, {0, 9}, {-2, 0}, {-9, -5}};
    std::vector<Real> lost;
    std::uint32_t body = 0;
    for (const BodyParts::Part& part : parts.parts) // alike in all groups of a body
    {
        const bool first = part.from == lost.size();
        const auto& of = range[(count + body / 4) % 4]; // each for held, loose and carried ones
        lost.push_back(first ? static_cast<Real>((part.to - part.from) * random.uniform(of[0], of[1]))
                             : lost[part.from]);
        body += first ? 1 : 0;
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))}, {"low", bytes_of(low)},   {"sums", bytes_of(sums)},
            {"delta", bytes_of(delta)},           {"lost", bytes_of(lost)}, {"position", bytes_of(position)}};
    const kernels::vbd_limit::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words,
                                            frame};
    c.launches = {
        make_launch(kernels::vbd_limit::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    std::array<std::uint32_t, 3> untouched{}, shortened{}, stopped{}, indebted{}; // loose, held, carried
    for (const BodyParts::Part& part : parts.parts)
    {
        const Carrier& carrier = carriers[part.from];
        const bool carried = contact && carrier.carries;
        const std::size_t kind = carried ? 2 : part.held ? 1 : 0;
        std::array<double, 10> sum{}, size{};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::uint32_t k = 0; k < 10; ++k)
            {
                sum[k] += double(sums[TAUT_VBD_SUMS * g + k]);
                size[k] += std::abs(double(sums[TAUT_VBD_SUMS * g + k]));
            }
        const auto of_mass = [&](const std::array<double, 10>& s, std::size_t k) {
            return glm::dvec3(s[k], s[k + 1], s[k + 2]) / sum[1];
        };
        const glm::dvec3 mean = of_mass(sum, 2), came = of_mass(sum, 5);
        const glm::dvec3 mean_size = of_mass(size, 2), came_size = of_mass(size, 5);
        double had = 0.5 * sum[9], has = sum[0] + 0.5 * sum[8];
        double terms = size[0] + 0.5 * (sum[8] + sum[9]);
        if (kind == 0) // the motion of the mean is not for the sweeps to make
        {
            had -= 0.5 * sum[1] * glm::dot(came, came);
            has -= 0.5 * sum[1] * glm::dot(mean, mean);
            terms += 0.5 * sum[1] * (glm::dot(came_size, came_size) + glm::dot(mean_size, mean_size));
        }
        // What may be there at the end: what there was, and of what was lost before no more than that; or
        // what there was less a debt, if that is anything.
        const double spare = std::clamp(double(lost[part.from]), -had, had);
        const double most = std::max(had + spare, 0.0), share = has > most ? most / has : 1;
        terms += std::abs(spare);
        c.expected["lost"].add(std::min(had + spare - share * has, had), terms);
        ++(share == 0 ? stopped : share < 1 ? shortened : untouched)[kind];
        indebted[kind] += spare < 0 && most > 0 ? 1 : 0;
        if (share == 1)
            continue;
        const std::size_t at = TAUT_VBD_SUMS * part.from + 10;
        const glm::dvec3 origin(sums[at], sums[at + 1], sums[at + 2]), base(position[part.base + 3]);
        const double unsure = most > 0 ? terms / has : 0; // the share, by roundings of the energies
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const glm::dvec3 place(position[v]);
            glm::dvec3 still(low[v]);
            double near = glm::length(still);
            if (carried)
            {
                still += carrier.way_at(place - base);
                near += carrier.size(glm::length(place) + glm::length(base));
            }
            else if (!part.held)
            {
                still += mean + origin;
                near += glm::length(mean_size) + glm::length(origin);
            }
            scale[v] = near + (near + glm::length(want[v])) * (share + unsure);
            want[v] = still + (want[v] - still) * share;
        }
    }
    for (std::size_t kind = 0; count == 1000 && kind < (contact ? 3u : 2u); ++kind)
    {
        CAPTURE(kind);
        CHECK((untouched[kind] > 0 && shortened[kind] > 0 && stopped[kind] > 0 && indebted[kind] > 0));
    }
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}
