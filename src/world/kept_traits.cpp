#include "taut/world/kept_traits.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <array>
#include <fstream>
#include <mutex>
#include <sstream>

namespace taut {
namespace {

constexpr std::string_view kTitle =
    "taut device costs 1: dispatch, group barrier, element, lane element (ns)";

struct Place
{
    std::mutex mutex;
    std::filesystem::path file;
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

} // namespace

void keep_costs_in(const std::filesystem::path& file)
{
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
    std::map<std::string, DeviceCosts> out;
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code))
        return out;
    std::ifstream stream(file);
    std::string line;
    if (!std::getline(stream, line) || line != kTitle)
        return out;
    while (std::getline(stream, line))
    {
        const std::size_t tab = line.find('\t');
        std::istringstream numbers(line.substr(std::min(tab, line.size())));
        numbers.imbue(std::locale::classic());
        DeviceCosts c;
        if (numbers >> c.dispatch_ns >> c.group_barrier_ns >> c.element_ns >> c.lane_element_ns && sound(c))
            out[line.substr(0, tab)] = c;
    }
    return out;
}

bool add_costs(const std::filesystem::path& file, const std::string& device, const DeviceCosts& costs)
{
    std::map<std::string, DeviceCosts> all = read_costs(file);
    all[device] = costs;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(17);
    text << kTitle << '\n';
    for (const auto& [name, c] : all)
        text << name << '\t' << c.dispatch_ns << ' ' << c.group_barrier_ns << ' ' << c.element_ns << ' '
             << c.lane_element_ns << '\n';
    if (!is_free_for_file(file))
        return false;
    try
    {
        write_file(file, text.str());
        return true;
    }
    catch (const Error&)
    {
        return false;
    }
}

} // namespace taut
