#include "taut/scene/values.hpp"

#include "taut/runtime/base/error.hpp"

#include <bit>
#include <cmath>

namespace taut::scene_file {

Values::Values(std::string_view text, const std::string& file, std::size_t line)
    : file_(&file),
      words_(text, file, line)
{
    words_.set_comment('\0');
}

void Values::fail(const std::string& text) const
{
    if (binary()) // lines mean nothing among bytes
        throw Error(ErrorCode::bad_input, *file_ + ": byte " + std::to_string(words_.offset()) + ": " + text);
    words_.fail(text);
}

void Values::begin_block()
{
    if (binary())
        words_.end_line();
}

std::uint64_t Values::bits(std::size_t bytes)
{
    if (bytes > words_.left())
        fail("the file ends in the middle of its values");
    const std::string_view taken = words_.take(bytes);
    std::uint64_t out = 0;
    for (std::size_t b = 0; b < bytes; ++b)
    {
        const std::size_t from = form_ == Form::little_endian ? b : bytes - 1 - b;
        out |= std::uint64_t(static_cast<unsigned char>(taken[from])) << (8 * b);
    }
    return out;
}

std::int64_t Values::integer(std::size_t bytes, std::string_view what)
{
    if (!binary())
        return words_.to_integer(words_.any_word(), what);
    const std::size_t unused = 64 - 8 * bytes; // moved out and back, the sign comes along
    return static_cast<std::int64_t>(bits(bytes) << unused) >> unused;
}

double Values::number(std::size_t bytes, std::string_view what)
{
    if (!binary())
        return words_.to_number(words_.any_word(), what);
    const double value = bytes == 4 ? double(std::bit_cast<float>(static_cast<std::uint32_t>(bits(4))))
                                    : std::bit_cast<double>(bits(8));
    if (!std::isfinite(value))
        fail(std::string(what) + " is not finite; every number must be");
    return value;
}

glm::dvec3 Values::position(std::size_t bytes)
{
    glm::dvec3 p(0);
    for (int c = 0; c < 3; ++c)
        p[c] = number(bytes, "a coordinate");
    return p;
}

void Values::skip(std::size_t numbers, std::size_t bytes)
{
    if (binary())
    {
        if (numbers > words_.left() / bytes)
            fail("the file ends in the middle of its values");
        words_.take(numbers * bytes);
        return;
    }
    for (; numbers > 0; --numbers)
        if (words_.any_word().empty())
            fail("the file ends in the middle of its values");
}

std::size_t Values::count(std::int64_t announced, std::size_t numbers, std::size_t bytes,
                          std::string_view what) const
{
    // A number of a text takes a digit and what parts it from the next.
    const std::size_t each = binary() ? bytes : 2 * numbers;
    if (announced < 0 || static_cast<std::uint64_t>(announced) > (words_.left() + 1) / each)
        fail("the file announces " + std::to_string(announced) + " " + std::string(what) + "; the " +
             std::to_string(words_.left()) + " bytes left have no room for so many");
    return static_cast<std::size_t>(announced);
}

void Values::expect(std::string_view keyword)
{
    const std::string_view found = words_.any_word();
    if (found != keyword)
        fail("there is " + quoted(found) + " where \"" + std::string(keyword) + "\" must stand");
}

} // namespace taut::scene_file
