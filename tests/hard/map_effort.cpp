// What cells of the robustness map take beyond the settings that the map gives their method: the cheapest
// with which `tests/hard/update_map.sh search` found them to pass, at the size of the short form.

#include "hard/map.hpp"

#include <algorithm>
#include <stdexcept>

namespace taut::hard {
namespace {

struct Entry
{
    const char *id, *what;
    MethodKind method;
    Effort effort;
};

using enum MethodKind;

const std::vector<Entry> kEntries = {
    {"A04", "stiff cloth, 1e8 N/m, hung by one edge", pbd, {8, 1, false}},
    {"A04", "stiff cloth, 1e8 N/m, hung by one edge", xpbd, {8, 1, false}},
    {"A06", "rope, last link 1,800 times heavier", xpbd, {16, 1, false}},
    {"A08", "rope, bob 1e5 times heavier", xpbd, {16, 2, false}},
    {"A09", "step of 0.1 s", xpbd, {4, 1, false}},
    {"A09", "step of 1 s", xpbd, {64, 1, false}},
    {"A15", "masses of 1e12, 1 and 1e-12 kg in one body", implicit_constraints, {1, 1, true}},
    {"C02", "fan of 120 triangles at one vertex, in full 1,000", implicit_euler, {2, 4, false}},
    {"C02", "fan of 120 triangles at one vertex, in full 1,000", acad, {1, 2, false}},
    {"C02", "fan of 120 triangles at one vertex, in full 1,000", pbd, {4, 1, false}},
    {"C02", "fan of 120 triangles at one vertex, in full 1,000", xpbd, {8, 1, false}},
    {"C02", "fan of 120 triangles at one vertex, in full 1,000", vbd, {2, 4, false}},
    {"C09", "chain of 2,000 links at rest under its weight, in full 100,000", xpbd, {32, 1, false}},
    {"E03", "a ball of 20 m/s into hanging cloth", vbd, {2, 1, false}},
    {"F03", "chain of 16 links from the horizontal", xpbd, {2, 1, false}},
    {"F03", "chain of 16 links from the horizontal", vbd, {2, 1, false}},
    {"F13", "a corner dragged 10 times the cloth's size in a second", implicit_constraints, {2, 1, false}},
    {"F13", "a corner dragged 10 times the cloth's size in a second", xpbd, {4, 1, false}},
    {"F13", "a corner dragged 10 times the cloth's size in a second", acad, {1, 2, false}},
    {"F13", "a corner drawn out by 16 cm, strain limit of 10 %", implicit_euler, {4, 1, false}},
    {"F13", "a corner drawn out by 16 cm, strain limit of 10 %", implicit_constraints, {2, 1, false}},
    {"F13", "a corner drawn out by 16 cm, strain limit of 10 %", vbd, {2, 1, false}},
    {"B03", "spring of 0.1 m, ends 1e-20 m apart", implicit_euler, {1, 1, true}},
    {"B03", "spring of 0.1 m, ends 1e-20 m apart", xpbd, {1, 1, true}},
    {"B03", "spring of 0.1 m, ends 1e-20 m apart", vbd, {1, 1, true}},
    {"B03", "spring of 0.1 m, ends 1e-30 m apart", implicit_euler, {1, 1, true}},
    {"B03", "spring of 0.1 m, ends 1e-30 m apart", xpbd, {1, 1, true}},
    {"B03", "spring of 0.1 m, ends 1e-30 m apart", vbd, {1, 1, true}},
    {"B04", "every vertex twice, 1e-9 m apart, joined", xpbd, {2, 1, false}},
    {"B18", "hanging cloth 10 km from the origin", xpbd, {2, 1, false}},
    {"pins apart", "two corners pulled to twice the width", implicit_constraints, {2, 1, false}},
    {"pins apart", "two corners pulled to twice the width", xpbd, {4, 1, false}},
    {"gust", "a flag in a gust of 50 m/s", xpbd, {2, 1, false}},
    {"gust", "a flag in a gust of 50 m/s", vbd, {2, 1, false}},
    {"F17", "stretch stiffness 1e+12 N/m", implicit_constraints, {2, 1, false}},
    {"F17", "stretch stiffness 1e+12 N/m", pbd, {32, 1, false}},
    {"F17", "stretch stiffness 1e+12 N/m", xpbd, {64, 1, false}},
    {"G03", "an impulse of 1e6 N on one vertex", mass_spring, {2, 1, false}},
    {"G03", "an impulse of 1e6 N on one vertex", xpbd, {2, 1, false}},
    {"G04", "gravity of 1e4 m/s^2, turned over every frame for a second", mass_spring, {2, 1, false}},
    {"G04", "gravity of 1e4 m/s^2, turned over every frame for a second", acad, {2, 1, false}},
    {"G04", "gravity of 1e4 m/s^2, turned over every frame for a second", xpbd, {2, 1, false}},
    {"A05", "springs of 1e3 and 1e6 N/m by turns", mass_spring, {1, 1, true}},
    {"A05", "springs of 1e3 and 1e6 N/m by turns", acad, {1, 1, true}},
    {"A05", "springs of 1e3 and 1e6 N/m by turns", xpbd, {2, 2, false}},
    {"A07", "rope, last of 50 links 200 times heavier", pbd, {4, 1, false}},
    {"A07", "rope, last of 50 links 200 times heavier", xpbd, {8, 1, false}},
    {"C03", "star of 400 springs on one vertex, in full 10,000", acad, {1, 2, false}},
    {"F04", "cloth, every edge twice", xpbd, {2, 1, false}},
    {"F04", "tetrahedron of six stiff edges with its volume, and without", implicit_euler, {1, 2, false}},
    {"F04", "tetrahedron of six stiff edges with its volume, and without", xpbd, {2, 1, false}},
    {"F04", "tetrahedron of six stiff edges with its volume, and without", vbd, {16, 1, true}},
    {"B05", "a sliver of a millionth of its edge in a block", vbd, {8, 1, false}},
    {"E11", "cloth falls on a spike of 1 mm", implicit_euler, {2, 1, false}},
    {"E11", "cloth falls on a spike of 1 mm", implicit_constraints, {8, 1, false}},
    {"E11", "cloth falls on a spike of 1 mm", xpbd, {2, 1, false}},
    {"E11", "solid falls on a spike of 1 mm", implicit_euler, {2, 1, false}},
    {"E11", "solid falls on a spike of 1 mm", implicit_constraints, {2, 1, false}},
    {"E11", "solid falls on a spike of 1 mm", vbd, {2, 1, false}},
    {"E13", "solid on a capsule that spins with 50 rad/s", acad, {1, 2, true}},
    {"E13", "solid on a box that spins with 50 rad/s", acad, {1, 16, false}},
    {"A07", "solid bar, end 200 times heavier", xpbd, {2, 1, false}},
    {"E08", "solid of seven layers, each twice as heavy as the one below", implicit_euler, {2, 1, false}},
    {"E08",
     "solid of seven layers, each twice as heavy as the one below",
     implicit_constraints,
     {2, 1, false}},
    {"E08", "solid of seven layers, each twice as heavy as the one below", vbd, {2, 1, false}},
    {"E12", "solid whose upper half is 1e4 times heavier", implicit_constraints, {64, 1, false}},
    {"E12", "solid whose upper half is 1e4 times heavier", pbd, {16, 1, false}},
    {"E12", "solid whose upper half is 1e4 times heavier", xpbd, {32, 1, false}},
    {"E12", "solid whose upper half is 1e4 times heavier", vbd, {32, 1, false}},
    {"", "Young's modulus of 1e2, 1e5, 1e8, 1e11 Pa in one scene, dropped", implicit_euler, {2, 1, false}},
    {"",
     "Young's modulus of 1e2, 1e5, 1e8, 1e11 Pa in one scene, dropped",
     implicit_constraints,
     {2, 1, false}},
    {"", "Young's modulus of 1e2, 1e5, 1e8, 1e11 Pa in one scene, dropped", xpbd, {2, 1, false}},
    {kDataCase, "dress_stage.obj", xpbd, {2, 1, false}},
    {kDataCase, "elephant-with-holes.off", vbd, {2, 1, false}},
};

} // namespace

std::string Effort::text() const
{
    std::string out;
    const auto add = [&](bool is_so, const std::string& part) {
        if (is_so)
            out += (out.empty() ? "" : ", ") + part;
    };
    add(substeps > 1, std::to_string(substeps) + " x substeps");
    add(iterations > 1, std::to_string(iterations) + " x iterations");
    add(in_double, "double");
    return out;
}

void put_efforts(std::vector<MapCase>& cases)
{
    const bool data = std::ranges::any_of(cases, [](const MapCase& c) { return c.id == kDataCase; });
    for (const Entry& entry : kEntries)
    {
        const auto found = std::find_if(cases.begin(), cases.end(), [&](const MapCase& c) {
            return c.id == entry.id && c.what == entry.what;
        });
        if (found == cases.end() && entry.id == std::string(kDataCase) && !data)
            continue; // there is none here
        if (found == cases.end())
            throw std::logic_error(std::string("map_effort.cpp: no case ") + entry.id + " " + entry.what);
        found->effort[entry.method] = entry.effort;
    }
}

} // namespace taut::hard
