#pragma once
// Kernels of implicit_euler for an element: slopes and curvature in the system of a Newton step, their
// product with a vector, and what a step does to the energy, against its energy.

#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/element_terms.hpp"
#include "support/implicit_net.hpp"
#include "support/linear_groups.hpp"

namespace taut::elements_test {

using namespace conformance;

/// A net of elements with its table; every second vertex is a corner of three.
template <typename Real, template <typename> typename Record>
struct System
{
    ElementNet<Real, Record> net;
    Net<Real> table;
    std::vector<std::uint32_t> words;

    static constexpr auto n = static_cast<std::uint32_t>(ElementNet<Real, Record>::n);

    explicit System(std::uint32_t count) : net(count, count, 80 + count)
    {
        std::vector<std::uint32_t> corners;
        for (const auto& e : net.elements)
            for (const std::uint32_t v : elements_test::corners_of(e))
                corners.push_back(v);
        table.count = count;
        table.position = net.position;
        table.delta = net.delta;
        table.step.substep = Real(0.01);
        const std::set<std::uint32_t> used(corners.begin(), corners.end());
        for (std::uint32_t v = 0; v < count; ++v)
            table.held.insert(table.held.end(), 3, net.position[v].w > 0 && used.count(v) > 0 ? 0u : 1u);
        std::set<Place> met;
        words = make_table(table, corners, n, met, true);
    }
    Buffers buffers() const
    {
        return {{"constraint", bytes_of(net.elements)},
                {"position", bytes_of(net.position)},
                {"delta", bytes_of(net.delta)},
                {"table", bytes_of(words)},
                {"step_values", bytes_of(std::vector{table.step})},
                {"events", no_events()}};
    }
    double units() const { return table.h() * table.h() * double(table.scale); }
};

template <typename Real, template <typename> typename Record, typename Params>
void check_system(KernelTable info)
{
    const std::uint32_t count = GENERATE(8u, 64u, 65u);
    CAPTURE(count);
    const System<Real, Record> in(count);
    constexpr auto n = System<Real, Record>::n;
    Random random(81 + count);
    const auto side = random_reals<Real>(random, 3 * count);
    const auto before = random_reals<Real>(random, in.table.values());
    Case c;
    c.precision = precision_of<Real>();
    c.in = in.buffers();
    c.in["b"] = bytes_of(side);
    c.in["values"] = bytes_of(before);
    c.launches = {make_launch(info("", c.precision), Params{count, 1, in.table.scale, in.table.lift}, count)};
    std::vector<Sized> pull(count);
    std::map<Place, SizedBlock> blocks;
    for (std::size_t k = 0; k < in.net.elements.size(); ++k)
    {
        double size = 0;
        const auto t = in.net.terms(k, in.net.delta, size);
        const double rough = block_size(in.net.elements[k], places(in.net, k), size);
        const auto v = elements_test::corners_of(in.net.elements[k]);
        for (std::size_t i = 0; i < n; ++i)
        {
            if (!in.table.solved(v[i]))
                continue;
            pull[v[i]].add(-t.slope[i], glm::length(t.slope[i]) + t.stiff * size);
            for (std::size_t j = 0; j < n; ++j)
                if (in.table.solved(v[j]))
                    blocks[{v[i], v[j]}].add(t.curvature[i][j], rough);
        }
    }
    Field& b = c.expected["b"];
    for (std::uint32_t v = 0; v < count; ++v)
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const double old = double(side[3 * v + k]), units = in.units() * double(in.table.lift);
            const bool added = pull[v].size > 0;
            b.add(old + units * pull[v].value[static_cast<int>(k)],
                  added ? std::abs(old) + units * pull[v].size : 0);
        }
    Field& values = c.expected["values"];
    for (const Real value : before)
        values.add(double(value), 0);
    for (const auto& [place, block] : blocks)
        for (int e = 0; e < 9; ++e)
        {
            const std::size_t at = in.table.blocks.at(place) + 32u * static_cast<std::size_t>(e);
            const double old = place.first == place.second ? double(before[at]) : 0; // the mass is there
            values.value[at] = old + in.units() * block.value[e % 3][e / 3];
            values.scale[at] = std::abs(old) + in.units() * block.size;
        }
    check_on_every_device(c);
}

template <typename Real, template <typename> typename Record, typename Params>
void check_product(KernelTable info)
{
    const std::string variant = GENERATE("", "dot", "residual");
    for (const Dealt& dealt : deals())
    {
        if (dealt.count > 130 || dealt.count < 8)
            continue;
        const std::uint32_t count = dealt.count;
        CAPTURE(variant, count, dealt.groups);
        const System<Real, Record> in(count);
        Random random(82 + count);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = in.table.held[k] != 0 ? Real(0) : x[k];
        const auto y = random_reals<Real>(random, 3 * count);
        Case c;
        c.precision = precision_of<Real>();
        c.in = in.buffers();
        c.in["x"] = bytes_of(x);
        c.in["y"] = bytes_of(y);
        c.in["partials"] = bytes_of(std::vector<Real>(dealt.groups, Real(7)));
        c.launches = {make_launch(info(variant, c.precision),
                                  Params{count, dealt.chunk(), dealt.groups, in.table.scale},
                                  dealt.dispatched())};
        std::vector<Sized> more(count);
        for (std::size_t k = 0; k < in.net.elements.size(); ++k)
        {
            double size = 0;
            const auto t = in.net.terms(k, in.net.delta, size);
            const double rough = block_size(in.net.elements[k], places(in.net, k), size);
            const auto v = elements_test::corners_of(in.net.elements[k]);
            for (std::size_t i = 0; i < v.size(); ++i)
                for (std::size_t j = 0; j < v.size() && in.table.solved(v[i]); ++j)
                {
                    const glm::dvec3 far(x[3 * v[j]], x[3 * v[j] + 1], x[3 * v[j] + 2]);
                    more[v[i]].add(t.curvature[i][j] * far, rough * glm::length(far));
                }
        }
        Field& field = c.expected["y"];
        GroupSums sums(dealt);
        const double sign = variant == "residual" ? -1 : 1;
        for (std::uint32_t v = 0; v < count; ++v)
            for (std::uint32_t k = 0; k < 3; ++k)
            {
                const double old = double(y[3 * v + k]);
                const double value = old + sign * in.units() * more[v].value[static_cast<int>(k)];
                const double size = std::abs(old) + in.units() * more[v].size;
                field.add(value, size);
                sums.add(v, double(x[3 * v + k]) * value, std::abs(double(x[3 * v + k])) * size);
            }
        if (variant == "dot")
            sums.put(c.expected["partials"]);
        look_on_every_device(c, nullptr);
    }
}

template <typename Real, template <typename> typename Record, typename Params>
void check_rise(KernelTable info)
{
    const std::uint32_t first = 1, trials = 17, parts = 2, part = 1;
    for (const std::uint32_t count : {8u, 65u, 300u})
    {
        CAPTURE(count);
        const System<Real, Record> in(count);
        Dealt dealt;
        dealt.count = static_cast<std::uint32_t>(in.net.elements.size());
        dealt.groups = count > 200 ? 3 : 1;
        dealt.spare = 1;
        Random random(83 + count);
        const auto x = random_reals<Real>(random, 3 * count);
        Case c;
        c.precision = precision_of<Real>();
        c.in = in.buffers();
        c.in["x"] = bytes_of(x);
        c.in["partials"] = bytes_of(std::vector<Real>(trials * parts * dealt.groups, Real(7)));
        c.launches = {make_launch(info("", c.precision),
                                  Params{dealt.count, dealt.chunk(), dealt.groups, first, trials, part, parts,
                                         in.table.scale, in.table.lift},
                                  dealt.dispatched())};
        Field& field = c.expected["partials"];
        const double lift = double(in.table.lift);
        double share = 1 / lift;
        for (std::uint32_t trial = 0; trial < trials; ++trial, share /= 2)
        {
            for (std::uint32_t g = 0; g < dealt.groups; ++g)
                field.add(7, 0);
            if (trial < first) // of an earlier pass
            {
                for (std::uint32_t g = 0; g < dealt.groups; ++g)
                    field.add(7, 0);
                continue;
            }
            GroupSums sums(dealt);
            for (std::uint32_t k = 0; k < dealt.count; ++k)
            {
                const auto v = elements_test::corners_of(in.net.elements[k]);
                std::array<glm::dvec3, System<Real, Record>::n> w;
                for (std::size_t i = 0; i < v.size(); ++i)
                    w[i] = glm::dvec3(x[3 * v[i]], x[3 * v[i] + 1], x[3 * v[i] + 2]) * share;
                double size = 0;
                in.net.terms(k, in.net.delta, size);
                const double rise = rise_of(in.net.elements[k], places(in.net, k), w, size);
                sums.add(k, rise * in.units() * lift * lift, size * in.units() * lift * lift);
            }
            sums.put(field);
        }
        look_on_every_device(c, nullptr);
    }
}

} // namespace taut::elements_test
