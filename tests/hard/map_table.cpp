// The robustness map as a table of numbers: read, written, compared, shown.

#include "hard/map_table.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace taut::hard {
namespace {

constexpr const char* kHead = "case,what,method,verdict,criterion,number,limit,energy,inverted,volume,"
                              "effort,cost,also";
constexpr const char* kBegin = "<!-- map -->\n";
constexpr const char* kEnd = "\n<!-- end -->";

std::string quoted(const std::string& text)
{
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

/// Four digits: the table is read by people, and compared by a factor.
std::string digits(const std::optional<double>& value)
{
    if (!value)
        return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", *value);
    return text;
}

std::vector<std::string> fields_of(const std::string& line)
{
    std::vector<std::string> out(1);
    bool inside = false;
    for (const char c : line)
    {
        if (c == '"')
            inside = !inside;
        else if (c == ',' && !inside)
            out.emplace_back();
        else
            out.back() += c;
    }
    return out;
}

std::optional<double> number_of(const std::string& text)
{
    return text.empty() ? std::optional<double>() : std::stod(text);
}

/// Within the factor, or both below the floor.
bool near(const std::optional<double>& a, const std::optional<double>& b, double floor)
{
    if (!a || !b)
        return a.has_value() == b.has_value();
    if (*a == *b || (std::isnan(*a) && std::isnan(*b)) || (std::abs(*a) <= floor && std::abs(*b) <= floor))
        return true;
    // A number beside one within the floor is measured from the floor, so that nothing jumps at its edge.
    const double x = std::max(std::abs(*a), floor), y = std::max(std::abs(*b), floor);
    return (*a < 0) == (*b < 0) ? std::max(x, y) <= kFactor * std::min(x, y)
                                : std::max(std::abs(*a), std::abs(*b)) <= kFactor * floor;
}

struct Missed
{
    std::string criterion;
    std::optional<double> number;
};

/// What `text` (Row::also) lists.
std::vector<Missed> missed_of(const std::string& text)
{
    std::vector<Missed> out;
    std::istringstream list(text);
    for (std::string part; std::getline(list >> std::ws, part, ';');)
    {
        const std::size_t blank = part.rfind(' ');
        out.push_back({part.substr(0, blank), number_of(part.substr(blank + 1))});
    }
    return out;
}

/// What is missed besides is the same, by no more than the factor.
bool same_missed(const std::string& was, const std::string& is)
{
    return std::ranges::equal(missed_of(was), missed_of(is), [](const Missed& a, const Missed& b) {
        return a.criterion == b.criterion && near(a.number, b.number, 0);
    });
}

std::string page_text()
{
    std::ifstream file(TAUT_SOURCE_DIR "/docs/results/robustness.md");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string cell_of(const Row& row)
{
    if (!row.number)
        return row.verdict;
    const std::string at = row.effort.empty() ? "" : " at " + row.effort;
    if (row.verdict == "pass" || row.verdict == "runs")
        return row.verdict + " " + shown(*row.number, 3) + at;
    return row.verdict + at + ": " + row.criterion + " " + shown(*row.number, 3) + ", limit " +
           shown(*row.limit, 3) + (row.also.empty() ? "" : "; also " + row.also);
}

/// How many cells of each method begin with each word.
std::string counts_of(const std::vector<Row>& rows)
{
    constexpr const char* kWords[] = {"pass", "refuses", "stops", "reports", "FAIL"};
    std::string text = "| cells |", rule = "\n|---|";
    for (const char* word : kWords)
    {
        text += std::string(" ") + word + " |";
        rule += "---:|";
    }
    text += rule + "\n";
    for (const std::string_view method : words_of<MethodKind>())
    {
        text += "| " + std::string(method) + " |";
        for (const char* word : kWords)
            text += " " +
                    std::to_string(std::count_if(rows.begin(), rows.end(),
                                                 [&](const Row& row) {
                                                     return row.method == method &&
                                                            row.verdict.rfind(word, 0) == 0;
                                                 })) +
                    " |";
        text += "\n";
    }
    return text;
}

} // namespace

Row row_of(const MapCase& c, MethodKind method, const Outcome& outcome)
{
    Row row{c.id,
            c.what,
            std::string(words_of<MethodKind>()[static_cast<std::size_t>(method)]),
            outcome.verdict,
            {},
            {},
            {},
            {},
            {},
            {},
            {},
            {},
            {}};
    if (const auto more = c.effort.find(method); more != c.effort.end())
    {
        row.effort = more->second.text();
        row.cost = more->second.cost();
    }
    const Measured shown = outcome.shown();
    if (shown.what.empty())
        return row;
    row.criterion = shown.what;
    row.number = shown.value;
    row.limit = shown.limit;
    row.energy = outcome.energy;
    row.inverted = outcome.inverted;
    row.volume = outcome.volume;
    for (const Measured& m : outcome.also_missed())
        row.also += (row.also.empty() ? "" : "; ") + m.what + " " + digits(m.value);
    return row;
}

std::string difference(const Row& committed, const Row& now)
{
    const auto differs = [&](const char* name, const std::optional<double>& was,
                             const std::optional<double>& is, double floor) {
        return near(was, is, floor) ? std::string()
                                    : std::string(name) + " " + digits(was) + " is now " + digits(is) + "; ";
    };
    std::string text;
    if (committed.verdict != now.verdict || committed.criterion != now.criterion)
        text = "\"" + cell_of(committed) + "\" (" + committed.criterion + ") is now \"" + cell_of(now) +
               "\" (" + now.criterion + "); ";
    else
        text = differs("number", committed.number, now.number, kFloor * now.limit.value_or(0)) +
               (digits(committed.limit) == digits(now.limit)
                    ? ""
                    : "limit " + digits(committed.limit) + " is now " + digits(now.limit) + "; ");
    // Of the energy and the volume the floors are those of the usual limits (MapCase), whatever the case's.
    const MapCase usual;
    if (!same_missed(committed.also, now.also))
        text += "also missed: \"" + committed.also + "\" is now \"" + now.also + "\"; ";
    if (committed.effort != now.effort)
        text += "effort \"" + committed.effort + "\" is now \"" + now.effort + "\"; ";
    return text + differs("energy", committed.energy, now.energy, kFloor * usual.most_energy) +
           differs("inverted", committed.inverted, now.inverted, 0) +
           differs("volume", committed.volume, now.volume, kFloor * usual.most_volume);
}

std::filesystem::path table_file(bool short_form)
{
    return std::filesystem::path(TAUT_SOURCE_DIR "/tests/hard") / (short_form ? "map_short.csv" : "map.csv");
}

std::vector<Row> read_table(const std::filesystem::path& path)
{
    std::ifstream file(path);
    std::string line;
    std::vector<Row> rows;
    if (std::getline(file, line) && line != kHead)
        throw std::runtime_error(path.string() + ": its first line must be " + kHead);
    while (std::getline(file, line))
    {
        const std::vector<std::string> f = fields_of(line);
        if (f.size() != 13)
            throw std::runtime_error(path.string() + ": thirteen fields, not: " + line);
        rows.push_back({f[0], f[1], f[2], f[3], f[4], number_of(f[5]), number_of(f[6]), number_of(f[7]),
                        number_of(f[8]), number_of(f[9]), f[10], number_of(f[11]), f[12]});
    }
    return rows;
}

void write_table(const std::filesystem::path& path, const std::vector<Row>& rows)
{
    std::string text = std::string(kHead) + "\n";
    for (const Row& r : rows)
        text += quoted(r.id) + ',' + quoted(r.what) + ',' + r.method + ',' + r.verdict + ',' +
                quoted(r.criterion) + ',' + digits(r.number) + ',' + digits(r.limit) + ',' +
                digits(r.energy) + ',' + digits(r.inverted) + ',' + digits(r.volume) + ',' +
                quoted(r.effort) + ',' + digits(r.cost) + ',' + quoted(r.also) + '\n';
    write_file(path.string(), text);
}

std::string page_of(const std::vector<Row>& rows)
{
    std::string text = "| case | what |", rule = "\n|---|---|";
    for (const std::string_view name : words_of<MethodKind>())
    {
        text += " " + std::string(name) + " |";
        rule += "---|";
    }
    text += rule;
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
        const bool begins = k == 0 || rows[k].id != rows[k - 1].id || rows[k].what != rows[k - 1].what;
        text += (begins ? "\n| " + rows[k].id + " | " + rows[k].what + " | " : " ") + cell_of(rows[k]) + " |";
    }
    return text + "\n\n" + counts_of(rows);
}

std::string page_part()
{
    const std::string page = page_text();
    const std::size_t begin = page.find(kBegin), end = page.find(kEnd, begin);
    if (begin == std::string::npos || end == std::string::npos)
        throw std::runtime_error("docs/results/robustness.md has no marks of the map");
    return page.substr(begin + std::string(kBegin).size() + 1, end - begin - std::string(kBegin).size() - 1);
}

void put_page_part(const std::string& text)
{
    const std::string page = page_text(), part = page_part();
    const std::size_t begin = page.find(kBegin) + std::string(kBegin).size() + 1;
    write_file(TAUT_SOURCE_DIR "/docs/results/robustness.md",
               page.substr(0, begin) + text + page.substr(begin + part.size()));
}

} // namespace taut::hard
