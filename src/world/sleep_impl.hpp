#pragma once
// Internal to src/world: what SleepWorld is made of. sleep.cpp has falling asleep, sleep_wake.cpp waking.

#include "taut/scene/extent.hpp"
#include "taut/world/carry.hpp"
#include "taut/world/moved.hpp"
#include "taut/world/sleep.hpp"

#include <memory>
#include <vector>

namespace taut {

struct SleepWorld::Impl
{
    Scene scene;
    SleepOptions options;
    std::shared_ptr<Device> device;
    std::vector<std::uint32_t> first; ///< scene-wide vertex of each body, and the total
    std::vector<std::uint32_t> awake; ///< bodies
    std::vector<bool> sleeping;
    std::vector<std::uint32_t> quiet; ///< looks in a row, by body
    std::vector<double> threshold;    ///< m/s, by body; 0 = never sleeps
    CarriedState carried;             ///< of those that sleep, as they fell asleep
    std::vector<glm::dvec3> resting;  ///< m, where they lie; scene-wide
    std::vector<glm::dvec3> seen;     ///< m, at the last look
    std::vector<Extent> box;          ///< of those that sleep
    std::vector<std::uint32_t> led;   ///< bodies with a pin that has a motion
    bool meet = false;                ///< two bodies may
    Moved program;
    std::unique_ptr<World> world;
    Events before; ///< of worlds that are no more; so are the contacts
    ContactCounts met_before;
    std::uint64_t steps = 0, changes = 0;

    std::vector<std::uint32_t> vertices() const { return scene_vertices(world->plan(), awake, first); }
    void plan_anew(const std::vector<bool>& now);
    void look();
    void wake_the_disturbed();
    std::size_t wake(std::size_t body, const char* who);
    void let_go_on(const std::vector<std::uint32_t>& bodies);
    double margin(std::uint32_t body) const { return margin(body, box[body]); }
    double margin(std::uint32_t body, const Extent& at) const;
    bool led_now(std::uint32_t body) const;
    bool stands(std::uint32_t body) const { return scene.bodies[body].kinematic.used && !led_now(body); }
    std::vector<std::uint32_t> islands_of(std::vector<Extent> boxes) const;
    void keep_islands_awake(std::vector<bool>& now, const std::vector<glm::dvec3>& x) const;
    void add_approached(std::vector<std::uint32_t>& disturbed) const;
    Extent way_of(std::size_t own, const std::vector<glm::dvec3>& x, const std::vector<glm::dvec3>& v) const;
};

} // namespace taut
