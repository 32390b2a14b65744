#include "taut/linear/format.hpp"

#include "taut/runtime/base/error.hpp"

#include <array>

namespace taut::linear {
namespace {

constexpr std::array kFormats = {Format::dense, Format::coo,  Format::csr,
                                 Format::ell,   Format::sell, Format::bcsr3};
constexpr std::array<std::string_view, 7> kWords = {"auto", "dense", "coo", "csr", "ell", "sell", "bcsr3"};

} // namespace

std::string_view to_string(Format format) { return kWords[static_cast<std::size_t>(format)]; }

Format format_from(std::string_view word)
{
    std::string words;
    for (std::size_t k = 0; k < kWords.size(); ++k)
    {
        if (kWords[k] == word)
            return static_cast<Format>(k);
        words += (k == 0 ? "\"" : ", \"") + std::string(kWords[k]) + '"';
    }
    throw Error(ErrorCode::bad_input, "\"" + std::string(word) + "\" is no matrix format: take one of " + words);
}

std::span<const Format> all_formats() { return kFormats; }

} // namespace taut::linear
