#pragma once
// The header of a PLY file, and its values one after another, whatever their encoding.

#include "taut/scene/words.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

enum class PlyType
{
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64
};
enum class PlyFormat
{
    ascii,
    little_endian,
    big_endian
};

struct PlyProperty
{
    std::string name;
    PlyType type = PlyType::float32;
    bool list = false;
    PlyType count_type = PlyType::uint8; ///< of a list
};

struct PlyElement
{
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader
{
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0; ///< where the values start
};

PlyHeader read_ply_header(std::string_view text, const std::string& file);

class PlyValues
{
public:
    PlyValues(std::string_view body, const std::string& file, PlyFormat format);

    /// Refuses an element whose count cannot fit in what is left.
    void expect_room(const PlyElement& element) const;
    double value(PlyType type);
    std::size_t list_size(const PlyProperty& property);
    void skip(const PlyProperty& property);
    [[noreturn]] void fail(const std::string& text) const;

private:
    std::size_t left() const;
    double binary(PlyType type);

    std::string_view body_;
    const std::string* file_;
    PlyFormat format_;
    std::size_t at_ = 0;
    Words words_;
};

} // namespace taut::scene_file
