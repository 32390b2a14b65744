#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace taut {

/// Writes beside the file under a temporary name that no other writer uses, in this process or another,
/// then renames: a reader never sees half a file. When that fails, nothing is left behind and the old
/// file is as it was. A link is followed. A pipe or a character device (/dev/null) is not replaced but
/// written to; a folder or anything else is refused. Throws Error{io} naming the file and the reason.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// Throws what write_file would when its folder takes no file, or what stands there takes no text; for asking
/// before long work. Makes an empty file beside the named one, under a temporary name, and removes it.
void check_writable(const std::filesystem::path& file);

/// Whether nothing is there or a regular file. A folder, a device or a pipe is somebody else's, and to open a
/// pipe may wait forever.
bool is_free_for_file(const std::filesystem::path& file);

/// "a folder", "a pipe", "a character device": what stands there, for messages. "nothing" where nothing does.
std::string kind_of_file(const std::filesystem::path& file);

} // namespace taut
