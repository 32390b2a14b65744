#pragma once
// Other people's programs, started without a shell.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// The program of this name in the folders of PATH; relative ones are passed over.
std::optional<std::filesystem::path> find_program(const std::string& name);

struct ProcessEnd
{
    bool interrupted = false; ///< by Ctrl-C or SIGTERM, which ended it too
    std::string failure;      ///< "status 3", "signal 6"; empty when it ended with 0
    std::string last_words;   ///< the last line that it printed, printable and cut short
};

/// Runs it in `folder` to its end, with nothing to read; what it prints goes to a file there. Throws
/// Error{io} when it cannot be started.
ProcessEnd run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder);

/// A new folder below the system's one for temporary files; gone with the object. Throws Error{io}.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace taut::cli
