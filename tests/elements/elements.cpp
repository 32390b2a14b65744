#include "elements/energies.hpp"

#include "taut/kernels/cubic_spring.hpp"
#include "taut/kernels/held_area.hpp"
#include "taut/kernels/thin_rod.hpp"

namespace taut::elements_test {

void add_elements()
{
    [[maybe_unused]] static const bool once = [] {
        add_element({"cubic_spring", 2, {"rest_length", "compliance"}, kernels::cubic_spring::all(),
                     energy_of<CubicSpringEnergy>});
        add_element({"held_area", 3, {"rest_area", "compliance"}, kernels::held_area::all(),
                     energy_of<HeldAreaEnergy>});
        add_element(
            {"thin_rod", 3, {"stiffness"}, kernels::thin_rod::all(), energy_of<ThinRodEnergy>});
        return true;
    }();
}

} // namespace taut::elements_test
