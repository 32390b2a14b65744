// What reading takes grows as the file does: counted in calls of the allocator and in the bytes that they ask
// for, which are the same on every machine, not in seconds. So a list or a path that is copied for each of
// its elements is seen here; what is only walked over is seen by tests/bench/host_bench.cpp.

#include "child.hpp"
#include "support/catch.hpp"
#include "support/skip.hpp"

#include "taut/scene/mesh.hpp"
#include "taut/scene/scene.hpp"
#include "temporary.hpp"

#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>
#include <tuple>

#if !defined(TAUT_TEST_ASAN)

namespace {

std::atomic<std::uint64_t> calls = 0, bytes = 0;

} // namespace

// Not within their callers: g++ would pair one there with its own other half.
[[gnu::noinline]] void* operator new(std::size_t size)
{
    ++calls;
    bytes += size;
    if (void* const memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

struct Asked
{
    std::uint64_t calls = 0, bytes = 0;
};

Asked asked_by(const std::function<void()>& work)
{
    const Asked before{calls, bytes};
    work();
    return {calls - before.calls, bytes - before.bytes};
}

constexpr std::uint32_t kFew = 2048; // a power of two: vectors that grow twofold have room for no more

/// `read` takes so many elements; what it asks for must double with them, but for what stays the same.
void check_growth(const std::function<void(std::uint32_t)>& read)
{
    read(kFew); // what is made once is there then
    const Asked few = asked_by([&] { read(kFew); });
    const Asked twice = asked_by([&] { read(2 * kFew); });
    INFO("calls " << few.calls << " and " << twice.calls << ", bytes " << few.bytes << " and "
                  << twice.bytes);
    CHECK(few.bytes > kFew); // it is counted at all
    CHECK(static_cast<double>(twice.calls) < 2.02 * static_cast<double>(few.calls));
    CHECK(static_cast<double>(twice.bytes) < 2.02 * static_cast<double>(few.bytes));
}

/// `element` so many times, "#" being its number.
std::string repeated(const std::string& element, std::uint32_t count, const std::string& between)
{
    std::string text;
    text.reserve(count * (element.size() + 10)); // one call, whatever the count
    for (std::uint32_t k = 0; k < count; ++k)
    {
        text += k == 0 ? "" : between;
        for (const char c : element)
            text += c == '#' ? std::to_string(k) : std::string(1, c);
    }
    return text;
}

} // namespace

TEST_CASE("reading and checking a scene asks for memory in proportion to its lists")
{
    std::string before, element, behind; // no bindings: clang 14 takes none along into a lambda
    std::tie(before, element, behind) = GENERATE(table<std::string, std::string, std::string>(
        {{R"("bodies": [{"grid": {"cells": [64, 64]}, "springs": [)",
          R"({"a": #, "b": 4200, "rest_length": 0.5, "compliance": 1e-5})", "]}]"},
         {R"("bodies": [{"grid": {"cells": [64, 64]}, "pins": [{"vertices": [)", "#", "]}]}]"},
         {R"("bodies": [{"grid": {"cells": [64, 64]}, "pins": [)", R"({"vertices": [#]})", "]}]"},
         {R"("bodies": [)", R"({"name": "body #", "grid": {"cells": [2, 2]}})", "]"},
         {R"("bodies": [{"grid": {}}], "colliders": [)", R"({"sphere": {"centre": [#, 0, 0]}})", "]"}}));
    INFO(element);
    check_growth([&](std::uint32_t count) {
        const std::string text = R"({"taut": 1, )" + before + repeated(element, count, ", ") + behind + "}";
        for (const taut::SceneIssue& issue : check(taut::parse_scene(text)))
            CHECK_FALSE(issue.error);
    });
}

TEST_CASE("reading a mesh asks for memory in proportion to its lines")
{
    const Temporary folder;
    const std::string line = GENERATE("v # 0 0\nv # 1 0\nv # 0 1\nf -3 -2 -1\n", "seam # 1\n");
    INFO(line);
    check_growth([&](std::uint32_t count) {
        const auto file =
            folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + repeated(line, count, ""));
        taut::MeshFindings findings;
        taut::read_mesh(file, 0, &findings);
        CHECK(findings.skipped.size() == (line.starts_with("seam") ? 1 : 0));
    });
}

#else

TEST_CASE("reading asks for memory in proportion to what is read")
{
    TAUT_LEFT_OUT("the growth of reading: a sanitizer has an allocator of its own");
}

#endif
