#include "cli/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace fs = std::filesystem;

namespace program {
namespace {

/// In the child: streams to files, working folder, then the program. Never returns.
[[noreturn]] void become(std::vector<char*> words, const fs::path& folder)
{
    const auto redirect = [&](const char* name, int stream) {
        dup2(open((folder / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    };
    redirect("stdout.txt", STDOUT_FILENO);
    redirect("stderr.txt", STDERR_FILENO);
    if (chdir(folder.c_str()) == 0)
        execv(words[0], words.data());
    _exit(127);
}

} // namespace

Folder::Folder()
{
    std::string pattern = (fs::temp_directory_path() / "taut-cli-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("cannot make " + pattern);
    path_ = pattern;
}

Folder::~Folder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string Folder::file(const std::string& name, const std::string& text) const
{
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
}

Result Folder::taut(const std::vector<std::string>& arguments,
                    const std::function<void(int)>& meanwhile) const
{
    std::vector<std::string> text = {TAUT_PROGRAM};
    text.insert(text.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : text)
        words.push_back(word.data());
    words.push_back(nullptr);

    const pid_t process = fork();
    if (process == 0)
        become(words, path_);
    int status = 0;
    while (meanwhile && waitpid(process, &status, WNOHANG) == 0)
    {
        meanwhile(process);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (!meanwhile)
        waitpid(process, &status, 0);
    Result result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result.out = read(path_ / "stdout.txt");
    result.err = read(path_ / "stderr.txt");
    return result;
}

std::vector<std::string> Folder::list(const std::string& below) const
{
    std::vector<std::string> names;
    if (fs::exists(path_ / below))
        for (const auto& entry : fs::directory_iterator(path_ / below))
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string read(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

nlohmann::json parse(const std::string& text) { return nlohmann::json::parse(text); }

} // namespace program
