#include "taut/scene/vtu_text.hpp"

#include "taut/runtime/base/error.hpp"

#if TAUT_HAS_EXPAT

#include "taut/scene/words.hpp"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>

namespace taut::scene_file {
namespace {

/// What the callbacks share. They are called through C, so what they throw is kept until the parser is back.
struct Reading
{
    const std::string& file;
    XML_Parser parser = nullptr;
    VtuText out;
    std::vector<std::string> path; ///< names of the open elements
    VtuArray* array = nullptr;     ///< whose text is being read
    std::exception_ptr thrown;

    std::size_t line() const
    {
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9 // which deprecates the name before
        return static_cast<std::size_t>(XML_GetCurrentLineNumber64(parser));
#else
        return XML_GetCurrentLineNumber(parser);
#endif
    }
    [[noreturn]] void fail(const std::string& text) const
    {
        throw Error(ErrorCode::bad_input, file + ": line " + std::to_string(line()) + ": " + text);
    }
};

std::string attribute(const XML_Char** attributes, std::string_view name)
{
    for (; attributes[0]; attributes += 2)
        if (name == attributes[0])
            return attributes[1];
    return {};
}

/// The array of the piece that this DataArray is; null if the grid does not need it.
VtuArray* array_of(Reading& in, std::string_view name)
{
    if (in.out.pieces.empty() || in.path.empty())
        return nullptr;
    VtuPiece& piece = in.out.pieces.back();
    if (in.path.back() == "Points")
        return &piece.positions;
    if (in.path.back() != "Cells")
        return nullptr;
    return name == "connectivity" ? &piece.connectivity
           : name == "offsets"    ? &piece.offsets
           : name == "types"      ? &piece.types
                                  : nullptr;
}

void start_array(Reading& in, const XML_Char** attributes)
{
    const std::string name = attribute(attributes, "Name");
    in.array = array_of(in, name);
    if (!in.array)
        return;
    if (in.array->found)
        in.fail("a piece has a second array " + scene_file::quoted(name) + "; it must have one");
    *in.array = {attribute(attributes, "type"),
                 attribute(attributes, "format"),
                 attribute(attributes, "NumberOfComponents"),
                 "",
                 in.line(),
                 true};
}

void start(Reading& in, std::string_view name, const XML_Char** attributes)
{
    if (in.path.empty())
    {
        if (name != "VTKFile")
            in.fail("the file starts with the element " + scene_file::quoted(name) + "; it must be VTKFile");
        in.out.type = attribute(attributes, "type");
        in.out.byte_order = attribute(attributes, "byte_order");
        in.out.header_type = attribute(attributes, "header_type");
        in.out.compressor = attribute(attributes, "compressor");
    }
    if (name == "Piece")
        in.out.pieces.push_back({attribute(attributes, "NumberOfPoints"),
                                 attribute(attributes, "NumberOfCells"),
                                 {},
                                 {},
                                 {},
                                 {},
                                 in.line()});
    if (name == "DataArray")
        start_array(in, attributes);
    if (in.path.size() >= 100)
        in.fail("elements are nested a hundred deep; a VTU file has six levels");
    in.path.emplace_back(name);
}

template <class Work>
void guarded(void* user, const Work& work)
{
    Reading& in = *static_cast<Reading*>(user);
    try
    {
        if (!in.thrown)
            work(in);
    }
    catch (...)
    {
        in.thrown = std::current_exception();
        XML_StopParser(in.parser, XML_FALSE);
    }
}

void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char** attributes)
{
    guarded(user, [&](Reading& in) { start(in, name, attributes); });
}

void XMLCALL on_end(void* user, const XML_Char* name)
{
    guarded(user, [&](Reading& in) {
        if (std::string_view(name) == "DataArray")
            in.array = nullptr;
        in.path.pop_back();
    });
}

void XMLCALL on_text(void* user, const XML_Char* text, int bytes)
{
    guarded(user, [&](Reading& in) {
        if (in.array)
            in.array->text.append(text, static_cast<std::size_t>(bytes));
    });
}

void XMLCALL on_document_type(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int)
{
    guarded(user, [&](Reading& in) { in.fail("the file declares a document type; a VTU file has none"); });
}

/// Expat takes lengths as int.
void parse(Reading& in, std::string_view text)
{
    constexpr std::size_t piece = std::size_t(1) << 26;
    for (std::size_t at = 0;; at += piece)
    {
        const std::string_view part = text.substr(at, piece);
        const bool last = at + part.size() == text.size();
        const bool good =
            XML_Parse(in.parser, part.data(), static_cast<int>(part.size()), last) == XML_STATUS_OK;
        if (in.thrown)
            std::rethrow_exception(in.thrown);
        if (!good)
            in.fail(std::string("this is not XML: ") + XML_ErrorString(XML_GetErrorCode(in.parser)));
        if (last)
            return;
    }
}

} // namespace

VtuText read_vtu_text(std::string_view text, const std::string& file)
{
    Reading in{file, nullptr, {}, {}, nullptr, nullptr};
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                              &XML_ParserFree);
    if (!parser)
        throw Error(ErrorCode::out_of_memory, file + ": there is no memory to read it");
    in.parser = parser.get();
    XML_SetUserData(in.parser, &in);
    XML_SetElementHandler(in.parser, on_start, on_end);
    XML_SetCharacterDataHandler(in.parser, on_text);
    XML_SetStartDoctypeDeclHandler(in.parser, on_document_type);
    parse(in, text);
    return std::move(in.out);
}

} // namespace taut::scene_file

#else

namespace taut::scene_file {

VtuText read_vtu_text(std::string_view, const std::string& file)
{
    throw Error(
        ErrorCode::unsupported,
        file + ": this build reads no .vtu (it was made without Expat, libexpat1-dev); it reads .node with "
               ".ele, .msh, .vtk and .mesh");
}

} // namespace taut::scene_file

#endif
