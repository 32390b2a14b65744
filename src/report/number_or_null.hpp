#pragma once
// Internal to src/report: values of a study that may be absent, in JSON.

#include <nlohmann/json.hpp>

#include <optional>

namespace taut {

inline nlohmann::ordered_json number_or_null(const std::optional<double>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace taut
