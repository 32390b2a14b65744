#include "taut/scene/options.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"

namespace taut {

void refuse_word(std::string_view word, std::span<const std::string_view> known)
{
    throw Error(ErrorCode::bad_input, "the option " + scene_file::unknown_word(word, known));
}

} // namespace taut
