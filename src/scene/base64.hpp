#pragma once
// Bytes written as letters (RFC 4648, section 4).

#include <string>
#include <string_view>

namespace taut::scene_file {

/// White space is passed over; a part that ends with `=` may be followed by another one. False if the text is
/// not base64.
bool from_base64(std::string_view text, std::string& bytes);

} // namespace taut::scene_file
