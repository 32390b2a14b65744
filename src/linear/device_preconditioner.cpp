#include "taut/linear/device_preconditioner.hpp"

#include "taut/linear/multigrid.hpp"
#include "taut/linear/reals.hpp"

#include <algorithm>
#include <cmath>

namespace taut::linear {
namespace {

constexpr double kSmallestInverse = 1e-30; ///< 0 would hold its row
constexpr double kLargestInverse = 1e30;

/// Into float's range, where a preconditioner may be coarse, but not indefinite: blocks (of 6 values) are
/// scaled as a whole, and only their diagonals raised.
void fit_to_float(std::vector<double>& inverse, std::size_t block)
{
    for (std::size_t at = 0; at + block <= inverse.size(); at += block)
    {
        const std::span<double> part(inverse.data() + at, block);
        double largest = 0;
        for (const double value : part)
            largest = std::max(largest, std::abs(value));
        if (largest > kLargestInverse)
            for (double& value : part)
                value *= kLargestInverse / largest;
        for (const std::size_t k : {0, 3, 5})
            if (k < block && part[k] > 0)
                part[k] = std::max(part[k], kSmallestInverse);
    }
}

BufferPtr upload(Device& device, std::span<const double> values, Precision precision, std::string_view label)
{
    BufferPtr buffer = device.make_buffer(values.size() * real_bytes(precision), label);
    write_reals(device, buffer, values, precision);
    return buffer;
}

std::vector<double> inverse_of(const PreconditionerInput& in, Preconditioner kind)
{
    const std::span<const std::uint32_t> held = in.options.held;
    if (kind == Preconditioner::spai0)
        return spai0_inverse(in.a, held);
    if (kind == Preconditioner::block_jacobi)
        return block_jacobi_inverse(in.a, held, in.precision == Precision::float64 ? 0x1p-53 : 0x1p-24);
    return jacobi_inverse(in.a, held);
}

} // namespace

std::vector<double> scaled_inverse(const PreconditionerInput& in, Preconditioner kind)
{
    if (kind == Preconditioner::none)
    {
        std::vector<double> ones(in.a.rows, 1.0);
        for (const std::uint32_t row : in.options.held)
            ones[row] = 0;
        return ones;
    }
    std::vector<double> inverse = inverse_of(in, kind);
    for (double& value : inverse)
        value = std::ldexp(value, -in.exponent);
    if (in.precision == Precision::float32)
        fit_to_float(inverse, kind == Preconditioner::block_jacobi ? 6 : 1);
    return inverse;
}

Preconditioning make_preconditioning(const std::shared_ptr<Device>& device, const PreconditionerInput& in,
                                     const std::shared_ptr<const Operator>& matrix)
{
    Preconditioning out;
    out.kind = in.options.preconditioner;
    const auto inverse = [&](Preconditioner kind) {
        return upload(*device, scaled_inverse(in, kind), in.precision, "cg inverse");
    };
    // Held rows are an inverse of zero, which plain conjugate gradients do not read.
    if (out.kind == Preconditioner::none && !in.options.held.empty())
    {
        out.inverse = inverse(Preconditioner::none);
        out.kind = Preconditioner::jacobi;
    }
    else if (out.kind == Preconditioner::chebyshev)
    {
        const Interval interval = chebyshev_interval(in.a, jacobi_inverse(in.a, in.options.held));
        const BufferPtr diagonal = inverse(Preconditioner::jacobi);
        out.stored =
            std::make_shared<Chebyshev>(device, matrix, diagonal, interval, in.options.chebyshev_degree);
        if (!in.options.held.empty())
            out.inverse = diagonal; // its zeros keep held rows out of the residual
    }
    else if (out.kind == Preconditioner::multigrid)
        out.stored = std::make_shared<Multigrid>(device, aggregate(in.a), matrix, in.exponent);
    else if (out.kind != Preconditioner::none)
        out.inverse = inverse(out.kind);
    return out;
}

} // namespace taut::linear
