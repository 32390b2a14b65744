#include "taut/scene/file_text.hpp"

#include "taut/runtime/base/error.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>

namespace taut::scene_file {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& text)
{
    throw Error(ErrorCode::io, file.string() + ": " + text);
}

/// Unique among processes and threads that write the same file at the same time.
std::filesystem::path temporary_name(const std::filesystem::path& file)
{
    static const std::uint32_t process = std::random_device{}();
    static std::atomic<std::uint32_t> next{0};
    return file.string() + "." + std::to_string(process) + "-" + std::to_string(next++) + ".tmp";
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

void write_file(const std::filesystem::path& file, const std::string& contents)
{
    const std::filesystem::path temporary = temporary_name(file);
    std::ofstream stream(temporary, std::ios::binary);
    if (!stream)
        fail(file, std::string("it cannot be created: ") + std::strerror(errno) + "; does the folder exist?");
    stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    stream.close();
    std::error_code code;
    if (stream)
        std::filesystem::rename(temporary, file, code);
    else
        code = std::make_error_code(std::errc::io_error);
    if (!code)
        return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    fail(file, "it cannot be written: " + code.message() + "; is there room, and is it writable?");
}

} // namespace taut::scene_file
