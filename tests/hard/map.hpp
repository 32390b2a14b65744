#pragma once
// The robustness map: hard cases of cloth and solids x methods. Every cell is run and judged by one rule;
// docs/robustness.md is written from it.

#include "hard/cases.hpp"

#include "taut/plan/methods.hpp"

#include <functional>
#include <string>
#include <vector>

namespace taut::hard {

/// What was seen on the way and at the end of a run.
struct Journey
{
    const World& world;
    std::vector<glm::dvec3> start; ///< m, before the first step
    StepReport first, last;
    double highest_energy = 0; ///< J, kinetic and potential, the first look included
    double scale = 0;          ///< J, that energies are compared with: m g D, and what the start has
    double fastest = 0;        ///< m/s
    double stretch = 0;        ///< largest (l - L)/L
    double deepest = 0;        ///< m below a collider
    double volume = 0;         ///< largest |V/V0 - 1|
};

/// What a criterion says: nothing, or in words what it misses. A cell that may report still fails beyond
/// `worst`, and for words without a number.
struct Missed
{
    Missed() = default;
    Missed(std::string text, double found = kInfinity, double most = 0)
        : words(std::move(text)),
          value(found),
          worst(most)
    {}
    Missed(const char* text) : Missed(std::string(text)) {}
    std::string words;
    double value = kInfinity, worst = 0;
};

struct MapCase
{
    std::string id, what;
    Scene scene;
    int steps = 60;
    /// Empty: as it should be. Else what is not, with its number.
    std::function<Missed(const Journey&)> judge;
    /// Methods that may miss the criterion, up to Missed::worst, and say so (methods.md, "reported").
    MethodSet may_report = 0;
    /// Called before step k; for what changes on the way.
    std::function<void(World&, int)> before_step = {};
    /// Steps of a short run (TAUT_HARD_SHORT) of a long case; 0 = all; < 0: a few, and nothing is judged.
    int short_steps = 0;
    /// In place of one world that is run and judged, for what compares several: the scene with its method,
    /// the steps that there are. Says what judge says; on every executor, with kStepsElsewhere.
    std::function<Missed(const Scene&, const std::shared_ptr<Device>&, int)> check = {};
};

/// Of the executors that do not run the cases whole: of a run that is judged by its end, and of `check`.
inline constexpr int kStepsSound = 10, kStepsElsewhere = 5, kStepsShort = 3; // the last: in a short run

/// The cases; those on real meshes only where the data is.
std::vector<MapCase> map_cases();

/// "pass", "refuses: unstable_timestep", "reports: stretch 4.2" or "FAIL: ...". `whole`: with all steps that
/// the case has in this run, and judged; else "sound so far".
std::string verdict(const MapCase& hard_case, MethodKind method, const std::shared_ptr<Device>& device,
                    bool whole);

/// Settings under which the map runs a method. Solids are springs under methods without neo-Hookean
/// tetrahedra, and hold no volumes under those that cannot (nor, unless asked, within their surface).
void set_method(Scene& scene, MethodKind method);

} // namespace taut::hard
