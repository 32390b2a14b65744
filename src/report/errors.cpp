#include "taut/report/errors.hpp"

#include "taut/report/contact.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace taut {
namespace {

double square(const ErrorWeights& weights, Positions a, Positions b)
{
    assert(a.size() == weights.mass.size() && b.size() == a.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (weights.mass[i] > 0)
            sum += weights.mass[i] * glm::dot(a[i] - b[i], a[i] - b[i]);
    return sum;
}

} // namespace

ErrorWeights error_weights(const PhysicalModel& model)
{
    ErrorWeights out{model.mass, model.diameter};
    for (std::size_t i = 0; i < out.mass.size(); ++i)
        if (model.pinned[i])
            out.mass[i] = 0;
    return out;
}

double distance_by_mass(const ErrorWeights& weights, Positions a, Positions b)
{
    return std::sqrt(square(weights, a, b));
}

std::optional<double> displacement_error(const ErrorWeights& weights, Positions x, Positions reference,
                                         Positions start)
{
    const double moved = square(weights, reference, start);
    if (!(moved > 0))
        return std::nullopt;
    return std::sqrt(square(weights, x, reference) / moved);
}

double largest_error(const ErrorWeights& weights, Positions x, Positions reference)
{
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double error = glm::distance(x[i], reference[i]);
        if (weights.mass[i] > 0 && !(error <= largest)) // a NaN is an error, not a pass
            largest = error;
    }
    return largest / weights.diameter;
}

double largest_error(const ErrorWeights& weights, const Frames& x, const Frames& reference)
{
    assert(x.size() == reference.size());
    double largest = 0;
    for (std::size_t f = 0; f < x.size(); ++f)
        if (const double error = largest_error(weights, x[f], reference[f]); !(error <= largest))
            largest = error;
    return largest;
}

std::optional<double> trajectory_error(const ErrorWeights& weights, const Frames& x, const Frames& reference)
{
    assert(x.size() == reference.size());
    double error = 0, moved = 0;
    for (std::size_t f = 0; f < x.size(); ++f)
    {
        error += square(weights, x[f], reference[f]);
        moved += square(weights, reference[f], reference.front());
    }
    if (!(moved > 0))
        return std::nullopt;
    return std::sqrt(error / moved);
}

Frames smoothed(const Frames& frames, std::size_t window)
{
    assert(window > 0);
    Frames out;
    if (frames.empty())
        return out;
    out.push_back(frames.front());
    for (std::size_t f = 1; f + window <= frames.size(); ++f)
    {
        std::vector<glm::dvec3> mean(frames[f].size(), glm::dvec3(0));
        for (std::size_t k = 0; k < window; ++k)
            for (std::size_t i = 0; i < mean.size(); ++i)
                mean[i] += frames[f + k][i] / static_cast<double>(window);
        out.push_back(std::move(mean));
    }
    return out;
}

StretchErrors stretch_errors(const PhysicalModel& model, Positions x)
{
    std::vector<double> strain;
    for (const StretchElement& s : model.springs)
        if (s.rest_length > 0)
            strain.push_back(glm::distance(x[s.a], x[s.b]) / s.rest_length - 1);
    StretchErrors out;
    if (strain.empty())
        return out;
    for (double c : strain)
    {
        out.rms += c * c;
        out.rms_tension += c > 0 ? c * c : 0;
    }
    const auto count = static_cast<double>(strain.size());
    out.rms = std::sqrt(out.rms / count);
    out.rms_tension = std::sqrt(out.rms_tension / count);
    std::sort(strain.begin(), strain.end());
    out.largest = strain.back();
    out.percentile_99 = strain[static_cast<std::size_t>(0.99 * (count - 1))];
    return out;
}

std::optional<double> acceleration_residual(const PhysicalModel& model, Positions x)
{
    const double g = glm::length(model.gravity);
    if (!(g > 0))
        return std::nullopt;
    std::vector<glm::dvec3> force(x.size(), glm::dvec3(0));
    add_forces(model, x, force);
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!model.pinned[i])
            for (int k = 0; k < 3; ++k)
                largest = std::max(largest, std::abs(force[i][k]) / model.mass[i]);
    return largest / g;
}

std::optional<double> energy_gap(double energy, double start, double minimum)
{
    if (!(start > minimum))
        return std::nullopt;
    return (energy - minimum) / (start - minimum);
}

EnergyDrift energy_drift(std::span<const double> energy, double period, double reference_energy)
{
    assert(reference_energy > 0);
    EnergyDrift out;
    const auto n = static_cast<double>(energy.size());
    double sum = 0, moment = 0, spread = 0;
    for (double e : energy)
        sum += e;
    for (std::size_t i = 0; i < energy.size(); ++i)
    {
        const double t = static_cast<double>(i) - 0.5 * (n - 1);
        moment += t * (energy[i] - sum / n);
        spread += t * t;
        out.largest = std::max(out.largest, std::abs(energy[i] - energy[0]) / reference_energy);
    }
    out.per_period = spread > 0 ? moment / spread * period / reference_energy : 0;
    return out;
}

double momentum_error(const ErrorWeights& weights, Positions velocity, Positions start_velocity,
                      const glm::dvec3& impulse, double gravity)
{
    glm::dvec3 momentum(0), change(0);
    double mass = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i)
    {
        mass += weights.mass[i];
        momentum += weights.mass[i] * velocity[i];
        change += weights.mass[i] * (velocity[i] - start_velocity[i]);
    }
    const double speed = std::max(glm::length(momentum) / mass, std::sqrt(gravity * weights.diameter));
    return speed > 0 ? glm::length(change - impulse) / (mass * speed) : 0;
}

Oscillation oscillation(std::span<const double> signal, double timestep)
{
    std::vector<double> rising; // times of upward crossings
    std::vector<double> peaks;  // largest value between them
    double peak = 0;
    for (std::size_t i = 1; i < signal.size(); ++i)
    {
        const double a = signal[i - 1], b = signal[i];
        if (a < 0 && b >= 0)
        {
            if (!rising.empty())
                peaks.push_back(peak);
            rising.push_back((static_cast<double>(i) - b / (b - a)) * timestep);
            peak = 0;
        }
        peak = std::max(peak, b);
    }
    Oscillation out;
    if (rising.size() < 2)
        return out;
    out.periods = rising.size() - 1;
    out.frequency = static_cast<double>(out.periods) / (rising.back() - rising.front());
    if (peaks.size() > 1)
        out.damping = std::log(peaks.front() / peaks.back()) / static_cast<double>(peaks.size() - 1) /
                      (2 * 3.14159265358979323846);
    return out;
}

double penetration(const PhysicalModel& model, const ErrorWeights& weights, Positions x, double time)
{
    double deepest = 0;
    for (const Collider& collider : model.colliders)
    {
        const reference::Surface surface = reference::surface_at(collider, time);
        for (std::size_t i = 0; i < x.size(); ++i)
            if (weights.mass[i] > 0)
                deepest = std::max(deepest, -surface.touch(x[i], model.gap[i]).height);
    }
    return deepest / weights.diameter;
}

} // namespace taut
