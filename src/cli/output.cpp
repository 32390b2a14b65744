#include "taut/cli/output.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>

namespace fs = std::filesystem;

namespace taut::cli {

void make_folder(const fs::path& folder, const std::string& option)
{
    std::error_code error;
    fs::create_directories(folder, error);
    std::error_code ignored;
    if (error || !fs::is_directory(folder, ignored))
        throw Error(ErrorCode::io, "cannot make the folder " + folder.string() + ": " +
                                       (error ? error.message() : "a file of this name is in the way") +
                                       "; choose another with " + option + ".");
}

std::string to_text(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json known(double value)
{
    return value < 0 ? Json(nullptr) : Json(value);
}

std::string table(const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t column = 0; column < row.size(); ++column)
        {
            if (column == widths.size())
                widths.push_back(0);
            widths[column] = std::max(widths[column], row[column].size());
        }
    std::string text;
    for (const auto& row : rows)
    {
        for (std::size_t column = 0; column < row.size(); ++column)
        {
            const std::string space(widths[column] - row[column].size(), ' ');
            text += column == 0 ? row[column] + space : "  " + space + row[column];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

std::string bytes_text(std::uint64_t bytes)
{
    if (bytes < 1024)
        return std::to_string(bytes) + " B";
    const char* const units[] = {"KiB", "MiB", "GiB", "TiB"};
    double value = static_cast<double>(bytes) / 1024;
    std::size_t unit = 0;
    for (; value >= 1024 && unit < 3; ++unit)
        value /= 1024;
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 1).ptr;
    return std::string(text, end) + " " + units[unit];
}

std::string number(double value, int digits) { return shown(value, digits); }

void warn(const std::string& sentence)
{
    std::cout.flush();
    std::fprintf(stderr, "taut: warning: %s\n", sentence.c_str());
}

} // namespace taut::cli
