#pragma once
// A method's settings in words and as a block of a scene file.

#include "taut/plan/methods.hpp"
#include "taut/scene/scene.hpp"

#include <string>
#include <vector>

namespace taut {

/// The method of a name. Throws Error{bad_input} that lists them.
MethodKind method_named(std::string_view name);

/// These settings for that method. What methods read differently is as by default where the method is another
/// one: the scheme, the integrator, relaxation and spectral_radius.
MethodSettings settings_for(MethodKind kind, const MethodSettings& base);

/// Of figures: colour and marker of a method (PlotSeries::style), its place in MethodKind.
int method_style(MethodKind kind);

/// "xpbd,vbd" or "all", in the order of MethodKind and each once. Throws Error{bad_input}.
std::vector<MethodKind> methods_listed(const std::vector<std::string>& names);

/// Whether the method repeats its substeps' solve (docs/scene.md, `iterations`).
bool reads_iterations(MethodKind kind);

/// The keys of a scene's `method` that the method reads, beside type, substeps and precision, which all read.
std::vector<std::string_view> keys_read(MethodKind kind);

/// A warning for each of the keys given for a method (given_method_keys) that it does not read.
std::vector<SceneIssue> unread_keys(const MethodSettings& settings, const std::vector<std::string>& given);

/// What the method reads and is not as by default, beside substeps, iterations and precision:
/// "integrator verlet, scheme spring_centric"; empty when all of it is.
std::string settings_details(const MethodSettings& settings);

/// One JSON object, on one line, that a scene takes as its `method`: type, substeps, iterations, precision
/// and the details.
std::string settings_block(const MethodSettings& settings);

/// "vbd, 20 substeps x 2 iterations in float, start inertial"
std::string settings_text(const MethodSettings& settings);

} // namespace taut
