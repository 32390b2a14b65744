#pragma once
// Internal to src/world: what a World owns. Shared by world.cpp and world_state.cpp.

#include "taut/world/at_step.hpp"
#include "taut/world/tearing.hpp"
#include "taut/world/world.hpp"

#include <map>
#include <memory>
#include <vector>

namespace taut {

struct World::Impl
{
    Scene scene;
    Plan plan;
    std::shared_ptr<Device> device;
    std::vector<BufferPtr> buffers;       ///< as plan.buffers
    std::unique_ptr<Recording> recording; ///< null when nothing is to be done
    std::uint64_t steps = 0;
    bool guessed = false; ///< the buffer of predictions is of the last substep: no restore() since
    Clock clock;
    bool moves = false;
    std::map<std::uint32_t, double> force_size; ///< N, by scene-wide vertex, of forces set from outside
    double push = 0;                            ///< N s, as WorldDrive::push
    PlanOptions options;
    DeviceTraits traits;
    std::uint64_t torn = 0;     ///< vertices that came apart
    std::uint32_t overlong = 0; ///< what plan.torn counted when it was last looked at

    double time() const { return clock.at(steps); }
    void restart_clock(const Clock& before);
    Pace pace() const;
    Pace pace(const Clock& clock) const;
    std::vector<glm::dvec3> velocities() const;
    void move_velocities(const Pace& before);
    void create_buffers();
    void record();
    void write_inputs();
    void write_all_inputs();
    void count_step();
    void after_step();
    void replace_scene(const TornScene& next);
    template <typename Real>
    std::vector<glm::dvec3> read_vectors(std::uint32_t buffer, std::uint32_t added) const;
    template <typename Real>
    std::vector<Kept> kept() const;
    template <typename Real>
    void repace(const Pace& before);
    std::vector<glm::dvec3> vectors(std::uint32_t buffer, std::uint32_t added = kNoBuffer) const;
    std::vector<std::byte> raw(std::uint32_t buffer) const;
};

} // namespace taut
