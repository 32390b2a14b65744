#pragma once
// What the tests of kernels/acad share: a net whose springs are near their threshold, with flags.

#include "support/constraint_net.hpp"

#include "taut/kernels/shared/active_rows.h"

namespace taut::conformance {

/// `count` elements of which about a share `on` carries the flag of a row, others one of the other flags;
/// `compress`: every third row is a compressed one.
inline std::vector<std::uint32_t> random_flags(Random& random, std::uint32_t count, double on,
                                               bool compress = false)
{
    std::vector<std::uint32_t> flags;
    for (std::uint32_t i = 0; i < count; ++i)
        flags.push_back(random.chance(on)    ? TAUT_ACAD_ROW
                        : random.chance(0.5) ? TAUT_ACAD_SPRING
                                             : TAUT_ACAD_RELEASED);
    for (std::uint32_t i = 0; compress && i < count; i += 3)
        flags[i] = flags[i] == TAUT_ACAD_ROW ? TAUT_ACAD_PRESSED : flags[i];
    return flags;
}

/// Integers must come out exactly.
inline void check_words(const Buffers& out, const char* name, const std::vector<std::uint32_t>& expected)
{
    INFO("buffer " << name);
    CHECK(values_of<std::uint32_t>(out.at(name)) == expected);
}

/// Rows member by member: in double a record ends in four bytes of padding that nobody has to copy.
template <typename Real>
void check_rows(const Buffers& out, const char* name, const std::vector<layout::Spring<Real>>& expected)
{
    const auto got = values_of<layout::Spring<Real>>(out.at(name));
    REQUIRE(got.size() == expected.size());
    std::size_t wrong = 0;
    for (std::size_t r = 0; r < got.size(); ++r)
        wrong += got[r].a != expected[r].a || got[r].b != expected[r].b ||
                 got[r].rest_length != expected[r].rest_length || got[r].stiffness != expected[r].stiffness ||
                 got[r].damping != expected[r].damping || got[r].kind != expected[r].kind;
    INFO("buffer " << name);
    CHECK(wrong == 0);
}

} // namespace taut::conformance
