#include "taut/kernels/contact_search.hpp"

#include "support/contact_net.hpp"

#include "taut/kernels/contact_refit.hpp"
#include "taut/kernels/contact_scan.hpp"

#include <algorithm>
#include <map>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr float kSkin = 0.03f;
constexpr std::uint32_t kSubsteps = 5;

using Key = std::array<std::uint32_t, 5>;

/// By how much a pair is nearer than it must be, m.
struct Near
{
    double may = 0;  ///< to be found, by the rule of the kernel
    double must = 0; ///< at some time until the next search, if all go on as in the first substep
};

/// How near a pair comes under the guarantee, beside `reach`: each corner anywhere on its way, and a tenth of
/// it astray. Looked for by places of all corners on their ways, so it is not less than the truth.
template <typename Real>
double nearest_astray(const ContactNet<Real>& net, const layout::ContactPair<Real>& p, std::size_t ends)
{
    const std::uint32_t ids[] = {p.a, p.b, p.c, p.d};
    double stray[] = {0, 0};
    for (std::size_t k = 0; k < 4; ++k)
        stray[k < ends ? 0 : 1] =
            std::max(stray[k < ends ? 0 : 1], 0.1 * kSubsteps * glm::length(net.d(ids[k])));
    double least = 1e9;
    for (std::uint32_t stops = 0; stops < 81; ++stops) // each corner at its start, half way, or its end
    {
        const std::uint32_t at[] = {stops % 3, stops / 3 % 3, stops / 9 % 3, stops / 27};
        const auto x = [&](std::uint32_t v) {
            const auto k = static_cast<std::size_t>(std::find(ids, ids + 4, v) - ids);
            return net.x(v) + 0.5 * at[k] * kSubsteps * net.d(v);
        };
        least = std::min(least, nearest_of(p, x).distance());
    }
    return least - stray[0] - stray[1];
}

/// What the three bodies of a net do among each other.
enum class Meets
{
    all,
    none,
    some ///< the first and the last pass through each other, since the last one says so
};

template <typename Real>
ContactNet<Real> meeting(ContactNet<Real> net, Meets which)
{
    for (auto& body : net.body)
        body.meets = which == Meets::none ? 0u : ~0u;
    if (which == Meets::some)
        net.body[2].meets = ~net.body[0].group;
    return net;
}

/// Every pair that can be meant.
template <typename Real>
std::map<Key, Near> all_pairs(const ContactNet<Real>& net, Meets which, bool guarded = false)
{
    std::map<Key, Near> out;
    const auto put = [&](const layout::ContactPair<Real>& p, std::size_t ends, double gap) {
        const std::uint32_t ids[] = {p.a, p.b, p.c, p.d};
        double motion = 0, masses = 0;
        for (std::size_t i = 0; i < 4; ++i)
        {
            masses += static_cast<double>(net.position[ids[i]].w);
            for (std::size_t j = ends; i < ends && j < 4; ++j)
                motion = std::max(motion, glm::length(net.d(ids[i]) - net.d(ids[j])));
        }
        if (masses == 0 || std::set<std::uint32_t>(ids, ids + 4).size() < 4)
            return;
        const auto at = [&](double time) {
            return nearest_of(p, [&](std::uint32_t v) { return net.x(v) + time * net.d(v); }).distance();
        };
        double least = at(0);
        for (int k = 1; k <= 10; ++k)
            least = std::min(least, at(0.1 * k * kSubsteps));
        const double reach = gap + static_cast<double>(kSkin);
        Near& near = out[{p.a, p.b, p.c, p.d, p.kind}];
        near = {reach + kSubsteps * motion - at(0), reach - least};
        if (!guarded)
            return;
        double ways = 0;
        for (const std::uint32_t v : ids)
            ways = std::max(ways, glm::length(net.d(v)));
        const bool far = at(0) > reach + 2.2 * kSubsteps * ways;
        near = {reach + kSubsteps * 5.2 * ways - at(0), far ? -1 : reach - nearest_astray(net, p, ends)};
    };
    for (std::size_t i = 0; i < net.triangle.size(); ++i)
        for (std::size_t j = 0; j < net.triangle.size(); ++j)
        {
            const auto &t = net.triangle[i], &u = net.triangle[j];
            const bool between =
                which == Meets::all || (which == Meets::some && (t.body == 1 || u.body == 1));
            const bool meets = t.body == u.body ? net.body[t.body].self != 0 : between;
            const double gap = static_cast<double>(net.body[t.body].radius + net.body[u.body].radius);
            const std::uint32_t tc[] = {t.a, t.b, t.c}, uc[] = {u.a, u.b, u.c};
            for (std::uint32_t k = 0; k < 3 && meets && i != j; ++k)
            {
                if ((t.owns >> k & 1) != 0)
                    put({tc[k], u.a, u.b, u.c, TAUT_CONTACT_VERTEX}, 1, gap);
                for (std::uint32_t l = 0; l < 3 && i < j; ++l)
                    if ((t.owns >> (3 + k) & u.owns >> (3 + l) & 1) != 0)
                        put({tc[k], tc[(k + 1) % 3], uc[l], uc[(l + 1) % 3], TAUT_CONTACT_EDGES}, 2, gap);
            }
        }
    return out;
}

template <typename Real>
Case search(const ContactNet<Real>& net, std::uint32_t capacity, bool guarded = false)
{
    const auto count = static_cast<std::uint32_t>(net.triangle.size());
    Case c;
    c.precision = precision_of<Real>();
    using Vec = glm::vec<4, Real>;
    c.in = {{"triangle", bytes_of(net.triangle)},
            {"position", bytes_of(net.position)},
            {"delta", bytes_of(net.delta)},
            {"node", bytes_of(std::vector<Vec>(4 * net.leaves, Vec(0)))},
            {"body", bytes_of(net.body)},
            {"found", bytes_of(std::vector<std::uint32_t>((1 + TAUT_CONTACT_KEPT) * count, 9))},
            {"compared", bytes_of(std::vector<std::uint32_t>(count, 9))},
            {"lost", bytes_of(std::vector<std::uint32_t>(2, 0))},
            {"start", bytes_of(std::vector<std::uint32_t>(count + 1, 9))},
            {"control", bytes_of(control_of(0))},
            {"pair", bytes_of(std::vector<layout::ContactPair<Real>>(capacity, {7, 7, 7, 7, 7}))}};
    const kernels::contact_search::Params how = {count, net.leaves,    kSubsteps,
                                                 kSkin, 0.04f + kSkin, capacity};
    c.launches = {
        make_launch(kernels::contact_search::info(guarded ? "guarded" : "", c.precision), how, count)};
    const auto groups = [](std::uint32_t level) {
        return level / std::min<std::uint32_t>(level, TAUT_CONTACT_REFIT);
    };
    std::vector<Launch> refit = {
        make_launch(kernels::contact_refit::info(guarded ? "guarded" : "leaves", c.precision),
                    kernels::contact_refit::Params{net.leaves, count, kSubsteps}, groups(net.leaves))};
    for (std::uint32_t level = groups(net.leaves); level > 1; level = groups(level))
        refit.push_back(make_launch(kernels::contact_refit::info("", c.precision),
                                    kernels::contact_refit::Params{level, count, kSubsteps}, groups(level)));
    c.launches.insert(c.launches.begin(), refit.begin(), refit.end());
    c.launches.push_back(make_launch(kernels::contact_scan::info("rows", c.precision),
                                     kernels::contact_scan::Params{count, capacity, 1}, 1));
    c.launches.push_back(make_launch(
        kernels::contact_search::info(guarded ? "guarded_fill" : "fill", c.precision), how, count));
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("contact_search finds every pair that may meet, once, and none that cannot", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 2u, 63u, 65u, 300u);
    const Meets which = GENERATE(Meets::all, Meets::none, Meets::some);
    const bool guarded = GENERATE(false, true);
    const bool alike = which == Meets::all && GENERATE(false, true);
    CAPTURE(count, int(which), guarded, alike);
    Random random(2200 + count);
    auto net = meeting(contact_net<Real>(count, random, 0.003), which);
    if (alike) // then what they may go astray is all that brings them together
        std::fill(net.delta.begin(), net.delta.end(), glm::vec<4, Real>(0.006, 0.002, -0.003, 0));
    const std::map<Key, Near> wanted = all_pairs(net, which, guarded);
    const std::uint32_t capacity = 1 << 15;
    const double doubt = sizeof(Real) == 8 ? 1e-12 : 1e-5;
    look_on_every_device(search(net, capacity, guarded), [&](const Buffers& out) {
        const auto pairs = values_of<layout::ContactPair<Real>>(out.at("pair"));
        const std::uint32_t listed = words_of(out, "control")[TAUT_CONTACT_LISTED];
        REQUIRE(words_of(out, "start").back() == listed);
        std::set<Key> found;
        std::size_t strangers = 0, twice = 0, lost = 0, must = 0;
        for (std::uint32_t k = 0; k < listed; ++k)
        {
            const Key key = {pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d, pairs[k].kind};
            const auto known = wanted.find(key);
            strangers += known == wanted.end() || known->second.may < -doubt ? 1 : 0;
            twice += found.insert(key).second ? 0 : 1;
        }
        for (const auto& [key, by] : wanted)
        {
            must += by.must > doubt ? 1 : 0;
            lost += by.must > doubt && found.count(key) == 0 ? 1 : 0;
        }
        CHECK(strangers == 0);
        CHECK(twice == 0);
        CHECK(lost == 0);
        CHECK((count < 63 || which != Meets::all || must > count)); // the net is dense enough
        if (count == 300 && which == Meets::all) // lists that are kept, and such as are looked for again
        {
            const auto all = words_of(out, "found");
            const auto [few, many] = std::minmax_element(all.begin(), all.begin() + count);
            CHECK((*few <= TAUT_CONTACT_KEPT && *many > TAUT_CONTACT_KEPT));
        }
        CHECK(pairs[listed].a == 7);
        CHECK(words_of(out, "lost") == std::vector<std::uint32_t>{0, 0});
    });
}

TEST_CASE("contact_search counts what a list that is too short does not hold, and writes no further")
{
    Random random(2300);
    const auto net = contact_net<float>(300, random, 0.003);
    const std::uint32_t capacity = 40;
    const Buffers full =
        run(*test_device("cpu:serial"), search(net, 1 << 15).launches, search(net, 1 << 15).in);
    look_on_every_device(search(net, capacity), [&](const Buffers& out) {
        const auto control = words_of(out, "control");
        const std::uint32_t all = words_of(full, "control")[TAUT_CONTACT_LISTED];
        CHECK(control[TAUT_CONTACT_FOUND] == all);
        CHECK(control[TAUT_CONTACT_LISTED] == capacity);
        CHECK(control[TAUT_CONTACT_MISSING] == all - capacity);
        CHECK(std::memcmp(out.at("pair").data(), full.at("pair").data(), out.at("pair").size()) == 0);
    });
}

namespace {

/// A wavy sheet of 8 x 4 cells in the x-y plane, its cells row after row along x, so that both halves are
/// nodes of the tree; `folded`: the second half lies on the first.
ContactNet<float> sheet(bool folded, std::uint32_t patch)
{
    ContactNet<float> net;
    net.body = {{0.01f, 0.2f, 1, 1, ~0u, 1}};
    for (std::uint32_t i = 0; i <= 8; ++i)
        for (std::uint32_t j = 0; j <= 4; ++j)
        {
            const bool over = folded && i > 4;
            const float x = 0.04f * float(over ? 8 - i : i), wave = 0.01f * std::sin(25 * x);
            net.position.emplace_back(x, 0.04f * float(j), wave + (over ? 0.025f : 0.0f), 1.0f);
            net.delta.emplace_back(1e-3f, 0.0f, 0.0f, 0.0f);
        }
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t j = 0; j < 4; ++j)
        {
            const std::uint32_t v = 5 * i + j;
            net.triangle.push_back({v, v + 5, v + 1, 0, 0});
            net.triangle.push_back({v + 5, v + 6, v + 1, 0, 0});
        }
    share_out(net);
    for (auto& t : net.triangle)
        t.owns |= patch << TAUT_CONTACT_OWNS_PATCH;
    return net;
}

/// Pairs of a search, and whether their two are of different halves of the sheet.
std::map<Key, bool> listed(const Buffers& out)
{
    std::map<Key, bool> found;
    const auto pairs = values_of<layout::ContactPair<float>>(out.at("pair"));
    for (std::uint32_t k = 0; k < words_of(out, "control")[TAUT_CONTACT_LISTED]; ++k)
        found[{pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d, pairs[k].kind}] =
            std::max(pairs[k].a, pairs[k].kind == TAUT_CONTACT_EDGES ? pairs[k].b : 0u) / 25 !=
            std::max(pairs[k].c, pairs[k].d) / 25;
    return found;
}

} // namespace

TEST_CASE("contact_search passes over a patch while it faces one way, and over nothing else")
{
    const bool folded = GENERATE(false, true);
    CAPTURE(folded);
    const Case all = search(sheet(folded, 0), 1 << 12);
    const std::map<Key, bool> without = listed(run(*test_device("cpu:serial"), all.launches, all.in));
    CHECK(without.size() > 100); // neighbours are near enough for that
    look_on_every_device(search(sheet(folded, 6), 1 << 12), [&](const Buffers& out) {
        const std::map<Key, bool> with = listed(out);
        CHECK(with.empty() == !folded);
        std::size_t across = 0, missing = 0;
        for (const auto& [key, between] : without)
        {
            across += between;
            missing += between && with.count(key) == 0;
        }
        CHECK((!folded || (missing == 0 && across > 50)));
        CHECK((!folded || with.size() < without.size()));
    });
}
