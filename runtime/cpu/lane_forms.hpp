#pragma once
// How the indices lie through which the elements of a block reach a buffer. Constraints of grids and ribbons
// stand in such an order that eight in a row often reach eight vertices in a row, or four pairs.
// Where that holds, loads and stores are half as many and twice as wide, and need no index but the first.
//
// Nothing is kept from one pass to the next: the form is found block by block as it runs, so a buffer of
// constraints may change as it likes.

#include "taut/runtime/cpu/lanes.hpp"

#include <cstddef>

namespace taut::lanes {

enum class Form : unsigned char
{
    any,  ///< every element has an index of its own
    run,  ///< first + 0, 1, 2, 3, 4, 5, 6, 7
    pairs ///< first + 0, 1, 4, 5, 8, 9, 12, 13
};

/// How far an element's index lies behind the first element's.
constexpr uint behind_first(Form form, uint element)
{
    switch (form)
    {
    case Form::run: return element;
    case Form::pairs: return element / 2 * 4 + element % 2;
    case Form::any: break;
    }
    return 0;
}

/// behind_first of all elements, by lane.
struct Distances
{
    alignas(32) uint of[kLanes];

    constexpr explicit Distances(Form form) : of{}
    {
        for (uint element = 0; element < kLanes; ++element)
            of[lane_of(element)] = behind_first(form, element);
    }
};

inline constexpr Distances kDistances[] = {Distances(Form::run), Distances(Form::pairs)};

constexpr Form other_than(Form form) { return form == Form::run ? Form::pairs : Form::run; }

/// Watches what a block's elements index with: whether all their corners are of a form.
class Lookout
{
public:
    TAUT_LANE explicit Lookout(Form form)
        : distances_(_mm256_load_si256(
              reinterpret_cast<const __m256i*>(kDistances[static_cast<uint>(form) - 1].of)))
    {}

    /// `indices`: a lane each; `first`: where that of element 0 lies.
    TAUT_LANE void see(__m256i indices, const std::byte* first)
    {
        const __m256 firsts = _mm256_broadcast_ss(reinterpret_cast<const float*>(first));
        const __m256i behind = _mm256_sub_epi32(indices, _mm256_castps_si256(firsts));
        const __m256i same = _mm256_cmpeq_epi32(behind, distances_);
        all_ = indexed_ ? _mm256_and_si256(all_, same) : same;
        indexed_ = true;
    }

    TAUT_LANE bool agrees() const { return indexed_ && _mm256_movemask_epi8(all_) == -1; }

private:
    __m256i distances_;
    __m256i all_ = _mm256_setzero_si256();
    bool indexed_ = false;
};

/// What is looked for first, and when to look at all: without a form, ever more blocks pass unseen.
class Patience
{
public:
    TAUT_LANE bool wants_look()
    {
        if (unseen_ == 0)
            return true;
        --unseen_;
        return false;
    }

    TAUT_LANE Form likely() const { return likely_; }

    TAUT_LANE void found(Form form)
    {
        if (form != Form::any)
        {
            likely_ = form;
            longest_ = 0;
            return;
        }
        longest_ = longest_ < kLongest ? 2 * longest_ + 1 : longest_;
        unseen_ = longest_;
    }

private:
    static constexpr uint kLongest = 15;
    Form likely_ = Form::run;
    uint longest_ = 0;
    uint unseen_ = 0; ///< blocks that pass before the next look
};

} // namespace taut::lanes
