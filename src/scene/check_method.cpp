// Checks of how a scene advances: method and wind.

#include "taut/scene/checker.hpp"

#include <array>

namespace taut::scene_file {
namespace {

constexpr std::uint32_t kMaxIterations = 1000;

/// A share: in [low, high], or below high only.
void check_share(const Checker& out, std::string_view member, double value, double high, bool zero, bool top)
{
    const bool good = (zero ? value >= 0 : value > 0) && (top ? value <= high : value < high);
    if (!good)
        out.error(member, "is " + shown(value) + "; it must be " + (zero ? "0 or more" : "above 0") +
                              " and " + (top ? "at most " : "below ") + shown(high));
}

void check_explicit(const MethodSettings& method, const Checker& out)
{
    constexpr std::array<std::string_view, 3> integrators = {"semi_implicit", "explicit", "verlet"};
    constexpr std::array<std::string_view, 3> stabilities = {"refuse", "substep", "ignore"};
    constexpr std::array<std::string_view, 5> schemes = {"automatic", "node_centric", "spring_centric",
                                                         "coloured", "constraint_centric"};
    constexpr std::array<std::string_view, 3> starts = {"adaptive", "inertial", "previous"};
    out.word("integrator", method.integrator, integrators);
    out.word("stability", method.stability, stabilities);
    out.word("scheme", method.scheme, schemes);
    out.word("start", method.start, starts);
    const bool pbd = method.type == "pbd", springs = method.type == "mass_spring";
    if (pbd && method.scheme == "spring_centric")
        out.error("scheme", "is \"spring_centric\"; pbd has \"coloured\", \"node_centric\" and "
                            "\"constraint_centric\"");
    if (springs && (method.scheme == "coloured" || method.scheme == "constraint_centric"))
        out.error("scheme",
                  "is \"" + method.scheme + "\"; mass_spring has \"node_centric\" and \"spring_centric\"");
    check_share(out, "stretch", method.stretch, 1, true, true);
    check_share(out, "bend", method.bend, 1, true, true);
    check_share(out, "volume", method.volume, 1, true, true);
    check_share(out, "relaxation", method.relaxation, 2, false, false);
    check_share(out, "spectral_radius", method.spectral_radius, 1, true, false);
}

void check_implicit(const MethodSettings& method, const Checker& out)
{
    constexpr std::array<std::string_view, 2> operators = {"assembled", "matrix_free"};
    constexpr std::array<std::string_view, 2> constrained = {"all", "structural"};
    constexpr std::array<std::string_view, 2> releases = {"multiplier", "strain"};
    constexpr std::array<std::string_view, 2> targets = {"threshold", "rest"};
    out.range("linear_iterations", method.linear_iterations, 1, 100000);
    check_share(out, "linear_tolerance", method.linear_tolerance, 1, false, false);
    out.word("linear_operator", method.linear_operator, operators);
    out.range("line_search", method.line_search, 0, 16);
    out.word("constrained", method.constrained, constrained);
    if (!(method.constraint_compliance < 0))
        out.not_negative("constraint_compliance", method.constraint_compliance, "m/N");
    out.positive("activate_strain", method.activate_strain, "");
    if (method.compress && !(method.activate_strain < 1))
        out.error("activate_strain",
                  "is " + shown(method.activate_strain) +
                      "; with compress it must be below 1: no spring is shorter than nothing");
    if (!(method.release_strain >= 0 && method.release_strain <= method.activate_strain))
        out.error("release_strain", "is " + shown(method.release_strain) +
                                        "; it must be 0 or more and at most activate_strain");
    out.word("release", method.release, releases);
    out.word("target", method.target, targets);
}

} // namespace

void check_method(const MethodSettings& method, const Checker& out)
{
    constexpr std::array<std::string_view, 2> precisions = {"float", "double"};
    out.word("type", method.type, kMethodNames);
    if (method.substeps != 0) // 0: automatic
        out.range("substeps", method.substeps, 1, kMaxIterations);
    out.range("iterations", method.iterations, 1, kMaxIterations);
    out.word("precision", method.precision, precisions);
    check_explicit(method, out);
    check_implicit(method, out);
}

void check_wind(const Wind& wind, const Checker& out)
{
    out.not_negative("density", wind.density, "kg/m^3");
    out.finite("velocity", wind.velocity, "m/s");
    for (std::size_t i = 0; i < wind.keys.size(); ++i)
    {
        const Checker key = out.at("keys", i);
        key.finite("velocity", wind.keys[i].velocity, "m/s");
        if (key.finite("time", wind.keys[i].time, "s") && i > 0 &&
            !(wind.keys[i].time > wind.keys[i - 1].time))
            key.error("time", "is " + shown(wind.keys[i].time) + " s, and the key before it stands at " +
                                  shown(wind.keys[i - 1].time) + " s; times must ascend");
    }
}

} // namespace taut::scene_file
