#include "taut/report/cost_energy.hpp"

#include "taut/report/cost_design.hpp"
#include "taut/report/cost_reference.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/separate_start.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

void check_conservative(const Scene& scene)
{
    const auto refuse = [](const char* what) {
        throw Error(ErrorCode::bad_input,
                    std::string(what) + ": energy is not kept; take it out of the scene.");
    };
    if (scene.bodies.empty())
        refuse("bodies is empty");
    if (scene.damping > 0)
        refuse("damping is above 0");
    if (!scene.colliders.empty())
        refuse("there are colliders");
    for (const Body& body : scene.bodies)
    {
        if (body.material.stretch_damping > 0)
            refuse("stretch_damping is above 0");
        if (body.material.plastic_yield > 0)
            refuse("plastic_yield is above 0");
        for (const Pin& pin : body.pins)
            if (is_led(pin))
                refuse("a pin moves");
    }
}

/// Energies in J; `reference` grows to the largest kinetic energy.
EnergyRun run_one(const Scene& scene, const std::shared_ptr<Device>& device, const MethodSettings& settings,
                  std::size_t frames, double& reference)
{
    EnergyRun out{settings, {}, {}, ""};
    try
    {
        Scene mine = scene;
        mine.method = settings;
        World world(mine, device);
        for (std::size_t f = 0; f <= frames && out.reason.empty(); ++f)
        {
            if (f > 0)
                world.step();
            const StepReport report = measure(world);
            const double energy = report.kinetic_energy + report.potential_energy;
            if (rank(report.status) >= rank(Status::diverged) || !std::isfinite(energy))
            {
                out.reason = std::string(to_string(report.status)) + " in frame " + std::to_string(f);
                break;
            }
            reference = std::max(reference, report.kinetic_energy);
            out.energy.push_back(energy);
            if (report.momentum_error >= 0)
                out.momentum.push_back(report.momentum_error);
        }
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::bad_input || error.code() == ErrorCode::device_lost)
            throw;
        out.reason = std::string(to_string(error.code())) + ": " + error.what();
    }
    if (out.momentum.size() < out.energy.size())
        out.momentum.clear();
    return out;
}

} // namespace

EnergyStudy run_energy(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options)
{
    const bool done = std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.mesh.positions.empty(); });
    const Scene resolved = with_start(done ? scene : resolve(scene));
    check_conservative(resolved);
    EnergyStudy out{resolved.name, resolved.timestep, 0, {}};
    const std::size_t frames = cost::wanted_frames(resolved, options);
    for (const MethodKind kind : options.methods)
        for (const Precision precision : options.precisions)
            for (const MethodSettings& settings :
                 options.designed ? method_design(kind, precision, resolved.method)
                                  : method_product(kind, precision, options, resolved.method))
                if (!(options.progress && !options.progress(out.runs.size(), 0)))
                    out.runs.push_back(run_one(resolved, device, settings, frames, out.reference_energy));
    for (EnergyRun& run : out.runs)
    {
        const double first = run.energy.empty() ? 0 : run.energy[0];
        for (double& energy : run.energy)
            energy = out.reference_energy > 0 ? (energy - first) / out.reference_energy : 0;
    }
    return out;
}

std::string energy_csv(const EnergyStudy& study)
{
    std::string out = "setting,time,energy,momentum\n";
    for (const EnergyRun& run : study.runs)
        for (std::size_t f = 0; f < run.energy.size(); ++f)
            out += "\"" + settings_text(run.settings) + "\"," +
                   shown(static_cast<double>(f) * study.timestep, 6) + "," + shown(run.energy[f], 4) + "," +
                   (run.momentum.empty() ? "" : shown(run.momentum[f], 4)) + "\n";
    return out;
}

Plot energy_plot(const EnergyStudy& study, Conserved what)
{
    Plot plot;
    const bool energy = what == Conserved::energy;
    plot.title = std::string(energy ? "Energy" : "Momentum") + " against time: " + study.scene;
    plot.x_label = "time, s";
    plot.y_label = energy ? "|E - E(0)| / E_ref" : "|P - P(0) - impulse| / (M v_ref)";
    plot.front = false;
    plot.x_linear = true;
    for (const EnergyRun& run : study.runs)
    {
        const std::vector<double>& values = energy ? run.energy : run.momentum;
        PlotSeries series{settings_text(run.settings), {}, false, "", method_style(run.settings.type)};
        for (std::size_t f = 1; f < values.size(); ++f)
            if (values[f] != 0)
                series.points.push_back(
                    {static_cast<double>(f) * study.timestep, std::abs(values[f]), "", 0});
        if (!series.points.empty())
            add_variant(plot, std::move(series));
        if (!run.reason.empty())
            plot.gaps.push_back(settings_text(run.settings) + ": " + run.reason);
    }
    if (energy)
        plot.caption.push_back("E_ref = " + shown(study.reference_energy, 4) +
                               " J, the largest kinetic energy of all runs.");
    plot.caption.emplace_back(
        "No reference: both are kept by the model itself (class R1). Zeros are not drawn.");
    return plot;
}

std::vector<std::string> energy_sentences(const EnergyStudy& study)
{
    std::vector<std::string> out;
    for (const EnergyRun& run : study.runs)
    {
        std::string text = settings_text(run.settings) + ": ";
        if (!run.reason.empty())
            text += run.reason;
        else if (!run.energy.empty())
        {
            const double last = run.energy.back();
            text +=
                std::string(last < 0 ? "loses " : "gains ") + shown_percent(std::abs(last)) + " of E_ref";
            if (!run.momentum.empty())
                text += ", momentum off by at most " +
                        shown(*std::max_element(run.momentum.begin(), run.momentum.end()), 2);
        }
        out.push_back(text + ".");
    }
    return out;
}

} // namespace taut
