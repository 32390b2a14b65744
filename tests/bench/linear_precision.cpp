// Work-precision: time against true residual and against forward error.

#include "linear_bench.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/linear/solve.hpp"
#include "taut/report/median.hpp"
#include "taut/report/svg_plot.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cstdio>
#include <limits>

namespace bench {

using namespace taut::linear;

namespace {

constexpr int kTurns = 10;
constexpr std::uint32_t kMost = 2000; // iterations
constexpr double kTolerances[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
constexpr Format kFormats[] = {Format::csr, Format::sell, Format::bcsr3};
constexpr SolvePrecision kPrecisions[] = {SolvePrecision::float32, SolvePrecision::mixed,
                                          SolvePrecision::float64};
constexpr Preconditioner kPreconditioners[] = {Preconditioner::none,         Preconditioner::jacobi,
                                               Preconditioner::block_jacobi, Preconditioner::chebyshev,
                                               Preconditioner::multigrid,    Preconditioner::spai0};

/// What one setting did.
struct Work
{
    SolveOptions options;
    SolveReport report;
    double milliseconds = 0; ///< iterations only, median
    double low = 0, high = 0; ///< first and third quartile
    double error = 0;        ///< forward
    std::string refused;
    std::vector<double> times = {};

    bool reached(double tolerance) const { return refused.empty() && report.relative_residual <= tolerance; }
};

struct Study
{
    System system;
    std::vector<Work> all;
};

std::vector<Work> all_settings()
{
    std::vector<Work> all;
    for (const Format format : kFormats)
        for (const SolvePrecision precision : kPrecisions)
            for (const Preconditioner preconditioner : kPreconditioners)
                for (const double tolerance : kTolerances)
                {
                    Work work;
                    work.options.format = format;
                    work.options.precision = precision;
                    work.options.preconditioner = preconditioner;
                    work.options.tolerance = tolerance;
                    work.options.max_iterations = kMost;
                    all.push_back(work);
                }
    return all;
}

/// All settings take turns.
Study measure(System system, const std::shared_ptr<taut::Device>& device)
{
    std::fprintf(stderr, "%s\n", system.name.c_str());
    Study study{std::move(system), all_settings()};
    for (int turn = 0; turn < kTurns; ++turn)
        for (Work& work : study.all)
        {
            if (!work.refused.empty())
                continue;
            try
            {
                const Solution solution = solve(device, study.system.a, study.system.b, work.options);
                work.report = solution.report;
                work.error = forward_error(solution.x, study.system.exact);
                work.times.push_back(solution.report.seconds * 1e3);
            }
            catch (const taut::Error& error)
            {
                work.refused = error.what();
            }
        }
    for (Work& work : study.all)
        if (work.refused.empty())
        {
            work.milliseconds = taut::median(work.times);
            work.low = taut::quantile(work.times, 0.25);
            work.high = taut::quantile(work.times, 0.75);
        }
    return study;
}

/// The cheapest setting that `asked` lets through and that reaches the tolerance.
template <typename Asked>
const Work* cheapest(const Study& study, double tolerance, Asked asked)
{
    const Work* best = nullptr;
    for (const Work& work : study.all)
        if (asked(work.options) && work.reached(tolerance) &&
            (!best || work.milliseconds < best->milliseconds))
            best = &work;
    return best;
}

void print_digits(const std::vector<Study>& studies)
{
    std::printf(
        "| system | precision | ms to 1e-2 | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 | ms a digit | least true "
        "residual | least forward error |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Study& study : studies)
        for (const SolvePrecision precision : kPrecisions)
        {
            std::printf("| %s | %s |", study.system.name.c_str(), std::string(to_string(precision)).c_str());
            const auto asked = [&](const SolveOptions& o) { return o.precision == precision; };
            const Work *first = nullptr, *last = nullptr;
            double digits = 0;
            for (const double tolerance : kTolerances)
            {
                const Work* work = cheapest(study, tolerance, asked);
                std::printf(" %s |", work ? taut::shown(work->milliseconds, 3).c_str() : "never");
                if (work && first)
                    digits += 2;
                if (work && !first)
                    first = work;
                if (work)
                    last = work;
            }
            double residual = std::numeric_limits<double>::infinity(), error = residual;
            for (const Work& work : study.all)
                if (work.refused.empty() && asked(work.options))
                {
                    residual = std::min(residual, work.report.relative_residual);
                    error = std::min(error, work.error);
                }
            std::printf(
                " %s | %s | %s |\n",
                digits > 0 ? taut::shown((last->milliseconds - first->milliseconds) / digits, 2).c_str() : "",
                taut::shown(residual, 2).c_str(), taut::shown(error, 2).c_str());
        }
}

void print_preconditioners(const std::vector<Study>& studies)
{
    std::printf("| system | preconditioner | iterations to 1e-8 in double | ms | set-up ms | format | ms in "
                "mixed | format |\n|---|---|---|---|---|---|---|---|\n");
    for (const Study& study : studies)
        for (const Preconditioner preconditioner : kPreconditioners)
        {
            const auto in = [&](SolvePrecision precision) {
                return cheapest(study, 1e-8, [&](const SolveOptions& o) {
                    return o.tolerance == 1e-8 && o.precision == precision &&
                           o.preconditioner == preconditioner;
                });
            };
            const Work *whole = in(SolvePrecision::float64), *mixed = in(SolvePrecision::mixed);
            std::printf("| %s | %s |", study.system.name.c_str(),
                        std::string(to_string(preconditioner)).c_str());
            if (whole)
                std::printf(" %u | %s | %s | %s |", whole->report.iterations,
                            taut::shown(whole->milliseconds, 3).c_str(),
                            taut::shown(whole->report.setup_seconds * 1e3, 3).c_str(),
                            std::string(to_string(whole->options.format)).c_str());
            else
                std::printf(" never | | | |");
            if (mixed)
                std::printf(" %s | %s |\n", taut::shown(mixed->milliseconds, 3).c_str(),
                            std::string(to_string(mixed->options.format)).c_str());
            else
                std::printf(" never | |\n");
        }
}

std::string csv(const std::vector<Study>& studies, const std::string& conditions)
{
    std::string text = "# " + conditions +
                       "\nsystem,n,nonzeros,format,precision,preconditioner,tolerance,iterations,ms,setup_ms,"
                       "true_residual,forward_error,status,ms_quartile_1,ms_quartile_3,refused\n";
    for (const Study& study : studies)
        for (const Work& w : study.all)
        {
            text += study.system.name + ',' + std::to_string(study.system.a.rows) + ',' +
                    std::to_string(study.system.a.nonzeros()) + ',' +
                    std::string(to_string(w.options.format)) + ',' +
                    std::string(to_string(w.options.precision)) + ',' +
                    std::string(to_string(w.options.preconditioner)) + ',' +
                    taut::shown(w.options.tolerance) + ',';
            if (w.refused.empty())
                text += std::to_string(w.report.iterations) + ',' + taut::shown(w.milliseconds, 5) + ',' +
                        taut::shown(w.report.setup_seconds * 1e3, 3) + ',' +
                        taut::shown(w.report.relative_residual, 4) + ',' + taut::shown(w.error, 4) + ',' +
                        std::string(to_string(w.report.status)) + ',' + taut::shown(w.low, 5) + ',' +
                        taut::shown(w.high, 5) + ",\n";
            else
                text += ",,,,,,,," + taut::csv_cell(w.refused) + '\n';
        }
    return text;
}

enum class Height
{
    residual,
    error,
};

taut::PlotPoint point_of(const Work& work, Height height)
{
    taut::PlotPoint point;
    const bool there = work.refused.empty();
    point.x = there ? work.milliseconds : std::numeric_limits<double>::quiet_NaN();
    point.y = height == Height::residual ? work.report.relative_residual : work.error;
    point.label = taut::shown(work.options.tolerance);
    point.x_low = work.low;
    point.x_high = work.high;
    if (height == Height::residual && work.reached(work.options.tolerance))
        point.floor = work.options.tolerance; // what was asked for is reached: less is chance
    return point;
}

taut::Plot plot_of(const Study& study, Height height, const std::string& what, const std::string& device)
{
    taut::Plot plot;
    plot.title = study.system.name + ": " + what;
    plot.x_label = "time of the iterations, ms";
    plot.y_label =
        height == Height::residual ? "true residual |b - A x| / |b|" : "forward error |x - x*| / |x*|";
    plot.caption = {std::to_string(study.system.a.rows) + " unknowns, " +
                        std::to_string(study.system.a.nonzeros()) + " entries, on " + device +
                        "; a point for each tolerance, 1e-2 to 1e-12; at most " + std::to_string(kMost) +
                        " iterations",
                    "Median of " + std::to_string(kTurns) +
                        " runs in turns with all others; bars go from the first to the third quartile."};
    return plot;
}

/// A line for each precision and format, with Jacobi.
taut::Plot plot_formats(const Study& study, Height height, const std::string& device)
{
    taut::Plot plot = plot_of(study, height, "precision and format, Jacobi", device);
    for (const SolvePrecision precision : kPrecisions)
        for (const Format format : kFormats)
        {
            taut::PlotSeries series{std::string(to_string(precision)) + ", " + std::string(to_string(format)),
                                    {}};
            for (const Work& work : study.all)
                if (work.options.precision == precision && work.options.format == format &&
                    work.options.preconditioner == Preconditioner::jacobi && work.refused.empty())
                    series.points.push_back(point_of(work, height));
            plot.series.push_back(series);
        }
    return plot;
}

/// A line for each preconditioner: at every tolerance the fastest format, in double.
taut::Plot plot_preconditioners(const Study& study, const std::string& device)
{
    taut::Plot plot = plot_of(study, Height::residual, "preconditioners, double, fastest format", device);
    for (const Preconditioner preconditioner : kPreconditioners)
    {
        taut::PlotSeries series{std::string(to_string(preconditioner)), {}};
        for (const double tolerance : kTolerances)
        {
            const Work* best = nullptr;
            for (const Work& work : study.all)
                if (work.options.preconditioner == preconditioner && work.options.tolerance == tolerance &&
                    work.options.precision == SolvePrecision::float64 && work.refused.empty() &&
                    (!best || work.milliseconds < best->milliseconds))
                    best = &work;
            if (best)
                series.points.push_back(point_of(*best, Height::residual));
        }
        plot.series.push_back(series);
    }
    return plot;
}

} // namespace

void run_precision(const PrecisionOptions& options, const std::string& conditions)
{
    const auto device = taut::Device::open(options.device);
    std::vector<Study> studies;
    if (const std::filesystem::path folder = matrix_folder(); !folder.empty())
        for (const char* name : {"bcsstk16", "fv3", "nos3"})
            studies.push_back(measure(
                manufactured(name,
                             read_matrix_market((folder / (std::string(name) + ".mtx")).string()).matrix),
                device));
    studies.push_back(measure(manufactured("poisson3d_30", poisson3d(30)), device));
    print_digits(studies);
    std::printf("\n");
    print_preconditioners(studies);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv(studies, conditions));
    if (options.pictures.empty())
        return;
    std::filesystem::create_directories(options.pictures);
    const std::string name = device->info().name + " (" + device->info().selector + ")";
    for (const Study& study : studies)
    {
        const auto file = [&](const char* what) { return options.pictures / (study.system.name + what); };
        taut::write_svg(file("_residual.svg"), plot_formats(study, Height::residual, name));
        taut::write_svg(file("_error.svg"), plot_formats(study, Height::error, name));
        taut::write_svg(file("_preconditioners.svg"), plot_preconditioners(study, name));
    }
}

} // namespace bench
