// Based on: the fractional design that work-precision studies of cloth call for: the split of equal work
//   between substeps and iterations is an axis (Macklin et al., Small Steps in Physics Simulation, 2019).
// Departures: none.
#include "taut/report/cost_design.hpp"

#include "taut/report/method_settings.hpp"

namespace taut {
namespace {

using Counts = std::vector<std::uint32_t>;

class Design
{
public:
    Design(MethodKind kind, Precision precision, const MethodSettings& base) : base_(settings_for(kind, base))
    {
        base_.precision = precision;
        base_.stability = StabilityRule::refuse;
    }

    MethodSettings& base() { return base_; }

    void add(std::uint32_t iterations, const Counts& substeps)
    {
        for (const std::uint32_t n : substeps)
        {
            out_.push_back(base_);
            out_.back().substeps = n;
            out_.back().iterations = iterations;
        }
    }

    std::vector<MethodSettings> take() { return std::move(out_); }

private:
    MethodSettings base_;
    std::vector<MethodSettings> out_;
};

const Counts kAll{1, 2, 4, 8, 16, 32, 64, 128};

void explicit_springs(Design& design)
{
    for (const Integrator integrator : {Integrator::semi_implicit, Integrator::verlet})
    {
        design.base().integrator = integrator;
        design.add(1, kAll);
    }
    design.base().integrator = Integrator::explicit_euler;
    design.add(1, {32, 128});
}

void newton(Design& design)
{
    design.add(1, kAll);
    design.add(2, {1, 4, 16, 64});
    design.add(4, {1, 4, 16});
    design.base().linear_tolerance = 1e-2;
    design.add(1, {1, 4, 16, 64});
}

void constraints(Design& design)
{
    design.add(1, kAll);
    design.add(2, {1, 4, 16, 64});
    design.add(4, {1, 4, 16});
}

void activated(Design& design)
{
    design.add(1, {4, 8, 16, 32, 64, 128});
    design.add(2, {16, 64});
    design.base().activate_strain = design.base().release_strain = 0.01;
    design.add(1, {4, 8, 16, 32, 64, 128});
}

/// Sweeps of Gauss-Seidel: the same work split differently.
void sweeps(Design& design)
{
    design.add(1, kAll);
    design.add(4, {1, 4, 16, 64});
    design.add(16, {1, 4, 16});
    design.add(64, {1, 4});
}

} // namespace

std::vector<MethodSettings> method_design(MethodKind kind, Precision precision, const MethodSettings& base)
{
    Design design(kind, precision, base);
    switch (kind)
    {
    case MethodKind::mass_spring: explicit_springs(design); break;
    case MethodKind::implicit_euler: newton(design); break;
    case MethodKind::implicit_constraints: constraints(design); break;
    case MethodKind::acad: activated(design); break;
    case MethodKind::xpbd: sweeps(design); break;
    case MethodKind::pbd:
        sweeps(design);
        design.base().scheme = ElementScheme::node_centric;
        design.add(4, {4});
        design.add(16, {4});
        break;
    case MethodKind::vbd:
        sweeps(design);
        design.base().spectral_radius = 0.9; // pays only where there are iterations to accelerate
        design.add(16, {1, 4});
        break;
    }
    return design.take();
}

std::vector<MethodSettings> method_product(MethodKind kind, Precision precision, const CostOptions& options,
                                           const MethodSettings& base)
{
    Design design(kind, precision, base);
    for (const std::uint32_t iterations : reads_iterations(kind) ? options.iterations : Counts{1})
        design.add(iterations, options.substeps);
    return design.take();
}

} // namespace taut
