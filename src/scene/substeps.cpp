// How many substeps a scene asks for that names none.
//
// Based on: Macklin, Storey, Lu, et al. Small Steps in Physics Simulation. SCA 2019: one sweep a substep.
//   At rest a constraint that carries n vertices of mass m is corrected once a substep by what restores the
//   impulse n m g h^2, so it stays open by (w_a + w_b) n m g h^2 = 2 n g h^2: a strain of 2 n g h^2 / L.
// Departures: n is estimated by the mesh: links from a pin, or across a body that is free (it may come to
//   hang from one end), and the mass that hangs from the edges of pinned vertices; k iterations count like a
//   substep of 1/sqrt(k). A sweep of vbd carries a load over one link like one of xpbd, and counts the same.
//   Spanned bodies sag by L sqrt(3 e / 8) at a strain of e, so they may have less of it. Solids under xpbd
//   bend: material of speed of sound c acts as if softer by (c h / edge)^2, so that a bar of length L and
//   thickness t clamped at its end sags by 3/2 rho g L^4 / (E t^2) times that, 3/2 g h^2 L^4 / (t edge)^2,
//   too far. What lands on a few vertices is carried by them alone, under vbd and implicit_euler too:
//   contacts come after the solve, or a sweep spreads them by an edge. Cloth and chains that begin beside
//   their pins swing: a pendulum let go at an angle a from the plumb pulls with 3 - 2 cos a times its
//   weight where it passes below. Under vbd a sweep carries what happened at a vertex over about one edge:
//   held bodies take as many as their waves need. Membranes get the part of the strain that
//   membrane_share() says. A gas
//   of pressure p pushes cloth of s kg/m^2 by p / s, and half the radius over an edge of it hang from
//   one constraint (the tension of a sphere is p r / 2); one that draws in presses edges together, which
//   buckle where they act softer by (c h / edge)^2. What a sweep leaves of a plastic body flows like strain.
//   A sail that is held all round is spanned by the wind's push. One sweep bends cloth softer by
//   k B h^2 / (s edge^4), k measured, whatever B is where that is large: cloth that stands out sags by
//   k g h^2 L^4 / (8 edge^4) too far. Of a strain by which pins draw springs apart one sweep leaves
//   2.2 a / (1 + 0.82 a), a = (c h / edge)^2, measured. Measured in docs/methods.md.

#include "taut/scene/substeps.hpp"

#include "taut/scene/body_measures.hpp"
#include "taut/scene/chain_waves.hpp"
#include "taut/scene/drawn_strain.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/held.hpp"
#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double kSofter = 0.2;
constexpr double kAimedWay = kSeenWay / 2; ///< of a body's size: what the rule aims at is less than is seen
constexpr double kShortArm = 0.05;         ///< of a body's size: nearer to its pins it does not swing
constexpr double kStandsOut = 1.5;         ///< weights (swing_pull): less is within 41 degrees of the plumb
constexpr double kPressed = 1e-4; ///< strain of edges that are pressed together: less buckles nothing
constexpr double kLimp = 2;       ///< of its length: cloth that a beam's formula lets sag further hangs
constexpr double kFlowSweep = 3;  ///< of (c h / edge)^2 of the yield: what a sweep leaves, measured
/// Of what pins draw apart: half of accept.stretch, within these, since it costs 1/h.
constexpr double kLeastLeft = 0.005, kMostLeft = 0.05;
/// Of a body's weight times its height: what a layer that a floor presses may keep.
constexpr double kPressedEnergy = 0.08;
constexpr double kHingeSweep = 8; ///< of B h^2 / (s edge^4): by how much softer one sweep bends

glm::dvec3 centre_of_mass(const Body& body)
{
    double mass = 0;
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < body.mesh.positions.size(); ++i)
    {
        const double m = body.vertex_masses.empty() ? 1.0 : body.vertex_masses[i];
        mass += m;
        sum += m * body.mesh.positions[i];
    }
    return mass > 0 ? sum / mass : sum;
}

/// Weights with which cloth or a chain that is let go pulls at its pins when it passes below them: 1 where it
/// hangs, 3 where it begins level with them. 1 where nothing holds it, or all round; too much where it is
/// held so that it cannot swing, as on three sides.
double swing_pull(const Body& body, const glm::dvec3& down)
{
    glm::dvec3 pins(0); // weighted by mass, as the centre of all is
    double held = 0;
    Extent size;
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
        {
            const double mass = body.vertex_masses.empty() ? 1.0 : body.vertex_masses[v];
            pins += mass * body.mesh.positions[v];
            held += mass;
        }
    for (const glm::dvec3& p : body.mesh.positions)
        size.take(p);
    if (!(held > 0) || !body.mesh.tetrahedra.empty())
        return 1;
    const glm::dvec3 arm = centre_of_mass(body) - pins / held;
    const double length = glm::length(arm);
    return length > kShortArm * size.size() ? 3 - 2 * glm::dot(arm, down) / length : 1;
}

/// Of (c h / edge)^2, what a sweep of vbd carries on: through a solid, and through cloth and chains, of which
/// at 0.4 waves arrive too late for what swings, which loses a quarter of its energy.
constexpr double kWaveInSolid = 0.4, kWave = 0.1;

/// Iterations that sweep: one where a scene names none.
std::uint32_t sweeps_of(const MethodSettings& method) { return std::max(method.iterations, 1u); }

/// s: the longest substep in which a body acts under xpbd as stiff as it is but for kSofter.
double longest_for_stiffness(const Body& body, const SweepLoad& load)
{
    return load.edge * std::sqrt(kSofter / wave_speed_squared(body));
}

/// s: the longest substep in which a plastic body that its pins draw flows by the strain of its material:
/// what a sweep leaves of it, kFlowSweep (c h / edge)^2 of the yield, is kSofter. No limit for others.
double longest_for_flow(const Body& body, const SweepLoad& load)
{
    const bool drawn = std::ranges::any_of(
        body.pins, [](const Pin& pin) { return !pin.motion.empty() || pin.moved_by_program; });
    return body.material.plastic_yield > 0 && drawn
               ? longest_for_stiffness(body, load) / std::sqrt(kFlowSweep)
               : HUGE_VAL;
}

/// s: the longest substep in which sweeps leave half of accept.stretch of the strain by which pins draw the
/// springs of cloth or of a chain apart (fabrics leave about half of that); no limit for others.
double longest_for_drawn(const Scene& scene, const Body& body, const SweepLoad& load)
{
    const Material& m = body.material;
    const bool chain = body.shape.kind == ShapeKind::chain;
    const double cloth = chain ? m.stretch_stiffness / m.density : wave_speed_squared(body);
    const double square = body.mesh.tetrahedra.empty() ? cloth : 0;
    if (!(square > 0) || !std::isfinite(square))
        return HUGE_VAL;
    const double strain = drawn_strain(body);
    const double left = std::clamp(scene.accept.stretch / 2, kLeastLeft, kMostLeft) / strain;
    const double rest = 2.2 - 0.82 * left; // without strain none is left
    return rest > 0 ? load.edge * std::sqrt(left / rest / square) : HUGE_VAL;
}

/// s: the longest substep in which a held solid sags by no more than is seen too far, or acts as stiff as it
/// is but for kSofter; no limit for others.
double longest_for_solid(const Body& body, const SweepLoad& load, double gravity)
{
    const double thick = body.pins.empty() ? 0 : thickness_of(body);
    if (!(thick > 0) || body.mesh.tetrahedra.empty() || !(body.material.youngs_modulus > 0))
        return HUGE_VAL;
    const double length = load.reach * load.edge;
    const double seen = thick * load.edge * std::sqrt(kAimedWay / (1.5 * gravity * length * length * length));
    return std::max(seen, longest_for_stiffness(body, load));
}

/// The strain that a push of the floor may leave in the layer of a solid that it meets, of which the whole is
/// `carried` times as much: kSweepStrain, or what keeps kPressedEnergy in it. Under vbd, which meets
/// colliders in its sweeps, nothing stays.
double pressed_strain(const Scene& scene, const Body& body, double carried)
{
    if (scene.method.type == MethodKind::vbd)
        return kSweepStrain;
    Extent size;
    for (const glm::dvec3& p : body.mesh.positions)
        size.take(p);
    const double height = size.size() / std::sqrt(3.0); // of a cube in that box
    const double weight = body.material.density * glm::length(scene.gravity) * height; // J/m^3
    const double nu = body.material.poissons_ratio;
    const double modulus = body.material.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    return std::min(kSweepStrain, std::sqrt(2 * kPressedEnergy * weight * carried / modulus));
}

/// s: the longest substep in which a free solid stands on its lowest vertices and leaves no more strain above
/// them than pressed_strain(), or acts as stiff as it is but for kSofter; no limit for others. Boxes stand on
/// a face, balls on a point. Under vbd and implicit_euler, which soften nothing, the same limit was measured
/// to do (docs/methods.md): there it is how far a push of the floor gets in a substep.
double longest_for_standing(const Scene& scene, const Body& body, const SweepLoad& load)
{
    const glm::dvec3& gravity = scene.gravity;
    const double g = glm::length(gravity);
    if (!body.pins.empty() || body.mesh.tetrahedra.empty() || !(body.material.youngs_modulus > 0))
        return HUGE_VAL;
    double lowest = -HUGE_VAL, lying = 0;
    for (const glm::dvec3& p : body.mesh.positions)
        lowest = std::max(lowest, glm::dot(p, gravity) / g);
    for (const glm::dvec3& p : body.mesh.positions)
        lying += glm::dot(p, gravity) / g >= lowest - 0.1 * load.edge ? 1 : 0;
    const double carried = static_cast<double>(body.mesh.positions.size()) / lying;
    return std::max(std::sqrt(pressed_strain(scene, body, carried) * load.edge / (2 * carried * g)),
                    longest_for_stiffness(body, load));
}

/// s: the longest substep in which sweeps over the vertices of a held body carry its waves on; no limit where
/// nothing holds it, nor for a chain that hangs still, which is right with ten.
double longest_for_waves(const Scene& scene, const Body& body, const SweepLoad& load)
{
    const double wave = body.mesh.tetrahedra.empty() ? kWave : kWaveInSolid;
    const double carried = wave * sweeps_of(scene.method); // edges^2
    if (body.pins.empty())
        return HUGE_VAL;
    if (const double rate = chain_waves(body); rate > 0)
        return hangs_still(scene, body) ? HUGE_VAL : std::sqrt(carried / rate);
    const double square = wave_speed_squared(body);
    return square > 0 ? load.edge * std::sqrt(carried / square) : HUGE_VAL;
}

/// s: the longest substep in which sweeps carry a body that is pushed everywhere by so many m/s^2.
double longest_for_push(const Scene& scene, const Body& body, const SweepLoad& load, const glm::dvec3& push)
{
    const double g = glm::length(push);
    const bool spanned = is_spanned(body, push);
    const double pull = spanned ? 1 : swing_pull(body, push / g);
    const double open = 2 * std::max(load.vertices, 1.0) * pull * g; // m/s^2: see "Based on"
    const bool sweeps = scene.method.type != MethodKind::vbd; // whose steps at a vertex see all its triangles
    const double sag = spanned && sweeps ? 8.0 / 3 * kAimedWay * kAimedWay : 1;
    const double strain = std::min(kSweepStrain * (sweeps ? scene_file::membrane_share(body) : 1), sag);
    return std::sqrt(strain * load.edge / open);
}

/// s: the longest substep in which sweeps carry what a gas presses on closed cloth; no limit without. What a
/// gas of lower pressure draws in presses its edges together, and buckles where xpbd makes them softer.
double longest_for_pressure(const Scene& scene, const Body& body, const SweepLoad& load)
{
    const double force = std::abs(body.material.pressure) * area_of(body), mass = mass_of(body); // N, kg
    if (!(force > 0) || !(mass > 0))
        return HUGE_VAL;
    Extent all;
    for (const glm::dvec3& p : body.mesh.positions)
        all.take(p);
    const double radius = all.size() / (2 * std::sqrt(3.0)); // of a ball in that box
    const double vertices = std::max(1.0, radius / (2 * load.edge));
    const double carried = std::sqrt(kSweepStrain * load.edge / (2 * vertices * force / mass));
    if (scene.method.type != MethodKind::xpbd || !body.mesh.tetrahedra.empty())
        return carried;
    const double stiffness = wave_speed_squared(body) * body.material.density; // N/m; 0: rigid
    const bool buckles = stiffness > 0 && -body.material.pressure * radius / 2 > kPressed * stiffness;
    return buckles ? std::min(carried, longest_for_stiffness(body, load)) : carried;
}

/// The mean of all triangles, of length 1 where they lie in a plane, 0 where they enclose a volume.
glm::dvec3 mean_normal(const Body& body)
{
    const auto& x = body.mesh.positions;
    glm::dvec3 sum(0);
    for (const auto& t : body.mesh.triangles)
        sum += glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) / 2.0;
    const double area = area_of(body);
    return area > 0 ? sum / area : sum;
}

/// m/s^2, by which the wind pushes a body along its normal where it pushes most.
glm::dvec3 wind_push(const Scene& scene, const Body& body)
{
    const glm::dvec3 normal = mean_normal(body);
    const auto square = [&](const glm::dvec3& v) { return glm::length(v) * std::abs(glm::dot(v, normal)); };
    const auto& keys = scene.wind.keys;
    double most = keys.empty() || keys.front().time > 0 ? square(scene.wind.velocity) : 0;
    for (const Wind::Key& key : keys)
        most = std::max(most, square(key.velocity));
    const double mass = mass_of(body);
    const double drag = scene.wind.density * body.material.drag * area_of(body) / 2;
    return mass > 0 ? drag / mass * most * normal : glm::dvec3(0);
}

/// s: the longest substep in which sweeps carry what blows into a sail; no limit for what is not held on all
/// sides of its plane, as a flag, which streams.
double longest_for_wind(const Scene& scene, const Body& body, const SweepLoad& load)
{
    const glm::dvec3 push = wind_push(scene, body);
    return is_spanned(body, push) ? longest_for_push(scene, body, load, push) : HUGE_VAL;
}

/// Whether pins hold the direction of a body, not places alone.
bool holds_a_triangle(const Body& body)
{
    const std::vector<bool> held = held_vertices(body);
    return std::ranges::any_of(body.mesh.triangles,
                               [&](const auto& t) { return held[t[0]] && held[t[1]] && held[t[2]]; });
}

/// s: the longest substep in which cloth that stands out from its pins by its bending stiffness sags by no
/// more than is seen too far, or bends no softer than kSofter; no limit for cloth that hangs, is spanned, is
/// held about its middle or by an axle (no triangle is held), or is too limp to stand out.
double longest_for_bending(const Body& body, const SweepLoad& load, const glm::dvec3& gravity)
{
    const Material& m = body.material;
    const FabricBending& woven = m.fabric.bending;
    const double rigidity =
        m.fabric.used && woven.used ? std::max(woven.warp, woven.weft) : m.bending_stiffness;
    const double g = glm::length(gravity);
    if (!(rigidity > 0) || body.pins.empty() || body.mesh.triangles.empty() || !(m.density > 0) ||
        !holds_a_triangle(body) || is_spanned(body, gravity) || swing_pull(body, gravity / g) < kStandsOut)
        return HUGE_VAL;
    const double steps = load.reach, length = load.length;
    if (!(length > 0) || m.density * g * length * length * length > 8 * kLimp * rigidity)
        return HUGE_VAL;
    const double fourth = std::pow(length / steps, 4); // m^4, of an edge along the way
    const double softer = kSofter * m.density * fourth / (kHingeSweep * rigidity);
    const double seen = 8 * kAimedWay * length / (kHingeSweep * g * std::pow(steps, 4));
    return std::sqrt(std::max(softer, seen));
}

/// s: the longest substep that a body allows.
double longest_substep(const Scene& scene, const Body& body, double g)
{
    const MethodKind method = scene.method.type;
    const SweepLoad load = sweep_load(body);
    if (!(load.edge > 0) || body.kinematic.used) // whose vertices are all led
        return HUGE_VAL;
    const double sweeps = std::sqrt(sweeps_of(scene.method));
    const double gas =
        method == MethodKind::implicit_euler ? HUGE_VAL : sweeps * longest_for_pressure(scene, body, load);
    const double carried = // whatever gravity does
        method == MethodKind::vbd    ? std::min(gas, longest_for_waves(scene, body, load))
        : method == MethodKind::xpbd ? std::min({gas, sweeps * longest_for_flow(body, load),
                                                 sweeps * longest_for_drawn(scene, body, load)})
                                     : gas;
    const double blown =
        method == MethodKind::implicit_euler ? HUGE_VAL : sweeps * longest_for_wind(scene, body, load);
    if (!(g > 0))
        return std::min(carried, blown);
    const bool meets = !scene.colliders.empty() || scene.contact.between;
    const double standing = meets ? longest_for_standing(scene, body, load) : HUGE_VAL;
    if (method == MethodKind::implicit_euler)
        return standing;
    const double weight = sweeps * longest_for_push(scene, body, load, scene.gravity);
    const double all = std::min({carried, blown, weight});
    if (method == MethodKind::vbd) // whose sweeps spread a contact by an edge each
        return std::min(all, standing);
    if (method == MethodKind::pbd)
        return all;
    return std::min(all, sweeps * std::min({longest_for_solid(body, load, g), standing,
                                            longest_for_bending(body, load, scene.gravity)}));
}

} // namespace

bool is_spanned(const Body& body, const glm::dvec3& push)
{
    constexpr double kSpan = 0.5, kBeside = 0.1, kBelow = 0.2; // of the body's size
    if (!(glm::length(push) > 0))
        return false;
    const glm::dvec3 down = glm::normalize(push);
    Extent all, pins;
    double highest = HUGE_VAL, lowest = -HUGE_VAL; // pins, along the push
    for (const glm::dvec3& p : body.mesh.positions)
        all.take(p);
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
        {
            const glm::dvec3& p = body.mesh.positions[v];
            pins.take(p);
            highest = std::min(highest, glm::dot(p, down));
            lowest = std::max(lowest, glm::dot(p, down));
        }
    if (!(highest <= lowest))
        return false;
    const double size = all.size();
    const glm::dvec3 off = centre_of_mass(body) - 0.5 * (pins.low + pins.high);
    const double below = glm::dot(off, down);
    return lowest - highest <= kBelow * size && pins.size() >= kSpan * size &&
           std::abs(below) <= kBelow * size && glm::length(off - below * down) <= kBeside * size;
}

double wanted_substeps(const Scene& scene)
{
    const MethodKind method = scene.method.type;
    const double g = glm::length(scene.gravity);
    double most = kLeastSubsteps;
    if (method == MethodKind::xpbd || method == MethodKind::pbd || method == MethodKind::vbd ||
        method == MethodKind::implicit_euler)
        for (const Body& body : scene.bodies)
            most = std::max(most, std::ceil(scene.timestep / longest_substep(scene, body, g)));
    return most;
}

double substeps_of_solids(const Scene& scene)
{
    const bool meets = !scene.colliders.empty() || scene.contact.between;
    double most = 0;
    for (const Body& body : scene.bodies)
        if (!body.mesh.tetrahedra.empty() && (meets || !body.pins.empty()))
            most = std::max(most,
                            scene.timestep / longest_substep(scene, body, glm::length(scene.gravity)));
    return most;
}

std::uint32_t automatic_substeps(const Scene& scene)
{
    return static_cast<std::uint32_t>(std::min<double>(wanted_substeps(scene), kMostSubsteps));
}

} // namespace taut
