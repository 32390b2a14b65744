// Files of signed distances: "ni nj nk", "x y z" of the first point, the distance of neighbours, then the
// values, x fastest, each where text has a word. SDFGen writes one a line; so do we.

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/distance_field.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/words.hpp"

#include <charconv>

namespace taut {
namespace {

using scene_file::Words;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t(1) << 34;

std::uint32_t point_count(Words& words)
{
    const std::string_view word = words.any_word();
    const std::int64_t count = words.to_integer(word, "a number of points along an axis");
    if (count < 2 || count > static_cast<std::int64_t>(kMostFieldPoints))
        words.fail("a number of points along an axis is " + std::to_string(count) +
                   "; it must be from 2 to 2^30 (the file begins with three of them)");
    return static_cast<std::uint32_t>(count);
}

double next_number(Words& words, std::string_view what) { return words.to_number(words.any_word(), what); }

/// A text has two bytes a value at least: what it has no room for is refused before memory is taken.
std::size_t value_count(const DistanceField& field, const Words& words)
{
    std::size_t count = 1;
    for (const std::uint32_t n : field.points)
    {
        if (n > (words.left() + 1) / 2 / count)
            words.fail("the grid has " + std::to_string(field.points[0]) + " x " +
                       std::to_string(field.points[1]) + " x " + std::to_string(field.points[2]) +
                       " points, for which the file is too short");
        count *= n;
    }
    return count;
}

template <typename Number>
void append(std::string& text, Number value, char end)
{
    char digits[32];
    const auto done = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, done.ptr);
    text += end;
}

} // namespace

DistanceField read_distance_field(const std::filesystem::path& file)
{
    const std::string name = file.string();
    const std::string text = scene_file::read_file(file, kMaxBytes);
    Words words(text, name);
    DistanceField field;
    for (std::uint32_t& points : field.points)
        points = point_count(words);
    for (int axis = 0; axis < 3; ++axis)
        field.low[axis] = next_number(words, "a coordinate of the first point");
    field.cell = next_number(words, "the distance of neighbours");
    field.values.resize(value_count(field, words));
    for (float& value : field.values)
        value = static_cast<float>(next_number(words, "a distance"));
    if (const std::string_view more = words.any_word(); !more.empty())
        words.fail("more values stand here than the grid has points (" + std::to_string(field.values.size()) +
                   ")");
    if (const std::string fault = fault_of(field); !fault.empty())
        throw Error(ErrorCode::bad_input, name + ": the grid " + fault + ".");
    return field;
}

void write_distance_field(const std::filesystem::path& file, const DistanceField& field)
{
    std::string text;
    text.reserve(12 * field.values.size() + 100);
    for (std::size_t axis = 0; axis < 3; ++axis)
        text += std::to_string(field.points[axis]) + (axis == 2 ? '\n' : ' ');
    for (int axis = 0; axis < 3; ++axis)
        append(text, field.low[axis], axis == 2 ? '\n' : ' ');
    append(text, field.cell, '\n');
    for (const float value : field.values)
        append(text, value, '\n');
    write_file(file, text);
}

} // namespace taut
