#include "taut/runtime/base/atomic_file.hpp"

#include "taut/runtime/base/error.hpp"

#include <unistd.h>

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

/// What is written is what a link points to, not the link: /dev/stdout must not become a file.
fs::path behind_links(const fs::path& file)
{
    std::error_code code;
    if (!fs::is_symlink(file, code))
        return file;
    const fs::path target = fs::canonical(file, code);
    return code ? file : target; // of pipes under /proc there is no path, and of what is missing
}

/// Takes what is written to it and has no contents that a new file could replace.
bool is_stream(const fs::path& file)
{
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    return fs::is_character_file(status) || fs::is_fifo(status);
}

/// Empty, or why not.
std::string try_to_fill(const fs::path& file, std::string_view contents)
{
    std::ofstream stream(file, std::ios::binary);
    if (!stream)
        return std::strerror(errno);
    stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    stream.close(); // what was buffered fails here, not in the destructor
    return stream ? std::string() : std::strerror(errno);
}

/// Empty, or why not.
std::string try_to_replace(const fs::path& file, const fs::path& temporary, std::string_view contents)
{
    if (std::string why = try_to_fill(temporary, contents); !why.empty())
        return why;
    std::error_code code;
    fs::rename(temporary, file, code);
    return code ? code.message() : std::string();
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why)
{
    throw Error(ErrorCode::io, "cannot write " + file.string() + ": " + why +
                                   "; the folder must exist, be writable and have room.");
}

/// Of what is neither file nor stream.
void require_place(const fs::path& file)
{
    if (!is_free_for_file(file))
        throw Error(ErrorCode::io,
                    "cannot write " + file.string() + ": it is " + kind_of_file(file) + "; name a file.");
}

} // namespace

void write_file(const fs::path& file, std::string_view contents)
{
    if (is_stream(file))
    {
        if (const std::string why = try_to_fill(file, contents); !why.empty())
            throw Error(ErrorCode::io,
                        "cannot write to " + file.string() + ", " + kind_of_file(file) + ": " + why + ".");
        return;
    }
    require_place(file);
    const fs::path place = behind_links(file), temporary = temporary_name(place);
    const std::string why = try_to_replace(place, temporary, contents);
    if (why.empty())
        return;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    refuse(file, why);
}

void check_writable(const fs::path& file)
{
    if (is_stream(file))
    {
        if (access(file.c_str(), W_OK) != 0) // opening a pipe would wait for its reader
            throw Error(ErrorCode::io, "cannot write to " + file.string() + ", " + kind_of_file(file) + ": " +
                                           std::strerror(errno) + ".");
        return;
    }
    require_place(file);
    const fs::path temporary = temporary_name(behind_links(file));
    const bool made = std::ofstream(temporary, std::ios::binary).is_open();
    const int why = errno;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    if (!made)
        refuse(file, std::strerror(why));
}

bool is_free_for_file(const fs::path& file)
{
    std::error_code code; // an error, where nothing is there yet
    const fs::file_status status = fs::status(file, code);
    return !fs::exists(status) || fs::is_regular_file(status);
}

std::string kind_of_file(const fs::path& file)
{
    std::error_code code;
    switch (fs::status(file, code).type())
    {
    case fs::file_type::not_found: return "nothing";
    case fs::file_type::regular: return "a file";
    case fs::file_type::directory: return "a folder";
    case fs::file_type::fifo: return "a pipe";
    case fs::file_type::character: return "a character device";
    case fs::file_type::block: return "a block device";
    case fs::file_type::socket: return "a socket";
    default: return "no file";
    }
}

} // namespace taut
