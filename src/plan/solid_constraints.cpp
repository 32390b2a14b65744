#include "taut/plan/solid_constraints.hpp"

#include "taut/plan/coloured_set.hpp"
#include "taut/plan/records.hpp"

namespace taut {
namespace {

/// Those with a corner that moves, in plan vertices.
template <typename Element>
std::vector<Element> acting(const PlanBuilder& b, std::size_t body, std::vector<Element> all)
{
    std::erase_if(all, [&](Element& e) {
        double moves = 0;
        for (std::uint32_t& v : e.vertex)
        {
            v = b.vertex(body, v);
            moves += b.inverse_mass[v];
        }
        return !(moves > 0);
    });
    return all;
}

} // namespace

std::vector<VolumeElement> acting_volumes(const PlanBuilder& b, std::size_t body)
{
    return acting(b, body, volume_elements(b.scene.bodies[body]));
}

std::vector<SolidElement> acting_solids(const PlanBuilder& b, std::size_t body)
{
    return acting(b, body, solid_elements(b.scene.bodies[body]));
}

std::vector<SolidElement> all_solids(const PlanBuilder& b)
{
    std::vector<SolidElement> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (auto of : {solid_elements, volume_solids})
            for (SolidElement& e : acting(b, body, of(b.scene.bodies[body])))
                out.push_back(e);
    return out;
}

void prepare_volume(PlanBuilder& b)
{
    prepare_set(
        b, {"volume", true}, 1, [&](std::size_t body) { return acting_volumes(b, body); },
        [](auto zero, const VolumeElement& e) { return volume_record<decltype(zero)>(e); });
}

void record_volume(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "volume"))
        record_colours(b, *set, "xpbd_volume", 4, moment);
}

void prepare_neo_hookean(PlanBuilder& b)
{
    prepare_set(
        b, {"neo_hookean", true}, 4, [&](std::size_t body) { return acting_solids(b, body); },
        [](auto zero, const SolidElement& e) { return solid_record<decltype(zero)>(e); });
}

void record_neo_hookean(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "neo_hookean"))
        record_colours(b, *set, "neo_hookean", 4, moment);
}

} // namespace taut
