#pragma once
// What a plan is refused for: gathered, so that `taut check` names all of it, by field.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

#include <utility>
#include <vector>

namespace taut {

struct DeviceTraits;

/// A refusal as an issue of the scene. Messages of planning begin with the field that they are of, and go on
/// with "is", "has" or a colon ("bodies[0].material.model is ..."); the field is empty where one does not.
SceneIssue issue_of(const Error& error);

/// Refusals of one scene, in the order in which they were found. Not thread-safe.
class Refusals
{
public:
    /// Runs `look`; an Error that it throws is one refusal, and one of `out_of_memory` is thrown on.
    template <typename Look>
    void attempt(Look&& look)
    {
        try
        {
            std::forward<Look>(look)();
        }
        catch (const Error& error)
        {
            if (error.code() == ErrorCode::out_of_memory)
                throw;
            found_.push_back(error);
        }
    }
    /// The same for every body of `scene`, which `look` takes with its number.
    template <typename Look>
    void attempt_bodies(const Scene& scene, Look&& look)
    {
        for (std::size_t k = 0; k < scene.bodies.size(); ++k)
            attempt([&] { look(scene.bodies[k], k); });
    }
    /// As make_plan() throws them: the first, if there is any.
    void throw_first() const
    {
        if (!found_.empty())
            throw Error(found_.front());
    }
    const std::vector<Error>& found() const { return found_; }

private:
    std::vector<Error> found_;
};

/// All that make_plan() would refuse a resolved scene for before it plans anything: what method, effects and
/// elements cannot do, body by body. Time: linear. Thread-safe. Throws Error{out_of_memory}.
std::vector<SceneIssue> plan_issues(const Scene& resolved, const DeviceTraits& traits);

} // namespace taut
