#include "taut/scene/ply_values.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/checker.hpp"

#include <array>
#include <bit>
#include <cmath>

namespace taut::scene_file {

namespace {

struct TypeName
{
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> kTypes = {{{"char", PlyType::int8},
                                              {"int8", PlyType::int8},
                                              {"uchar", PlyType::uint8},
                                              {"uint8", PlyType::uint8},
                                              {"short", PlyType::int16},
                                              {"int16", PlyType::int16},
                                              {"ushort", PlyType::uint16},
                                              {"uint16", PlyType::uint16},
                                              {"int", PlyType::int32},
                                              {"int32", PlyType::int32},
                                              {"uint", PlyType::uint32},
                                              {"uint32", PlyType::uint32},
                                              {"float", PlyType::float32},
                                              {"float32", PlyType::float32},
                                              {"double", PlyType::float64},
                                              {"float64", PlyType::float64}}};

constexpr std::size_t bytes_of(PlyType type)
{
    switch (type)
    {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::float64: return 8;
    default: return 4;
    }
}

PlyType type_named(std::string_view name, const Words& words)
{
    for (const TypeName& known : kTypes)
        if (known.name == name)
            return known.type;
    words.fail("a property has the type " + quoted(name) +
               "; it must be char, uchar, short, ushort, int, uint, float or double");
}

PlyFormat format_named(std::string_view name, const Words& words)
{
    if (name == "ascii")
        return PlyFormat::ascii;
    if (name == "binary_little_endian")
        return PlyFormat::little_endian;
    if (name == "binary_big_endian")
        return PlyFormat::big_endian;
    words.fail("the format is " + quoted(name) +
               "; it must be ascii, binary_little_endian or binary_big_endian");
}

PlyProperty read_property(Words& words)
{
    PlyProperty property;
    std::string_view type = words.word();
    if (type == "list")
    {
        property.list = true;
        property.count_type = type_named(words.word(), words);
        if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
            words.fail("a list has a count that is not whole; its type must be an integer's");
        type = words.word();
    }
    property.type = type_named(type, words);
    property.name = words.word();
    return property;
}

} // namespace

PlyHeader read_ply_header(std::string_view text, const std::string& file)
{
    // The words of the header only: binary values behind it are no lines.
    const std::size_t end = text.find("\nend_header");
    const std::size_t stop = end == std::string_view::npos ? end : text.find('\n', end + 1);
    Words words(text.substr(0, end), file);
    words.set_comment('\0');
    if (!words.next_line() || words.word() != "ply")
        words.fail("the file does not start with \"ply\" as a PLY file must");
    if (stop == std::string_view::npos)
        words.fail("the header has no line \"end_header\"");
    PlyHeader header;
    header.bytes = stop + 1;
    bool has_format = false;
    while (words.next_line())
    {
        const std::string_view keyword = words.word();
        if (keyword == "format")
        {
            header.format = format_named(words.word(), words);
            has_format = true;
        }
        else if (keyword == "element")
        {
            const std::string name(words.word());
            const std::int64_t count = words.integer("the count of an element");
            if (count < 0)
                words.fail("the count of an element is " + std::to_string(count) + "; it must be 0 or more");
            header.elements.push_back({name, static_cast<std::size_t>(count), {}});
        }
        else if (keyword == "property" && !header.elements.empty())
            header.elements.back().properties.push_back(read_property(words));
        else if (keyword != "comment" && keyword != "obj_info")
            words.fail("the header has " + quoted(keyword) +
                       "; it may have format, element, property (after an element), comment and obj_info");
    }
    if (!has_format)
        words.fail("the header lacks the line \"format\"");
    return header;
}

PlyValues::PlyValues(std::string_view body, const std::string& file, PlyFormat format)
    : body_(body),
      file_(&file),
      format_(format),
      words_(body, file)
{
    words_.set_comment('\0');
}

std::size_t PlyValues::left() const
{
    return format_ == PlyFormat::ascii ? words_.left() : body_.size() - at_;
}

void PlyValues::fail(const std::string& text) const
{
    throw Error(ErrorCode::bad_input, *file_ + ": after the header: " + text);
}

void PlyValues::expect_room(const PlyElement& element) const
{
    std::size_t each = 0; // the fewest bytes of one
    for (const PlyProperty& property : element.properties)
        if (format_ == PlyFormat::ascii)
            each += 2;
        else
            each += bytes_of(property.list ? property.count_type : property.type);
    // The last word of a text needs no blank behind it.
    if (each > 0 && element.count > (left() + 1) / each)
        fail("the header announces " + std::to_string(element.count) + " of \"" + element.name.substr(0, 30) +
             "\"; the " + std::to_string(left()) + " bytes left have no room for so many");
    if (each == 0 && element.count > 0 && (element.name == "vertex" || element.name == "face"))
        fail("the element \"" + element.name + "\" has no properties");
}

double PlyValues::binary(PlyType type)
{
    const std::size_t bytes = bytes_of(type);
    if (bytes > left())
        fail("the file ends in the middle of its values");
    std::uint64_t bits = 0;
    for (std::size_t b = 0; b < bytes; ++b)
    {
        const std::size_t from = format_ == PlyFormat::little_endian ? b : bytes - 1 - b;
        bits |= std::uint64_t(static_cast<unsigned char>(body_[at_ + from])) << (8 * b);
    }
    at_ += bytes;
    switch (type)
    {
    case PlyType::int8: return static_cast<std::int8_t>(bits);
    case PlyType::int16: return static_cast<std::int16_t>(bits);
    case PlyType::int32: return static_cast<std::int32_t>(bits);
    case PlyType::float32: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case PlyType::float64: return std::bit_cast<double>(bits);
    default: return static_cast<double>(bits);
    }
}

double PlyValues::value(PlyType type)
{
    return format_ == PlyFormat::ascii ? words_.to_number(words_.any_word(), "a value") : binary(type);
}

std::size_t PlyValues::list_size(const PlyProperty& property)
{
    const double size = value(property.count_type);
    const std::size_t each = format_ == PlyFormat::ascii ? 2 : bytes_of(property.type);
    if (!(size >= 0 && size <= double((left() + 1) / each) && size == std::floor(size)))
        fail("a list has " + shown(size) + " entries; the " + std::to_string(left()) +
             " bytes left have no room for them");
    return static_cast<std::size_t>(size);
}

void PlyValues::skip(const PlyProperty& property)
{
    const std::size_t count = property.list ? list_size(property) : 1;
    for (std::size_t i = 0; i < count; ++i)
        if (format_ == PlyFormat::ascii)
            words_.any_word();
        else
            binary(property.type);
}

} // namespace taut::scene_file
