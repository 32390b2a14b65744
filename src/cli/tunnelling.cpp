#include "taut/cli/tunnelling.hpp"

#include "taut/report/look_due.hpp"
#include "taut/report/warnings.hpp"

namespace taut::cli {
namespace {

constexpr std::size_t kSentences = 3;

std::string where(const Crossing& c)
{
    return "\"" + c.body + "\" and collider \"" + c.collider + "\" (frame " + std::to_string(c.frame) + ", " +
           number(c.time, 3) + " s)";
}

Json list_json(const std::vector<Crossing>& list)
{
    Json out = Json::array();
    for (const Crossing& c : list)
        out.push_back({{"body", c.body}, {"collider", c.collider}, {"frame", c.frame}, {"time", c.time}});
    return out;
}

} // namespace

TunnelWatch::TunnelWatch(const Simulation& simulation, std::uint64_t frames)
    : simulation_(simulation),
      frames_(frames),
      torn_(simulation.torn()),
      watch_(simulation.scene())
{
    look(0);
}

void TunnelWatch::after(std::uint64_t frame)
{
    const double next = simulation_.time() + simulation_.scene().timestep;
    if (look_due(frame, frames_, kCrossingLooks) || next - looked_ > watch_.clear_for())
        look(frame);
}

void TunnelWatch::look(std::uint64_t frame)
{
    if (!watch_.needed())
        return;
    if (simulation_.torn() != torn_)
        watch_.set_scene(simulation_.scene());
    torn_ = simulation_.torn();
    looked_ = simulation_.time();
    const double substep = simulation_.scene().timestep / simulation_.substeps();
    watch_.look(frame, looked_, substep, simulation_.positions(), simulation_.velocities());
}

void describe_crossings(const Crossings& crossings, std::map<std::string, std::uint64_t>& warnings,
                        std::vector<std::string>& messages)
{
    count(Warning::tunnelling, crossings.seen.size(), warnings);
    count(Warning::may_tunnel, crossings.likely.size(), warnings);
    for (std::size_t k = 0; k < std::min(crossings.seen.size(), kSentences); ++k)
        messages.push_back(std::string(crossings.seen[k].through ? "passed through" : "pierced") + ": body " +
                           where(crossings.seen[k]) +
                           "; use more substeps, or finer meshes where vertices alone collide");
    for (std::size_t k = 0; k < std::min(crossings.likely.size(), kSentences); ++k)
        messages.push_back("may pass through each other by speed and size: body " +
                           where(crossings.likely[k]));
}

Json tunnelling_json(const Crossings& crossings)
{
    return {{"passed", crossings.passed},        {"elements", crossings.elements},
            {"depth", crossings.depth},          {"may_tunnel", crossings.may_tunnel},
            {"seen", list_json(crossings.seen)}, {"likely", list_json(crossings.likely)}};
}

} // namespace taut::cli
