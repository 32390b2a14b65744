#include "support/catch.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>

// Only what is between push and pop is compiled for AVX2: other code must not be (runtime/cpu/lanes.hpp).
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

#include "taut/runtime/cpu/lane_forms.hpp"

namespace {

using Indices = std::array<std::uint32_t, 8>;

/// Whether corners that index with these are of a form.
bool are_of(taut::lanes::Form form, const Indices& a, const Indices& b)
{
    taut::lanes::Lookout lookout(form);
    for (const Indices* corner : {&a, &b})
    {
        alignas(32) Indices by_lane;
        for (std::uint32_t element = 0; element < 8; ++element)
            by_lane[taut::lanes::lane_of(element)] = (*corner)[element];
        lookout.see(_mm256_load_si256(reinterpret_cast<const __m256i*>(by_lane.data())),
                    reinterpret_cast<const std::byte*>(corner->data()));
    }
    return lookout.agrees();
}

bool is_of_without_corners(taut::lanes::Form form) { return taut::lanes::Lookout(form).agrees(); }

/// How many of `blocks` blocks without a form are looked at.
int looks_in(int blocks, taut::lanes::Patience& patience)
{
    int looks = 0;
    for (int block = 0; block < blocks; ++block)
        if (patience.wants_look())
        {
            ++looks;
            patience.found(taut::lanes::Form::any);
        }
    return looks;
}

struct Looks
{
    int at_first, later, after_a_form;
    taut::lanes::Form likely;
};

/// Blocks without a form, then one of pairs, then such without again.
Looks looks_of_a_pass()
{
    taut::lanes::Patience patience;
    Looks out{};
    out.at_first = looks_in(16, patience);
    out.later = looks_in(1600, patience);
    while (!patience.wants_look())
        ;
    patience.found(taut::lanes::Form::pairs);
    out.after_a_form = looks_in(16, patience);
    out.likely = patience.likely();
    return out;
}

} // namespace

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

using taut::lanes::Form;

namespace {

Indices from(std::uint32_t first, Form form)
{
    Indices out;
    for (std::uint32_t element = 0; element < 8; ++element)
        out[element] = first + taut::lanes::behind_first(form, element);
    return out;
}

} // namespace

TEST_CASE("a block is of a form if all its corners are, and any change of one index is noticed")
{
    if (!__builtin_cpu_supports("avx2"))
    {
        WARN("left out: this processor has no AVX2");
        return;
    }
    CHECK(from(3, Form::run) == Indices{3, 4, 5, 6, 7, 8, 9, 10});
    CHECK(from(3, Form::pairs) == Indices{3, 4, 7, 8, 11, 12, 15, 16});
    for (const Form form : {Form::run, Form::pairs})
    {
        const Indices a = from(5, form), b = from(0xFFFFFFF0u, form);
        CHECK(are_of(form, a, b));
        CHECK_FALSE(are_of(form == Form::run ? Form::pairs : Form::run, a, b));
        CHECK_FALSE(is_of_without_corners(form)); // nothing indexes, nothing to gain
        for (std::size_t element = 0; element < 8; ++element)
        {
            Indices other = a;
            other[element] += 1;
            CHECK_FALSE(are_of(form, other, b));
            CHECK_FALSE(are_of(form, b, other));
            for (std::size_t with = 0; with < element; ++with)
            {
                Indices swapped = a;
                std::swap(swapped[element], swapped[with]);
                CHECK_FALSE(are_of(form, swapped, b));
            }
        }
        Indices backwards = a;
        std::reverse(backwards.begin(), backwards.end());
        CHECK_FALSE(are_of(form, backwards, a));
    }
    CHECK_FALSE(are_of(Form::run, from(5, Form::run), from(9, Form::pairs)));
    CHECK_FALSE(are_of(Form::run, Indices{}, Indices{}));
}

TEST_CASE("blocks without a form are looked at ever more rarely, and at once again after one that has one")
{
    if (!__builtin_cpu_supports("avx2"))
    {
        WARN("left out: this processor has no AVX2");
        return;
    }
    const Looks looks = looks_of_a_pass();
    CHECK(looks.at_first == 4); // blocks 0, 2, 6, 14
    CHECK(looks.later <= 100);  // of 1,600
    CHECK(looks.after_a_form == 4);
    CHECK(looks.likely == Form::pairs);
}

#endif
