#pragma once
// Internal to src/plan: what passes work on, for those that cut a plan.

#include "taut/plan/plan.hpp"

#include <string_view>
#include <utility>

namespace taut {

/// What the invocations of a pass stand for.
enum class Over
{
    vertices,    ///< each reads and writes what is its vertex's alone
    pins,        ///< a moving pin each, in the order of Plan::moving_pins
    constraints, ///< a record each, whose first words are its corners; no two share one
};

/// What a buffer holds an element of.
enum class Each
{
    whole, ///< of the step or the scene: both parts have it
    vertex,
    collider_and_vertex,
    pin,
    pin_vertex, ///< the same, naming its vertex
    constraint,
};

/// The constraints of one colour: their buffer of records, the first of them.
using ColourKey = std::pair<std::uint32_t, std::uint32_t>;

/// Throws Error{unsupported} where a plan with this pass cannot be cut.
Over over(const Dispatch& pass);
Each each(const Dispatch& pass, std::size_t slot);

/// Corners of a record.
std::uint32_t corner_count(const Dispatch& pass);
ColourKey colour_of(const Dispatch& pass);

/// A parameter of a pass by its name; `has_param` says whether there is one.
bool has_param(const Dispatch& pass, std::string_view name);
std::uint32_t param(const Dispatch& pass, std::string_view name);
void set_param(Dispatch& pass, std::string_view name, std::uint32_t value);

} // namespace taut
