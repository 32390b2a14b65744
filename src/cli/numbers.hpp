#pragma once
// Checks of options that take numbers, with sentences that say what would be right.

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <string>

namespace taut::cli {

inline constexpr std::uint32_t kAnyCount = std::numeric_limits<std::uint32_t>::max();

/// Takes decimal digits of a whole number of `least` to `most`, before they are converted.
CLI::Validator whole_number(std::uint32_t least, std::uint32_t most = kAnyCount);

/// Ends of an interval of numbers.
enum class Ends
{
    open,  ///< both ends are outside
    closed ///< both are inside
};

/// Takes a finite decimal number between two, before it is converted. `most` infinite: any above `least`.
/// `hint` ends the sentence: " (0.01 is 1 %)".
CLI::Validator number_between(double least, double most, Ends ends, const std::string& hint = "");

/// What CLI11 says of a value that such a check refused ("--frames: is \"-3\"; ...") as a sentence.
std::string sentence(const CLI::ParseError& error);

} // namespace taut::cli
