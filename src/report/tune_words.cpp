// What a search says in words: why nothing was found and what would help, and lists of settings.
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace taut {
namespace {

/// Settings that differ in substeps and iterations alone.
struct Family
{
    std::string name;
    std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> rows; ///< iterations, then substeps
};

std::string counted(const std::string& list, const char* what)
{
    return list + " " + what + (list == "1" ? "" : "s");
}

std::string line(const Family& family, bool iterates)
{
    std::string out;
    for (auto [iterations, substeps] : family.rows)
    {
        std::sort(substeps.begin(), substeps.end());
        std::string list;
        for (const std::uint32_t n : substeps)
            list += (list.empty() ? "" : ", ") + std::to_string(n);
        out += (out.empty() ? ": " : "; ") + counted(list, "substep");
        if (iterates)
            out += " x " + counted(std::to_string(iterations), "iteration");
    }
    return family.name + out;
}

} // namespace

std::string_view to_string(TuneAnswer answer)
{
    switch (answer)
    {
    case TuneAnswer::found: return "found";
    case TuneAnswer::no_reference: return "no_reference";
    case TuneAnswer::poor_reference: return "poor_reference";
    case TuneAnswer::unsound_reference: return "unsound_reference";
    case TuneAnswer::none_of_tried: break;
    }
    return "none_of_tried";
}

std::vector<std::string> listed_settings(const std::vector<MethodSettings>& settings)
{
    std::vector<std::pair<Family, bool>> families;
    for (const MethodSettings& one : settings)
    {
        const std::string details = settings_details(one);
        const std::string name = std::string(to_string(one.type)) + " in " +
                                 std::string(to_string(one.precision)) +
                                 (details.empty() ? "" : ", " + details);
        auto found = std::find_if(families.begin(), families.end(),
                                  [&](const auto& f) { return f.first.name == name; });
        if (found == families.end())
            found = families.insert(found, {{name, {}}, reads_iterations(one.type)});
        auto& rows = found->first.rows;
        auto row =
            std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == one.iterations; });
        if (row == rows.end())
            row = rows.insert(row, {one.iterations, {}});
        row->second.push_back(one.substeps);
    }
    std::vector<std::string> out;
    for (auto& [family, iterates] : families)
    {
        std::sort(family.rows.begin(), family.rows.end());
        out.push_back(line(family, iterates));
    }
    return out;
}

namespace tuning {

Watch::Watch(const TuneOptions& options) : options_(options), begun_(0) { begun_ = now(); }

double Watch::spent() const { return now() - begun_; }

double Watch::now() const
{
    if (options_.clock)
        return options_.clock();
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

std::string no_reference(const TuneResult& result, const TuneOptions& options)
{
    std::string text = "Without a reference that can be trusted no error can be bounded.";
    const double seconds = result.reference.times * options.seconds;
    if (seconds > 0 && std::isfinite(seconds))
        return text + " The time for it was up: the method that comes next needs at least --seconds " +
               shown(seconds, 3) + " (now " + shown(options.seconds, 3) +
               "; see \"passed over\" for how far each came).";
    if (result.kind == CostKind::at_rest)
        return text + " Its trajectory may have one: --moving.";
    return text +
           " No method's substeps can be refined until they agree: see \"passed over\" for what halving "
           "still changes. Such a motion is chaotic or has kinks; more damping, fewer --frames or more "
           "--reference-steps may help.";
}

std::string poor_reference(const TuneResult& result)
{
    const double own = result.reference.error.value_or(0);
    std::string text = "The reference is not good enough: its own error, " + shown_percent(own) +
                       ", is more than " + shown(kReferenceShare, 3) + " of the bound of " +
                       shown_percent(result.bound) + ", so nothing was tried.";
    text += " It is good enough for an --error of " + shown(1.01 * own / kReferenceShare, 3) + " or more";
    return text + (result.kind == CostKind::moving
                       ? "; fewer --frames, more --seconds or more --reference-steps may have a better one."
                       : ".");
}

std::string unsound_reference(std::uint64_t inverted, const Accept& accept)
{
    return "The reference ends with " + std::to_string(inverted) +
           " tetrahedra inside out, accept.inverted is " + std::to_string(accept.inverted) +
           ", so nothing was tried: a run that comes near it is `unconverged`, whatever its setting. "
           "The material does not carry its load: take a stiffer one, or one that keeps its volume, or "
           "accept more.";
}

std::string none_of_tried(const TuneResult& result)
{
    if (result.tried.empty())
        return "No setting was tried" + std::string(result.not_tried.empty()
                                                        ? ": the filter rejected all of them."
                                                        : ": " + result.not_tried[0].reason + ".");
    std::string text =
        "None of the " + std::to_string(result.tried.size()) + " settings tried keeps that error";
    if (result.not_tried.empty())
        return text + "; more substeps than those of the design may (`taut cost --substeps`).";
    return text + ", and " + std::to_string(result.not_tried.size()) +
           " were not tried: " + result.not_tried[0].reason + ".";
}

std::string frames_note(std::size_t good, std::size_t verified, std::size_t wanted)
{
    std::string text = "the error is bounded over the first " + std::to_string(good) + " of " +
                       std::to_string(wanted) + " frames alone: ";
    return text + (good < verified ? "from there on the reference's own error takes more than " +
                                         shown(kReferenceShare, 3) + " of the bound"
                                   : "no reference is verified beyond them");
}

std::vector<std::string> never_rests_note(const Scene& resolved)
{
    if (!held_still(resolved) || !resolved.colliders.empty())
        return {};
    return {
        "without damping the scene never rests: the error is that of its trajectory; with damping above 0 it "
        "would be that at rest"};
}

std::string loosened_note(const TuneResult& result, const TuneOptions& options)
{
    return "the bound is " + shown_percent(result.bound) + ": none is asked for, and with less (from " +
           shown_percent(options.error) +
           " on) no reference is good enough or none of those tried keeps it; --error " +
           shown(options.error, 3) + " insists";
}

std::string perturbed_note(std::uint32_t which, const CostReference& reference, double bound)
{
    const std::string start = "perturbed start " + std::to_string(which) + " is left out: ";
    if (!reference.verified)
        return start + "it has no reference that can be trusted" +
               (reference.passed.empty() ? "" : " (" + reference.passed[0] + ")");
    return start + "its reference's own error, " + shown_percent(reference.error.value_or(0)) +
           ", takes more than " + shown(kReferenceShare, 3) + " of the bound of " + shown_percent(bound);
}

} // namespace tuning
} // namespace taut
