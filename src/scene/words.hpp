#pragma once
// Reads text files word by word, remembering the line for messages. Never reads past the text.

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace taut::scene_file {

class Words
{
public:
    /// `line`: of the file, where the text starts.
    Words(std::string_view text, const std::string& file, std::size_t line = 1)
        : text_(text),
          file_(&file),
          line_(line)
    {}

    /// Goes to the next line that has a word; false at the end. `#` starts a comment.
    bool next_line();
    /// The next word of the line; empty at its end.
    std::string_view word();
    /// The next word of the text, over line ends; empty at its end.
    std::string_view any_word();

    /// The rest of the line as it is, without its end; goes past that.
    std::string_view raw_line();
    /// Goes past the end of the line; refuses a line that has another word.
    void end_line();
    /// The next bytes, whatever they are; refuses when the text has fewer left.
    std::string_view take(std::size_t bytes);
    /// Goes behind the next `mark`; false, and nowhere, if there is none.
    bool skip_past(std::string_view mark);

    /// The next word (of the line) as a finite number, a position, or a whole number.
    double number(std::string_view what);
    glm::dvec3 position();
    std::int64_t integer(std::string_view what);

    /// A word as a number; refuses what is not one, and what is not finite.
    double to_number(std::string_view word, std::string_view what) const;
    std::int64_t to_integer(std::string_view word, std::string_view what) const;

    std::size_t offset() const { return at_; } ///< bytes consumed
    std::size_t left() const { return text_.size() - at_; }
    void set_comment(char mark) { comment_ = mark; }
    /// A backslash before the line end joins two lines (OBJ).
    void join_lines() { joins_ = true; }

    [[noreturn]] void fail(const std::string& text) const;

private:
    bool skip_blanks();

    std::string_view text_;
    const std::string* file_;
    std::size_t at_ = 0, line_;
    bool started_ = false, joins_ = false;
    char comment_ = '#';
};

/// A word for messages: printable, cut short, in quotes.
std::string quoted(std::string_view word);

} // namespace taut::scene_file
