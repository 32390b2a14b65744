#include "taut/world/kept_traits.hpp"

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <mutex>
#include <sstream>
#include <utility>
#include <vector>

namespace taut {
namespace {

constexpr std::string_view kTitle =
    "taut device costs 1: dispatch, group barrier, element, lane element (ns)";

struct Place
{
    std::mutex mutex;
    std::filesystem::path file;
    std::optional<DeviceCosts> fixed;
};

Place& place()
{
    static Place one;
    return one;
}

bool sound(const DeviceCosts& c)
{
    for (const double ns : {c.dispatch_ns, c.group_barrier_ns, c.element_ns, c.lane_element_ns})
        if (!(ns > 0 && ns < 1e12))
            return false;
    return true;
}

/// Of a line that may be anything.
std::string in_quotes(const std::string& line)
{
    constexpr std::size_t kMost = 60;
    std::string text = line.substr(0, kMost) + (line.size() > kMost ? "..." : "");
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ')
            c = c == '\t' ? ' ' : '?';
    return '"' + text + '"';
}

/// Before anything is opened: a pipe would wait for its writer.
void require_place(const std::filesystem::path& file)
{
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    std::error_code code;
    if (!std::filesystem::is_directory(folder, code))
        throw Error(ErrorCode::io, "device costs " + file.string() + ": there is no folder " +
                                       folder.string() + "; make it first");
    if (!is_free_for_file(file))
        throw Error(ErrorCode::io,
                    "device costs " + file.string() + ": there is " + kind_of_file(file) + "; name a file");
}

/// Device and costs of a line, nothing of an empty line or a comment.
std::optional<std::pair<std::string, DeviceCosts>> read_line(const std::string& place,
                                                             const std::string& line)
{
    if (line.empty() || line.front() == '#')
        return std::nullopt;
    const std::size_t tab = line.find('\t');
    std::istringstream numbers(line.substr(std::min(tab, line.size())));
    numbers.imbue(std::locale::classic());
    DeviceCosts c;
    std::string more;
    if (tab == 0 || tab == std::string::npos ||
        !(numbers >> c.dispatch_ns >> c.group_barrier_ns >> c.element_ns >> c.lane_element_ns) ||
        numbers >> more || !sound(c))
        throw Error(ErrorCode::bad_input,
                    place + ": the line is " + in_quotes(line) +
                        "; a device, a tab and four numbers above 0 and below 1e12 (ns) would be right, " +
                        "or a comment that begins with #");
    return std::pair(line.substr(0, tab), c);
}

/// The lines of a file as they are, the title first. None where nothing is there or nothing in it.
std::vector<std::string> lines_of(const std::filesystem::path& file)
{
    require_place(file);
    std::vector<std::string> lines;
    std::ifstream stream(file, std::ios::binary);
    for (std::string line; std::getline(stream, line);)
    {
        if (lines.empty() && line != kTitle)
            throw Error(ErrorCode::bad_input,
                        file.string() + " holds no device costs and is left as it is: its first line is " +
                            in_quotes(line) + ", \"" + std::string(kTitle) +
                            "\" would be right; name another file, or remove it");
        lines.push_back(line);
    }
    return lines;
}

std::string place_of(const std::filesystem::path& file, std::size_t line)
{
    return file.string() + ", line " + std::to_string(line + 1);
}

std::string line_for(const std::string& device, const DeviceCosts& c)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(17);
    text << device << '\t' << c.dispatch_ns << ' ' << c.group_barrier_ns << ' ' << c.element_ns << ' '
         << c.lane_element_ns;
    return text.str();
}

bool agree(double a, double b) { return a <= kProbesAgree * b && b <= kProbesAgree * a; }

constexpr double DeviceCosts::*kCosts[] = {&DeviceCosts::dispatch_ns, &DeviceCosts::group_barrier_ns,
                                           &DeviceCosts::element_ns, &DeviceCosts::lane_element_ns};

/// The smallest value that another probe agrees with: other work only lengthens what is measured, and a
/// difference that it made too small does not come twice. Without any such the smallest but one, or what
/// there is.
double confirmed(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    for (std::size_t k = 0; k + 1 < values.size(); ++k)
        if (agree(values[k], values[k + 1]))
            return values[k];
    return values[std::min<std::size_t>(1, values.size() - 1)];
}

/// Whether the last two of enough probes say so, too.
bool settled(const std::vector<double>& probes, double value)
{
    const std::size_t n = probes.size();
    return n >= std::size_t(kLeastProbes) && agree(probes[n - 1], value) && agree(probes[n - 2], value);
}

} // namespace

void set_costs(DeviceTraits& traits, const DeviceCosts& costs)
{
    traits.dispatch_ns = costs.dispatch_ns;
    traits.group_barrier_ns = costs.group_barrier_ns;
    traits.element_ns = costs.element_ns;
    traits.lane_element_ns = costs.lane_element_ns;
}

DeviceCosts agreed_costs(const std::function<DeviceCosts()>& probe)
{
    std::array<std::vector<double>, std::size(kCosts)> probes;
    const DeviceTraits assumed;
    DeviceCosts out;
    bool done = false;
    for (int tried = 0; tried < kMostProbes && !done; ++tried)
    {
        const DeviceCosts found = probe();
        out = {assumed.dispatch_ns, assumed.group_barrier_ns, assumed.element_ns, assumed.lane_element_ns};
        done = true;
        for (std::size_t k = 0; k < probes.size(); ++k)
        {
            if (found.*kCosts[k] > 0)
                probes[k].push_back(found.*kCosts[k]);
            if (!probes[k].empty())
                out.*kCosts[k] = confirmed(probes[k]);
            done = done && found.*kCosts[k] > 0 && settled(probes[k], out.*kCosts[k]);
        }
    }
    out.lane_element_ns = std::max(out.lane_element_ns, out.element_ns); // one lane is part of the device
    return out;
}

void fix_costs(const std::optional<DeviceCosts>& costs)
{
    const std::lock_guard lock(place().mutex);
    place().fixed = costs;
}

std::optional<DeviceCosts> fixed_costs()
{
    const std::lock_guard lock(place().mutex);
    return place().fixed;
}

void keep_costs_in(const std::filesystem::path& file)
{
    if (!file.empty())
        read_costs(file);
    const std::lock_guard lock(place().mutex);
    place().file = file;
}

std::filesystem::path costs_kept_in()
{
    const std::lock_guard lock(place().mutex);
    return place().file;
}

std::map<std::string, DeviceCosts> read_costs(const std::filesystem::path& file)
{
    const std::vector<std::string> lines = lines_of(file);
    std::map<std::string, DeviceCosts> out;
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (const auto found = read_line(place_of(file, i), lines[i]))
            out[found->first] = found->second;
    return out;
}

bool add_costs(const std::filesystem::path& file, const std::string& device, const DeviceCosts& costs)
{
    std::vector<std::string> lines = lines_of(file);
    if (lines.empty())
        lines.emplace_back(kTitle);
    bool replaced = false;
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (const auto found = read_line(place_of(file, i), lines[i]); found && found->first == device)
        {
            lines[i] = line_for(device, costs);
            replaced = true;
        }
    if (!replaced)
        lines.push_back(line_for(device, costs));
    std::string text;
    for (const std::string& line : lines)
        text += line + '\n';
    try
    {
        write_file(file, text);
        return true;
    }
    catch (const Error&)
    {
        return false;
    }
}

} // namespace taut
