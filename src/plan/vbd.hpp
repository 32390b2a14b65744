#pragma once
// Internal to src/plan: vertex block descent. docs/methods/vbd.md.

#include "taut/plan/builder.hpp"

#include "taut/kernels/shared/vbd_parts.h"

#include <algorithm>
#include <limits>

namespace taut {

class Refusals;

inline constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max(); ///< of a held vertex

/// What the effects of vertex block descent share while a plan is made.
struct BlockBuffers
{
    /// Consecutive colours that one pass does: one of its own, or several small ones in one group.
    struct Run
    {
        std::uint32_t first = 0, rows = 0, colours = 1;
        bool grouped() const { return colours >= 2; }
    };
    std::vector<Run> runs;
    std::uint32_t rows = 0;                          ///< vertices that move
    /// Elements of one kind that the program has added (kernels/methods/vbd/).
    struct Kind
    {
        std::string name;
        std::uint32_t corners = 2, count = 0;
        std::uint32_t records = kNoBuffer;
        std::uint32_t rows = kNoBuffer;  ///< which are at the vertex of each row
        std::uint32_t parts = kNoBuffer; ///< which are each group's of the bodies' sums
    };
    std::vector<Kind> kinds;
    std::uint32_t block = kNoBuffer; ///< what they come to at each vertex
    /// Of a row on average, for the accounts.
    std::uint32_t springs_each = 0, hinges_each = 0, tetrahedra_each = 0;
    bool hinges = false, damped = false;
    bool volumes = false, elastic = false; ///< held volumes, neo-Hookean tetrahedra
    bool apart = false; ///< there are added elements; then rows are as with tetrahedra
    bool tetrahedra() const { return volumes || elastic; }
    std::uint32_t row_words() const { return tetrahedra() ? 5 : 4; }
    /// Words of the corners, and positions beside its own, that a row reads on average.
    std::uint32_t corners_each() const
    {
        return (hinges ? hinges_each : 0) + (tetrahedra() ? tetrahedra_each : 0);
    }
    std::uint32_t near() const
    {
        return springs_each + (hinges ? 4 * hinges_each : 0) + (tetrahedra() ? 3 * tetrahedra_each : 0);
    }
    /// Of bodies' sums (vbd_rise, vbd_drift): groups, and where in `row` their table is.
    std::uint32_t groups = 0, table = 0, sums = kNoBuffer;
    std::uint32_t lost = kNoBuffer; ///< by group: energy that a body lost of late, J (vbd_limit)
    std::vector<std::uint32_t> group_start; ///< first of each body, and the end
    bool loose = false; ///< a body of which nothing is held
    std::uint32_t row = kNoBuffer, ends = kNoBuffer, corners = kNoBuffer;
    std::uint32_t share = kNoBuffer, support = kNoBuffer;                    ///< adaptive start
    std::uint32_t touched = kNoBuffer, seen = kNoBuffer, solved = kNoBuffer; ///< and with colliders
    /// What colliders are in the way of vertices (vbd_touch), four reals each from `surfaces` on; 0 = none.
    std::uint32_t contacts = kNoBuffer, surfaces = 0;
    /// Where in `sums` vbd_carry's are, and behind them the frames of what carries a body.
    std::uint32_t carry() const { return groups * TAUT_VBD_PARTS + TAUT_VBD_FALL; }
    std::uint32_t frame() const { return surfaces == 0 ? 0 : carry() + groups * TAUT_VBD_DRIFT; }
    std::uint32_t newest = kNoBuffer, older = kNoBuffer, body = kNoBuffer,
                  progress = kNoBuffer; ///< Chebyshev
    std::vector<float> omega;           ///< by iteration; empty = not accelerated
};

/// As refuse_rigid.
void check_vbd(const Scene& resolved, Refusals& out);

/// Factors of the iterations of a substep: 1 for the first ones, then those of the recurrence of Wang 2015
/// with `radius` (at most what that many iterations bear). Empty where it would not pay.
std::vector<float> chebyshev_factors(double radius, std::uint32_t iterations);

void prepare_vbd(PlanBuilder& builder);
/// The row of a vertex and of how many elements it is.
struct GuardedRow
{
    std::uint32_t row = kNoRow, elements = 0;
};

void prepare_vbd_start(PlanBuilder& builder, BlockBuffers& blocks);
/// What vbd_rise and vbd_choose read behind the rows, nothing where the start needs no guard; counts its
/// groups. `row_of`: by plan vertex.
std::vector<std::uint32_t> guard_table(const PlanBuilder& builder, BlockBuffers& blocks,
                                       std::span<const GuardedRow> row_of);
/// Whether any collider is there whose effect is available.
bool meets_colliders(const PlanBuilder& builder);
void prepare_vbd_touch(PlanBuilder& builder, BlockBuffers& blocks);
/// What is in the way, before a substep's start.
void record_vbd_touch(PlanBuilder& builder, const Moment& moment);
void record_vbd_start(PlanBuilder& builder, const Moment& moment);
void record_vbd_solve(PlanBuilder& builder, const Moment& moment);
void record_vbd_end(PlanBuilder& builder, const Moment& moment);
void record_vbd_mark(PlanBuilder& builder, const Moment& moment);
void record_vbd_share(PlanBuilder& builder, const Moment& moment);

} // namespace taut
