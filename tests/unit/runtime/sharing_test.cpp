// Which way a recording runs, decided by times that the test makes up.

#include "support/catch.hpp"
#include "taut/runtime/cpu/sharing.hpp"

#include <functional>
#include <random>

using taut::cpu::Sharing;
using taut::cpu::Way;

namespace {

/// `replays` replays of `time`(way) ns each; gives the sum of what they took.
double replay(Sharing& sharing, std::uint32_t replays, const std::function<double(Way)>& time)
{
    double total = 0;
    for (std::uint32_t replay = 0; replay < replays; ++replay)
    {
        const double took = time(sharing.next());
        sharing.took(took);
        total += took;
    }
    return total;
}

std::function<double(Way)> times(double alone, double shared)
{
    return [=](Way way) { return way == Way::alone ? alone : shared; };
}

} // namespace

TEST_CASE("a recording that threads make slower runs alone, and loses 2 % to trials at most")
{
    Sharing sharing;
    const double total = replay(sharing, 2000, times(100, 200));
    CHECK(sharing.best() == Way::alone);
    CHECK(total < 1.02 * 2000 * 100);
    CHECK(total > 2000 * 100); // it does try
}

TEST_CASE("a recording that threads make faster is shared, whatever its first replays took")
{
    Sharing sharing;
    replay(sharing, 1, times(1e9, 1e9)); // cold caches
    const double total = replay(sharing, 2000, times(100, 55));
    CHECK(sharing.best() == Way::shared);
    CHECK(total < 1.02 * 2000 * 55);
}

TEST_CASE("the first replays run alone, and each way has run before one is chosen")
{
    Sharing sharing;
    CHECK(sharing.next() == Way::alone);
    std::uint32_t shared = 0;
    replay(sharing, 8, [&](Way way) { return shared += way == Way::shared, 100.0; });
    CHECK(shared == 4);
}

TEST_CASE("a recording whose times change takes the other way soon")
{
    Sharing sharing;
    replay(sharing, 5000, times(100, 55));
    REQUIRE(sharing.best() == Way::shared);
    replay(sharing, 30, times(100, 150)); // what is slower than usual is tried again at once
    CHECK(sharing.best() == Way::alone);
    replay(sharing, 600, times(100, 55)); // what would be faster now, at the next trial
    CHECK(sharing.best() == Way::shared);
}

TEST_CASE("a replay that lost its core, and times that differ by less than a few per cent, change nothing")
{
    Sharing sharing;
    replay(sharing, 100, times(100, 60));
    std::minstd_rand random(5);
    std::uint32_t changes = 0;
    Way before = sharing.best();
    for (std::uint32_t replay = 0; replay < 20'000; ++replay)
    {
        const double time = sharing.next() == Way::alone ? 100 : 60;
        sharing.took(random() % 50 == 0 ? 20 * time : time);
        changes += sharing.best() != before;
        before = sharing.best();
    }
    CHECK(changes <= 2); // two of three at once are rare, and soon mended
    CHECK(sharing.best() == Way::shared);

    Sharing even;
    replay(even, 100, times(100, 100));
    before = even.best();
    replay(even, 3000, times(100, before == Way::alone ? 98 : 102));
    CHECK(even.best() == before);
}
