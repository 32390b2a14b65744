#include "taut/kernels/pbd_volume.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_volume::Params;

TEMPLATE_TEST_CASE("a PBD tetrahedron moves its corners by its share of the volume that is missing", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "slots");
    const float share = GENERATE(1.0f, 0.3f, 1.5f);
    const bool report = share < 1.2f;
    CAPTURE(count, variant, share);
    Random random(2800 + count);
    PbdInput<Real> in;
    for (const std::uint32_t n : {5u, count, 5u}) // before and after: colours which must not be touched
        add_volume_colour(in, random, n);
    plant_volumes(in, in.volume_colours[1], count);
    check_pbd_colours<Params>(kernels::pbd_volume::info, in, in.tetrahedron, in.volume_colours, 1, 2, variant,
                              share, report);
}

TEMPLATE_TEST_CASE("colours of PBD tetrahedra in one group give what one dispatch a colour gives", "", float,
                   double)
{
    using Real = TestType;
    Random random(2900);
    PbdInput<Real> in;
    for (const std::uint32_t n : {3u, 64u, 65u, 1u, 200u})
        add_volume_colour(in, random, n);
    plant_volumes(in, in.volume_colours[1], 64);
    for (const char* variant : {"tail", ""})
        check_pbd_colours<Params>(kernels::pbd_volume::info, in, in.tetrahedron, in.volume_colours, 1, 4,
                                  variant, 0.5f, true);
}
