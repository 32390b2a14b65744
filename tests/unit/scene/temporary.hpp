#pragma once
// A folder that lives as long as the test.

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

struct Temporary
{
    std::filesystem::path path;

    Temporary()
        : path(std::filesystem::temp_directory_path() /
               ("taut-test-" + std::to_string(std::random_device{}())))
    {
        std::filesystem::create_directories(path);
    }
    ~Temporary()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};
