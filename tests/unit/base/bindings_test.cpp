// Bindings by name: what a variant has must be set, and nothing else.

#include "taut/runtime/base/bindings.hpp"

#include "support/catch.hpp"

#include <array>
#include <stdexcept>

using namespace taut;

namespace {

constexpr std::array kBindings = {BindingInfo{"position", 0, Access::read, 16},
                                  BindingInfo{"delta", 1, Access::update, 16},
                                  BindingInfo{"low", 2, Access::read, 16}};

KernelInfo kernel()
{
    KernelInfo info;
    info.name = "relax";
    info.variant = "kept";
    info.bindings = kBindings;
    return info;
}

std::vector<std::size_t> places(std::vector<NamedBinding> named)
{
    return places_in_slot_order(kernel(), named);
}

} // namespace

TEST_CASE("bindings come in order of slot, whatever the order of their names")
{
    CHECK(places({{"low", true}, {"spare", false}, {"position", true}, {"delta", true}}) ==
          std::vector<std::size_t>{2, 3, 0});
}

TEST_CASE("a binding that is missing, one too many and one of no such name are refused by name")
{
    const auto refused = [](std::vector<NamedBinding> named, const std::string& binding,
                            const std::string& why) {
        CHECK_THROWS_AS(places(named), std::logic_error);
        CHECK_THROWS_WITH(places(named),
                          "kernel \"relax\" (variant kept): binding \"" + binding + "\" " + why);
    };
    refused({{"position", true}, {"delta", true}, {"low", false}}, "low", "is not set");
    refused({{"position", true}, {"low", true}}, "delta", "is not set");
    refused({{"position", true}, {"delta", true}, {"low", true}, {"table", true}}, "table",
            "is set, but there is no such binding");
    refused({{"postion", true}, {"delta", true}, {"low", true}}, "position", "is not set");
}
