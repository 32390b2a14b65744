#pragma once
// Kernels of xpbd for an element against XPBD by definition, with the constraint and its gradients taken from
// the energy alone.

#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/element_terms.hpp"

namespace taut::elements_test {

using namespace conformance;

/// m^2/N where C has no unit of its own: of an element that gives its energy C = sqrt(2 E), and 1.
template <typename Record>
double compliance_of(const Record& record)
{
    if constexpr (requires { record.compliance; })
        return static_cast<double>(record.compliance);
    return 1;
}

/// XPBD of one constraint with |C| = sqrt(2 a E) and a grad E = C grad C.
template <typename Energy, typename Record>
void project(State& s, const Record& record, std::uint32_t)
{
    constexpr std::size_t n = Energy::corners;
    using D = Dual<3 * n>;
    const std::array<std::uint32_t, n> v = elements_test::corners_of(record);
    std::array<Point<D>, n> x;
    double masses = 0, size = 0;
    for (std::size_t c = 0; c < n; ++c)
    {
        masses += s.position[v[c]].w;
        size += glm::distance(s.at(v[c]), s.at(v[0])) + glm::length(glm::dvec3(s.delta[v[c]])) +
                s.delta_scale[v[c]];
        for (std::size_t axis = 0; axis < 3; ++axis)
            x[c][axis] = D::variable(s.at(v[c])[static_cast<int>(axis)], 3 * c + axis);
    }
    const double a = compliance_of(record);
    const auto values = record.values();
    const D energy = Energy()(x, values);
    const double value = std::sqrt(2 * a * energy.value);
    double weight = 0, steepest = 0;
    std::array<glm::dvec3, n> gradient;
    for (std::size_t c = 0; c < n; ++c)
    {
        gradient[c] =
            glm::dvec3(energy.slope[3 * c], energy.slope[3 * c + 1], energy.slope[3 * c + 2]) * (a / value);
        weight += s.position[v[c]].w * glm::dot(gradient[c], gradient[c]);
        steepest = std::max(steepest, glm::length(gradient[c]));
    }
    if (!(weight > 0))
        return;
    const double soft = a * s.inverse_substep * s.inverse_substep;
    const double dlambda = -value / (weight + soft);
    // What rounds: the differences of the corners, in C by its slope and in the direction.
    const double terms =
        steepest * (value + steepest * size) / (weight + soft) + std::abs(dlambda) * steepest;
    for (std::size_t c = 0; c < n; ++c)
        s.push(v[c], gradient[c] * (s.position[v[c]].w * dlambda), s.position[v[c]].w * terms * 4);
}

/// Three colours of elements on random vertices of their own.
template <typename Energy, typename Real, template <typename> typename Record>
Colours<Real, Record> random_elements(std::uint32_t count)
{
    constexpr std::uint32_t n = Energy::corners;
    Random random(40 + count);
    Colours<Real, Record> in;
    const std::uint32_t size = n * std::max(count, 5u) + 3;
    in.position = random.vec4s<Real>(size, 1, 0, 0);
    for (auto& p : in.position)
        p.w = random.inverse_mass<Real>();
    in.delta = random.vec4s<Real>(size, 0.1, 0, 0);
    in.step.inverse_substep = 600;
    static constexpr double kCompliances[] = {1e-9, 1e-6, 1e-3};
    for (const std::uint32_t elements : {5u, count, 5u})
    {
        const auto order = random.shuffled(size);
        for (std::uint32_t k = 0; k < elements; ++k)
        {
            auto record = Record<Real>::random(random);
            std::memcpy(&record, order.data() + n * k, 4 * n); // corners come first
            if constexpr (requires { record.compliance; })
                record.compliance = static_cast<Real>(kCompliances[random.below(3)]);
            in.constraint.push_back(record);
            in.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
        }
        in.colour_start.push_back(static_cast<std::uint32_t>(in.constraint.size()));
    }
    in.groups = {{1, 2}};
    return in;
}

template <typename Energy, typename Real, template <typename> typename Record, typename Params>
void check_sweep(KernelTable info)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    auto in = random_elements<Energy, Real, Record>(count);
    check_colours<Params>(info, in, Mode(), precision_of<Real>(), project<Energy, Record<Real>>);
    check_first_iteration_equals_base<Params>(info, in, precision_of<Real>());
    in.groups = {{0, 3}}; // one after another: colours may share vertices
    check_tail_equals_dispatches<Params>(info, in, Mode(), precision_of<Real>());
}

} // namespace taut::elements_test
