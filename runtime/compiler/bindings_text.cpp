#include "taut/runtime/compiler/bindings_text.hpp"

#include <algorithm>
#include <sstream>

namespace taut {
namespace {

using Kernels = std::vector<std::shared_ptr<const CompiledKernel>>;

/// Words in the order in which they came, each once.
struct Words
{
    std::vector<std::string> all;

    void add(const std::string& word)
    {
        if (std::find(all.begin(), all.end(), word) == all.end())
            all.push_back(word);
    }

    std::string joined(const std::string& between) const
    {
        std::string out;
        for (const std::string& word : all)
            out += (out.empty() ? "" : between) + word;
        return out;
    }
};

struct Member
{
    std::string name;
    Words access, types, variants;
};

std::string word(Access access)
{
    switch (access)
    {
    case Access::read: return "read";
    case Access::write: return "write";
    case Access::update: return "update";
    case Access::count: return "count";
    }
    return {};
}

/// As the kernel spells a type, of which the form in double precision is known.
std::string in_kernel(const std::string& type)
{
    return type == "double" ? "real" : type.starts_with("dvec") ? "rvec" + type.substr(4) : type;
}

/// Forms of one precision only, the one that shows which types are `real`.
Kernels one_precision(const Kernels& kernels)
{
    Kernels out;
    for (const auto& k : kernels)
        if (k->info.precision == kernels.back()->info.precision)
            out.push_back(k);
    return out;
}

std::vector<Member> members_of(const Kernels& variants)
{
    std::vector<Member> members;
    for (const auto& k : variants)
        for (std::size_t i = 0; i < k->bindings.size(); ++i)
        {
            const BindingInfo& binding = k->bindings[i];
            auto at = std::find_if(members.begin(), members.end(),
                                   [&](const Member& m) { return m.name == binding.name; });
            if (at == members.end())
                at = members.insert(at, Member{std::string(binding.name), {}, {}, {}});
            at->access.add(word(binding.access));
            at->types.add(in_kernel(k->binding_types[i]));
            at->variants.add(k->variant.empty() ? "base" : k->variant);
        }
    return members;
}

std::string member_line(const Member& m, bool everywhere)
{
    return "    Binding " + m.name + " = {}; ///< " + m.access.joined(" or ") + ", " +
           m.types.joined(" or ") + (everywhere ? "" : "; of " + m.variants.joined(", ")) + "\n";
}

} // namespace

std::string bindings_text(const std::string& stem, const Kernels& kernels)
{
    const Kernels variants = one_precision(kernels);
    const std::vector<Member> members = members_of(variants);
    std::ostringstream out;
    out << "/// What a dispatch binds, by name. Members that a variant does not have stay unset.\n"
           "template <typename Binding>\nstruct Bindings\n{\n";
    if (!kernels.front()->params.empty())
        out << "    using Params = kernels::" << stem << "::Params;\n\n";
    for (const Member& m : members)
        out << member_line(m, m.variants.all.size() == variants.size());
    out << "\n    /// Every member with its name.\n"
           "    std::array<std::pair<std::string_view, const Binding*>, "
        << members.size() << "> named() const\n    {\n        return {{";
    for (const Member& m : members)
        out << "\n            {\"" << m.name << "\", &" << m.name << "},";
    out << "\n        }};\n    }\n\n"
           "    static const KernelInfo& info(std::string_view variant, Precision precision)\n    {\n"
           "        return kernels::"
        << stem << "::info(variant, precision);\n    }\n};\n";
    return out.str();
}

} // namespace taut
