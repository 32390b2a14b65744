#pragma once
// Keys and words in messages: which there are, and which one was meant.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

struct Table;

/// The keys of a table, in its order.
std::vector<std::string_view> names(const Table& table);

/// The candidate with the fewest edits to `word`; empty if none is closer than half its length.
std::string nearest(std::string_view word, std::span<const std::string_view> candidates);

/// What is wrong with a word that is none of the known ones: `is "fife"; it must be "five" or "six" (did you
/// mean "five"?)`.
std::string unknown_word(std::string_view word, std::span<const std::string_view> known);

/// "a", "b" or "c"
std::string listing(std::span<const std::string_view> words);

} // namespace taut::scene_file
