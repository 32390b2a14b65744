#pragma once
// Numbers of files that hold them as text or as bytes, behind one face.

#include "taut/scene/words.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace taut::scene_file {

enum class Form
{
    text,
    little_endian,
    big_endian
};

/// Starts as text. Every read throws Error{bad_input} naming the line of a text, the byte of bytes.
class Values
{
public:
    Values(std::string_view text, const std::string& file, std::size_t line = 1);

    Words& words() { return words_; } ///< for what is text in either form
    void set_form(Form form) { form_ = form; }
    const Words& words() const { return words_; }
    bool binary() const { return form_ != Form::text; }
    /// Before a block of numbers: bytes start behind the line end, text anywhere.
    void begin_block();

    /// A signed whole number of 1, 2, 4 or 8 bytes.
    std::int64_t integer(std::size_t bytes, std::string_view what);
    /// A finite number of 4 or 8 bytes.
    double number(std::size_t bytes, std::string_view what);
    glm::dvec3 position(std::size_t bytes);
    /// Passes over so many numbers.
    void skip(std::size_t numbers, std::size_t bytes);

    /// `announced` entries of so many numbers and bytes each; refuses what the file has no room for.
    std::size_t count(std::int64_t announced, std::size_t numbers, std::size_t bytes,
                      std::string_view what) const;
    /// The next word, which must be this one.
    void expect(std::string_view keyword);
    [[noreturn]] void fail(const std::string& text) const;

private:
    std::uint64_t bits(std::size_t bytes);

    const std::string* file_;
    Form form_ = Form::text;
    Words words_;
};

} // namespace taut::scene_file
