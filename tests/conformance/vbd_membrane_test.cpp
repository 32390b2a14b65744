// Membranes in the blocks of vertices.

#include "support/element_blocks.hpp"
#include "support/membrane.hpp"

#include "taut/kernels/vbd_membrane.hpp"

using namespace taut;
using namespace taut::elements_test;

TEMPLATE_TEST_CASE("membranes bring slope and curvature to the blocks of vertices", "", float, double)
{
    check_blocks<TestType, Membrane, kernels::vbd_membrane::Params>(kernels::vbd_membrane::info);
}
