#include "support/catch.hpp"
#include "taut/runtime/base/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <stdexcept>

using namespace taut;

namespace {

/// A kernel with one binding of the given access, or two.
struct TestKernel
{
    std::array<BindingInfo, 2> bindings;
    KernelInfo info;

    TestKernel(std::string_view name, std::initializer_list<Access> accesses)
    {
        constexpr std::string_view kNames[] = {"alpha", "beta"};
        std::uint32_t slot = 0;
        for (const Access access : accesses)
        {
            bindings[slot] = {kNames[slot], slot, access, 4};
            ++slot;
        }
        info.name = name;
        info.bindings = std::span(bindings).first(slot);
    }
    TestKernel(const TestKernel&) = delete;
    TestKernel& operator=(const TestKernel&) = delete;
};

const TestKernel kReader("reader", {Access::read});
const TestKernel kWriter("writer", {Access::write});
const TestKernel kUpdater("updater", {Access::update});
const TestKernel kCounter("counter", {Access::count});
const TestKernel kCopier("copier", {Access::read, Access::write});

Dispatch use(const TestKernel& kernel, std::vector<BufferRange> ranges)
{
    Dispatch dispatch;
    dispatch.kernel = &kernel.info;
    dispatch.bindings = std::move(ranges);
    dispatch.count = 1;
    return dispatch;
}

bool needs_barrier(Dispatch first, Dispatch second)
{
    const std::vector<Dispatch> list = {std::move(first), std::move(second)};
    const std::vector<bool> barriers = derive_barriers(list);
    CHECK_FALSE(barriers[0]);
    CHECK(find_hazards(list, barriers).empty());
    // Both authors of the definition must agree.
    CHECK(find_hazards(list, {false, false}).empty() == !barriers[1]);
    return barriers[1];
}

const BufferRange kWhole = {7, 0, 1024};

std::size_t count(const std::vector<bool>& barriers)
{
    return static_cast<std::size_t>(std::count(barriers.begin(), barriers.end(), true));
}

} // namespace

TEST_CASE("two accesses conflict unless both read or both count")
{
    CHECK_FALSE(needs_barrier(use(kReader, {kWhole}), use(kReader, {kWhole})));
    CHECK_FALSE(needs_barrier(use(kCounter, {kWhole}), use(kCounter, {kWhole})));
    for (const TestKernel* first : {&kReader, &kWriter, &kUpdater, &kCounter})
        for (const TestKernel* second : {&kReader, &kWriter, &kUpdater, &kCounter})
        {
            CAPTURE(first->info.name, second->info.name);
            const bool free = first == second && (first == &kReader || first == &kCounter);
            CHECK(needs_barrier(use(*first, {kWhole}), use(*second, {kWhole})) == !free);
        }
}

TEST_CASE("only bytes that overlap conflict")
{
    const auto write_at = [](std::uint32_t buffer, std::uint64_t offset, std::uint64_t bytes) {
        return use(kWriter, {{buffer, offset, bytes}});
    };
    CHECK(needs_barrier(write_at(0, 0, 100), write_at(0, 99, 1)));
    CHECK(needs_barrier(write_at(0, 99, 1), write_at(0, 0, 100)));
    CHECK(needs_barrier(write_at(0, 0, 100), write_at(0, 40, 10)));
    CHECK_FALSE(needs_barrier(write_at(0, 0, 100), write_at(0, 100, 100)));
    CHECK_FALSE(needs_barrier(write_at(0, 100, 100), write_at(0, 0, 100)));
    CHECK_FALSE(needs_barrier(write_at(0, 0, 100), write_at(1, 0, 100)));
    CHECK_FALSE(needs_barrier(write_at(0, 0, 100), write_at(0, 50, 0)));
    CHECK_FALSE(needs_barrier(write_at(0, 50, 0), write_at(0, 0, 100)));
}

TEST_CASE("the group counts of an indirect dispatch are read")
{
    Dispatch indirect = use(kReader, {{1, 0, 4}});
    indirect.indirect = {2, 16, 12};
    CHECK(needs_barrier(use(kWriter, {{2, 16, 4}}), indirect));
    CHECK(needs_barrier(indirect, use(kWriter, {{2, 24, 8}})));
    CHECK_FALSE(needs_barrier(use(kWriter, {{2, 0, 16}}), indirect));
    CHECK_FALSE(needs_barrier(use(kReader, {{2, 16, 12}}), indirect));
}

TEST_CASE("bindings of one dispatch do not conflict with each other")
{
    const std::vector<Dispatch> list = {use(kCopier, {kWhole, kWhole})};
    CHECK(derive_barriers(list) == std::vector<bool>{false});
    CHECK(find_hazards(list, {false}).empty());
}

TEST_CASE("a barrier forgets what came before it")
{
    // b=a; c=b; d=c: each needs the one before, so two barriers. Then a, read long ago, may be written.
    const BufferRange a{0, 0, 64}, b{1, 0, 64}, c{2, 0, 64}, d{3, 0, 64};
    const std::vector<Dispatch> list = {use(kCopier, {a, b}), use(kCopier, {b, c}), use(kCopier, {c, d}),
                                        use(kWriter, {a})};
    CHECK(derive_barriers(list) == std::vector<bool>{false, true, true, false});
}

TEST_CASE("colours that write apart share one section, colours that meet do not")
{
    std::vector<Dispatch> list;
    for (std::uint64_t i = 0; i < 8; ++i)
        list.push_back(use(kUpdater, {{0, i * 64, 64}}));
    CHECK(count(derive_barriers(list)) == 0);
    for (Dispatch& dispatch : list)
        dispatch.bindings[0] = kWhole;
    CHECK(count(derive_barriers(list)) == 7);
}

TEST_CASE("a barrier taken away is found, and the sentence names kernels, bindings and bytes")
{
    const std::vector<Dispatch> list = {
        use(kWriter, {{3, 0, 256}}), use(kCopier, {{3, 128, 256}, {4, 0, 256}}), use(kReader, {{5, 0, 16}})};
    std::vector<bool> barriers = derive_barriers(list);
    REQUIRE(barriers == std::vector<bool>{false, true, false});
    REQUIRE(find_hazards(list, barriers).empty());

    CHECK_NOTHROW(check_no_hazard(list, barriers));

    barriers[1] = false;
    // In every build, and not as an Error: nothing that a caller does is the cause.
    CHECK_THROWS_AS(check_no_hazard(list, barriers), std::logic_error);
    const std::vector<Hazard> hazards = find_hazards(list, barriers);
    REQUIRE(hazards.size() == 1);
    CHECK(hazards[0].first == 0);
    CHECK(hazards[0].second == 1);
    CHECK(hazards[0].buffer == 3);
    CHECK(
        hazards[0].text ==
        "dispatch 0 (writer) writes alpha [bytes 0 to 256] and dispatch 1 (copier) reads alpha [bytes 128 to "
        "384] of buffer 3 with no barrier between them, and bytes 128 to 256 are shared");
}

TEST_CASE("every single barrier of a random list is needed, and all of them are enough")
{
    std::mt19937 random(5);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const std::array kernels = {&kReader, &kWriter, &kUpdater, &kCounter, &kCopier};
    for (int trial = 0; trial < 50; ++trial)
    {
        std::vector<Dispatch> list;
        for (int i = 0; i < 60; ++i)
        {
            const TestKernel& kernel = *kernels[below(kernels.size())];
            std::vector<BufferRange> ranges;
            for (std::size_t k = 0; k < kernel.info.bindings.size(); ++k)
                ranges.push_back({below(4), below(16) * 16, below(6) * 16});
            list.push_back(use(kernel, ranges));
            if (below(8) == 0)
                list.back().indirect = {below(4), below(16) * 16, 12};
        }
        const std::vector<bool> barriers = derive_barriers(list);
        REQUIRE(find_hazards(list, barriers).empty());
        for (std::size_t i = 0; i < list.size(); ++i)
        {
            if (!barriers[i])
                continue;
            std::vector<bool> planted = barriers;
            planted[i] = false;
            REQUIRE_FALSE(find_hazards(list, planted).empty());
        }
    }
}

TEST_CASE("lists without conflicts keep no growing history")
{
    // Quadratic bookkeeping would compare 1.25e9 pairs here.
    std::vector<Dispatch> list;
    for (std::uint64_t i = 0; i < 50'000; ++i)
        list.push_back(use(kCopier, {kWhole, {8, i * 32, 16}}));
    CHECK(count(derive_barriers(list)) == 0);
    list.push_back(use(kWriter, {{8, 49'999u * 32 + 15, 1}}));
    CHECK(derive_barriers(list).back());
}

TEST_CASE("an empty list has no barriers and no hazards")
{
    CHECK(derive_barriers({}).empty());
    CHECK(find_hazards({}, {}).empty());
}
