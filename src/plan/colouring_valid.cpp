// The judge of colourings: reads the result and the graph, shares nothing with the methods.

#include "taut/plan/colouring.hpp"

#include <algorithm>

namespace taut {

namespace {

bool is_moving(const ConstraintGraph& graph, std::uint32_t v)
{
    return graph.fixed.empty() || !graph.fixed[v];
}

/// Whether the offsets rise from 0 to the number of items, one list for each of `lists`.
bool covers(const std::vector<std::uint32_t>& start, std::size_t lists, std::size_t items)
{
    if (start.empty())
    {
        return lists == 0 && items == 0;
    }
    return start.size() == lists + 1 && start.front() == 0 && start.back() == items &&
           std::is_sorted(start.begin(), start.end());
}

std::string vertices_fault(const ConstraintGraph& graph)
{
    if (graph.stride == 0 || graph.vertices.size() % graph.stride != 0)
    {
        return "the graph has " + std::to_string(graph.vertices.size()) +
               " vertex entries, which is no multiple of its stride " + std::to_string(graph.stride);
    }
    if (!graph.fixed.empty() && graph.fixed.size() != graph.vertex_count)
    {
        return "fixed has " + std::to_string(graph.fixed.size()) + " entries for " +
               std::to_string(graph.vertex_count) + " vertices";
    }
    for (std::size_t i = 0; i < graph.vertices.size(); ++i)
    {
        if (graph.vertices[i] >= graph.vertex_count)
        {
            return "constraint " + std::to_string(i / graph.stride) + " names vertex " +
                   std::to_string(graph.vertices[i]) + " of " + std::to_string(graph.vertex_count);
        }
    }
    return {};
}

std::string count_fault(const Colouring& colouring, std::size_t size)
{
    std::vector<std::uint32_t> seen(size, 0);
    for (const auto* list : {&colouring.order, &colouring.hub_constraints})
    {
        for (const std::uint32_t c : *list)
        {
            if (c >= size)
            {
                return "constraint " + std::to_string(c) + " does not exist, there are " +
                       std::to_string(size);
            }
            ++seen[c];
        }
    }
    for (std::size_t c = 0; c < size; ++c)
    {
        if (seen[c] != 1)
        {
            return "constraint " + std::to_string(c) + " occurs " + std::to_string(seen[c]) +
                   " times, not once";
        }
    }
    return {};
}

std::string conflict(const Colouring& colouring, const ConstraintGraph& graph)
{
    struct Writer
    {
        std::size_t colour = 0; ///< colour + 1
        std::uint32_t constraint = 0;
    };
    std::vector<Writer> writer(graph.vertex_count);
    for (std::size_t colour = 0; colour < colouring.colour_count(); ++colour)
    {
        for (std::uint32_t i = colouring.colour_start[colour]; i < colouring.colour_start[colour + 1]; ++i)
        {
            const std::uint32_t c = colouring.order[i];
            for (std::uint32_t k = 0; k < graph.stride; ++k)
            {
                const std::uint32_t v = graph.vertices[std::size_t(c) * graph.stride + k];
                if (is_moving(graph, v) && writer[v].colour == colour + 1 && writer[v].constraint != c)
                {
                    return "constraints " + std::to_string(writer[v].constraint) + " and " +
                           std::to_string(c) + " of colour " + std::to_string(colour) +
                           " both write vertex " + std::to_string(v);
                }
                writer[v] = {colour + 1, c};
            }
        }
    }
    return {};
}

std::string hub_fault(const Colouring& colouring, const ConstraintGraph& graph)
{
    for (std::size_t h = 0; h < colouring.hubs.size(); ++h)
    {
        for (std::uint32_t i = colouring.hub_start[h]; i < colouring.hub_start[h + 1]; ++i)
        {
            const std::uint32_t c = colouring.hub_constraints[i];
            const auto* first = graph.vertices.data() + std::size_t(c) * graph.stride;
            if (std::find(first, first + graph.stride, colouring.hubs[h]) == first + graph.stride)
            {
                return "constraint " + std::to_string(c) + " is listed at hub " +
                       std::to_string(colouring.hubs[h]) + ", which it does not touch";
            }
        }
    }
    return {};
}

std::string first_fault(const Colouring& colouring, const ConstraintGraph& graph)
{
    std::string fault = vertices_fault(graph);
    if (fault.empty() && !covers(colouring.colour_start, colouring.colour_count(), colouring.order.size()))
    {
        fault = "colour_start does not divide the " + std::to_string(colouring.order.size()) +
                " entries of order";
    }
    const std::size_t at_hubs = colouring.hub_constraints.size();
    if (fault.empty() && !covers(colouring.hub_start, colouring.hubs.size(), at_hubs))
    {
        fault = "hub_start does not divide the " + std::to_string(at_hubs) + " entries of hub_constraints";
    }
    fault = fault.empty() ? count_fault(colouring, graph.size()) : fault;
    fault = fault.empty() ? conflict(colouring, graph) : fault;
    return fault.empty() ? hub_fault(colouring, graph) : fault;
}

} // namespace

bool valid(const Colouring& colouring, const ConstraintGraph& graph, std::string* why)
{
    const std::string fault = first_fault(colouring, graph);
    if (why != nullptr)
    {
        *why = fault;
    }
    return fault.empty();
}

} // namespace taut
