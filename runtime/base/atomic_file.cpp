#include "taut/runtime/base/atomic_file.hpp"

#include "taut/runtime/base/error.hpp"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <string>

namespace taut {
namespace {

namespace fs = std::filesystem;

fs::path temporary_name(const fs::path& file)
{
    static const std::uint32_t process = std::random_device{}();
    static std::atomic<std::uint32_t> next{0};
    return file.string() + "." + std::to_string(process) + "-" + std::to_string(next++) + ".tmp";
}

/// Empty, or why not.
std::string try_to_write(const fs::path& file, const fs::path& temporary, std::string_view contents)
{
    std::ofstream stream(temporary, std::ios::binary);
    if (!stream)
        return std::strerror(errno);
    stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    stream.close(); // what was buffered fails here, not in the destructor
    if (!stream)
        return std::strerror(errno);
    std::error_code code;
    fs::rename(temporary, file, code);
    return code ? code.message() : std::string();
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why)
{
    throw Error(ErrorCode::io, "cannot write " + file.string() + ": " + why +
                                   "; the folder must exist, be writable and have room.");
}

} // namespace

void write_file(const fs::path& file, std::string_view contents)
{
    const fs::path temporary = temporary_name(file);
    const std::string why = try_to_write(file, temporary, contents);
    if (why.empty())
        return;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    refuse(file, why);
}

void check_writable(const fs::path& file)
{
    const fs::path temporary = temporary_name(file);
    const bool made = std::ofstream(temporary, std::ios::binary).is_open();
    const int why = errno;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    if (!made)
        refuse(file, std::strerror(why));
}

bool is_free_for_file(const std::filesystem::path& file)
{
    std::error_code code; // an error, where nothing is there yet
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

} // namespace taut
