// Based on: Karypis, Kumar. Parallel Multilevel k-way Partitioning Scheme for Irregular Graphs. SIAM Review
//   41(2), 1999, section 2: parts own vertices, and keep copies of the neighbours that others own.
// Departures: two parts, cut by the order of the plan, which follows rows or a space-filling curve; the
// copies
//   are deep enough for a whole sweep (cut_halo.cpp).

#include "taut/plan/cut.hpp"

#include "taut/plan/cut_halo.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace taut {
namespace {

/// How a buffer of the whole becomes that of a part.
struct Content
{
    Each each = Each::whole;
    std::uint32_t stride = 0;          ///< bytes of an element
    std::uint32_t records = kNoBuffer; ///< of constraints: the buffer of their corners
    std::uint32_t corners = 0;         ///< words that an element begins with and that name vertices
};

std::map<std::uint32_t, Content> contents_of(const Plan& whole)
{
    std::map<std::uint32_t, Content> out;
    for (const Dispatch& pass : whole.passes)
        for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
        {
            const std::uint32_t buffer = pass.bindings[slot].buffer;
            Content content{each(pass, slot), pass.kernel->bindings[slot].stride};
            if (content.each == Each::constraint)
                content.records = pass.bindings.front().buffer;
            if (content.records == buffer)
                content.corners = corner_count(pass);
            if (content.each == Each::pin_vertex)
                content.corners = 1;
            out.emplace(buffer, content);
        }
    return out;
}

/// Makes one part from what it has and what it solves.
class PartMaker
{
public:
    PartMaker(const Plan& whole, const std::map<std::uint32_t, Content>& contents, Selection selection,
              PlanPart& part)
        : whole_(whole),
          contents_(contents),
          selection_(std::move(selection)),
          part_(part)
    {}

    void make(const std::vector<std::size_t>& exchanges);

private:
    void number();
    void make_buffer(std::uint32_t buffer, const Content& content);
    std::vector<std::uint32_t> elements(std::uint32_t buffer, const Content& content) const;
    void rename_corners(std::uint32_t buffer, const Content& content);
    void add_pass(const Dispatch& pass);
    void add_constraints(const Dispatch& pass);
    void add(Dispatch pass, std::uint32_t count);

    const Plan& whole_;
    const std::map<std::uint32_t, Content>& contents_;
    Selection selection_;
    PlanPart& part_;
    std::vector<std::uint32_t> local_; ///< vertex of the part, of each of the whole; kNoBuffer: it has none
    std::vector<std::uint32_t> pins_;  ///< of the whole's that the part moves
    std::map<ColourKey, std::uint32_t> first_;   ///< of each colour, in the part
    std::map<ColourKey, std::uint32_t> counted_; ///< constraints of a colour whose events it reports
};

/// Vertices, pins and constraints of the part. A constraint that both parts solve is reported by the one that
/// moves its first corner; those of the other come last in their colour.
void PartMaker::number()
{
    local_.assign(whole_.vertex_count, kNoBuffer);
    for (std::uint32_t v = 0; v < part_.vertices.size(); ++v)
        local_[part_.vertices[v]] = v;
    for (std::uint32_t p = 0; p < whole_.moving_pins.size(); ++p)
        if (local_[whole_.moving_pins[p].vertex] < part_.own)
            pins_.push_back(p);
    std::map<ColourKey, const Dispatch*> passes;
    for (const Dispatch& pass : whole_.passes)
        if (over(pass) == Over::constraints)
            passes.emplace(colour_of(pass), &pass);
    std::map<std::uint32_t, std::uint32_t> filled; // of each buffer of records
    for (auto& [key, chosen] : selection_)
    {
        const Dispatch& pass = *passes.at(key);
        const auto ours = std::stable_partition(chosen.begin(), chosen.end(), [&](std::uint32_t k) {
            return local_[corners_of(whole_, pass, k).front()] < part_.own;
        });
        first_[key] = filled[key.first];
        counted_[key] = static_cast<std::uint32_t>(ours - chosen.begin());
        filled[key.first] += static_cast<std::uint32_t>(chosen.size());
        const std::uint64_t weight = corner_count(pass) == 4 ? 2 : 1;
        part_.work += weight * chosen.size();
        part_.own_work += weight * counted_[key];
    }
    part_.work += part_.own;
    part_.own_work += part_.own;
}

/// Of a buffer, those that the part has, in its order.
std::vector<std::uint32_t> PartMaker::elements(std::uint32_t buffer, const Content& content) const
{
    if (content.each == Each::vertex)
        return part_.vertices;
    std::vector<std::uint32_t> out;
    if (content.each == Each::constraint)
    {
        for (const auto& [key, chosen] : selection_)
            if (key.first == content.records)
                out.insert(out.end(), chosen.begin(), chosen.end());
        return out;
    }
    const std::uint64_t per_pin =
        whole_.buffers[buffer].bytes / (content.stride * std::max<std::size_t>(whole_.moving_pins.size(), 1));
    for (const std::uint32_t p : pins_)
        for (std::uint32_t k = 0; k < per_pin; ++k)
            out.push_back(static_cast<std::uint32_t>(p * per_pin + k));
    return out;
}

void PartMaker::rename_corners(std::uint32_t buffer, const Content& content)
{
    std::vector<std::byte>& bytes = part_.plan.buffers[buffer].initial;
    for (std::size_t at = 0; at < bytes.size(); at += content.stride)
        for (std::uint32_t c = 0; c < content.corners; ++c)
        {
            std::uint32_t corner = 0;
            std::memcpy(&corner, bytes.data() + at + c * sizeof corner, sizeof corner);
            corner = local_[corner];
            std::memcpy(bytes.data() + at + c * sizeof corner, &corner, sizeof corner);
        }
}

void PartMaker::make_buffer(std::uint32_t buffer, const Content& content)
{
    const PlanBuffer& from = whole_.buffers[buffer];
    PlanBuffer& to = part_.plan.buffers[buffer];
    if (content.each == Each::whole)
    {
        to.initial = from.initial;
        return;
    }
    if (content.each == Each::collider_and_vertex) // of its own vertices: the halo is pushed by the other
    {
        to.bytes = from.bytes / whole_.vertex_count * part_.own;
        return;
    }
    const std::vector<std::uint32_t> has = elements(buffer, content);
    to.bytes = std::max<std::uint64_t>(has.size(), 1) * content.stride;
    if (from.initial.empty())
        return;
    to.initial.reserve(to.bytes);
    for (const std::uint32_t e : has)
    {
        const auto begin = from.initial.begin() + static_cast<std::ptrdiff_t>(e) * content.stride;
        to.initial.insert(to.initial.end(), begin, begin + content.stride);
    }
    rename_corners(buffer, content);
}

void PartMaker::add(Dispatch pass, std::uint32_t count)
{
    if (count == 0)
        return;
    set_param(pass, "count", count);
    pass.count = count;
    for (BufferRange& range : pass.bindings)
        range.bytes = part_.plan.buffers[range.buffer].bytes;
    part_.plan.passes.push_back(std::move(pass));
}

void PartMaker::add_constraints(const Dispatch& pass)
{
    const ColourKey key = colour_of(pass);
    const auto all = static_cast<std::uint32_t>(selection_.at(key).size());
    Dispatch own = pass;
    set_param(own, "first", first_.at(key));
    if (!has_param(pass, "report") || param(pass, "report") == 0)
        return add(std::move(own), all);
    Dispatch others = own;
    set_param(others, "first", first_.at(key) + counted_.at(key));
    set_param(others, "report", 0);
    add(std::move(own), counted_.at(key));
    add(std::move(others), all - counted_.at(key));
}

void PartMaker::add_pass(const Dispatch& pass)
{
    switch (over(pass))
    {
    case Over::vertices: return add(pass, part_.own);
    case Over::pins: return add(pass, static_cast<std::uint32_t>(pins_.size()));
    case Over::constraints: return add_constraints(pass);
    }
}

void PartMaker::make(const std::vector<std::size_t>& exchanges)
{
    number();
    Plan& plan = part_.plan;
    for (PlanBuffer& buffer : plan.buffers)
        buffer.initial.clear();
    for (const auto& [buffer, content] : contents_)
        make_buffer(buffer, content);
    plan.vertex_count = static_cast<std::uint32_t>(part_.vertices.size());
    plan.original.clear();
    for (const std::uint32_t v : part_.vertices)
        plan.original.push_back(whole_.original[v]);
    plan.moving_pins.clear();
    for (const std::uint32_t p : pins_)
    {
        plan.moving_pins.push_back(whole_.moving_pins[p]);
        plan.moving_pins.back().vertex = local_[whole_.moving_pins[p].vertex];
    }
    if (pins_.empty())
        plan.pin_targets = kNoBuffer;
    auto next = exchanges.begin();
    part_.segment_start = {0};
    for (std::size_t p = 0; p < whole_.passes.size(); ++p)
    {
        if (next != exchanges.end() && *next == p)
        {
            part_.segment_start.push_back(plan.passes.size());
            ++next;
        }
        add_pass(whole_.passes[p]);
    }
    part_.segment_start.push_back(plan.passes.size());
    plan.barrier_before = derive_barriers(plan.passes);
    check_no_hazard(plan.passes, plan.barrier_before);
}

/// The whole without what is made anew for a part.
Plan frame_of(const Plan& whole)
{
    Plan out = whole;
    out.passes.clear();
    out.effects.clear();
    out.constraints.clear();
    out.pull.clear();
    return out;
}

/// The vertices of a part: its own, those that the other reads last, then what it reads of the other.
void order_vertices(PlanPart& part, const std::vector<bool>& own, const std::vector<bool>& reach,
                    const std::vector<bool>& others_reach)
{
    for (const bool sent : {false, true})
        for (std::uint32_t v = 0; v < own.size(); ++v)
            if (own[v] && others_reach[v] == sent)
            {
                part.vertices.push_back(v);
                part.sent += sent;
            }
    part.own = static_cast<std::uint32_t>(part.vertices.size());
    for (std::uint32_t v = 0; v < own.size(); ++v)
        if (reach[v] && !own[v])
            part.vertices.push_back(v);
}

} // namespace

PlanCut cut_plan(const Plan& whole, std::uint32_t first_count, Exchange exchange)
{
    const std::map<std::uint32_t, Content> contents = contents_of(whole);
    ExchangePoints points = exchange_points(whole, exchange);
    std::array<std::vector<bool>, 2> own, reach;
    std::array<Selection, 2> selection;
    for (std::size_t side = 0; side < 2; ++side)
    {
        for (std::uint32_t v = 0; v < whole.vertex_count; ++v)
            own[side].push_back((v < first_count) == (side == 0));
        reach[side] = own[side];
        selection[side] = select_constraints(whole, points, reach[side]);
    }
    if (reach == own) // nothing crosses the cut
        points.before.clear();
    PlanCut cut;
    for (std::size_t side = 0; side < 2; ++side)
    {
        PlanPart& part = cut.parts[side];
        part.plan = frame_of(whole);
        order_vertices(part, own[side], reach[side], reach[1 - side]);
        PartMaker(whole, contents, std::move(selection[side]), part).make(points.before);
    }
    points.buffers.resize(points.before.size());
    cut.exchanged = std::move(points.buffers);
    return cut;
}

} // namespace taut
