#include "taut/scene/keys.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace taut::scene_file {

namespace {

KeySet method_keys()
{
    return {"method",
            {"type",
             "substeps",
             "iterations",
             "precision",
             "integrator",
             "stability",
             "scheme",
             "stretch",
             "bend",
             "volume",
             "relaxation",
             "linear_iterations",
             "linear_tolerance",
             "linear_operator",
             "line_search",
             "constrained",
             "constraint_compliance",
             "activate_strain",
             "release_strain",
             "release",
             "target",
             "compress",
             "start",
             "spectral_radius"}};
}

} // namespace

std::span<const KeySet> all_keys()
{
    static const std::vector<KeySet> sets = {
        {"scene",
         {"taut", "name", "timestep", "duration", "gravity", "damping", "max_speed", "depenetration_speed",
          "external_forces", "method", "accept", "wind", "bodies", "colliders"}},
        method_keys(),
        {"accept", {"stretch", "residual", "inverted"}},
        {"wind", {"density", "velocity", "keys"}},
        {"wind key", {"time", "velocity"}},
        {"body",
         {"name", "grid", "chain", "mesh", "weld_distance", "box", "ball", "tetrahedra", "material",
          "transform", "velocity", "pins", "springs", "vertex_masses", "start_positions", "embedded"}},
        {"grid", {"cells", "size", "diagonals", "network"}},
        {"network", {"structural", "shear", "bend"}},
        {"chain", {"links", "length", "width"}},
        {"material",
         {"density", "stretch_stiffness", "bending_stiffness", "thickness", "stretch_damping", "strain_limit",
          "attachment_slack", "tear_strain", "drag", "friction_drag", "volume_stiffness", "pressure",
          "pressure_law", "plastic_yield", "plastic_creep", "plastic_limit"}},
        {"solid box", {"cells", "size", "split"}},
        {"ball", {"cells", "radius"}},
        {"solid material",
         {"density", "youngs_modulus", "poissons_ratio", "model", "volume_stiffness", "volume",
          "bending_stiffness", "thickness", "stretch_damping", "strain_limit", "attachment_slack", "drag",
          "friction_drag", "pressure", "pressure_law", "plastic_yield", "plastic_creep", "plastic_limit"}},
        {"transform", {"translate", "rotate", "scale"}},
        {"rotate", {"axis", "degrees"}},
        {"pin", {"vertices", "box", "corner", "corners", "edge", "edges", "face", "faces", "motion"}},
        {"box", {"min", "max"}},
        {"keyframe", {"time", "translate", "rotate"}},
        {"keyframe rotate", {"axis", "degrees", "centre"}},
        {"spring", {"a", "b", "rest_length", "compliance"}},
        {"collider", {"name", "plane", "sphere", "capsule", "cuboid", "friction", "motion"}},
        {"plane", {"point", "normal"}},
        {"sphere", {"centre", "radius"}},
        {"capsule", {"from", "to", "radius"}},
        {"cuboid", {"centre", "half_size", "rotate"}},
    };
    return sets;
}

const KeySet& keys_of(std::string_view object)
{
    const auto sets = all_keys();
    const auto found =
        std::find_if(sets.begin(), sets.end(), [&](const KeySet& s) { return s.object == object; });
    assert(found != sets.end());
    return *found;
}

std::string_view meant(std::string_view object, std::string_view key)
{
    constexpr std::string_view solid =
        "a solid is as stiff as \"youngs_modulus\" (Pa) and \"poissons_ratio\" say";
    constexpr std::string_view cloth =
        "cloth is as stiff as \"stretch_stiffness\" (N/m) and \"bending_stiffness\" (N m) say";
    constexpr std::array<std::array<std::string_view, 3>, 4> known = {{
        {"solid material", "stretch_stiffness", solid},
        {"solid material", "tear_strain", "solids do not tear"},
        {"material", "youngs_modulus", cloth},
        {"material", "poissons_ratio", cloth},
    }};
    for (const auto& [kind, wrong, text] : known)
        if (kind == object && wrong == key)
            return text;
    return {};
}

namespace {

/// Insertions, deletions, replacements and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = last;
        last = row;
    }
    return last.back();
}

} // namespace

std::string nearest(std::string_view word, std::span<const std::string_view> candidates)
{
    word = word.substr(0, 64); // no known word is longer; keeps hostile input cheap
    std::string best;
    std::size_t fewest = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (std::string_view candidate : candidates)
    {
        const std::size_t edits = edit_distance(word, candidate);
        if (edits < fewest && edits < candidate.size())
        {
            fewest = edits;
            best = candidate;
        }
    }
    return best;
}

std::string listing(std::span<const std::string_view> words)
{
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        if (i > 0)
            out += i + 1 == words.size() ? " or " : ", ";
        out += '"' + std::string(words[i]) + '"';
    }
    return out;
}

} // namespace taut::scene_file
