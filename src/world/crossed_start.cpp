#include "taut/world/crossed_start.hpp"

#include "taut/world/start_surfaces.hpp"

namespace taut {

std::string crossed_at_start(const Scene& resolved)
{
    const StartSurfaces surfaces(resolved);
    const std::string crossed = surfaces.crossed(surfaces.places());
    if (crossed.empty())
        return {};
    return "surfaces that are to meet go through each other at the start: " + crossed +
           "; move the bodies apart, or set contact.start to \"separate\" or \"ignore\"";
}

} // namespace taut
