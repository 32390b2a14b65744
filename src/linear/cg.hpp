#pragma once
// Conjugate gradients as passes of a recording: what `solve` replays, and what an implicit method puts into
// its own step. No host read between begin and end; a solve that has ended leaves passes of zero groups
// behind.

#include "taut/linear/operator.hpp"
#include "taut/linear/preconditioner.hpp"
#include "taut/runtime/base/status.hpp"

#include <functional>
#include <memory>

namespace taut::linear {

struct CgSettings
{
    double tolerance = 1e-8; ///< of |b - A x| / |b|, > 0
    std::uint32_t iteration_limit = 1000;
    double replacement = 0.01;     ///< |r| below this share of its peak: form the residual anew; in (0, 1)
    double growth = 1e8;           ///< |r| above this multiple of max(|b|, |r0|): the iteration runs away
    std::uint32_t patience = 1000; ///< iterations without a new smallest |r| after which it is formed anew
};

/// How M^-1 is applied. `inverse` as the functions of preconditioner.hpp lay it out, in reals.
struct Preconditioning
{
    Preconditioner kind = Preconditioner::none;
    BufferPtr inverse; ///< jacobi, spai0, block_jacobi; of a stored one only where rows are held: 0 there
    std::shared_ptr<const StoredPreconditioner> stored; ///< chebyshev, multigrid, or the caller's own
};

/// What the device says of a solve. Norms are of the vectors as they are on the device.
struct CgOutcome
{
    Status status = Status::iteration_limit;
    std::uint32_t cause = 0; ///< TAUT_CG_* (kernels/shared/layouts.h)
    bool running = false;    ///< more iterations are wanted
    std::uint32_t iterations = 0;
    std::uint32_t replacements = 0;
    double residual = 0;        ///< |r| / |b| at the end: of the residual formed anew where cause says so
    double curvature = 0;       ///< p.Ap of the last direction
    double curvature_ratio = 0; ///< p.Ap / p.Mp over the largest seen so far
    double rz = 0;
    /// The matrix that was given has no such curvature: what a float made of it has.
    bool misread = false;
};

class ConjugateGradient
{
public:
    /// With `pairs` (float only) b and x are pairs and the residual is formed in two floats: `mixed`.
    /// Throws Error{unsupported} where the operator cannot, Error{limit} for more than kMostRows rows.
    ConjugateGradient(std::shared_ptr<Device>, std::shared_ptr<const Operator>, Preconditioning, bool pairs);

    /// Right-hand side and solution (start value before begin, result after end): rows reals, or rows pairs.
    const BufferPtr& b() const { return b_; }
    const BufferPtr& x() const { return base_; }
    /// What the iterations since the residual was last formed have added to x: rows reals.
    const BufferPtr& gain() const { return x_; }
    /// The last direction p: rows reals.
    const BufferPtr& direction() const { return p_; }
    /// Where the solve stands: layout::CgState<real>. Final after record_end.
    const BufferPtr& state() const { return decided_; }

    /// Written by the host before a replay; the recording stays.
    void set(const CgSettings&);

    /// For a system of which only the first rows are in use, as many as a pass of the caller says. Before
    /// record_begin that pass writes the word TAUT_CONTROL_GROUPS of control() (shared/active_rows.h): the
    /// groups, of rows() / TAUT_LINEAR_GROUP in fixed shares (grid.hpp), that hold a row in use; and clears
    /// partials() and curvatures(), to which the others add nothing. Rows of the last of these groups that
    /// are not in use must have b = 0 and A x = 0 there. `always` says when what runs in any case runs, and
    /// with how many groups: where the word is 0 the whole solve is passed over.
    void use_part(BufferPtr control, std::uint64_t offset);
    const BufferPtr& control() const { return control_; }
    const BufferPtr& partials() const { return partials_; }
    const BufferPtr& curvatures() const { return curvatures_; }

    /// r = b - A x, b.b, and the state of a new solve.
    void record_begin(Recorder&);
    /// Room for `count` iterations: three dispatches each (COO and Chebyshev more), and after every eighth
    /// those that form the residual anew. What is not needed runs zero groups.
    void record_iterations(Recorder&, std::uint32_t count);
    /// Takes the last step, checks the true residual where that is still open, x += what was gained. After it
    /// outcome() is final: a solve that still went on has the status iteration_limit.
    void record_end(Recorder&);

    /// Reads the state; waits for the device.
    CgOutcome outcome();
    /// |r| / |b| of iterations first..outcome().iterations, as far as the ring of kHistory words goes back.
    std::vector<float> history(std::uint32_t first, std::uint32_t last);
    static constexpr std::uint32_t kHistory = 1024;

    std::uint64_t bytes() const; ///< of all vectors and tables of the solver

private:
    void record_direction(Recorder&, bool last);
    void record_iteration(Recorder&);
    void record_replacement(Recorder&);
    void record_residual(Recorder&, const Gate&);
    void record_restart(Recorder&, const Gate&, bool begin);
    void record_preconditioner(Recorder&, const Gate&);
    void record_collect(Recorder&, const Gate&, bool add);

    std::shared_ptr<Device> device_;
    std::shared_ptr<const Operator> operator_;
    Preconditioning preconditioning_;
    bool pairs_ = false;
    Precision precision_;
    std::uint32_t groups_ = 1;
    Gate always_; ///< of what runs in any case
    BufferPtr b_, base_, x_, r_, p_, q_, z_, partials_, curvatures_, settings_, decided_, measured_, control_;
};

} // namespace taut::linear
