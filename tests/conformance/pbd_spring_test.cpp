#include "taut/kernels/pbd_spring.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_spring::Params;

TEMPLATE_TEST_CASE("a PBD spring moves both ends by its share of what is missing", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "slots");
    const float share = GENERATE(1.0f, 0.3f, 1.5f);
    const bool report = share < 1.2f;
    CAPTURE(count, variant, share);
    Random random(2000 + count);
    auto in = pbd_vertices<Real>(random, 2 * std::max(count, 5u) + 7);
    for (const std::uint32_t n : {5u, count, 5u}) // before and after: colours which must not be touched
        add_spring_colour(in, random, n);
    plant_springs(in, in.spring_colours[1], count);
    check_pbd_colours<Params>(kernels::pbd_spring::info, in, in.spring, in.spring_colours, 1, 2, variant,
                              share, report);
}

TEMPLATE_TEST_CASE("colours of PBD springs in one group act one after another", "", float, double)
{
    using Real = TestType;
    Random random(2100);
    auto in = pbd_vertices<Real>(random, 500);
    for (const std::uint32_t n : {5u, 64u, 1u, 200u, 65u, 9u})
        add_spring_colour(in, random, n);
    plant_springs(in, in.spring_colours[1], 64);
    for (const char* variant : {"tail", ""})
        check_pbd_colours<Params>(kernels::pbd_spring::info, in, in.spring, in.spring_colours, 1, 5,
                                  variant, 0.5f, true);
}
