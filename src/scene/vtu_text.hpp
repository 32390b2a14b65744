#pragma once
// The XML of a VTU file as plain values: attributes and texts of the arrays that a grid needs.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

struct VtuArray
{
    std::string type, format, components; ///< attributes of DataArray, empty where there is none
    std::string text;
    std::size_t line = 0; ///< of the file, where the text starts
    bool found = false;
};

struct VtuPiece
{
    std::string points, cells; ///< NumberOfPoints, NumberOfCells
    VtuArray positions, connectivity, offsets, types;
    std::size_t line = 0;
};

struct VtuText
{
    std::string type, byte_order, header_type, compressor; ///< attributes of VTKFile
    std::vector<VtuPiece> pieces;
};

/// Reads the XML by Expat; document types and entities of its own are refused. Throws Error{bad_input} naming
/// file, line and what is wrong, Error{unsupported} in a build without Expat.
VtuText read_vtu_text(std::string_view text, const std::string& file);

} // namespace taut::scene_file
