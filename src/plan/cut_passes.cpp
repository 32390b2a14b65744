#include "taut/plan/cut_passes.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace taut {
namespace {

struct KernelRow
{
    std::string_view name;
    Over over;
    std::uint32_t corners = 0;
};

constexpr std::string_view kOfAnyShape = "collide_"; // and the collider's shape

constexpr KernelRow kKernels[] = {
    {kOfAnyShape, Over::vertices},
    {"coast", Over::vertices},
    {"damping", Over::vertices},
    {"external_force", Over::vertices},
    {"predict", Over::vertices},
    {"finish", Over::vertices},
    {"pin_motion", Over::pins},
    {"xpbd_spring", Over::constraints, 2},
    {"xpbd_hinge", Over::constraints, 4},
    {"xpbd_volume", Over::constraints, 4},
    {"neo_hookean", Over::constraints, 4},
    {"pbd_spring", Over::constraints, 2},
    {"pbd_hinge", Over::constraints, 4},
    {"pbd_volume", Over::constraints, 4},
    {"strain_limit", Over::constraints, 2},
};

/// By the names that kernels give their bindings.
constexpr std::pair<std::string_view, Each> kBindings[] = {
    {"position", Each::vertex},
    {"low", Each::vertex},
    {"velocity", Each::vertex},
    {"delta", Each::vertex},
    {"predicted", Each::vertex},
    {"coasting", Each::vertex},
    {"force", Each::vertex},
    {"contact", Each::collider_and_vertex},
    {"vertex", Each::pin_vertex},
    {"pin_target", Each::pin},
    {"constraint", Each::constraint},
    {"multiplier", Each::constraint},
    {"damping_time", Each::constraint},
    {"step_values", Each::whole},
    {"events", Each::whole},
    {"collider", Each::whole},
    {"values", Each::whole},
};

[[noreturn]] void refuse(const Dispatch& pass)
{
    const bool of_faces = pass.kernel->name.starts_with("face_");
    throw Error(ErrorCode::unsupported,
                "effect \"" + pass.label + "\" (kernel " + std::string(pass.kernel->name) +
                    ") cannot be cut between two devices; springs, hinges, tetrahedra of bodies with pins, "
                    "strain limits, pins, "
                    "colliders that meet vertices, damping and external forces can: " +
                    (of_faces ? "say \"meets\": \"vertices\", " : "") +
                    "divide whole bodies, or use one device");
}

const KernelRow& row_of(const Dispatch& pass)
{
    const auto row = std::find_if(std::begin(kKernels), std::end(kKernels), [&](const KernelRow& r) {
        return r.name == pass.kernel->name ||
               (r.name == kOfAnyShape && pass.kernel->name.starts_with(r.name));
    });
    if (row == std::end(kKernels) || pass.kernel->group_kernel || pass.indirect.buffer != kNoBuffer)
        refuse(pass);
    return *row;
}

const ParamInfo* find_param(const Dispatch& pass, std::string_view name)
{
    for (const ParamInfo& info : pass.kernel->params)
        if (info.name == name)
            return &info;
    return nullptr;
}

const ParamInfo& param_info(const Dispatch& pass, std::string_view name)
{
    const ParamInfo* info = find_param(pass, name);
    if (info == nullptr)
        throw std::logic_error("kernel " + std::string(pass.kernel->name) + " has no parameter " +
                               std::string(name));
    return *info;
}

} // namespace

Over over(const Dispatch& pass) { return row_of(pass).over; }

Each each(const Dispatch& pass, std::size_t slot)
{
    for (const auto& [name, what] : kBindings)
        if (name == pass.kernel->bindings[slot].name)
            return what;
    refuse(pass);
}

std::uint32_t corner_count(const Dispatch& pass) { return row_of(pass).corners; }

ColourKey colour_of(const Dispatch& pass) { return {pass.bindings.front().buffer, param(pass, "first")}; }

bool has_param(const Dispatch& pass, std::string_view name) { return find_param(pass, name) != nullptr; }

std::uint32_t param(const Dispatch& pass, std::string_view name)
{
    std::uint32_t value = 0;
    std::memcpy(&value, pass.params.data() + param_info(pass, name).offset, sizeof value);
    return value;
}

void set_param(Dispatch& pass, std::string_view name, std::uint32_t value)
{
    std::memcpy(pass.params.data() + param_info(pass, name).offset, &value, sizeof value);
}

} // namespace taut
