#include "taut/kernels/guarantee_filter.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct HalfSpace
{
    glm::dvec3 normal{0};
    double room = 0;
};

/// Half spaces s n . d >= -room of vertices, as guarantee_plane leaves them.
template <typename Real>
struct Asked
{
    using Vec = glm::vec<4, Real>;
    std::vector<std::uint32_t> start = {0}, corner;
    std::vector<Vec> row; ///< two a pair
    std::vector<Vec> low, anchor, delta;
    std::vector<std::uint32_t> asked;

    Asked(std::uint32_t count, Random& random)
    {
        const std::uint32_t pairs = count + 5;
        for (std::uint32_t k = 0; k < pairs; ++k)
        {
            const glm::dvec3 n = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
            row.emplace_back(glm::vec<3, Real>(n), static_cast<Real>(random.chance(0.5) ? 1e-6 : -1e-6));
            Vec room = random.vec4<Real>(0, Real(0));
            for (int c = 0; c < 4; ++c)
                room[c] = static_cast<Real>(some_room(random));
            row.push_back(room);
        }
        for (std::uint32_t v = 0; v < count + 2; ++v)
        {
            const std::uint32_t size = v == 0   ? TAUT_CONTACT_CROWD + 1
                                       : v == 1 ? TAUT_CONTACT_CROWD
                                                : random.below(6);
            for (std::uint32_t k = 0; v < count && k < size; ++k)
                corner.push_back(random.below(4 * pairs));
            if (v < count)
                start.push_back(static_cast<std::uint32_t>(corner.size()));
            low.push_back(random.vec4<Real>(1e-8, Real(0)));
            delta.push_back(random.vec4<Real>(0.01, Real(0.25)) + low.back());
            const Real bound = random.uniform<Real>(0.004, 0.03);
            const double dice = random.uniform(0, 1);
            anchor.push_back(random.vec4<Real>(0.002, dice < 0.1   ? Real(-1)
                                                      : dice < 0.2 ? -2 - bound
                                                                   : bound));
            anchor.push_back(random.vec4<Real>(0.01, Real(0))); // the forecast
            asked.push_back(random.chance(0.7) ? 1 + random.below(5) : 0);
        }
        anchor[0].w = Real(-1); // it has too many corners
        asked.back() = 0;
        asked[count] = 0; // not all are asked
    }

    static double some_room(Random& random)
    {
        const double dice = random.uniform(0, 1);
        return dice < 0.02 ? -1e30 : dice < 0.06 ? -0.5e-6 : dice < 0.1 ? -0.003 : random.uniform(0, 0.01);
    }

    std::vector<HalfSpace> of(std::uint32_t v) const
    {
        std::vector<HalfSpace> out;
        for (std::uint32_t k = start[v]; k < start[v + 1]; ++k)
        {
            const std::uint32_t p = corner[k] / 4, c = corner[k] % 4;
            const double side = c == 0 || (c == 1 && row[2 * p].w < 0) ? 1 : -1;
            out.push_back(
                {side * glm::dvec3(row[2 * p]), static_cast<double>(row[2 * p + 1][static_cast<int>(c)])});
        }
        return out;
    }
};

template <typename Real>
Case case_of(const Asked<Real>& in, std::uint32_t count)
{
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(in.start)},
            {"corner", bytes_of(in.corner)},
            {"row", bytes_of(in.row)},
            {"low", bytes_of(in.low)},
            {"asked", bytes_of(in.asked)},
            {"anchor", bytes_of(in.anchor)},
            {"delta", bytes_of(in.delta)},
            {"lost", bytes_of(std::vector<std::uint32_t>(TAUT_CONTACT_GUARDED_LOST_WORDS, 0))}};
    c.launches = {make_launch(kernels::guarantee_filter::info("", c.precision),
                              kernels::guarantee_filter::Params{count}, count)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("guarantee_filter leaves every way within its planes and its bound, or none", "", float,
                   double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(3u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(3300 + count);
    const Asked<Real> in(count, random);
    look_on_every_device(case_of(in, count), [&](const Buffers& out) {
        const auto delta = values_of<Vec>(out.at("delta")), anchor = values_of<Vec>(out.at("anchor"));
        std::uint32_t cut = 0, held = 0, moved = 0, wrong = 0, longer = 0, needless = 0, lagging = 0,
                      strayed = 0, doubtful = 0;
        for (std::uint32_t v = 0; v < count; ++v)
        {
            const glm::dvec3 whole = glm::dvec3(in.delta[v]) - glm::dvec3(in.low[v]);
            const glm::dvec3 way = glm::dvec3(delta[v]) - glm::dvec3(in.low[v]);
            const glm::dvec3 from(in.anchor[2 * v]), line(in.anchor[2 * v + 1]);
            const auto beyond = [&](const glm::dvec3& end) {
                return glm::length(end -
                                   line * glm::clamp(glm::dot(end, line) / glm::dot(line, line), 0.0, 1.0));
            };
            CHECK(delta[v].w == in.delta[v].w);
            lagging += glm::length(glm::dvec3(anchor[2 * v]) - (from + way)) > 1e-8 ? 1 : 0;
            const double bound = static_cast<double>(in.anchor[2 * v].w);
            const double half = 0.5 * (bound < -1.5 ? -2 - bound : bound), used = beyond(from + way);
            strayed += bound != -1 && used > half ? 1 : 0;
            doubtful += std::abs(used - half) < 1e-7 ? 1 : 0;
            const bool is_asked = in.asked[v] > 0 || bound == -1;
            const double past = beyond(from + whole) - bound;
            if (bound < -1.5 || (!is_asked && past < -1e-7))
            {
                CHECK(delta[v] == in.delta[v]);
                continue;
            }
            if (!is_asked && past < 1e-7)
                continue; // which of the two rounding decides
            const bool stands = glm::vec<3, Real>(delta[v]) == glm::vec<3, Real>(in.low[v]);
            bool free = bound >= 0 && beyond(from + whole) < 0.999 * bound;
            bool hold = bound < 0, pushed = false;
            for (const auto& [n, room] : bound < 0 ? std::vector<HalfSpace>() : in.of(v))
            {
                free = free && glm::dot(n, whole) > (room < 0 ? -room : -0.9 * room) + 1e-9;
                hold = hold || room < -1e29;
                pushed = pushed || (room < -1e-6 && room > -1e29);
                wrong += !stands && glm::dot(n, way) < -room - 0.2e-6 ? 1 : 0;
            }
            wrong += !stands && !pushed && beyond(from + way) > bound * 1.001 ? 1 : 0;
            wrong += hold && !stands ? 1 : 0;
            longer += !pushed && glm::length(way) > glm::length(whole) * 1.001 ? 1 : 0;
            needless += free && delta[v] != in.delta[v] ? 1 : 0;
            cut += delta[v] != in.delta[v] ? 1 : 0;
            moved += !stands && delta[v] != in.delta[v] ? 1 : 0;
            held += hold ? 1 : 0;
        }
        CHECK(wrong == 0);
        CHECK(longer == 0);
        CHECK(needless == 0);
        CHECK(lagging == 0);
        CHECK((count < 60 || 4 * moved > cut)); // much of what is cut goes on along its planes
        const auto lost = words_of(out, "lost");
        CHECK(lost[TAUT_CONTACT_FILTERED] == cut);
        CHECK(lost[TAUT_CONTACT_HELD] == held);
        CHECK(lost[TAUT_CONTACT_STRAYED] + doubtful >= strayed);
        CHECK(lost[TAUT_CONTACT_STRAYED] <= strayed + doubtful);
        CHECK((count < 1000 || lost[TAUT_CONTACT_PINCHED] > 0));
        CHECK(delta[count] == in.delta[count]);
    });
}

TEST_CASE("guarantee_filter asks everybody where the last round says so")
{
    Random random(3400);
    const std::uint32_t count = 200;
    Asked<float> in(count, random);
    in.asked.assign(count + 2, 0);
    for (std::size_t k = 0; k < in.anchor.size(); k += 2)
        in.anchor[k].w = 1; // none leaves its bound
    for (const bool all : {false, true})
    {
        in.asked[count] = all ? 3 : 0;
        look_on_every_device(case_of(in, count), [&](const Buffers& out) {
            const std::uint32_t filtered = words_of(out, "lost")[TAUT_CONTACT_FILTERED];
            CHECK((all ? filtered > count / 4 : filtered == 0));
        });
    }
}

TEST_CASE("guarantee_filter holds a vertex to its bound that no pair asks")
{
    Random random(3500);
    const std::uint32_t count = 100;
    Asked<float> in(count, random);
    in.asked.assign(count + 2, 0);
    in.start.assign(count + 1, 0);
    for (std::uint32_t v = 0; v < count; ++v)
    {
        in.anchor[2 * v] = glm::vec4(0, 0, 0, 0.004f);
        in.anchor[2 * v + 1] = glm::vec4(0);
        in.delta[v] = in.low[v] + glm::vec4(v % 2 == 0 ? 0.003f : 0.005f, 0, 0, 0);
    }
    look_on_every_device(case_of(in, count), [&](const Buffers& out) {
        const auto delta = values_of<glm::vec4>(out.at("delta"));
        for (std::uint32_t v = 0; v < count; ++v)
        {
            const float way = delta[v].x - in.low[v].x;
            CHECK((v % 2 == 0 ? delta[v] == in.delta[v] : way > 0.0035f && way < 0.00401f));
        }
        CHECK(words_of(out, "lost")[TAUT_CONTACT_FILTERED] == count / 2);
    });
}
