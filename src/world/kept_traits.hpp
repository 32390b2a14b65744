#pragma once
// What was measured of a device, kept in a file: a device is planned for alike in every run.

#include <filesystem>
#include <map>
#include <string>

namespace taut {

/// The four costs of DeviceTraits, ns.
struct DeviceCosts
{
    double dispatch_ns = 0, group_barrier_ns = 0, element_ns = 0, lane_element_ns = 0;
    bool operator==(const DeviceCosts&) const = default;
};

/// Where measure_traits() looks before it measures, and adds what it has measured; empty (at first): nowhere.
/// Of the whole process; thread-safe. A file that cannot be read, or of another format, counts as empty; one
/// that cannot be written is left as it is.
void keep_costs_in(const std::filesystem::path& file);
std::filesystem::path costs_kept_in();

/// The lines of such a file, by device and driver: what is no such line is left out.
std::map<std::string, DeviceCosts> read_costs(const std::filesystem::path& file);
/// Adds one or replaces it. False where the file cannot be written.
bool add_costs(const std::filesystem::path& file, const std::string& device, const DeviceCosts& costs);

} // namespace taut
