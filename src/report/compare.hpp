#pragma once
// Variants of one scene side by side: what each costs, how far it stretches, where it ends.

#include "taut/report/residuals.hpp"
#include "taut/report/svg_plot.hpp"
#include "taut/report/time_series.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace taut {

struct Variant
{
    std::string label;
    Scene scene; ///< resolved
    std::shared_ptr<Device> device;
};

struct CompareRow
{
    std::string label, method, executor;
    std::string refusal;          ///< why the plan refuses it; the rest is then empty
    bool interrupted = false;     ///< `progress` stopped it, or before it began: then the rest is empty
    StepReport report;            ///< at the end
    double worst_stretch = 0;     ///< (l - L)/L, largest over all frames looked at
    double worst_rms_stretch = 0; ///< the same of the root mean square of tension
    bool springs = true;          ///< false: nothing has a strain along an edge
    double smallest_volume = 1;   ///< V / V0, of all frames looked at; of scenes with volumes
    double mean_volume = 0;       ///< V / V0, over all frames looked at
    std::uint32_t measured = 0;   ///< frames looked at
    double highest_energy = 0;    ///< J, kinetic and potential
    Residuals residuals;          ///< of one step further; -1 where there is none
    std::vector<TimeSample> series; ///< at the frames that were measured
    double step_ms = 0;           ///< median wall time of a step, waiting included
    /// e_L of the last frame against the first variant that ran; empty where vertices do not correspond.
    std::optional<double> difference;
    std::vector<glm::dvec3> positions; ///< m, at the end
};

/// Runs each variant for so many time steps, one after another. A variant that its plan refuses is a row with
/// the reason. `progress` is called before each step; false stops: the run at hand ends there, `interrupted`
/// where it is sound, and the remaining ones do not begin. Throws Error{bad_input} without variants.
std::vector<CompareRow> compare(const std::vector<Variant>& variants, std::uint64_t frames,
                                const std::function<bool()>& progress = {});

/// A table in Markdown, and the same as CSV.
std::string compare_markdown(const std::vector<CompareRow>& rows);
std::string compare_csv(const std::vector<CompareRow>& rows);
/// The series of all variants that ran, a line for each sample, as CSV.
std::string compare_series_csv(const std::vector<CompareRow>& rows);
/// The same as curves over time: e_V = |V - V0| / V0 of scenes with volumes, else the largest strain.
/// Variants without a curve are listed with the reason. `scene`: the name in the title.
Plot compare_series_plot(const std::string& scene, const std::vector<CompareRow>& rows);

} // namespace taut
