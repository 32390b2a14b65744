// Where the program writes: never over what is not its own.

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <filesystem>

using program::Folder;
using program::Result;

TEST_CASE("x goes through a link to a device, which stays one")
{
    const Folder folder;
    const std::string matrix =
        folder.file("a.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 2\n2 2 4\n");
    std::filesystem::create_symlink("/dev/null", folder / "sink"); // the device itself is everybody's
    for (const char* option : {"--out", "--history"})
    {
        const Result result = folder.taut({"solve", matrix, option, folder / "sink"});
        INFO(result.err);
        CHECK(result.status == 0);
        CHECK(std::filesystem::is_symlink(folder / "sink"));
        CHECK(std::filesystem::is_character_file(folder / "sink"));
        CHECK(folder.taut({"solve", matrix, option, folder.path()}).status == 2);
    }
}
