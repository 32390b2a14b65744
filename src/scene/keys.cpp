#include "taut/scene/keys.hpp"

#include "taut/scene/descriptor.hpp"

#include <algorithm>

namespace taut::scene_file {

std::vector<std::string_view> names(const Table& table)
{
    std::vector<std::string_view> out;
    for (const Key& key : table.keys)
        out.push_back(key.name);
    return out;
}

namespace {

/// Insertions, deletions, replacements and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = last;
        last = row;
    }
    return last.back();
}

} // namespace

std::string nearest(std::string_view word, std::span<const std::string_view> candidates)
{
    word = word.substr(0, 64); // no known word is longer; keeps hostile input cheap
    std::string best;
    std::size_t fewest = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (std::string_view candidate : candidates)
    {
        const std::size_t edits = edit_distance(word, candidate);
        if (edits < fewest && edits < candidate.size())
        {
            fewest = edits;
            best = candidate;
        }
    }
    return best;
}

std::string unknown_word(std::string_view word, std::span<const std::string_view> known)
{
    const std::string close = nearest(word, known);
    return "is \"" + std::string(word.substr(0, 60)) + "\"; it must be " + listing(known) +
           (close.empty() || known.size() == 1 ? "" : " (did you mean \"" + close + "\"?)");
}

std::string listing(std::span<const std::string_view> words)
{
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        if (i > 0)
            out += i + 1 == words.size() ? " or " : ", ";
        out += '"' + std::string(words[i]) + '"';
    }
    return out;
}

} // namespace taut::scene_file
