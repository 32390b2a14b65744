// A libFuzzer target (option TAUT_FUZZ): any bytes end in a sound matrix or in Error, never otherwise.
// tests/fuzz/run.sh builds and runs it.

#include "support/sound_matrix.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/error.hpp"

#include <cstdlib>

using namespace taut;
using namespace taut::linear;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try
    {
        const MatrixFile file = parse_matrix_market(text, "fuzz");
        require_sound(file.matrix);
        if (file.stored_symmetric && file.matrix.rows != file.matrix.columns)
            std::abort();
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::bad_input ||
            !std::string_view(error.what()).starts_with("fuzz: line "))
            std::abort();
    }
    return 0; // anything else that is thrown ends the process, which libFuzzer reports
}
