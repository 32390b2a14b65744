#include "taut/scene/file_text.hpp"

#include "taut/runtime/base/error.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace taut::scene_file {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& text)
{
    throw Error(ErrorCode::io, file.string() + ": " + text);
}

} // namespace

std::string read_file(const std::filesystem::path& file, std::uintmax_t max_bytes)
{
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status))
        fail(file,
             "there is no such file (looked for " + std::filesystem::absolute(file, code).string() + ")");
    if (!std::filesystem::is_regular_file(status))
        fail(file, "this is not a regular file; name a file");
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    if (code)
        fail(file, "its size cannot be read: " + code.message());
    if (bytes > max_bytes)
        throw Error(ErrorCode::bad_input, file.string() + ": it has " + std::to_string(bytes) +
                                              " bytes; at most " + std::to_string(max_bytes) + " are read");
    std::ifstream stream(file, std::ios::binary);
    std::string text(static_cast<std::size_t>(bytes), '\0');
    if (!stream || !stream.read(text.data(), static_cast<std::streamsize>(bytes)))
        fail(file, std::string("it cannot be read: ") + std::strerror(errno));
    return text;
}

} // namespace taut::scene_file
