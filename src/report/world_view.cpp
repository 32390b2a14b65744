#include "taut/report/world_view.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace taut::reference {
namespace {

DistanceRecord widen(const layout::DistanceConstraint<float>& c)
{
    return {c.a, c.b, c.rest_length, c.compliance};
}
BendingRecord widen(const layout::BendingConstraint<float>& c)
{
    return {c.edge0, c.edge1, c.wing0, c.wing1, c.rest_angle, c.compliance};
}
DistanceRecord widen(const DistanceRecord& c) { return c; }
BendingRecord widen(const BendingRecord& c) { return c; }

template <typename Narrow>
auto decode_as(const std::vector<std::byte>& bytes)
{
    std::vector<decltype(widen(Narrow{}))> out(bytes.size() / sizeof(Narrow));
    for (std::size_t k = 0; k < out.size(); ++k)
    {
        Narrow record;
        std::memcpy(&record, bytes.data() + k * sizeof(Narrow), sizeof(Narrow));
        out[k] = widen(record);
    }
    return out;
}

/// What the methods without constraint records move by: the model's own elements.
std::vector<DistanceRecord> records_of(const std::vector<StretchElement>& springs)
{
    std::vector<DistanceRecord> out;
    out.reserve(springs.size());
    for (const StretchElement& e : springs)
        out.push_back({e.a, e.b, e.rest_length, e.compliance});
    return out;
}
std::vector<BendingRecord> records_of(const std::vector<BendElement>& hinges)
{
    std::vector<BendingRecord> out;
    for (const BendElement& e : hinges)
        out.push_back({e.edge0, e.edge1, e.wing0, e.wing1, e.rest_angle, e.compliance});
    return out;
}

void to_scene(DistanceRecord& c, const std::vector<std::uint32_t>& original)
{
    c.a = original[c.a];
    c.b = original[c.b];
}
void to_scene(BendingRecord& c, const std::vector<std::uint32_t>& original)
{
    for (std::uint32_t* v : {&c.edge0, &c.edge1, &c.wing0, &c.wing1})
        *v = original[*v];
}

/// A buffer as the device got it, or as it is now where it changes on the device (plasticity).
std::vector<std::byte> contents(const World& world, std::uint32_t buffer)
{
    const auto& kept = world.plan().kept;
    const auto at = static_cast<std::size_t>(std::find(kept.begin(), kept.end(), buffer) - kept.begin());
    return at == kept.size() ? world.plan().buffers[buffer].initial : world.state().kept[at];
}

/// The records in a buffer of the plan; vertices scene-wide.
template <template <typename> typename Record>
std::vector<Record<double>> decoded(const Plan& plan, const std::vector<std::byte>& bytes)
{
    auto out = plan.precision == Precision::float64 ? decode_as<Record<double>>(bytes)
                                                    : decode_as<Record<float>>(bytes);
    for (Record<double>& record : out)
        to_scene(record, plan.original);
    return out;
}

/// The records of a constraint kind as the device has them, else those of the model; vertices scene-wide.
template <template <typename> typename Record, typename Element>
std::vector<Record<double>> records(const World& world, std::string_view kind,
                                    const std::vector<Element>& of_model)
{
    for (const ConstraintSet& set : world.plan().constraints)
        if (set.kind == kind)
            return decoded<Record>(world.plan(), contents(world, set.buffer));
    return records_of(of_model);
}

/// Gives springs that flow as forces the rest lengths that they have come to.
template <typename Real>
void take_rest_lengths(const World& world, std::vector<DistanceRecord>& springs)
{
    const Plan& plan = world.plan();
    const std::vector<std::byte> bytes = contents(world, plan.flowing);
    using Ends = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Ends, std::vector<double>> at; // springs of the same ends in their order
    for (std::size_t k = 0; k < bytes.size() / sizeof(layout::Spring<Real>); ++k)
    {
        layout::Spring<Real> record;
        std::memcpy(&record, bytes.data() + k * sizeof record, sizeof record);
        at[{plan.original[record.a], plan.original[record.b]}].push_back(double(record.rest_length));
    }
    std::map<Ends, std::size_t> taken;
    for (DistanceRecord& spring : springs)
    {
        const Ends ends{spring.a, spring.b};
        auto found = at.find(ends);
        if (found == at.end()) // only the other end has it: this one is held
            found = at.find({spring.b, spring.a});
        if (found != at.end() && taken[ends] < found->second.size())
            spring.rest_length = found->second[taken[ends]++];
    }
}

} // namespace

View::View(const World& w)
    : world(w),
      plan(w.plan()),
      model(make_model(w.scene())),
      x(w.positions()),
      v(w.velocities()),
      distance(records<layout::DistanceConstraint>(world, "distance", model.springs)),
      bending(records<layout::BendingConstraint>(world, "bending", model.hinges))
{
    if (plan.flowing == kNoBuffer)
        return;
    if (plan.precision == Precision::float64)
        take_rest_lengths<double>(world, distance);
    else
        take_rest_lengths<float>(world, distance);
}

std::vector<double> View::first_lengths() const
{
    std::vector<double> out;
    for (const ConstraintSet& set : plan.constraints)
        if (set.kind == "distance" && out.empty())
            for (const DistanceRecord& c :
                 decoded<layout::DistanceConstraint>(plan, plan.buffers[set.buffer].initial))
                out.push_back(c.rest_length);
    return out;
}

double View::length(const DistanceRecord& c) const { return glm::length(x[c.a] - x[c.b]); }

HingeAngle<double> View::angle(const BendingRecord& c) const
{
    std::array<Vec<double>, 4> corners;
    const std::uint32_t ids[] = {c.edge0, c.edge1, c.wing0, c.wing1};
    for (std::size_t k = 0; k < 4; ++k)
        corners[k] = {x[ids[k]].x, x[ids[k]].y, x[ids[k]].z};
    return hinge_angle(corners);
}

} // namespace taut::reference
