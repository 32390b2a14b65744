#include "taut/kernels/contact_sort.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_sort puts rows of any length in order, and counts those that are too long", "",
                   float, double)
{
    Random random(2700);
    std::vector<std::uint32_t> start = {0}, corner, sorted;
    for (const std::uint32_t size :
         {0u, 1u, 2u, 3u, 40u, 300u, TAUT_CONTACT_CROWD, TAUT_CONTACT_CROWD + 1, 7u})
    {
        const auto order = random.shuffled(size);
        corner.insert(corner.end(), order.begin(), order.end());
        const bool crowded = size > TAUT_CONTACT_CROWD;
        for (std::uint32_t k = 0; k < size; ++k)
            sorted.push_back(crowded ? order[k] : k);
        start.push_back(static_cast<std::uint32_t>(corner.size()));
    }
    const auto vertices = static_cast<std::uint32_t>(start.size() - 1);
    const std::vector<std::uint32_t> some(vertices, 6), none(vertices, 0);
    Case c;
    c.precision = precision_of<TestType>();
    c.in = {{"start", bytes_of(start)},
            {"corner", bytes_of(corner)},
            {"corners", bytes_of(some)},
            {"taken", bytes_of(some)},
            {"lost", bytes_of(std::vector<std::uint32_t>(2, 0))}};
    c.launches = {make_launch(kernels::contact_sort::info("", c.precision),
                              kernels::contact_sort::Params{vertices}, vertices)};
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(words_of(out, "corner") == sorted);
        CHECK(words_of(out, "corners") == none);
        CHECK(words_of(out, "taken") == none);
        CHECK(words_of(out, "lost")[TAUT_CONTACT_CROWDED] == 1);
    });
}
