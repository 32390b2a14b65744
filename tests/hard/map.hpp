#pragma once
// The robustness map: hard cases of cloth and solids x methods. Every cell is run and judged by one rule and
// held against the committed table (map_table.hpp); docs/results/robustness.md is written from that table.

#include "hard/cases.hpp"

#include "taut/plan/methods.hpp"

#include <functional>
#include <map>
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
    double lowest_centre = 0;  ///< m, lowest place of the mean of all vertices along y
    double thinnest = HUGE_VAL;               ///< m, least extent of all vertices along y
    double farthest = 0;                      ///< m, way of a vertex that no pin holds from where it started
    std::vector<bool> held = {};              ///< by a pin, by vertex
    std::map<int, std::uint64_t> hashes = {}; ///< of the positions after so many steps (kHashed)
};

/// One criterion: what was measured, and the most that it may be.
struct Measured
{
    std::string what;
    double value = 0, limit = 0;
    bool missed() const { return !(value <= limit); }
};

/// What a case says of a run: its criteria in a fixed order. The first is the cell's number while none is
/// missed, else the first that is.
struct Findings
{
    Findings() = default;
    Findings(Measured one) : list{std::move(one)} {}
    std::vector<Measured> list;
    bool judged = true; ///< false: too few steps to say
};

/// Multiples of the settings that the map gives a method: what a cell needs to pass.
struct Effort
{
    std::uint32_t substeps = 1, iterations = 1;
    bool in_double = false;
    /// Sweeps or solves of a step, in multiples of the map's; of double precision the same.
    std::uint32_t cost() const { return substeps * iterations; }
    std::string text() const; ///< "4 x substeps, 2 x iterations, double"; empty: the map's own settings
};

struct MapCase
{
    std::string id, what;
    Scene scene;
    int steps = 60;
    /// The case's own criteria.
    std::function<Findings(const Journey&)> judge;
    /// Methods that may miss a criterion and say so, by no more than the committed number allows.
    MethodSet may_report = 0;
    /// Called before step k; for what changes on the way.
    std::function<void(World&, int)> before_step = {};
    /// Steps of a short run (TAUT_HARD_SHORT) of a long case; 0 = all; < 0: kStepsShort, and nothing is
    /// judged, but the numbers are those of the table.
    int short_steps = 0;
    /// For what compares several worlds: the scene with its method, the steps that there are. Its criteria
    /// stand before those that the run of the scene itself is judged by.
    std::function<Findings(const Scene&, const std::shared_ptr<Device>&, int)> check = {};
    /// J that what moves the body (pins, colliders, wind, gravity that turns) may put into it at most.
    std::function<double(const Journey&)> work = {};
    /// Every case is judged by its energy, its inverted tetrahedra and its volume at the end; these are the
    /// limits: (E - E0 - work)/(scale + work), and |V/V0 - 1|.
    double most_energy = 0.01, most_volume = 0.05;
    /// In place of `scene` in a whole run: the size that the literature names, too long for a short one.
    std::function<Scene()> full_size = {};
    /// About bits: compared on Vulkan in a short run too.
    bool compares_bits = false;
    /// Methods that need more than the map's settings (map_effort.cpp).
    std::map<MethodKind, Effort> effort = {};
};

/// The id of cases on data that may not be there.
inline constexpr const char* kDataCase = "mesh";

/// Steps of a short run of a case whose short_steps are < 0, and of the executors that do not run whole.
inline constexpr int kStepsShort = 3;
/// Of a whole run on the executors of drivers, whose dispatches cost thousands of times their work in
/// software: a cell takes as many steps as these make (`test_hard "[.whole]"` counts the whole ones).
inline constexpr std::uint64_t kDispatchesElsewhere = 200000;
/// Positions are hashed after these steps, and after the last.
inline constexpr int kHashed[] = {1, 3, 10, 30, 100, 300, 1000, 5000, 100000};

/// What came of a cell.
struct Outcome
{
    /// "pass", "reports" (missed, and the case says that the method may), "FAIL", "runs" (too few steps to
    /// judge), "refuses bad_timestep", "stops diverged".
    std::string verdict;
    std::vector<Measured> own;     ///< the case's own criteria, then the three that all have
    std::size_t of_case = 0;       ///< how many of them are the case's own, once it is judged
    std::optional<Measured> far;   ///< what is missed besides moved by ten times its size in a substep
    double energy = 0, volume = 0; ///< see MapCase::most_energy
    double inverted = 0;           ///< tetrahedra
    /// Empty where `taut run` would call the run completed, else the status and why. Of what changes on the
    /// way from outside (before_step), which no budget knows of, by the residuals at the end alone.
    std::string called = {};
    std::map<int, std::uint64_t> hashes = {};
    bool refused() const { return verdict.rfind("refuses", 0) == 0; }
    /// The criterion that the verdict is about; of a refusal none.
    Measured shown() const;
    /// The case's own criteria that are missed besides that one.
    std::vector<Measured> also_missed() const;
};

/// The cases; those on real meshes only where the data is.
std::vector<MapCase> map_cases();

/// Steps of the case in this run.
int steps_of(const MapCase& hard_case);

/// Puts into each case what map_effort.cpp says of it; an entry of no case throws std::logic_error.
void put_efforts(std::vector<MapCase>& cases);

/// Runs a cell and judges it.
Outcome judged(const MapCase& hard_case, MethodKind method, const std::shared_ptr<Device>& device);

/// Runs a cell for so many steps and only looks at its hashes; of `check`, at the numbers of as many. Without
/// one no more steps than `dispatches` make (0: any).
Outcome repeated(const MapCase& hard_case, MethodKind method, const std::shared_ptr<Device>& device,
                 int steps, std::uint64_t dispatches = 0);

/// Of `steps` steps of a cell those that so many dispatches make, up to one whose positions are hashed.
int steps_within(std::uint64_t dispatches, const MapCase& hard_case, MethodKind method,
                 const std::shared_ptr<Device>& device, int steps);

/// Settings under which the map runs a method. Solids are springs under methods without neo-Hookean
/// tetrahedra, and hold no volumes under those that cannot (nor, unless asked, within their surface).
void set_method(Scene& scene, MethodKind method);

} // namespace taut::hard
