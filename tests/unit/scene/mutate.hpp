#pragma once
// Deterministic damage for files: the same seed always makes the same mutation, on every machine.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace mutate {

/// splitmix64: tiny, fixed for ever, no dependence on the standard library's distributions.
struct Random
{
    std::uint64_t state;

    std::uint64_t next()
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }

    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
};

inline constexpr std::array<std::string_view, 28> kHostileTokens = {"nan",
                                                                    "-nan",
                                                                    "inf",
                                                                    "-inf",
                                                                    "1e400",
                                                                    "-1e400",
                                                                    "1e-400",
                                                                    "0",
                                                                    "-1",
                                                                    "-2147483648",
                                                                    "2147483647",
                                                                    "4294967295",
                                                                    "4294967296",
                                                                    "18446744073709551615",
                                                                    "99999999999999999999",
                                                                    "1000000",
                                                                    "268435456",
                                                                    "",
                                                                    "/",
                                                                    "//",
                                                                    "1//",
                                                                    "1/2/3/4",
                                                                    "0x7fffffff",
                                                                    "1e38",
                                                                    "3.5",
                                                                    "#",
                                                                    "\\",
                                                                    "element"};

inline constexpr std::array<std::uint32_t, 10> kHostileWords = {
    0u,          1u,          0x7fffffffu, 0x80000000u, 0xffffffffu,
    0x7fc00000u, 0x7f800000u, 0x00ffffffu, 0x10000000u, 0xff000000u};

inline bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// A word of the text, or a few bytes where there are no words: [begin, end).
inline std::pair<std::size_t, std::size_t> pick_token(const std::string& text, Random& random)
{
    std::size_t begin = random.below(text.size());
    while (begin > 0 && !is_space(text[begin - 1]))
        --begin;
    std::size_t end = begin;
    while (end < text.size() && !is_space(text[end]))
        ++end;
    return {begin, end};
}

inline std::pair<std::size_t, std::size_t> pick_line(const std::string& text, Random& random)
{
    std::size_t begin = random.below(text.size());
    while (begin > 0 && text[begin - 1] != '\n')
        --begin;
    std::size_t end = text.find('\n', begin);
    end = end == std::string::npos ? text.size() : end + 1;
    return {begin, end};
}

inline void damage_once(std::string& text, Random& random)
{
    if (text.empty())
        text = "\n";
    const std::size_t at = random.below(text.size());
    switch (random.below(9))
    {
    case 0: // flip a bit
        text[at] = static_cast<char>(text[at] ^ static_cast<char>(1u << random.below(8)));
        break;
    case 1: // any byte
        text[at] = static_cast<char>(random.below(256));
        break;
    case 2: // truncation
        text.resize(at);
        break;
    case 3: // a word becomes a hostile one
    case 4:
    {
        const auto [begin, end] = pick_token(text, random);
        text.replace(begin, end - begin, kHostileTokens[random.below(kHostileTokens.size())]);
        break;
    }
    case 5: // a line twice, or many times
    {
        const auto [begin, end] = pick_line(text, random);
        const std::string line = text.substr(begin, end - begin);
        for (std::size_t n = 1 + random.below(4); n > 0; --n)
            text.insert(begin, line);
        break;
    }
    case 6: // a line less
    {
        const auto [begin, end] = pick_line(text, random);
        text.erase(begin, end - begin);
        break;
    }
    case 7: // some bytes less
        text.erase(at, 1 + random.below(16));
        break;
    default: // a 32-bit word, little endian
    {
        const std::uint32_t word = kHostileWords[random.below(kHostileWords.size())];
        for (std::size_t b = 0; b < 4 && at + b < text.size(); ++b)
            text[at + b] = static_cast<char>((word >> (8 * b)) & 0xffu);
    }
    }
}

/// One to five damages of `seed_text`.
inline std::string damage(std::string_view seed_text, std::uint64_t seed)
{
    Random random{seed * 0x2545f4914f6cdd1dull + 1};
    std::string text(seed_text);
    for (std::size_t n = 1 + random.below(5); n > 0; --n)
        damage_once(text, random);
    return text;
}

} // namespace mutate
