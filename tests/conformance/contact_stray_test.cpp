#include "taut/kernels/contact_stray.hpp"

#include "support/contact_net.hpp"

#include <algorithm>
#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kVertices = 300, kSubsteps = 5;
constexpr float kBound = 0.01f;

template <typename Real>
struct Strays
{
    using Vec = glm::vec<4, Real>;
    std::vector<Vec> position, delta, place;
    std::uint32_t count = 0; ///< further than the bound from where they were expected

    explicit Strays(std::uint32_t since)
    {
        Random random(2910);
        for (std::uint32_t v = 0; v < kVertices; ++v)
        {
            const glm::dvec3 x(random.vec4<double>(3, 1)), d(random.vec4<double>(1e-3, 0)),
                then(random.vec4<double>(1e-3, 0)), to(random.vec4<double>(1, 0));
            // A tenth of the bound from it at least: no rounding decides.
            const double length = v % 2 == 0 ? random.uniform(0, 0.9) : random.uniform(1.1, 3);
            const glm::dvec3 off = glm::normalize(to) * (double(kBound) * length);
            const glm::dvec3 from = x + d - double(std::min(since + 1, kSubsteps)) * then - off;
            position.emplace_back(glm::vec<3, Real>(x), Real(1));
            delta.emplace_back(glm::vec<3, Real>(d), Real(0));
            place.emplace_back(glm::vec<3, Real>(from), Real(1));
            place.emplace_back(glm::vec<3, Real>(then), Real(0));
            count += v % 2;
        }
    }
};

} // namespace

TEMPLATE_TEST_CASE("contact_stray counts vertices that are not where they were expected", "", float, double)
{
    const std::uint32_t since = GENERATE(1u, 3u, 4u, 100u); // as far as the search looked, and beyond
    const bool lost = GENERATE(false, true);                // one that is no number strays
    CAPTURE(since, lost);
    Strays<TestType> strays(since);
    if (lost)
        strays.position[0].y = std::numeric_limits<TestType>::quiet_NaN();
    auto control = control_of(0);
    control[TAUT_CONTACT_SINCE] = since;
    Case c;
    c.precision = precision_of<TestType>();
    c.in = {{"position", bytes_of(strays.position)},
            {"delta", bytes_of(strays.delta)},
            {"place", bytes_of(strays.place)},
            {"control", bytes_of(control)},
            {"lost", bytes_of(std::vector<std::uint32_t>(TAUT_CONTACT_LOST_WORDS, 2))}};
    c.launches = {make_launch(kernels::contact_stray::info("", c.precision),
                              kernels::contact_stray::Params{kVertices, kSubsteps, kBound}, kVertices)};
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(words_of(out, "lost")[TAUT_CONTACT_STRAYED] == 2 + strays.count + (lost ? 1 : 0));
        CHECK(words_of(out, "lost")[TAUT_CONTACT_CUT] == 2);
    });
}

TEMPLATE_TEST_CASE(
    "contact_stray counts, with the guarantee, vertices that are off the way of their forecasts", "", float,
    double)
{
    using Vec = glm::vec<4, TestType>;
    Random random(2911);
    std::vector<Vec> position, delta, place;
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < kVertices; ++v)
    {
        const glm::dvec3 from(random.vec4<double>(3, 1)), then(random.vec4<double>(0.02, 0)),
            d(random.vec4<double>(1e-3, 0));
        const glm::dvec3 forecast = double(kSubsteps) * then;
        // Beside the way at a right angle, or beyond its ends; a twentieth of it is allowed, too.
        const double share = random.uniform(-0.3, 1.3), along = glm::clamp(share, 0.0, 1.0);
        const double allowed = double(kBound) + 0.05 * glm::length(forecast);
        const double length = (v % 2 == 0 ? random.uniform(0, 0.9) : random.uniform(1.1, 3)) * allowed;
        glm::dvec3 aside = glm::cross(forecast, glm::dvec3(random.vec4<double>(1, 0)));
        if (share != along)
            aside = (share - along) * forecast;
        const glm::dvec3 end = along * forecast + length * glm::normalize(aside);
        position.emplace_back(glm::vec<3, TestType>(from + end - d), TestType(1));
        delta.emplace_back(glm::vec<3, TestType>(d), TestType(0));
        place.emplace_back(glm::vec<3, TestType>(from), TestType(1));
        place.emplace_back(glm::vec<3, TestType>(then), TestType(0));
        count += v % 2;
    }
    Case c;
    c.precision = precision_of<TestType>();
    c.in = {{"position", bytes_of(position)},
            {"delta", bytes_of(delta)},
            {"place", bytes_of(place)},
            {"lost", bytes_of(std::vector<std::uint32_t>(TAUT_CONTACT_GUARDED_LOST_WORDS, 2))}};
    c.launches = {make_launch(kernels::contact_stray::info("guarded", c.precision),
                              kernels::contact_stray::Params{kVertices, kSubsteps, kBound}, kVertices)};
    look_on_every_device(
        c, [&](const Buffers& out) { CHECK(words_of(out, "lost")[TAUT_CONTACT_STRAYED] == 2 + count); });
}

TEMPLATE_TEST_CASE("contact_stray keeps where vertices are and go when a search is made", "", float, double)
{
    const Strays<TestType> strays(1);
    std::vector<glm::vec<4, TestType>> kept;
    for (std::size_t v = 0; v < kVertices; ++v)
        kept.insert(kept.end(), {strays.position[v], strays.delta[v]});
    Case c;
    c.precision = precision_of<TestType>();
    c.in = {{"position", bytes_of(strays.position)},
            {"delta", bytes_of(strays.delta)},
            {"place", bytes_of(strays.place)}};
    c.launches = {make_launch(kernels::contact_stray::info("keep", c.precision),
                              kernels::contact_stray::Params{kVertices, kSubsteps, kBound}, kVertices)};
    look_on_every_device(c, [&](const Buffers& out) { CHECK(out.at("place") == bytes_of(kept)); });
}
