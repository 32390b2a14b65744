#include "taut/report/energy_lost.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/report/model.hpp"
#include "taut/report/report.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr double kNothing = 1e-6; ///< of all that there can be: rounding

} // namespace

std::optional<double> energy_lost(const World& world, const PhysicalModel& model,
                                  std::span<const glm::dvec3> x, const Soundness& found,
                                  const StepReport& report)
{
    if (!found.energy_exact || world.torn() > 0 || world.scene().method.type == MethodKind::pbd)
        return std::nullopt;
    const double elastic = report.potential_energy - gravity_energy(model, x) - gas_energy(model, x);
    return found.energy_most - report.kinetic_energy - elastic;
}

double lost_share(double lost, double kinetic, double most)
{
    const double freed = lost + kinetic;
    return freed > kNothing * most ? lost / freed : 0;
}

std::vector<std::string_view> energy_takers(const Scene& scene)
{
    std::vector<std::string_view> out;
    const auto add = [&](bool takes, std::string_view name) {
        if (takes)
            out.push_back(name);
    };
    const auto any_material = [&](auto takes) {
        return std::ranges::any_of(scene.bodies, [&](const Body& b) { return takes(b.material); });
    };
    add(scene.damping > 0, "damping");
    add(any_material([](const Material& m) { return m.stretch_damping > 0; }), "stretch_damping");
    add(scene.wind.density > 0 &&
            any_material([](const Material& m) { return m.drag > 0 || m.friction_drag > 0; }),
        "air");
    add(!scene.colliders.empty(), "colliders");
    add(wants_contact(scene), "contact");
    add(any_material([](const Material& m) { return m.plastic_yield > 0; }), "plasticity");
    add(scene.max_speed > 0, "max_speed");
    return out;
}

} // namespace taut
