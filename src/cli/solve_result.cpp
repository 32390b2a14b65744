#include "taut/cli/solve_result.hpp"

#include "taut/runtime/base/shown.hpp"

namespace taut::cli {
namespace {

std::string error_text(const SolveResult& result)
{
    const linear::SolveReport& report = result.report;
    std::string text = "true residual " + number(report.relative_residual, 3) +
                       " of |b| (the recurrence says " + number(report.recursive_residual, 3) + ")";
    if (result.forward_error)
        text += ", forward error " + number(*result.forward_error, 3);
    return text;
}

std::string time_text(const linear::SolveReport& report)
{
    std::string text =
        number(1e3 * report.seconds, 3) + " ms for " + counted(report.iterations, "iteration", "iterations");
    if (report.iterations > 0)
        text += " (" + number(report.ms_per_iteration, 3) + " ms each)";
    text += ", set-up " + number(1e3 * report.setup_seconds, 3) + " ms";
    if (report.spmv_gb_per_s > 0)
        text += ", a product alone moves " + number(report.spmv_gb_per_s, 3) + " GB/s";
    return text;
}

} // namespace

Json to_json(const SolveResult& result)
{
    const linear::SolveReport& report = result.report;
    Json json = {{"status", to_string(report.status)}, {"reason", report.reason}};
    json["iterations"] = report.iterations;
    json["tolerance"] = result.tolerance;
    json["relative_residual"] = report.relative_residual;
    json["recursive_residual"] = report.recursive_residual;
    json["forward_error"] = result.forward_error ? Json(*result.forward_error) : Json(nullptr);
    json["replacements"] = report.replacements;
    json["seconds"] = report.seconds;
    json["setup_seconds"] = report.setup_seconds;
    json["ms_per_iteration"] = report.ms_per_iteration;
    json["spmv_gb_per_s"] = report.spmv_gb_per_s > 0 ? Json(report.spmv_gb_per_s) : Json(nullptr);
    json["bytes"] = report.bytes;
    json["format"] = to_string(report.format);
    json["format_reason"] = report.format_reason;
    json["precision"] = to_string(report.precision);
    json["preconditioner"] = to_string(report.preconditioner);
    json["device"] = report.device;
    json["n"] = report.n;
    json["nnz"] = report.nnz;
    json["null_part"] = report.null_part;
    json["residual_of_given_b"] = report.residual_of_given_b;
    json["notes"] = report.notes;
    return json;
}

std::string summary(const SolveResult& result)
{
    const linear::SolveReport& report = result.report;
    std::string text = std::string(to_string(report.status)) + ": " + report.reason + "\n";
    text += "system  " + result.matrix + ": " + counted(report.n, "unknown", "unknowns") + ", " +
            counted(report.nnz, "entry", "entries") + "; b " +
            (result.right_hand_side.empty() ? "made from a known x" : "from " + result.right_hand_side) +
            "\n";
    text += "error   " + error_text(result) + "\n";
    text += "time    " + time_text(report) + "\n";
    text += "how     " + std::string(to_string(report.format)) + ", " +
            std::string(to_string(report.precision)) + ", " + std::string(to_string(report.preconditioner)) +
            " on " + report.device + "; the matrix takes " + bytes_text(report.bytes) + "\n";
    if (!report.format_reason.empty())
        text += "format  " + report.format_reason + "\n";
    if (report.null_part > 0)
        text +=
            "null    " + number(report.null_part, 3) + " of |b| lay in the null space and was taken out\n";
    for (const std::string& note : report.notes)
        text += "note    " + note + "\n";
    for (const std::string& file : result.written)
        text += "written " + file + "\n";
    return text;
}

std::string history_csv(const linear::SolveReport& report)
{
    // A device may keep only the last ones.
    const std::uint64_t kept = report.history.size();
    const std::uint64_t first = kept <= report.iterations ? report.iterations + 1 - kept : 0;
    std::string text = "iteration,relative_residual\n";
    for (std::uint64_t k = 0; k < kept; ++k)
        text += std::to_string(first + k) + "," + number(double(report.history[k]), 9) + "\n";
    return text;
}

} // namespace taut::cli
