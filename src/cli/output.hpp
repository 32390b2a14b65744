#pragma once
// What commands write: JSON, tables of text.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

/// Keys stay in the order in which they are set.
using Json = nlohmann::ordered_json;

/// Makes the folder and its parents. Throws Error{io} when that cannot be done; `option` is the one that
/// named it.
void make_folder(const std::filesystem::path& folder, const std::string& option = "--out");

/// Indented, with a line end. Text that is not UTF-8 is replaced, numbers that are not finite become null.
std::string to_text(const Json& json);

/// What a report does not know is below zero there, and null for the reader.
Json known(double value);

/// Columns of equal width, the first to the left and the others to the right. rows[0] is the head.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// "812 B", "3.4 KiB", "12.0 MiB"
std::string bytes_text(std::uint64_t bytes);

/// printf("%.*g") in the "C" locale
std::string number(double value, int digits = 4);

/// On standard error: "taut: warning: <sentence>"
void warn(const std::string& sentence);

} // namespace taut::cli
