#pragma once
// Judging a world part by part: bodies that cannot meet have nothing to give each other, so that what one of
// them may have gained hides nothing of another.

#include "taut/report/soundness.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace taut {

/// What bodies that meet, directly or by others, can hold together. Const members may be called from any
/// thread.
class SceneBudget
{
public:
    /// `resolved` as EnergyBudget takes it.
    explicit SceneBudget(const Scene& resolved);
    /// The same for one who has make_model(resolved) already.
    SceneBudget(const Scene& resolved, std::shared_ptr<const PhysicalModel> model);

    /// Of a world that runs the scene, from its start: each part by judge_motion or judge_state. What has
    /// torn since needs a new budget: Error{bad_input} where there is more than one part. Waits.
    std::vector<Soundness> judge_parts(const World& world, Judged what) const;
    /// The worst of them, the energies of all together, and what is counted of the scene as a whole.
    Soundness judge_whole(const World& world, const std::vector<Soundness>& parts) const;

    std::size_t parts() const { return parts_.size(); }
    /// J, a part each: EnergyBudget::set_damped.
    void set_damped(const std::vector<double>& energy);

private:
    struct Part
    {
        std::string name;              ///< of its first body, for reasons
        std::vector<BodyRange> ranges; ///< of its vertices in the scene; empty: the scene is one part
        Scene scene;                   ///< its bodies alone, without colliders
        EnergyBudget budget;
    };
    std::vector<Part> parts_;
    std::size_t vertices_ = 0; ///< of the scene, where there are several
};

/// A world that runs the scene that `budget` was made of, from its start. Waits.
Soundness judge(const SceneBudget& budget, const World& world, Judged what = Judged::state);

} // namespace taut
