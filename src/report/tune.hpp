#pragma once
// The cheapest method and setting for a scene, a device and a bound on the error (docs/tune.md).

#include "taut/report/cost.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// What the bound is on.
enum class TuneCriterion
{
    motion, ///< e_traj, or e_disp of a scene that comes to rest
    volume  ///< e_V, the largest |V - V0| / V0 of a body, of all frames: of how it moves nothing is asked
};

struct TuneOptions
{
    double error = 0.01;             ///< bound on the error, (0, 1)
    /// Where no reference is good enough for `error`, or nothing that was tried keeps it: the first of 2, 5
    /// and 10 % that has a setting, if those are above it.
    bool loosen = false;
    TuneCriterion by = TuneCriterion::motion;
    /// Empty: all but those of another material (other_material() in tune_parts.hpp).
    std::vector<MethodKind> methods;
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
    CostKind kind = CostKind::automatic;
    std::size_t frames = 120;       ///< moving: of the last rung, at most; a reference may verify fewer
    double rest_seconds = 30;       ///< at rest: simulated s at most until a setting must rest
    double timing_seconds = 2;      ///< wall s after which no further repetition starts
    double reference_steps = 6e8;   ///< element steps of R3 at most, for each of three references
    /// Wall s for the whole search: what is not tried until then is named in the result. Infinite: the answer
    /// does not depend on the machine's speed.
    double seconds = std::numeric_limits<double>::infinity();
    std::function<double()> clock; ///< s since some moment; empty: the machine's own
    /// Price is the prior alone, with the default costs of a device: nothing is timed, the same on every
    /// machine.
    bool prior_only = false;
    /// Called before each candidate; false stops, and what is left is not tried.
    std::function<bool(std::size_t done, std::size_t total)> progress;
};

enum class TuneAnswer
{
    found,
    no_reference,      ///< none can be trusted
    poor_reference,    ///< its own error takes too much of the bound: nothing was tried
    unsound_reference, ///< it ends with more tetrahedra inside out than the scene accepts: nothing was tried
    none_of_tried      ///< of `tried` none keeps the bound
};
std::string_view to_string(TuneAnswer answer); ///< "found", "no_reference", ...

/// Where a candidate fell.
struct TuneRejection
{
    MethodSettings settings;
    std::string stage; ///< "filter", "material", "race", "guard", "perturbed", "price"
    std::string reason;
    std::optional<double> error; ///< at the rung where it fell
};

/// What was left, and why.
struct TuneLeft
{
    MethodSettings settings;
    std::string reason;
};

struct TuneResult
{
    std::string scene;
    DeviceInfo device;
    CostKind kind = CostKind::moving;
    std::string metric;
    std::size_t frames = 0; ///< moving: of the last rung
    double bound = 0;       ///< that the answer is for: TuneOptions::error, or what that was loosened to
    CostReference reference;
    TuneAnswer answer = TuneAnswer::none_of_tried;
    std::string why; ///< where nothing is found: a sentence with what would help; else empty
    bool found = false, interrupted = false;
    bool kept = false; ///< the scene's own setting holds the bound and nothing is 10 % cheaper
    MethodSettings settings;
    double predicted_error = 0;       ///< on the scene's own start: what the race went by
    double confirmed_error = 0;       ///< the worst of that and of the perturbed starts
    std::size_t starts = 0;           ///< that it was confirmed on
    double predicted_ms = 0;          ///< per simulated second, by the prior
    std::optional<double> ms, cpu_ms; ///< timed, wall and process; empty with prior_only
    std::vector<TuneRejection> rejected;
    std::vector<MethodSettings> tried; ///< simulated, in that order
    std::vector<TuneLeft> not_tried;
    std::vector<std::string> notes;
};

/// "xpbd in float: 1, 2, 4 substeps x 1 iteration; 1, 4 substeps x 4 iterations": a line for each method,
/// precision and choice of its own.
std::vector<std::string> listed_settings(const std::vector<MethodSettings>& settings);

/// Static filter, prices, race over rungs of 18, 48 and 120 frames with slack 3, 2, 1, guards, two perturbed
/// starts, a margin of 0.8 and hysteresis of 10 %. Throws Error{bad_input} for impossible options, among them
/// a bound on volume where no body has one or at rest.
TuneResult tune(const Scene& scene, std::shared_ptr<Device> device, const TuneOptions& options = {});

std::string tune_json(const TuneResult& result); ///< one object, indented

} // namespace taut
