#include "taut/kernels/solve_log.hpp"

#include "support/cg_cases.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct Counts
{
    std::uint32_t solves, iterations, most, limited, failed, last_status;
    bool operator==(const Counts&) const = default;
};

/// By the words of layout::SolveLog.
Counts counted(Counts c, std::uint32_t status, std::uint32_t iterations)
{
    c.iterations += iterations;
    c.most = std::max(c.most, iterations);
    c.last_status = status;
    switch (status)
    {
    case TAUT_CG_ZERO_RIGHT_HAND_SIDE: return c;
    case TAUT_CG_CONVERGED: break;
    case TAUT_CG_RUNNING: c.last_status = TAUT_CG_ITERATION_LIMIT; [[fallthrough]];
    case TAUT_CG_ITERATION_LIMIT: ++c.limited; break;
    default: ++c.failed;
    }
    ++c.solves;
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("solve_log counts every way in which a solve can end", "", float, double)
{
    using Real = TestType;
    const auto status =
        GENERATE(range(std::uint32_t{TAUT_CG_RUNNING}, std::uint32_t{TAUT_CG_ZERO_RIGHT_HAND_SIDE} + 1));
    const std::uint32_t count = GENERATE(0u, 1u);
    CAPTURE(status, count);
    const Counts before{7, 90, 30, 2, 1, TAUT_CG_CONVERGED};
    CgState<Real> state = middle_of_solve<Real>();
    state.status = status;
    state.iteration = GENERATE(0u, 12u, 31u);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"state", bytes_of(std::vector{state})}, {"run_log", bytes_of(std::vector{before})}};
    c.launches = {
        make_launch(kernels::solve_log::info("", c.precision), kernels::solve_log::Params{count}, 1)};
    const Counts want = count == 0 ? before : counted(before, status, state.iteration);
    look_on_every_device(
        c, [&](const Buffers& out) { CHECK((values_of<Counts>(out.at("run_log")).front() == want)); });
}

TEST_CASE("solve_log adds up over many solves")
{
    CgState<float> state = middle_of_solve<float>();
    state.status = TAUT_CG_CONVERGED;
    Case c;
    c.in = {{"state", bytes_of(std::vector{state})}, {"run_log", Bytes(sizeof(Counts))}};
    for (int k = 0; k < 5; ++k)
        c.launches.push_back(
            make_launch(kernels::solve_log::info("", c.precision), kernels::solve_log::Params{1}, 1));
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK((values_of<Counts>(out.at("run_log")).front() == Counts{5, 60, 12, 0, 0, TAUT_CG_CONVERGED}));
    });
}
