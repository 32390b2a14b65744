#include "taut/linear/solve.hpp"

namespace taut::linear {

std::string_view to_string(SolvePrecision precision)
{
    switch (precision)
    {
    case SolvePrecision::automatic: return "auto";
    case SolvePrecision::float32: return "float";
    case SolvePrecision::float64: return "double";
    case SolvePrecision::mixed: return "mixed";
    }
    return "unknown";
}

SolvePrecision solve_precision_from(std::string_view word)
{
    for (const SolvePrecision precision : {SolvePrecision::automatic, SolvePrecision::float32,
                                           SolvePrecision::float64, SolvePrecision::mixed})
        if (to_string(precision) == word)
            return precision;
    throw Error(ErrorCode::bad_input, "\"" + std::string(word) +
                                          "\" is no precision: there are auto, float, double and mixed");
}

} // namespace taut::linear
