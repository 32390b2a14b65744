#pragma once
// Runs the program `taut` as a user would: arguments in, exit status and two streams out.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace program {

struct Result
{
    int status = -1; ///< exit status, or minus the signal that ended it
    std::string out, err;
};

/// A folder of its own, gone with the object; also the working folder of the programs it starts.
class Folder
{
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// Writes a file into the folder and returns its path.
    std::string file(const std::string& name, const std::string& text) const;

    /// Starts the program. `meanwhile` is called again and again with the process id while it runs.
    Result taut(const std::vector<std::string>& arguments,
                const std::function<void(int)>& meanwhile = {}) const;

    /// Names of what is in the folder below, sorted.
    std::vector<std::string> list(const std::string& below) const;

private:
    std::filesystem::path path_;
};

std::string read(const std::filesystem::path& file);

/// Throws when the text is not one JSON value and nothing else.
nlohmann::json parse(const std::string& text);

} // namespace program
