// Options: an enum and its words.

#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/options.hpp"

namespace taut {
namespace {

/// `last` is the last enumerator: no word lacks, and none is too many.
template <Option E>
void check_words(E last)
{
    REQUIRE(words_of<E>().size() == static_cast<std::size_t>(last) + 1);
    for (std::size_t i = 0; i < words_of<E>().size(); ++i)
    {
        const E value = static_cast<E>(i);
        CHECK(!to_string(value).empty());
        CHECK(option_of<E>(to_string(value)) == value); // and so no word stands twice
    }
}

} // namespace

TEST_CASE("every value of an option has a word of its own")
{
    check_words(Precision::float64);
    check_words(MethodKind::vbd);
    check_words(Integrator::verlet);
    check_words(StabilityRule::ignore);
    check_words(ElementScheme::constraint_centric);
    check_words(LinearOperator::matrix_free);
    check_words(NewtonPreconditioner::two_level);
    check_words(ConstrainedSprings::structural);
    check_words(ReleaseRule::strain);
    check_words(ConstraintTarget::rest);
    check_words(SweepStart::previous);
    check_words(BendingModel::plate);
    check_words(PressureLaw::isothermal);
    check_words(SolidModel::springs);
    check_words(HeldVolume::surface);
    check_words(Diagonals::uniform);
    check_words(BoxSplit::six);
    check_words(GrainSource::texture);
    check_words(BiasSpecimen::sheet);
    check_words(ColliderMeets::surface);
    check_words(FrictionMix::geometric_mean);
    check_words(ContactStart::separate);
    check_words(Guarantee::no_crossing);
}

TEST_CASE("words and options: those that files have, and a refusal of any other")
{
    CHECK(to_string(Integrator::explicit_euler) == "explicit");
    CHECK(option_named<MethodKind>("vbd") == MethodKind::vbd);
    CHECK(quoted(Guarantee::no_crossing) == "\"no_crossing\"");
    CHECK(to_string(static_cast<BoxSplit>(2)).empty());
    CHECK(!option_of<BoxSplit>("seven"));
    CHECK_THROWS_WITH(option_named<BoxSplit>("fife"),
                      "the option is \"fife\"; it must be \"five\" or \"six\" (did you mean \"five\"?)");
    CHECK_THROWS_AS(option_named<BoxSplit>(""), Error);
}

} // namespace taut
