#include "taut/cli/run_result.hpp"

#include "taut/cli/output.hpp"
#include "taut/cli/tunnelling.hpp"
#include "taut/report/energy_lost.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/version.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace taut::cli {
namespace {

constexpr double kLostToSay = 0.05; ///< share of energy that is lost

/// Nearest rank; 0 of nothing.
double percentile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

template <class Value>
Json or_null(const std::optional<Value>& value)
{
    return value ? Json(*value) : Json();
}

std::string hex(std::uint64_t value)
{
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

Json solver_json(const SolverReport& solver)
{
    return {{"solves", solver.solves},        {"iterations", solver.iterations},
            {"most_iterations", solver.most}, {"at_limit", solver.limited},
            {"failed", solver.failed},        {"last_status", to_string(solver.last)}};
}

/// What was left out for any reason is missing.
Json contacts_json(const StepReport& report)
{
    const ContactCounts& c = report.contacts;
    Json forces = Json::array();
    for (const BodyContactForce& f : report.contact_forces)
        forces.push_back({{"a", f.a},
                          {"b", f.b},
                          {"pairs", f.pairs},
                          {"push", f.push},
                          {"friction", f.friction},
                          {"force", {f.force.x, f.force.y, f.force.z}}});
    Json json = {{"pairs", c.pairs},       {"candidates", c.candidates},
                 {"searches", c.searches}, {"missing", c.missing + c.cut + c.crowded},
                 {"capacity", c.capacity}, {"depth", report.contact_depth},
                 {"forces", forces}};
    if (c.guarded)
        json.update(Json{{"filtered", c.filtered},
                         {"pinched", c.pinched},
                         {"held", c.held},
                         {"refined", c.refined},
                         {"untangled", c.untangled}});
    return json;
}

Json passes_json(const std::vector<EffectTime>& passes)
{
    Json list = Json::array();
    for (const EffectTime& pass : passes)
        list.push_back({{"name", pass.name}, {"ms", pass.milliseconds}, {"dispatches", pass.dispatches}});
    return list;
}

Json parts_json(const std::vector<HybridPart>& parts)
{
    Json list = Json::array();
    for (const HybridPart& part : parts)
        list.push_back({{"device", part.device.name},
                        {"executor", part.device.executor},
                        {"bodies", part.bodies.size()},
                        {"vertices", part.vertices},
                        {"work", part.work},
                        {"ms", part.milliseconds}});
    return list;
}

/// Of methods that have them.
std::string residuals(const StepReport& report)
{
    std::string text;
    if (report.primal_residual >= 0)
        text += "; residual " + number(report.primal_residual, 2) + " primal";
    if (report.dual_residual >= 0)
        text += std::string(text.empty() ? "; residual " : ", ") + number(report.dual_residual, 2) + " dual";
    return text;
}

/// A body without springs has no stretch, one without tetrahedra no volume.
std::string errors_line(const StepReport& report)
{
    std::string text = "errors  ";
    if (report.springs)
        text += "stretch " + number(100 * report.max_stretch, 3) + " % largest, " +
                number(100 * report.rms_stretch, 3) + " % rms; ";
    if (report.volume.any)
        text += "volume " + number(100 * report.volume.ratio, 4) + " %, " +
                std::to_string(report.volume.inverted) + " tetrahedra inverted; ";
    return text + "penetration " + number(1000 * report.penetration, 3) + " mm" + residuals(report) + "\n";
}

double lost_share(const StepReport& report)
{
    return taut::lost_share(*report.energy_lost, report.kinetic_energy, report.energy_most);
}

Json lost_json(const RunResult& result)
{
    return {{"joules", *result.report.energy_lost},
            {"share", lost_share(result.report)},
            {"takers", result.energy_takers}};
}

/// Where the method alone has lost it; empty where that cannot be told, or is next to nothing.
std::string lost_line(const RunResult& result)
{
    const StepReport& report = result.report;
    if (!report.energy_lost || !result.energy_takers.empty() || lost_share(report) < kLostToSay)
        return "";
    return "energy  the method has lost " + number(100 * lost_share(report), 3) +
           " % of what was set free; nothing in the scene takes any\n";
}

} // namespace

Json memory_json(const DeviceCounters& counters)
{
    return {{"buffers", counters.bytes_allocated},
            {"reserved", counters.bytes_reserved},
            {"blocks", counters.memory_blocks}};
}

std::string memory_line(const DeviceCounters& counters)
{
    return "memory  " + bytes_text(counters.bytes_allocated) + " in buffers, " +
           bytes_text(counters.bytes_reserved) + " taken for them\n";
}

Json series_json(const std::vector<TimeSample>& series)
{
    Json list = Json::array();
    for (const TimeSample& sample : series)
    {
        list.push_back({{"frame", sample.frame},
                        {"time", sample.time},
                        {"max_stretch", sample.max_stretch},
                        {"active_share", or_null(sample.active_share)},
                        {"linear_iterations", or_null(sample.linear_iterations)}});
        if (sample.volume)
            list.back()["volume_ratio"] = *sample.volume;
    }
    return list;
}

Json to_json(const RunResult& result)
{
    const StepReport& report = result.report;
    Json json = {{"taut", TAUT_VERSION}, {"scene", result.scene}};
    json["device"] = result.device.name;
    json["executor"] = result.device.executor;
    json["memory"] = memory_json(result.counters);
    json["precision"] = to_string(result.precision);
    json["frames"] = result.frames;
    json["simulated_seconds"] = report.time;
    json["vertices"] = result.vertices;
    json["constraints"] = result.constraints;
    json["colours"] = result.colours;
    json["status"] = to_string(report.status);
    json["reason"] = report.reason.empty() ? Json(nullptr) : Json(report.reason);
    json["warnings"] = report.warnings;
    json["messages"] = result.messages;
    json["step_ms"] = {{"median", percentile(result.step_ms, 0.5)},
                       {"p95", percentile(result.step_ms, 0.95)}};
    json["passes"] = passes_json(result.passes);
    if (!result.parts.empty())
        json["hybrid"] = parts_json(result.parts);
    json["max_stretch"] = report.springs ? Json(report.max_stretch) : Json(nullptr);
    json["rms_stretch"] = report.springs ? Json(report.rms_stretch) : Json(nullptr);
    json["penetration"] = report.penetration;
    json["tunnelling"] = tunnelling_json(result.crossings);
    json["kinetic_energy"] = report.kinetic_energy;
    json["potential_energy"] = report.potential_energy;
    json["judged_energy"] = report.judged_energy;
    json["energy_most"] = report.energy_most;
    json["energy_lost"] = report.energy_lost ? lost_json(result) : Json(nullptr);
    json["momentum_error"] = known(report.momentum_error);
    json["primal_residual"] = known(report.primal_residual);
    json["dual_residual"] = known(report.dual_residual);
    json["imbalance"] = known(report.imbalance);
    json["load_residual"] = known(report.load_residual);
    json["load_way"] = report.load_residual >= 0 ? Json(report.load_way) : Json(nullptr);
    json["solver"] = result.solvers > 0 ? solver_json(report.solver) : Json(nullptr);
    json["active_share"] = known(report.active_share);
    json["series"] = result.solvers > 0 ? series_json(result.series) : Json(nullptr);
    json["contacts"] = report.contacts.any ? contacts_json(report) : Json(nullptr);
    json["torn"] = report.torn;
    if (result.asleep)
        json["asleep"] = *result.asleep;
    if (report.volume.any)
    {
        json["volume_ratio"] = {{"min", result.volume_min}, {"final", report.volume.ratio}};
        json["inverted_elements"] = report.volume.inverted;
    }
    json["position_hash"] = hex(report.position_hash);
    json["folder"] = result.folder;
    json["meshes"] = result.meshes;
    json["pictures"] = result.pictures;
    return json;
}

std::string summary(const RunResult& result)
{
    const StepReport& report = result.report;
    std::string text = std::string(to_string(report.status)) + ": " + std::to_string(result.frames) + " of " +
                       std::to_string(result.frames_wanted) + " frames, " + number(report.time) + " s, on " +
                       result.device.name + " (" + result.device.executor + ")\n";
    text += "step    " + number(percentile(result.step_ms, 0.5), 3) + " ms median, " +
            number(percentile(result.step_ms, 0.95), 3) + " ms at the 95th percentile, " +
            std::to_string(result.vertices) + " vertices\n";
    text += memory_line(result.counters);
    if (!report.reason.empty())
        text += "why     " + report.reason + "\n";
    text += errors_line(report) + lost_line(result);
    if (result.solvers > 0)
        text += "solver  " + std::to_string(report.solver.solves) + " linear solves, " +
                std::to_string(report.solver.iterations) + " iterations, " +
                std::to_string(report.solver.most) + " at most\n";
    if (const ContactCounts& c = report.contacts; c.any)
        text += "contact " + std::to_string(c.pairs) + " pairs, " + std::to_string(c.candidates) +
                " triangles compared, " + std::to_string(c.missing + c.cut + c.crowded) + " missing; depth " +
                number(1000 * report.contact_depth, 3) + " mm\n";
    if (const ContactCounts& c = report.contacts; c.guarded)
        text += "guarded " + std::to_string(c.filtered) + " ways cut, " + std::to_string(c.pinched) +
                " pinched, " + std::to_string(c.held) + " held, " + std::to_string(c.refined) +
                " steps in parts, " + std::to_string(c.untangled) + " times taken apart\n";
    if (report.torn > 0)
        text += "torn    at " + std::to_string(report.torn) + " vertices\n";
    for (const auto& [word, count] : report.warnings)
        text += "warning " + word + " (" + std::to_string(count) + ")\n";
    for (const std::string& message : result.messages)
        text += "warning " + message + "\n";
    for (const HybridPart& part : result.parts)
        text += "device  " + part.device.name + " (" + part.device.executor +
                "): " + counted(part.bodies.size(), "body", "bodies") + ", " + number(part.milliseconds, 3) +
                " ms a step alone\n";
    text += "meshes  " + std::to_string(result.meshes) + " files " + result.folder + "/mesh_*.obj\n";
    text += "report  " + result.folder + "/report.json\n";
    for (const std::string& picture : result.pictures)
        text += "picture " + result.folder + "/" + picture + "\n";
    return text;
}

} // namespace taut::cli
