#pragma once
// Every key of the scene file, object by object. The parser refuses what is not here, and a test
// looks each of them up in docs/scene.md.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

/// The keys that one kind of object may have.
struct KeySet
{
    std::string_view object; ///< as docs/scene.md calls it
    std::vector<std::string_view> keys;
};

/// The set of an object kind; asserts that it exists.
const KeySet& keys_of(std::string_view object);
std::span<const KeySet> all_keys();

/// The candidate with the fewest edits to `word`; empty if none is closer than half its length.
std::string nearest(std::string_view word, std::span<const std::string_view> candidates);

/// What to say to one who writes into `object` a key that means something elsewhere; empty if nothing is
/// known.
std::string_view meant(std::string_view object, std::string_view key);

/// "a", "b" or "c"
std::string listing(std::span<const std::string_view> words);

} // namespace taut::scene_file
