// Error of conjugate gradients against iteration, for matrices of one size whose condition numbers are
// prescribed, in the three precisions, beside the bound of theory.
//
// Based on: Saad. Iterative Methods for Sparse Linear Systems. 2nd edition, eq. 6.128:
//   |x - x_i|_A <= 2 ((sqrt k - 1) / (sqrt k + 1))^i |x - x_0|_A.
// Departures: none.

#include "linear_device.hpp"

#include "support/spectrum.hpp"
#include "taut/report/svg_plot.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace bench {

using namespace taut::linear;

namespace {

constexpr std::uint32_t kRows = 1536;
constexpr int kDecades[] = {1, 2, 4, 6}; // of the condition number
constexpr double kAsked[] = {1e-3, 1e-6};
constexpr int kMost = 8000;    // iterations
constexpr int kEachDecade = 8; // points of a curve
constexpr SolvePrecision kPrecisions[] = {SolvePrecision::float32, SolvePrecision::mixed,
                                          SolvePrecision::float64};

/// |x - exact|_A over |exact|_A, which is the error of the start x = 0.
double energy_error(const System& system, const std::vector<double>& x)
{
    const auto squared = [&](const std::vector<double>& e) {
        std::vector<double> product(e.size());
        multiply(system.a, e, product);
        double sum = 0;
        for (std::size_t i = 0; i < e.size(); ++i)
            sum += e[i] * product[i];
        return sum;
    };
    std::vector<double> error(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        error[i] = x[i] - system.exact[i];
    return std::sqrt(std::max(squared(error), 0.0) / squared(system.exact));
}

int curve_point(int k) { return static_cast<int>(std::lround(std::pow(10.0, double(k) / kEachDecade))); }

/// The error after so many iterations, each number run once. No preconditioner: Jacobi has a condition number
/// of its own.
class Curve
{
public:
    Curve(const std::string& device, const System& system, SolvePrecision precision)
        : system_(system),
          solver_(device_solver(device, system, Format::csr, precision, false))
    {
        for (int k = 0; curve_point(k) <= kMost; ++k)
        {
            at(curve_point(k));
            if (taken_ < curve_point(k))
                break; // the solver ended by itself: no digit more
        }
    }

    /// Fewest iterations after which the error is at most `asked`; 0: never. The A-norm of the error falls
    /// from iteration to iteration.
    int first_below(double asked)
    {
        int low = 0, high = 0;
        for (const auto& [iterations, error] : errors_)
        {
            if (error <= asked)
            {
                high = iterations;
                break;
            }
            low = iterations;
        }
        while (high - low > 1)
        {
            const int middle = low + (high - low) / 2;
            (at(middle) <= asked ? high : low) = middle;
        }
        return high;
    }

    double least() const
    {
        return std::min_element(errors_.begin(), errors_.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; })
            ->second;
    }
    const std::map<int, double>& errors() const { return errors_; }

private:
    double at(int iterations)
    {
        const auto found = errors_.find(iterations);
        if (found != errors_.end())
            return found->second;
        taken_ = std::max(taken_, solver_->solve(kNever, iterations));
        return errors_[iterations] = energy_error(system_, solver_->x());
    }

    static constexpr double kNever = 1e-18; // a tolerance; its square is a float
    const System& system_;
    std::unique_ptr<DeviceSolver> solver_;
    std::map<int, double> errors_;
    int taken_ = 0;
};

double shrink(double condition) { return (std::sqrt(condition) - 1) / (std::sqrt(condition) + 1); }

int bound_below(double condition, double asked)
{
    return static_cast<int>(std::ceil(std::log(asked / 2) / std::log(shrink(condition))));
}

void draw_bound(double condition, const std::string& label, int style, taut::Plot& plot)
{
    taut::PlotSeries series{"bound, " + label, {}};
    series.style = style;
    series.variant = 2;
    for (int k = 0; curve_point(k) <= kMost; ++k)
        if (const double value = 2 * std::pow(shrink(condition), curve_point(k)); value >= 1e-16)
            series.points.push_back({double(curve_point(k)), std::min(value, 1.0), {}});
    plot.series.push_back(std::move(series));
}

void draw(const Curve& curve, const std::string& label, int style, int variant, taut::Plot& plot)
{
    taut::PlotSeries series{label, {}};
    series.style = style;
    series.variant = variant;
    for (const auto& [iterations, error] : curve.errors())
        series.points.push_back({double(iterations), error, {}});
    plot.series.push_back(std::move(series));
}

void run_one(int decades, const std::string& device, std::string& csv, taut::Plot& plot)
{
    const double condition = std::pow(10.0, decades);
    const System system = manufactured("prescribed", taut::test::prescribed_matrix(kRows, condition));
    const std::string k = "1e" + std::to_string(decades);
    const std::string found = taut::shown(taut::test::condition_number(system.a, false), 4);
    const int style = static_cast<int>(plot.series.size()) / 3;
    for (const SolvePrecision precision : kPrecisions)
    {
        Curve curve(device, system, precision);
        const std::string word(to_string(precision));
        std::vector<std::string> cells = {k, word, found};
        for (const double asked : kAsked)
        {
            const int first = curve.first_below(asked);
            cells.push_back(first > 0 ? std::to_string(first) : "never");
            cells.push_back(std::to_string(bound_below(condition, asked)));
        }
        cells.push_back(taut::shown(curve.least(), 2));
        for (const std::string& cell : cells)
        {
            std::printf("| %s ", cell.c_str());
            csv += cell + (&cell == &cells.back() ? '\n' : ',');
        }
        std::printf("|\n");
        if (precision != SolvePrecision::mixed) // which follows double, and stops below float
            draw(curve, word + ", k = " + k, style, precision == SolvePrecision::float64 ? 0 : 1, plot);
    }
    draw_bound(condition, "k = " + k, style, plot);
}

} // namespace

void run_condition(const PrecisionOptions& options, const std::string& conditions)
{
    taut::Plot plot;
    plot.title = "Error against iteration by condition number";
    plot.x_label = "iterations";
    plot.y_label = "error |x - x*|_A / |x*|_A";
    plot.front = false;
    plot.caption = {std::to_string(kRows) +
                    " unknowns; eigenvalues from 1/k to 1, evenly spread in their "
                    "logarithm; csr, no preconditioner, on " +
                    options.device};
    std::printf(
        "| k | precision | k by Lanczos | iterations to 1e-3 | bound | to 1e-6 | bound | least error |\n"
        "|---|---|---|---|---|---|---|---|\n");
    std::string csv = "# " + conditions +
                      "\ncondition,precision,by_lanczos,to_1e-3,bound_1e-3,to_1e-6,bound_1e-6,least_error\n";
    for (const int decades : kDecades)
        run_one(decades, options.device, csv, plot);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv);
    if (options.pictures.empty())
        return;
    std::filesystem::create_directories(options.pictures);
    taut::write_svg(options.pictures / "condition.svg", plot);
}

} // namespace bench
