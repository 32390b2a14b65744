#pragma once
// What was measured of a device, kept in a file: a device is planned for alike in every run.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace taut {

struct DeviceTraits;

/// The four costs of DeviceTraits, ns.
struct DeviceCosts
{
    double dispatch_ns = 0, group_barrier_ns = 0, element_ns = 0, lane_element_ns = 0;
    bool operator==(const DeviceCosts&) const = default;
};

void set_costs(DeviceTraits& traits, const DeviceCosts& costs);

/// Two probes of a cost agree when neither is more than this times the other.
inline constexpr double kProbesAgree = 1.25;
inline constexpr int kLeastProbes = 10, kMostProbes = 24;

/// The costs by repeated probes: for each cost the smallest that two probes agree about, once the last two
/// agree with it, too, after at least kLeastProbes and at most kMostProbes. A probe's cost that is not above
/// 0 failed and does not count; where all failed, the value is that of a DeviceTraits.
DeviceCosts agreed_costs(const std::function<DeviceCosts()>& probe);

/// What measure_traits() tells of every device instead of measuring it; nothing (at first): as measured. Of
/// the whole process; thread-safe.
void fix_costs(const std::optional<DeviceCosts>& costs);
std::optional<DeviceCosts> fixed_costs();

/// Where measure_traits() looks before it measures, and adds what it has measured; empty (at first): nowhere.
/// Of the whole process; thread-safe. Throws as read_costs() does. A file that cannot be written is left as
/// it is.
void keep_costs_in(const std::filesystem::path& file);
std::filesystem::path costs_kept_in();

/// The lines of such a file, by device and driver; none where nothing is there yet. Empty lines and those
/// that begin with # say nothing. Throws Error{io} for a folder that is missing and for what is no file,
/// Error{bad_input} with the line for contents that are no costs.
std::map<std::string, DeviceCosts> read_costs(const std::filesystem::path& file);
/// Adds a line or replaces that of the device; the others, comments too, stay. False where the file cannot be
/// written. Throws as read_costs() does.
bool add_costs(const std::filesystem::path& file, const std::string& device, const DeviceCosts& costs);

} // namespace taut
