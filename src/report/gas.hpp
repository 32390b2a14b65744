#pragma once
// A gas within a closed surface as the effect pressure has it, in fp64: energy, force and stiffness.

#include "taut/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// The force is p times the gradient of the signed volume V within. p = `pressure`, or of an isothermal gas
/// `pressure` V0 / V while V / V0 is at least 1/100, and 100 times `pressure` below.
///
/// Based on: kernels/volume/pressure.comp. Departures: none.
struct GasElement
{
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< vertices scene-wide
    double rest_volume = 0; ///< V0, m^3, negative where triangles look inwards; not 0
    double pressure = 0;    ///< Pa more than outside, with the sign of V0
    bool isothermal = false;
};

/// Whether a body has one.
bool has_gas(const Body& body);
/// That of a resolved body for which has_gas, its vertices counted from `first`.
GasElement gas_element(const Body& body, std::uint32_t first);

/// J: -p V of a constant pressure, 0 without volume; -p V0 ln(V / V0) of an isothermal gas, 0 at rest, and
/// goes on in a straight line where its pressure grows no more.
double gas_energy(const GasElement& gas, std::span<const glm::dvec3> x);

/// N: adds minus the gradient of that.
void add_gas_forces(const GasElement& gas, std::span<const glm::dvec3> x, std::span<glm::dvec3> out);

/// As add_stiffness of element_rates.hpp; a gas makes some directions softer, which this counts as stiff.
void add_stiffness(const GasElement& gas, std::span<const glm::dvec3> x, std::span<double> rows);

} // namespace taut
