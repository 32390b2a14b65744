#pragma once
// Kernels of vbd for an element: what it brings to the block of a vertex, and to the sums of a body, against
// its energy.

#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/element_terms.hpp"
#include "support/linear_groups.hpp"

#include "taut/kernels/shared/vbd_parts.h"

#include <algorithm>

namespace taut::elements_test {

using namespace conformance;

/// Rows of vertices in some order, with the elements at each; the first of an element's counts it.
template <typename Record>
std::vector<std::uint32_t> row_table(const std::vector<Record>& elements,
                                     const std::vector<std::uint32_t>& rows)
{
    constexpr std::uint32_t n = Record::Energy::corners;
    std::vector<std::uint32_t> table, entries;
    std::vector<bool> counted(elements.size(), false);
    const auto begin = static_cast<std::uint32_t>(2 * (rows.size() + 1));
    for (const std::uint32_t v : rows)
    {
        table.insert(table.end(), {v, begin + static_cast<std::uint32_t>(entries.size())});
        for (std::uint32_t k = 0; k < elements.size(); ++k)
            for (std::uint32_t c = 0; c < n; ++c)
                if (corners_of(elements[k])[c] == v)
                {
                    entries.push_back((n * k + c) | (counted[k] ? 0u : 0x80000000u));
                    counted[k] = true;
                }
    }
    table.insert(table.end(), {0, begin + static_cast<std::uint32_t>(entries.size())});
    table.insert(table.end(), entries.begin(), entries.end());
    return table;
}

template <typename Real, template <typename> typename Record, typename Params>
void check_blocks(KernelTable info)
{
    constexpr std::size_t n = Record<Real>::Energy::corners;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 300u);
    const std::uint32_t begins = GENERATE(0u, 1u);
    CAPTURE(count, begins);
    const std::uint32_t vertices = std::max(count, 8u) + 3, first = 2;
    const ElementNet<Real, Record> net(vertices, std::max(count, 8u), 60 + count);
    Random random(61 + count);
    const auto order = random.shuffled(vertices);
    const std::vector<std::uint32_t> rows(order.begin(), order.end());
    auto predicted = random.vec4s<Real>(vertices, 0.1, 0, 0);
    for (auto& p : predicted)
        p.w = random.uniform<Real>(1, 1000);
    const auto before = random.vec4s<Real>(3 * vertices, 100, 0, 0);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(net.elements)},
            {"position", bytes_of(net.position)},
            {"predicted", bytes_of(predicted)},
            {"delta", bytes_of(net.delta)},
            {"table", bytes_of(row_table(net.elements, rows))},
            {"block", bytes_of(before)},
            {"events", no_events()}};
    c.launches = {make_launch(info("", c.precision), Params{first, count, begins, 1}, count)};
    std::vector<Terms<n>> terms;
    std::vector<double> rough, size;
    for (std::size_t k = 0; k < net.elements.size(); ++k)
    {
        double s = 0;
        terms.push_back(net.terms(k, net.delta, s));
        size.push_back(s);
        rough.push_back(block_size(net.elements[k], places(net, k), s));
    }
    Field& field = c.expected["block"];
    for (const auto& b : before)
        for (int k = 0; k < 4; ++k)
            field.add(double(b[k]), 0);
    for (std::uint32_t r = first; r < first + count; ++r)
    {
        const std::uint32_t v = rows[r];
        const double inertia = double(predicted[v].w);
        glm::dvec3 f(0), diagonal(0), mixed(0);
        double f_size = 0, h_size = 0;
        if (begins != 0)
        {
            f = inertia * (glm::dvec3(predicted[v]) - glm::dvec3(net.delta[v]));
            f_size =
                inertia * (glm::length(glm::dvec3(predicted[v])) + glm::length(glm::dvec3(net.delta[v])));
        }
        else
        {
            f = glm::dvec3(before[3 * v]);
            diagonal = glm::dvec3(before[3 * v + 1]);
            mixed = glm::dvec3(before[3 * v + 2]);
            f_size = glm::length(f);
            h_size = glm::length(diagonal) + glm::length(mixed);
        }
        for (std::size_t k = 0; k < net.elements.size(); ++k)
            for (std::size_t corner = 0; corner < n; ++corner)
                if (corners_of(net.elements[k])[corner] == v)
                {
                    const glm::dmat3& own = terms[k].curvature[corner][corner];
                    f -= terms[k].slope[corner];
                    f_size += glm::length(terms[k].slope[corner]) + terms[k].stiff * size[k];
                    diagonal += glm::dvec3(own[0][0], own[1][1], own[2][2]);
                    mixed += glm::dvec3(own[0][1], own[0][2], own[1][2]);
                    h_size += rough[k];
                }
        const auto put = [&](std::size_t at, const glm::dvec3& value, double scale, double last) {
            for (int k = 0; k < 4; ++k)
            {
                field.value[4 * at + static_cast<std::size_t>(k)] = k < 3 ? value[k] : last;
                field.scale[4 * at + static_cast<std::size_t>(k)] = k < 3 ? scale : 0;
            }
        };
        put(3 * std::size_t{v}, f, f_size, inertia);
        put(3 * std::size_t{v} + 1, diagonal, h_size, 0);
        put(3 * std::size_t{v} + 2, mixed, h_size, 0);
    }
    check_on_every_device(c);
}

template <typename Real, template <typename> typename Record, typename Params>
void check_sums(KernelTable info)
{
    constexpr std::size_t n = Record<Real>::Energy::corners;
    const std::uint32_t count = GENERATE(1u, 63u, 200u);
    CAPTURE(count);
    const ElementNet<Real, Record> net(count + 8, count, 70 + count);
    const std::vector<std::uint32_t> parts = {0, count / 3, count / 3, count};
    const std::uint32_t groups = 3;
    Random random(71 + count);
    const auto sums = random_reals<Real>(random, groups * TAUT_VBD_SUMS + 3);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(net.elements)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"delta", bytes_of(net.delta)},
            {"table", bytes_of(parts)},
            {"sums", bytes_of(sums)}};
    c.launches = {make_launch(info("", c.precision), Params{groups}, groups)};
    Field& field = c.expected["sums"];
    for (const Real value : sums)
        field.add(double(value), 0);
    for (std::uint32_t g = 0; g < groups; ++g)
    {
        double sum = double(sums[g * TAUT_VBD_SUMS]), whole = std::abs(sum);
        for (std::uint32_t k = parts[g]; k < parts[g + 1]; ++k)
        {
            const auto v = corners_of(net.elements[k]);
            std::array<glm::dvec3, n> still, way;
            double size = 0;
            net.terms(k, net.delta, size);
            for (std::size_t i = 0; i < n; ++i)
            {
                const bool moves = net.position[v[i]].w > 0;
                const glm::dvec3 from(moves ? net.low[v[i]] : net.delta[v[i]]);
                still[i] = glm::dvec3(net.position[v[i]]) + from;
                way[i] = glm::dvec3(net.delta[v[i]]) - from;
            }
            sum += rise_of(net.elements[k], still, way, size);
            whole += size;
        }
        field.value[g * TAUT_VBD_SUMS] = sum;
        field.scale[g * TAUT_VBD_SUMS] = parts[g] < parts[g + 1] ? whole : 0;
    }
    check_on_every_device(c);
}

} // namespace taut::elements_test
