#pragma once
// Rows that describe the keys of the scene file. Reading, checking, the JSON Schema and the tables of the
// pages all follow the rows (tables.hpp lists them), so that a key stands in two places: its row and its
// member. docs/how-to/add-a-scene-key.md walks through it.

#include "taut/scene/method_kind.hpp"
#include "taut/scene/scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace taut::scene_file {

class Checker;
class Field;
struct Table;

/// Largest magnitude of any value: more does not fit the float arithmetic of the kernels.
inline constexpr double kMaxValue = 1e30;
inline constexpr double kMaxCount = 4294967295.0;

/// What the file holds under a key, and with it the type of the member.
enum class Kind
{
    number,       ///< double
    count,        ///< std::uint32_t
    maybe_number, ///< std::optional<double>: none where the file has the key's word, or lacks the key
    maybe_count,  ///< std::optional<std::uint32_t>, likewise
    version,      ///< int
    boolean,      ///< bool
    text,         ///< std::string
    option,       ///< an enum with words (options.hpp)
    file,         ///< std::filesystem::path
    vector,       ///< glm::dvec3
    number_pair,  ///< glm::dvec2
    count_pair,   ///< glm::uvec2
    count_triple, ///< glm::uvec3
    counts,       ///< std::vector<std::uint32_t>
    numbers,      ///< std::vector<double>
    vectors,      ///< std::vector<glm::dvec3>
    texts,        ///< std::vector<std::string>
    object,       ///< the struct of another table, or the same struct
    objects,      ///< a list of these
    ignored       ///< a text that nothing keeps
};

/// Numbers that a value may be; of lists and vectors, each of theirs.
struct Limits
{
    double low = -kMaxValue, high = kMaxValue;
    bool above = false; ///< `low` itself is not allowed
    bool below = false; ///< `high` itself is not allowed

    constexpr bool has_low() const { return low > -kMaxValue; }
    constexpr bool has_high() const { return high < kMaxValue; }
    constexpr bool too_low(double v) const { return v < low || (above && v == low); }
    constexpr bool contains(double v) const
    {
        return !too_low(v) && (v < high || (!below && v == high)); // false for what is not a number
    }
};

/// The words that a text may be; `of`: the shape that has them, empty where it does not matter.
struct WordSet
{
    std::string_view of;
    std::span<const std::string_view> words;
};

/// The types of a row's structs, by address: rows stand in the table of their struct and nowhere else.
using TypeTag = const void*;
template <class T>
inline constexpr char kTypeTag = 0;

/// The value of an option by its place among the option's words.
struct OptionAccess
{
    std::size_t (*get)(const void*) = nullptr;
    void (*set)(void*, std::size_t) = nullptr;
};

/// How a list of objects grows and is walked.
struct ListAccess
{
    void* (*append)(void*) = nullptr; ///< a new last element, as its type is by default
    std::size_t (*size)(const void*) = nullptr;
    const void* (*element)(const void*, std::size_t) = nullptr;
};

/// One key of an object of the scene file. key(), object() and list() of rows.hpp make one; each of its
/// functions gives a copy that says one thing more, which the data member that it sets explains.
struct Key
{
    std::string_view name;
    std::string_view what; ///< one sentence, as the pages and the schema have it
    Kind kind = Kind::ignored;
    TypeTag owner = nullptr;
    void* (*at)(void*) = nullptr; ///< the member of a struct; the struct itself for objects that share it
    const Table* table = nullptr; ///< of an object or of each object of a list
    const Table* solid_table = nullptr; ///< instead of `table` where `solids` says so
    bool (*solids)(const void*) = nullptr;
    ListAccess access;
    OptionAccess option;

    std::string_view unit_text; ///< "kg/m^2"; in brackets what a number without a unit is: "(a strain)"
    Limits limits;
    std::string_view word;  ///< text that stands for `word_value`, or for no value
    double word_value = 0;  ///< beyond `limits`, or else a number may say it, too
    bool has_unset = false; ///< `unset`: what the member is where a file says nothing, beyond `limits`
    double unset = 0;
    std::array<WordSet, 2> word_sets; ///< of a text: nothing else is allowed
    std::string_view parts;           ///< of pairs and triples: "[columns, rows]"
    std::string_view reason;          ///< added to the message of a value out of range

    bool is_needed = false;
    std::string_view advice;   ///< what to write where a needed key lacks
    bool is_choice = false;    ///< one of the keys of which the table's `choice` speaks
    bool is_solid = false;     ///< of a choice: makes a body of tetrahedra
    bool is_single = false;    ///< one text for a member that is a list
    bool is_direction = false; ///< of a vector: not [0, 0, 0]
    bool is_ascending = false; ///< of a list's elements: from each to the next
    bool is_source = false;    ///< says where a body's mesh comes from: nothing to check where it has one
    std::string_view beside;   ///< the choice that it belongs to; "solids": any that makes one
    ErrorCode error = ErrorCode::bad_input;
    MethodSet readers = 0; ///< methods that read it; 0: all, or none of their business

    void (*begin)(void*) = nullptr;         ///< before the value is read, where the file has one
    bool (*present)(const void*) = nullptr; ///< whether the struct has it, so that it is checked; null: yes
    void (*own)(const Field&, void*) = nullptr; ///< reads it from the object that may have it

    std::string_view page, page_name; ///< of docs/, for more
    std::string_view default_text;    ///< for the pages, where the member's default says too little
    std::string_view range_text;      ///< for the pages, where limits and words say too little

    constexpr Key saying(std::string_view text) const { return with(&Key::what, text); }
    constexpr Key unit(std::string_view text) const { return with(&Key::unit_text, text); }
    constexpr Key above(double low) const { return with(low, limits.high, true, limits.below); }
    constexpr Key at_least(double low) const { return with(low, limits.high, false, limits.below); }
    constexpr Key below(double high) const { return with(limits.low, high, limits.above, true); }
    constexpr Key at_most(double high) const { return with(limits.low, high, limits.above, false); }
    constexpr Key range(double low, double high) const { return with(low, high, false, false); }
    constexpr Key or_word(std::string_view text, double value) const
    {
        Key key = with(&Key::word, text);
        key.word_value = value;
        return key;
    }
    constexpr Key or_word(std::string_view text) const { return with(&Key::word, text); }
    constexpr Key unset_as(double value) const
    {
        Key key = *this;
        key.has_unset = true;
        key.unset = value;
        return key;
    }
    constexpr Key words(std::span<const std::string_view> list, std::string_view of = {}) const
    {
        Key key = *this;
        key.word_sets[word_sets[0].words.empty() ? 0 : 1] = {of, list};
        return key;
    }
    constexpr Key called(std::string_view text) const { return with(&Key::parts, text); }
    constexpr Key because(std::string_view text) const { return with(&Key::reason, text); }
    constexpr Key needed(std::string_view text = {}) const
    {
        return with(&Key::is_needed).with(&Key::advice, text);
    }
    constexpr Key choice() const { return with(&Key::is_choice); }
    constexpr Key solid() const { return with(&Key::is_solid).choice(); }
    constexpr Key single() const { return with(&Key::is_single); }
    constexpr Key direction() const { return with(&Key::is_direction); }
    constexpr Key ascending() const { return with(&Key::is_ascending); }
    constexpr Key source() const { return with(&Key::is_source); }
    constexpr Key only_beside(std::string_view key) const { return with(&Key::beside, key); }
    constexpr Key code(ErrorCode which) const
    {
        Key key = *this;
        key.error = which;
        return key;
    }
    constexpr Key read_by(MethodSet methods) const
    {
        Key key = *this;
        key.readers = methods;
        return key;
    }
    constexpr Key see(std::string_view name_, std::string_view file) const
    {
        return with(&Key::page, file).with(&Key::page_name, name_);
    }
    constexpr Key usually(std::string_view text) const { return with(&Key::default_text, text); }
    constexpr Key ranges(std::string_view text) const { return with(&Key::range_text, text); }

    /// F: bool(const Owner&), whether the object has the keys of the other table.
    template <auto F>
    constexpr Key of_solids(const Table& other) const;
    /// F: void(Owner&)
    template <auto F>
    constexpr Key begins() const;
    /// F: bool(const Owner&)
    template <auto F>
    constexpr Key when() const;
    /// F: void(const Field& object, Owner&); also called where the file lacks the key.
    template <auto F>
    constexpr Key reads() const;

private:
    // One for each type and not a template: clang 14 would not evaluate that here.
    constexpr Key with(std::string_view Key::*member, std::string_view value) const
    {
        Key key = *this;
        key.*member = value;
        return key;
    }
    constexpr Key with(bool Key::*member) const
    {
        Key key = *this;
        key.*member = true;
        return key;
    }
    constexpr Key with(double low, double high, bool above_, bool below_) const
    {
        Key key = *this;
        key.limits = {low, high, above_, below_};
        return key;
    }
};

/// A key that one would look for in this object, and that means something elsewhere.
struct Stranger
{
    std::string_view name, advice;
};

enum class Choice
{
    none,
    exactly_one, ///< of the keys that are choices
    some         ///< one at least
};

/// All keys of one kind of object.
struct Table
{
    std::string_view name; ///< as docs/scene.md calls it
    std::span<const Key> keys;
    TypeTag owner = nullptr;
    Choice choice = Choice::none;
    std::span<const Stranger> strangers;
    std::shared_ptr<void> (*make)() = nullptr;            ///< a struct as its type is by default
    void (*begin)(void*) = nullptr;                       ///< other defaults, put in before a file is read
    void (*check)(const void*, const Checker&) = nullptr; ///< what takes more than one key

    const Key* find(std::string_view key) const
    {
        for (const Key& k : keys)
            if (k.name == key)
                return &k;
        return nullptr;
    }
};

} // namespace taut::scene_file
