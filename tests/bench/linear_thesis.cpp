// The comparison of the thesis, chapter 3: real symmetric positive definite matrices in every format on every
// executor, time per iteration of conjugate gradients and speed-up over the serial processor.

#include "linear_bench.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/linear/solve.hpp"
#include "taut/report/median.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace bench {

using namespace taut::linear;

namespace {

constexpr std::uint32_t kProbe = 8; // iterations of the solve that says how many more will fit
constexpr const char* kMatrices[] = {"494_bus",  "1138_bus", "gr_30_30", "nos3",     "pyamg_bar",
                                     "bcsstk13", "bcsstk16", "fv3",      "msc01050", "lap3D_7pt_n20"};
constexpr const char* kDevices[] = {"cpu:serial", "cpu", "vulkan", "opengl"};
constexpr std::size_t kSerial = 0;

struct Entry
{
    std::string matrix, device;
    Format format = Format::csr;
    SolveReport report;
    double milliseconds = 0; ///< an iteration, median
    std::string refused;     ///< why there is nothing
};

/// One matrix in one format on one device; solves it again and again.
class Contestant
{
public:
    Contestant(std::shared_ptr<taut::Device> device, const System& system, Format format,
               const ThesisOptions& options)
        : device_(std::move(device)),
          system_(system)
    {
        entry_.matrix = system.name;
        entry_.format = format;
        entry_.device = device_->info().executor;
        solve_.format = format;
        solve_.precision = SolvePrecision::float64;
        solve_.tolerance = options.tolerance;
        solve_.max_iterations = kProbe;
        probe(options);
    }

    bool runs() const { return entry_.refused.empty(); }
    void turn()
    {
        entry_.report = solve(device_, system_.a, system_.b, solve_).report;
        times_.push_back(entry_.report.ms_per_iteration);
    }
    Entry entry() const
    {
        Entry out = entry_;
        if (!times_.empty())
            out.milliseconds = taut::median(times_);
        return out;
    }

private:
    /// Double where it fits, else mixed; and as many iterations as fit into the budget.
    void probe(const ThesisOptions& options)
    {
        try
        {
            try
            {
                entry_.report = solve(device_, system_.a, system_.b, solve_).report;
            }
            catch (const taut::Error& error)
            {
                if (error.code() != taut::ErrorCode::limit && error.code() != taut::ErrorCode::unsupported)
                    throw;
                solve_.precision = SolvePrecision::mixed;
                entry_.report = solve(device_, system_.a, system_.b, solve_).report;
            }
        }
        catch (const taut::Error& error)
        {
            entry_.refused = error.what();
            return;
        }
        const double fit = options.budget * 1e3 / std::max(entry_.report.ms_per_iteration, 1e-6);
        solve_.max_iterations =
            static_cast<std::uint32_t>(std::clamp(fit, double(kProbe), 10.0 * system_.a.rows));
    }

    std::shared_ptr<taut::Device> device_;
    const System& system_;
    SolveOptions solve_;
    Entry entry_;
    std::vector<double> times_;
};

std::vector<std::shared_ptr<taut::Device>> open_devices()
{
    std::vector<std::shared_ptr<taut::Device>> out;
    for (const char* selector : kDevices)
        try
        {
            out.push_back(taut::Device::open(selector));
        }
        catch (const taut::Error& error)
        {
            std::fprintf(stderr, "left out: %s: %s\n", selector, error.what());
        }
    return out;
}

void run_format(const System& system, Format format,
                const std::vector<std::shared_ptr<taut::Device>>& devices, const ThesisOptions& options,
                std::vector<Entry>& entries)
{
    std::vector<Contestant> all;
    for (const auto& device : devices)
        all.emplace_back(device, system, format, options);
    for (int turn = 0; turn < options.turns; ++turn)
        for (Contestant& one : all)
            if (one.runs())
                one.turn();
    for (const Contestant& one : all)
        entries.push_back(one.entry());
}

/// Entries of one matrix and format side by side.
struct Line
{
    std::string matrix;
    Format format;
    std::map<std::string, const Entry*> on;
};

std::vector<Line> lines_of(const std::vector<Entry>& entries)
{
    std::vector<Line> lines;
    for (const Entry& entry : entries)
    {
        if (lines.empty() || lines.back().matrix != entry.matrix || lines.back().format != entry.format)
            lines.push_back({entry.matrix, entry.format, {}});
        lines.back().on[entry.device] = &entry;
    }
    return lines;
}

/// Milliseconds, and how many times faster than the serial processor.
std::string timed(const Line& line, const std::string& device)
{
    const auto at = line.on.find(device);
    if (at == line.on.end())
        return "not there";
    if (!at->second->refused.empty())
        return "refused";
    std::string text = taut::shown(at->second->milliseconds, 3);
    const auto serial = line.on.find(kDevices[kSerial]);
    if (device != kDevices[kSerial] && serial != line.on.end() && serial->second->refused.empty())
        text += " (" + taut::shown(serial->second->milliseconds / at->second->milliseconds, 2) + " x)";
    if (at->second->report.precision != SolvePrecision::float64)
        text += " " + std::string(to_string(at->second->report.precision));
    return text;
}

/// "converged, 2.1e-07": the words of all devices where they differ, and the largest true residual.
std::string outcome(const Line& line)
{
    std::string words;
    double worst = -1;
    for (const char* device : kDevices)
    {
        const auto at = line.on.find(device);
        if (at == line.on.end() || !at->second->refused.empty())
            continue;
        const std::string word(to_string(at->second->report.status));
        if (words.find(word) == std::string::npos)
            words += (words.empty() ? "" : " / ") + word;
        worst = std::max(worst, at->second->report.relative_residual);
    }
    return worst < 0 ? "" : words + " | " + taut::shown(worst, 2);
}

void print_matrices(const std::vector<System>& systems, const std::vector<Line>& lines)
{
    std::printf(
        "| matrix | n | entries | format | cpu:serial ms | cpu ms | vulkan ms | opengl ms | status | worst "
        "true residual |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Line& line : lines)
        for (const System& system : systems)
        {
            const std::string end = outcome(line);
            if (system.name == line.matrix && !end.empty())
                std::printf("| %s | %u | %llu | %s | %s | %s | %s | %s | %s |\n", line.matrix.c_str(),
                            system.a.rows, static_cast<unsigned long long>(system.a.nonzeros()),
                            std::string(to_string(line.format)).c_str(), timed(line, "cpu:serial").c_str(),
                            timed(line, "cpu").c_str(), timed(line, "vulkan").c_str(),
                            timed(line, "opengl").c_str(), end.c_str());
        }
}

/// Mean time an iteration over the matrices that every device took, for each format and for all.
void print_means(const std::vector<Line>& lines)
{
    std::printf("\n| format | matrices | mean cpu:serial ms | cpu ms | vulkan ms | opengl ms | cpu speed-up, "
                "geometric "
                "mean |\n|---|---|---|---|---|---|---|\n");
    const auto row = [&](const std::string& name, std::optional<Format> format) {
        double sums[4] = {}, logs = 0;
        int count = 0;
        for (const Line& line : lines)
        {
            bool whole = !format || *format == line.format;
            for (const char* device : kDevices)
                whole = whole && line.on.count(device) > 0 && line.on.at(device)->refused.empty();
            if (!whole)
                continue;
            for (std::size_t d = 0; d < 4; ++d)
                sums[d] += line.on.at(kDevices[d])->milliseconds;
            logs += std::log(line.on.at("cpu:serial")->milliseconds / line.on.at("cpu")->milliseconds);
            ++count;
        }
        if (count == 0)
            return;
        std::printf("| %s | %d |", name.c_str(), count);
        for (const double sum : sums)
            std::printf(" %s |", taut::shown(sum / count, 3).c_str());
        std::printf(" %s |\n", taut::shown(std::exp(logs / count), 3).c_str());
    };
    for (const Format format : all_formats())
        row(std::string(to_string(format)), format);
    row("all", std::nullopt);
}

/// One sentence for all devices that say the same.
void print_refusals(const std::vector<Entry>& entries)
{
    std::printf("\nRefused, in the library's words:\n\n");
    std::vector<std::pair<std::string, std::string>> reasons; // reason, who
    for (const Entry& entry : entries)
    {
        if (entry.refused.empty())
            continue;
        const auto same = [&](const auto& pair) { return pair.first == entry.refused; };
        const auto at = std::find_if(reasons.begin(), reasons.end(), same);
        if (at != reasons.end())
            at->second += ", " + entry.device;
        else
            reasons.emplace_back(entry.refused, entry.matrix + " on " + entry.device);
    }
    for (const auto& [reason, who] : reasons)
        std::printf("- %s: %s.\n", who.c_str(), reason.c_str());
}

std::string csv(const std::vector<Entry>& entries, const std::string& conditions)
{
    std::string text = "# " + conditions +
                       "\nmatrix,n,nonzeros,format,device,precision,iterations,ms_per_iteration,matrix_bytes,"
                       "true_residual,status,refused\n";
    for (const Entry& e : entries)
    {
        text += e.matrix;
        if (e.refused.empty())
            text += ',' + std::to_string(e.report.n) + ',' + std::to_string(e.report.nnz);
        else
            text += ",,";
        text += ',' + std::string(to_string(e.format)) + ',' + e.device + ',';
        if (e.refused.empty())
            text += std::string(to_string(e.report.precision)) + ',' + std::to_string(e.report.iterations) +
                    ',' + taut::shown(e.milliseconds, 6) + ',' + std::to_string(e.report.bytes) + ',' +
                    taut::shown(e.report.relative_residual, 4) + ',' +
                    std::string(to_string(e.report.status)) + ",\n";
        else
            text += ",,,,,," + taut::csv_cell(e.refused) + '\n';
    }
    return text;
}

} // namespace

void run_thesis(const ThesisOptions& options, const std::string& conditions)
{
    const std::filesystem::path folder = matrix_folder();
    if (folder.empty())
        return;
    const auto devices = open_devices();
    std::vector<System> systems;
    std::vector<Entry> entries;
    for (const char* name : kMatrices)
        systems.push_back(
            manufactured(name, read_matrix_market((folder / (std::string(name) + ".mtx")).string()).matrix));
    for (const System& system : systems)
    {
        std::fprintf(stderr, "%s\n", system.name.c_str());
        for (const Format format : all_formats())
            run_format(system, format, devices, options, entries);
    }
    const std::vector<Line> lines = lines_of(entries);
    print_matrices(systems, lines);
    print_means(lines);
    print_refusals(entries);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv(entries, conditions));
}

} // namespace bench
