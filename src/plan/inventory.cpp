#include "taut/plan/inventory.hpp"

#include "taut/runtime/base/registry.hpp"

#include <algorithm>

namespace taut {
namespace {

void add_once(std::vector<std::string>& names, const std::string& name)
{
    if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
}

/// A counter is read only to be added to, which no kernel depends on.
void add_use(const Dispatch& pass, const BindingInfo& binding, BoundBuffer& use)
{
    const std::string name = full_name(*pass.kernel);
    if (binding.access != Access::count && reads(binding.access))
        add_once(use.read_by, name);
    if (writes(binding.access))
        add_once(use.written_by, name);
}

} // namespace

std::vector<BoundBuffer> buffer_uses(const Plan& plan)
{
    std::vector<BoundBuffer> uses;
    for (const PlanBuffer& buffer : plan.buffers)
        uses.push_back({buffer.name, buffer.effect, buffer.bytes, buffer.host_written, {}, {}});
    for (const Dispatch& pass : plan.passes)
    {
        for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
            add_use(pass, pass.kernel->bindings[slot], uses[pass.bindings[slot].buffer]);
        if (pass.indirect.buffer != kNoBuffer)
            add_once(uses[pass.indirect.buffer].read_by, full_name(*pass.kernel));
    }
    return uses;
}

std::vector<DispatchedKernel> kernel_uses(const Plan& plan)
{
    std::vector<DispatchedKernel> uses;
    for (const Dispatch& pass : plan.passes)
    {
        const std::string name = full_name(*pass.kernel);
        const auto same = [&](const DispatchedKernel& use) {
            return use.name == name && use.effect == pass.label;
        };
        auto at = std::find_if(uses.begin(), uses.end(), same);
        if (at == uses.end())
            at = uses.insert(at, {name, pass.label, 0, 0, pass.kernel->group_kernel});
        ++at->dispatches;
        at->elements += pass.count;
    }
    return uses;
}

} // namespace taut
