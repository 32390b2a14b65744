#pragma once
// What the tests of kernels/linear share: how rows are dealt to groups, partial sums in fp64, and a look at
// buffers that are no plain reals.

#include "support/expect.hpp"
#include "support/random.hpp"

#include <functional>

namespace taut::conformance {

/// `count` rows dealt to `groups` groups in chunks that are multiples of the group size.
struct Dealt
{
    std::uint32_t count = 0;
    std::uint32_t groups = 1;
    std::uint32_t spare = 0; ///< groups dispatched beyond those
    std::uint32_t chunk() const
    {
        const std::uint32_t share = (count + groups - 1) / groups;
        return (share + TAUT_LINEAR_GROUP - 1) / TAUT_LINEAR_GROUP * TAUT_LINEAR_GROUP;
    }
    std::uint32_t group_of(std::uint32_t row) const { return row / chunk(); }
    std::uint32_t dispatched() const { return groups + spare; }
};

/// Around one group and several; more groups than rows ask for, fewer, and groups in excess.
inline std::vector<Dealt> deals()
{
    return {{1, 1, 0},   {63, 1, 1},  {64, 1, 0},   {65, 1, 2},   {127, 1, 0},  {128, 1, 0},  {129, 2, 0},
            {129, 1, 0}, {300, 5, 1}, {1000, 8, 3}, {1000, 3, 0}, {1000, 8, 0}, {20000, 7, 1}};
}

/// Those of at most 1,000 rows, for kernels whose references take long.
inline std::vector<Dealt> small_deals()
{
    std::vector<Dealt> small = deals();
    std::erase_if(small, [](const Dealt& dealt) { return dealt.count > 1000; });
    return small;
}

/// One sum a group with the size of its terms, over values a row.
class GroupSums
{
public:
    explicit GroupSums(const Dealt& dealt)
        : dealt_(dealt),
          value_(dealt.groups, 0.0L),
          scale_(dealt.groups, 0.0)
    {}
    void add(std::uint32_t row, double term) { add(row, term, std::abs(term)); }
    void add(std::uint32_t row, double term, double size)
    {
        value_[dealt_.group_of(row)] += term;
        scale_[dealt_.group_of(row)] += size;
    }
    void put(Field& field) const
    {
        for (std::size_t g = 0; g < value_.size(); ++g)
            field.add(static_cast<double>(value_[g]), scale_[g]);
    }

private:
    Dealt dealt_;
    std::vector<long double> value_; // the reference must not round as much as what it judges
    std::vector<double> scale_;
};

/// Values that must come out as they went in.
template <typename Real>
void add_unchanged(Field& field, const std::vector<Real>& values, std::size_t from = 0)
{
    for (std::size_t i = from; i < values.size(); ++i)
        field.add(static_cast<double>(values[i]), 0);
}

template <typename Real>
std::vector<Real> random_reals(Random& random, std::size_t n, double low = -1, double high = 1)
{
    std::vector<Real> values;
    for (std::size_t i = 0; i < n; ++i)
        values.push_back(random.uniform<Real>(low, high));
    return values;
}

} // namespace taut::conformance
