#include "taut/scene/words.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace taut::scene_file {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

} // namespace

std::string quoted(std::string_view word)
{
    if (word.empty())
        return "nothing";
    std::string out = "\"";
    for (const char c : word.substr(0, 30))
        out += c >= ' ' && c <= '~' ? c : '?';
    return out + (word.size() > 30 ? "...\"" : "\"");
}

void Words::fail(const std::string& text) const
{
    throw Error(ErrorCode::bad_input, *file_ + ": line " + std::to_string(line_) + ": " + text);
}

/// To the next word or line end; false at the end of the line or text.
bool Words::skip_blanks()
{
    while (at_ < text_.size())
    {
        const char c = text_[at_];
        if (is_blank(c))
            ++at_;
        else if (joins_ && c == '\\' && text_.substr(at_ + 1, 1) == "\n")
            at_ += 2, ++line_;
        else if (joins_ && c == '\\' && text_.substr(at_ + 1, 2) == "\r\n")
            at_ += 3, ++line_;
        else if (c == comment_ && comment_ != '\0')
        {
            const std::size_t end = text_.find('\n', at_);
            at_ = end == std::string_view::npos ? text_.size() : end;
        }
        else
            return c != '\n';
    }
    return false;
}

bool Words::next_line()
{
    if (started_) // leave the rest of the current line
        while (word().size() > 0)
        {}
    started_ = true;
    while (!skip_blanks())
    {
        if (at_ >= text_.size())
            return false;
        ++at_;
        ++line_;
    }
    return true;
}

std::string_view Words::word()
{
    if (!skip_blanks())
        return {};
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n')
        ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view Words::any_word()
{
    started_ = true;
    while (!skip_blanks())
    {
        if (at_ >= text_.size())
            return {};
        ++at_;
        ++line_;
    }
    return word();
}

std::string_view Words::raw_line()
{
    started_ = true;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    if (end < text_.size())
        ++line_;
    at_ = std::min(end + 1, text_.size());
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

void Words::end_line()
{
    started_ = true;
    if (skip_blanks())
        fail("there is " + quoted(word()) + " where the line must end");
    if (at_ < text_.size())
        ++at_, ++line_;
}

std::string_view Words::take(std::size_t bytes)
{
    if (bytes > left())
        fail("the file ends in the middle of its values");
    const std::string_view taken = text_.substr(at_, bytes);
    line_ += static_cast<std::size_t>(std::count(taken.begin(), taken.end(), '\n'));
    at_ += bytes;
    return taken;
}

bool Words::skip_past(std::string_view mark)
{
    const std::size_t found = text_.find(mark, at_);
    if (found == std::string_view::npos)
        return false;
    take(found + mark.size() - at_);
    return true;
}

double Words::to_number(std::string_view word, std::string_view what) const
{
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
        fail(std::string(what) + " is " + quoted(word) + "; it must be a finite number");
    return value;
}

std::int64_t Words::to_integer(std::string_view word, std::string_view what) const
{
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    std::int64_t value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc() || end != digits.data() + digits.size())
        fail(std::string(what) + " is " + quoted(word) + "; it must be a whole number");
    return value;
}

double Words::number(std::string_view what) { return to_number(word(), what); }

std::int64_t Words::integer(std::string_view what) { return to_integer(word(), what); }

glm::dvec3 Words::position()
{
    const double x = number("x"), y = number("y"), z = number("z");
    return {x, y, z};
}

} // namespace taut::scene_file
