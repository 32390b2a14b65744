#include "taut/kernels/pbd_hinge.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_hinge::Params;

TEMPLATE_TEST_CASE("a PBD hinge turns its four corners by its share of what is missing", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "slots");
    const float share = GENERATE(1.0f, 0.3f, 1.5f);
    const bool report = share < 1.2f;
    CAPTURE(count, variant, share);
    Random random(2200 + count);
    PbdInput<Real> in;
    for (const std::uint32_t n : {5u, count, 5u}) // before and after: colours which must not be touched
        add_hinge_colour(in, random, n);
    plant_hinges(in, in.hinge_colours[1], count);
    check_pbd_colours<Params>(kernels::pbd_hinge::info, in, in.hinge, in.hinge_colours, 1, 2, variant, share,
                              report);
}

TEMPLATE_TEST_CASE("colours of PBD hinges in one group give what one dispatch a colour gives", "", float,
                   double)
{
    using Real = TestType;
    Random random(2300);
    PbdInput<Real> in;
    for (const std::uint32_t n : {3u, 64u, 65u, 1u, 200u})
        add_hinge_colour(in, random, n);
    plant_hinges(in, in.hinge_colours[1], 64);
    for (const char* variant : {"tail", ""})
        check_pbd_colours<Params>(kernels::pbd_hinge::info, in, in.hinge, in.hinge_colours, 1, 4, variant,
                                  0.5f, true);
}
