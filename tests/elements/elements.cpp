#include "elements/energies.hpp"

#include "taut/kernels/xpbd_cubic_spring.hpp"
#include "taut/kernels/xpbd_held_area.hpp"

namespace taut::elements_test {

void add_elements()
{
    [[maybe_unused]] static const bool once = [] {
        add_element({"cubic_spring", 2, {"rest_length", "compliance"}, kernels::xpbd_cubic_spring::all(),
                     energy_of<CubicSpringEnergy>});
        add_element({"held_area", 3, {"rest_area", "compliance"}, kernels::xpbd_held_area::all(),
                     energy_of<HeldAreaEnergy>});
        return true;
    }();
}

} // namespace taut::elements_test
