#include "taut/cli/process.hpp"

#include "taut/cli/interrupt.hpp"
#include "taut/runtime/base/error.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr const char* kOutput = "output.txt";
constexpr int kNotStarted = 127;

/// In the child, where only what is safe after fork may be called. Never returns.
[[noreturn]] void become(const char* program, char* const* words, const char* folder)
{
    // Handlers of the parent fall away with exec; a group of its own would keep Ctrl-C from it.
    if (chdir(folder) != 0)
        _exit(kNotStarted);
    const int input = open("/dev/null", O_RDONLY);
    const int output = open(kOutput, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (input < 0 || output < 0 || dup2(input, 0) < 0 || dup2(output, 1) < 0 || dup2(output, 2) < 0)
        _exit(kNotStarted);
    execv(program, words);
    _exit(kNotStarted);
}

/// Waits for the child; the first interrupt is passed on to it.
int wait_for(pid_t child, const InterruptGuard& guard, bool& interrupted)
{
    int status = 0;
    pid_t ended = 0;
    for (; ended == 0; ended = waitpid(child, &status, WNOHANG))
    {
        if (guard.interrupted() && !interrupted)
        {
            interrupted = true;
            kill(child, SIGTERM);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    interrupted = interrupted || guard.interrupted();
    if (ended < 0)
        throw Error(ErrorCode::io, std::string("the program's end cannot be seen: ") + std::strerror(errno));
    return status;
}

std::string last_line(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string line, last;
    while (std::getline(stream, line))
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            last = line.substr(0, 200);
    for (char& c : last)
        if (c < ' ' || c > '~')
            c = ' ';
    last.erase(0, last.find_first_not_of(' '));
    last.erase(last.find_last_not_of(' ') + 1);
    return last;
}

} // namespace

std::optional<fs::path> find_program(const std::string& name)
{
    const char* variable = std::getenv("PATH");
    const std::string folders = variable ? variable : "/usr/local/bin:/usr/bin:/bin";
    for (std::size_t begin = 0; begin <= folders.size();)
    {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        const fs::path folder = folders.substr(begin, end - begin);
        begin = end + 1;
        std::error_code ignored;
        const fs::path file = folder / name;
        if (folder.is_absolute() && fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
            return file;
    }
    return {};
}

ProcessEnd run_process(const fs::path& program, const std::vector<std::string>& arguments,
                       const fs::path& folder)
{
    std::vector<std::string> text = {program.string()};
    text.insert(text.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : text)
        words.push_back(word.data());
    words.push_back(nullptr);
    const InterruptGuard guard; // before there is a child that an early interrupt would leave behind
    const pid_t child = fork();
    if (child < 0)
        throw Error(ErrorCode::io, "cannot start " + program.string() + ": " + std::strerror(errno));
    if (child == 0)
        become(text[0].c_str(), words.data(), folder.c_str());
    ProcessEnd end;
    const int status = wait_for(child, guard, end.interrupted);
    if (WIFSIGNALED(status))
        end.failure = "signal " + std::to_string(WTERMSIG(status));
    else if (WEXITSTATUS(status) == kNotStarted)
        throw Error(ErrorCode::io, "cannot start " + program.string() + " in " + folder.string());
    else if (WEXITSTATUS(status) != 0)
        end.failure = "status " + std::to_string(WEXITSTATUS(status));
    end.last_words = last_line(folder / kOutput);
    return end;
}

TemporaryFolder::TemporaryFolder()
{
    std::error_code code;
    std::string pattern = (fs::temp_directory_path(code) / "taut-XXXXXX").string();
    if (code || mkdtemp(pattern.data()) == nullptr)
        throw Error(ErrorCode::io, "cannot make a folder for temporary files: " +
                                       (code ? code.message() : std::string(std::strerror(errno))) +
                                       "; TMPDIR may name another place.");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace taut::cli
