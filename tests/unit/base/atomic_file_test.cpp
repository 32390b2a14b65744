#include "support/catch.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;

class Folder
{
public:
    Folder() : path_(fs::temp_directory_path() / ("taut_atomic_file_" + std::to_string(getpid())))
    {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }

    fs::path operator/(const std::string& name) const { return path_ / name; }
    std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(path_), {}); }

private:
    fs::path path_;
};

std::string text_of(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("a file is replaced by exactly the new contents and nothing else is left in the folder")
{
    const Folder folder;
    taut::write_file(folder / "a", "a longer text that was there before");
    const std::string bytes("new\0\r\n\xff", 7);
    taut::write_file(folder / "a", bytes);
    CHECK(text_of(folder / "a") == bytes);
    CHECK(folder.entries() == 1);
}

TEST_CASE("a file that cannot be put in its place is an io error that names it and leaves nothing behind")
{
    const Folder folder;
    fs::create_directories(folder / "taken" / "inside"); // a folder cannot be replaced by a file
    for (const fs::path& file : {folder / "taken", folder / "missing" / "a"})
        try
        {
            taut::write_file(file, "text");
            FAIL(file.string() + " was written");
        }
        catch (const taut::Error& error)
        {
            CHECK(error.code() == taut::ErrorCode::io);
            CHECK(std::string(error.what()).find(file.string()) != std::string::npos);
        }
    CHECK(folder.entries() == 1);
}

TEST_CASE("a file that grows beyond what the system allows is an io error and leaves nothing behind")
{
    const Folder folder;
    const pid_t child = fork(); // the limit is of a whole process
    REQUIRE(child >= 0);
    if (child == 0)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        int end = setrlimit(RLIMIT_FSIZE, &limit) == 0 ? 1 : 2;
        try
        {
            taut::write_file(folder / "long", std::string(100'000, 'x'));
        }
        catch (const taut::Error& error)
        {
            end = end == 1 && error.code() == taut::ErrorCode::io ? 0 : 3;
        }
        _exit(end);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(folder.entries() == 0);
}

TEST_CASE("writers of one file at one time leave one of their texts whole")
{
    const Folder folder;
    std::vector<std::thread> writers;
    for (const char letter : {'a', 'b', 'c', 'd'})
        writers.emplace_back([&folder, letter] {
            for (int i = 0; i < 20; ++i)
                taut::write_file(folder / "shared", std::string(20'000, letter));
        });
    for (std::thread& writer : writers)
        writer.join();
    const std::string text = text_of(folder / "shared");
    REQUIRE(text.size() == 20'000);
    CHECK(text == std::string(20'000, text[0]));
    CHECK(folder.entries() == 1);
}

TEST_CASE("whether a file could be written is asked without a trace")
{
    const Folder folder;
    taut::write_file(folder / "a", "old");
    taut::check_writable(folder / "a");
    taut::check_writable(folder / "b");
    CHECK(text_of(folder / "a") == "old");
    CHECK(folder.entries() == 1);
    try
    {
        taut::check_writable(folder / "missing" / "a");
        FAIL("a folder that is not there takes files");
    }
    catch (const taut::Error& error)
    {
        CHECK(error.code() == taut::ErrorCode::io);
        CHECK(std::string(error.what()).find((folder / "missing" / "a").string()) != std::string::npos);
    }
}

TEST_CASE("a device or a pipe is written to and not replaced by a file")
{
    const Folder folder;
    const fs::path device = "/dev/null", pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    taut::check_writable(device);
    taut::check_writable(pipe); // and does not wait for a reader
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    taut::write_file(pipe, "text");
    char text[8] = {};
    CHECK(read(reader, text, sizeof text) == 4);
    CHECK(std::string(text) == "text");
    close(reader);
    fs::create_symlink(device, folder / "link"); // the device itself would be lost to all, if this failed
    taut::write_file(folder / "link", "text");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_character_file(folder / "link"));
    CHECK(fs::is_fifo(pipe));
    CHECK(folder.entries() == 2);
}

TEST_CASE("a file behind a link is replaced, and the link stays")
{
    const Folder folder;
    taut::write_file(folder / "a", "old");
    fs::create_symlink("a", folder / "link");
    taut::check_writable(folder / "link");
    taut::write_file(folder / "link", "new");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(text_of(folder / "a") == "new");
    CHECK(folder.entries() == 2);
}

TEST_CASE("a folder in the place of a file is called one, before any work and after it")
{
    const Folder folder;
    fs::create_directory(folder / "taken");
    for (const auto& act : {+[](const fs::path& file) { taut::check_writable(file); },
                            +[](const fs::path& file) { taut::write_file(file, "text"); }})
        try
        {
            act(folder / "taken");
            FAIL("a folder was taken for a file");
        }
        catch (const taut::Error& error)
        {
            CHECK(error.code() == taut::ErrorCode::io);
            CHECK(std::string(error.what()).find("it is a folder; name a file") != std::string::npos);
        }
    CHECK(folder.entries() == 1);
}
