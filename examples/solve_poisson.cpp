// A sparse system without any physics: the Poisson equation on a cube, solved on a device of choice.
//   solve_poisson [DEVICE] [N]     DEVICE as in `taut devices`, N points an edge (default: auto, 40)
#include <taut/taut.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv)
try
{
    const auto device = taut::Device::open(argc > 1 ? argv[1] : "auto");
    const auto points = static_cast<std::uint32_t>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 40);

    const taut::linear::SparseMatrix a = taut::linear::poisson3d(points);
    const std::vector<double> b(a.rows, 1.0); // heat everywhere, and zero around

    taut::linear::SolveOptions options; // format and precision follow from the matrix and the device
    options.tolerance = 1e-8;
    const taut::linear::Solution solution = taut::linear::solve(device, a, b, options);

    const taut::linear::SolveReport& report = solution.report;
    std::printf("%s on %s: %u unknowns, %s in %s\n", taut::to_string(report.status).data(),
                report.device.c_str(), report.n, taut::linear::to_string(report.precision).data(),
                taut::linear::to_string(report.format).data());
    std::printf("true residual %.2e |b| in %.1f ms and %u iterations, after %.1f ms of set-up\n",
                report.relative_residual, 1e3 * report.seconds, report.iterations,
                1e3 * report.setup_seconds);
    if (points > 0)
    {
        const std::size_t half = points / 2, n = points;
        std::printf("in the middle x = %.6g\n", solution.x[(half * n + half) * n + half]);
    }
    return report.status == taut::Status::converged ? 0 : 1;
}
catch (const taut::Error& error) // no such device, no memory, too large a cube
{
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
