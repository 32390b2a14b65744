// The generated Bindings of every kernel against what its tables say.

#include "kernel_bindings.inc"
#include "support/catch.hpp"
#include "taut/runtime/base/bindings.hpp"
#include "taut/runtime/base/registry.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace taut;

namespace {

/// A binding that knows nothing but its name.
struct Word
{
    std::string_view name = {};
    bool is_set() const { return !name.empty(); }
};

bool has(const KernelInfo& kernel, std::string_view name)
{
    return std::any_of(kernel.bindings.begin(), kernel.bindings.end(),
                       [&](const BindingInfo& b) { return b.name == name; });
}

/// Names that the variants of a kernel bind, in the order in which they are met.
std::vector<std::string_view> reflected(std::string_view stem)
{
    std::vector<std::string_view> names;
    for (const KernelInfo* kernel : all_kernels())
        for (const BindingInfo& binding : kernel->bindings)
            if (kernel->name == stem && std::find(names.begin(), names.end(), binding.name) == names.end())
                names.push_back(binding.name);
    return names;
}

template <template <typename> typename Bindings>
void check(const std::string& stem)
{
    CAPTURE(stem);
    const std::vector<std::string_view> wanted = reflected(stem);
    Bindings<Word> bindings;
    const auto members = bindings.named();
    REQUIRE(members.size() == wanted.size());
    REQUIRE(sizeof(bindings) == members.size() * sizeof(Word)); // no member without a name
    auto* words = reinterpret_cast<Word*>(&bindings);
    for (std::size_t k = 0; k < wanted.size(); ++k)
    {
        CHECK(members[k].first == wanted[k]);
        CHECK(members[k].second == words + k);
    }
    for (const KernelInfo* kernel : all_kernels())
        if (kernel->name == stem)
        {
            CAPTURE(kernel->variant);
            for (std::size_t k = 0; k < wanted.size(); ++k)
                words[k].name = has(*kernel, wanted[k]) ? wanted[k] : "";
            const std::vector<Word> slots = in_slot_order(*kernel, bindings);
            REQUIRE(slots.size() == kernel->bindings.size());
            for (const BindingInfo& binding : kernel->bindings)
                CHECK(slots[binding.slot].name == binding.name);
            CHECK(&Bindings<Word>::info(kernel->variant, kernel->precision) == kernel);
        }
}

} // namespace

TEST_CASE("the bindings of every kernel have the names, in order, that its variants bind")
{
#define TAUT_CHECK(stem) check<kernels::stem::Bindings>(#stem);
    TAUT_EACH_KERNEL(TAUT_CHECK)
#undef TAUT_CHECK
}
