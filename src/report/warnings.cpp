#include "taut/report/warnings.hpp"

namespace taut {

std::string_view to_string(Warning warning)
{
    switch (warning)
    {
    case Warning::degenerate: return "degenerate";
    case Warning::speed_clamp: return "speed_clamp";
    case Warning::conflict: return "conflict";
    case Warning::precision: return "precision";
    case Warning::iteration_limit: return "iteration_limit";
    case Warning::solve_failed: return "solve_failed";
    case Warning::unconverged: return "unconverged";
    case Warning::tunnelling: return "tunnelling";
    case Warning::may_tunnel: return "may_tunnel";
    case Warning::soft: return "soft";
    }
    return "unknown";
}

void count(Warning warning, std::uint64_t times, std::map<std::string, std::uint64_t>& warnings)
{
    if (times > 0)
        warnings[std::string(to_string(warning))] += times;
}

void add_warnings(const Events& events, std::map<std::string, std::uint64_t>& warnings)
{
    count(Warning::degenerate, events.degenerate, warnings);
    count(Warning::speed_clamp, events.speed_clamped, warnings);
    count(Warning::conflict, events.conflicts, warnings);
}

} // namespace taut
