#include "taut/kernels/corner_matrix.hpp"
#include "taut/kernels/shared/corner_address.h"

#include "support/volume_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// Rows of both kinds: the gradient of an address by definition, with the size of its terms.
template <typename Real>
struct Gradients
{
    const VolumeNet<Real>& net;
    const std::vector<glm::vec<4, Real>>& direction;

    glm::dvec3 at(std::uint32_t address) const
    {
        if ((address & TAUT_CORNER_ROW) != 0)
            return net.gradient_of((address & ~TAUT_CORNER_ROW) / 4, address % 4);
        return glm::dvec3(direction[address / 2]) * (address % 2 == 0 ? 1.0 : -1.0);
    }
    double size(std::uint32_t address) const
    {
        return (address & TAUT_CORNER_ROW) != 0 ? net.scale_of((address & ~TAUT_CORNER_ROW) / 4)
                                                : glm::length(glm::dvec3(direction[address / 2]));
    }
    double soft(std::uint32_t address) const
    {
        return static_cast<double>((address & TAUT_CORNER_ROW) != 0
                                       ? net.gradient[3 * ((address & ~TAUT_CORNER_ROW) / 4)].w
                                       : direction[address / 2].w);
    }
};

} // namespace

TEMPLATE_TEST_CASE("corner_matrix sums weight times the gradients of two rows over their common vertices", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    CAPTURE(count);
    Random random(270 + count);
    const VolumeNet<Real> net = random_volume_net<Real>(random, 30);
    const auto direction = random.vec4s<Real>(20, 1, 0, 9);
    const Gradients<Real> gradients{net, direction};
    const std::uint32_t all = count + 5; // five behind the count stay as they are
    std::vector<std::uint32_t> start = {0}, term;
    const auto any = [&] {
        return random.chance(0.4) ? random.below(40) : TAUT_CORNER_ROW | random.below(120);
    };
    for (std::uint32_t k = 0; k < all; ++k)
    {
        const bool diagonal = k % 3 == 0;
        for (std::uint32_t t = 0; t < 1 + random.below(4); ++t)
        {
            const std::uint32_t row = any();
            std::uint32_t column = diagonal ? row : any();
            while (!diagonal && column == row)
                column = any();
            term.insert(term.end(), {row, column});
        }
        start.push_back(static_cast<std::uint32_t>(term.size() / 2));
    }
    const std::vector<Real> weight = random_reals<Real>(random, term.size() / 2, -100, 100);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},       {"term", bytes_of(term)},
            {"weight", bytes_of(weight)},     {"direction", bytes_of(direction)},
            {"gradient", bytes_of(net.gradient)}, {"values", bytes_of(std::vector<Real>(all, Real(7)))}};
    c.launches = {make_launch(kernels::corner_matrix::info("", c.precision),
                              kernels::corner_matrix::Params{count}, count)};
    for (std::uint32_t k = 0; k < all; ++k)
    {
        if (k >= count)
        {
            c.expected["values"].add(7, 0);
            continue;
        }
        const std::uint32_t first = start[k];
        const bool diagonal = term[2 * first] == term[2 * first + 1];
        double value = diagonal ? gradients.soft(term[2 * first]) : 0, size = std::abs(value);
        for (std::uint32_t t = first; t < start[k + 1]; ++t)
        {
            const double w = static_cast<double>(weight[t]);
            value += w * glm::dot(gradients.at(term[2 * t]), gradients.at(term[2 * t + 1]));
            size += std::abs(w) * gradients.size(term[2 * t]) * gradients.size(term[2 * t + 1]);
        }
        c.expected["values"].add(value, size);
    }
    check_on_every_device(c);
}
