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
//   too far. What lands on a few vertices is carried by them alone, under vbd and implicit_euler too, whose
//   contacts come after the solve. Cloth and chains that begin beside their pins swing: a pendulum let go at
//   an angle a from the plumb pulls with 3 - 2 cos a times its weight where it passes below. Under vbd a
//   sweep carries what happened at a vertex over about one edge: held bodies take as many as their waves
//   need. Membranes, of which each corner hangs from several triangles at once, get a ninth of the strain. A
//   gas of pressure p pushes cloth of s kg/m^2 by p / s, and half the radius over an edge of it hang from
//   one constraint (the tension of a sphere is p r / 2). Measured in docs/methods.md.

#include "taut/scene/substeps.hpp"

#include "taut/scene/extent.hpp"
#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut {
namespace {

constexpr double kSofter = 0.2;
constexpr double kMembraneShare = 1.0 / 9; ///< of kSweepStrain
constexpr double kShortArm = 0.05; ///< of a body's size: nearer to its pins it does not swing

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const Body& body)
{
    Neighbours out(body.mesh.positions.size());
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        out[a].push_back(b);
        out[b].push_back(a);
    };
    for (const auto& t : body.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            add(t[k], t[(k + 1) % 3]);
    for (const auto& t : body.mesh.tetrahedra)
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t j = k + 1; j < 4; ++j)
                add(t[k], t[j]);
    for (const auto& link : body.mesh.links)
        add(link[0], link[1]);
    for (const Body::Spring& spring : body.springs)
        add(spring.a, spring.b);
    for (auto& list : out)
    {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return out;
}

/// Edges to the furthest vertex that `sources` reach, and that vertex.
std::pair<std::uint32_t, std::uint32_t> furthest(const Neighbours& around, std::vector<std::uint32_t> wave)
{
    std::vector<bool> seen(around.size(), false);
    for (const std::uint32_t v : wave)
        seen[v] = true;
    std::uint32_t depth = 0, last = wave.empty() ? 0 : wave.front();
    while (!wave.empty())
    {
        std::vector<std::uint32_t> next;
        last = wave.front();
        for (const std::uint32_t v : wave)
            for (const std::uint32_t u : around[v])
                if (!seen[u])
                {
                    seen[u] = true;
                    next.push_back(u);
                }
        if (!next.empty())
            ++depth;
        wave = std::move(next);
    }
    return {depth, last};
}

double mean_edge(const Body& body, const Neighbours& around)
{
    double sum = 0, count = 0;
    for (std::uint32_t v = 0; v < around.size(); ++v)
        for (const std::uint32_t u : around[v])
        {
            sum += glm::distance(body.mesh.positions[u], body.mesh.positions[v]);
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

/// Mass that moves over the mass of a vertex, for each edge from a pinned vertex to one that moves.
double hanging_vertices(const Body& body, const Neighbours& around, const std::vector<bool>& held)
{
    const auto mass = [&](std::uint32_t v) {
        return body.vertex_masses.empty() ? 1.0 : body.vertex_masses[v];
    };
    double total = 0, edges = 0, carriers = 0;
    for (std::uint32_t v = 0; v < around.size(); ++v)
    {
        if (held[v])
            continue;
        total += mass(v);
        for (const std::uint32_t u : around[v])
            if (held[u])
            {
                ++edges;
                carriers += mass(v);
            }
    }
    return edges > 0 ? total / carriers : 0;
}

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

/// m^2, of all triangles.
double area_of(const Body& body)
{
    const auto& x = body.mesh.positions;
    double area = 0;
    for (const auto& t : body.mesh.triangles)
        area += glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 2;
    return area;
}

/// m^3, of all tetrahedra.
double volume_of(const Body& body)
{
    const auto& x = body.mesh.positions;
    double volume = 0;
    for (const auto& t : body.mesh.tetrahedra)
        volume += std::abs(glm::dot(x[t[1]] - x[t[0]], glm::cross(x[t[2]] - x[t[0]], x[t[3]] - x[t[0]]))) / 6;
    return volume;
}

/// m: of a bar of square section its side, by volume over surface.
double thickness_of(const Body& body)
{
    const double area = area_of(body);
    return area > 0 ? 4 * volume_of(body) / area : 0;
}

/// kg
double mass_of(const Body& body)
{
    if (!body.vertex_masses.empty())
        return std::accumulate(body.vertex_masses.begin(), body.vertex_masses.end(), 0.0);
    return body.material.density * (body.mesh.tetrahedra.empty() ? area_of(body) : volume_of(body));
}

constexpr double kWave = 0.4; ///< of (c h / edge)^2 that a sweep of vbd carries on

/// (m/s)^2 of waves along a body: of a fabric along its stiffer yarns.
double wave_speed_squared(const Body& body)
{
    const Material& m = body.material;
    if (!(m.density > 0))
        return 0;
    if (!body.mesh.tetrahedra.empty())
        return m.youngs_modulus / m.density;
    const double along = m.fabric.used ? std::max(m.fabric.warp, m.fabric.weft) : m.stretch_stiffness;
    return body.mesh.triangles.empty() || !std::isfinite(along) ? 0 : along / m.density;
}

/// s: the longest substep in which a solid acts under xpbd as stiff as it is but for kSofter.
double longest_for_stiffness(const Body& body, const SweepLoad& load)
{
    return load.edge * std::sqrt(kSofter / wave_speed_squared(body));
}

/// s: the longest substep in which a held solid sags by no more than is seen too far, or acts as stiff as it
/// is but for kSofter; no limit for others.
double longest_for_solid(const Body& body, const SweepLoad& load, double gravity)
{
    const double thick = body.pins.empty() ? 0 : thickness_of(body);
    if (!(thick > 0) || body.mesh.tetrahedra.empty() || !(body.material.youngs_modulus > 0))
        return HUGE_VAL;
    const double length = load.reach * load.edge;
    const double seen = thick * load.edge * std::sqrt(kSeenWay / (1.5 * gravity * length * length * length));
    return std::max(seen, longest_for_stiffness(body, load));
}

/// s: the longest substep in which a free solid stands on its lowest vertices and leaves no more strain above
/// them than kSweepStrain, or acts as stiff as it is but for kSofter; no limit for others. Boxes stand on a
/// face, balls on a point. Under vbd and implicit_euler, which soften nothing, the same limit was measured to
/// do (docs/methods.md): there it is how far a push of the floor gets in a substep.
double longest_for_standing(const Body& body, const SweepLoad& load, const glm::dvec3& gravity)
{
    const double g = glm::length(gravity);
    if (!body.pins.empty() || body.mesh.tetrahedra.empty() || !(body.material.youngs_modulus > 0))
        return HUGE_VAL;
    double lowest = -HUGE_VAL, lying = 0;
    for (const glm::dvec3& p : body.mesh.positions)
        lowest = std::max(lowest, glm::dot(p, gravity) / g);
    for (const glm::dvec3& p : body.mesh.positions)
        lying += glm::dot(p, gravity) / g >= lowest - 0.1 * load.edge ? 1 : 0;
    const double carried = static_cast<double>(body.mesh.positions.size()) / lying;
    return std::max(std::sqrt(kSweepStrain * load.edge / (2 * carried * g)),
                    longest_for_stiffness(body, load));
}

/// s: the longest substep in which sweeps over the vertices of a held body carry its waves on; no limit where
/// nothing holds it.
double longest_for_waves(const Body& body, const SweepLoad& load, double iterations)
{
    const double square = body.pins.empty() ? 0 : wave_speed_squared(body);
    return square > 0 ? load.edge * std::sqrt(kWave * iterations / square) : HUGE_VAL;
}

/// s: the longest substep in which sweeps carry a body's weight.
double longest_for_weight(const Scene& scene, const Body& body, const SweepLoad& load, double g)
{
    const bool spanned = is_spanned(body, scene.gravity);
    const double pull = spanned ? 1 : swing_pull(body, scene.gravity / g);
    const double open = 2 * std::max(load.vertices, 1.0) * pull * g; // m/s^2: see "Based on"
    const bool sweeps = scene.method.type != "vbd"; // whose steps at a vertex see all its triangles
    const auto is_membrane = [](const Body::Elements& e) { return e.kind == scene_file::kMembrane; };
    const bool membrane = std::any_of(body.elements.begin(), body.elements.end(), is_membrane);
    const double sag = spanned && sweeps ? 8.0 / 3 * kSeenWay * kSeenWay : 1;
    const double strain = std::min(kSweepStrain * (membrane && sweeps ? kMembraneShare : 1), sag);
    return std::sqrt(strain * load.edge / open);
}

/// s: the longest substep in which sweeps carry what a gas presses on closed cloth; no limit without.
double longest_for_pressure(const Body& body, const SweepLoad& load)
{
    const double force = std::abs(body.material.pressure) * area_of(body), mass = mass_of(body); // N, kg
    if (!(force > 0) || !(mass > 0))
        return HUGE_VAL;
    Extent all;
    for (const glm::dvec3& p : body.mesh.positions)
        all.take(p);
    const double radius = all.size() / (2 * std::sqrt(3.0)); // of a ball in that box
    const double vertices = std::max(1.0, radius / (2 * load.edge));
    return std::sqrt(kSweepStrain * load.edge / (2 * vertices * force / mass));
}

/// s: the longest substep that a body allows.
double longest_substep(const Scene& scene, const Body& body, double g)
{
    const std::string& method = scene.method.type;
    const SweepLoad load = sweep_load(body);
    if (!(load.edge > 0) || body.kinematic.used) // whose vertices are all led
        return HUGE_VAL;
    const double sweeps = std::sqrt(scene.method.iterations);
    const double gas = method == "implicit_euler" ? HUGE_VAL : sweeps * longest_for_pressure(body, load);
    if (!(g > 0))
        return gas;
    const bool meets = !scene.colliders.empty() || scene.contact.between;
    const double standing = meets ? longest_for_standing(body, load, scene.gravity) : HUGE_VAL;
    if (method == "implicit_euler")
        return standing;
    const double weight = longest_for_weight(scene, body, load, g);
    if (method == "vbd") // whose contacts come once a substep, whatever the sweeps
        return std::min(
            {gas, sweeps * weight, longest_for_waves(body, load, scene.method.iterations), standing});
    if (method == "pbd")
        return std::min(gas, sweeps * weight);
    return std::min(gas, sweeps * std::min({weight, longest_for_solid(body, load, g), standing}));
}

} // namespace

bool is_spanned(const Body& body, const glm::dvec3& gravity)
{
    constexpr double kSpan = 0.5, kBeside = 0.1, kBelow = 0.2; // of the body's size
    if (!(glm::length(gravity) > 0))
        return false;
    const glm::dvec3 down = glm::normalize(gravity);
    Extent all, pins;
    double highest = HUGE_VAL, lowest = -HUGE_VAL; // pins, along gravity
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

SweepLoad sweep_load(const Body& body)
{
    const Neighbours around = neighbours_of(body);
    std::vector<bool> held(around.size(), false);
    std::vector<std::uint32_t> pinned;
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
        {
            held[v] = true;
            pinned.push_back(v);
        }
    if (around.empty())
        return {};
    SweepLoad out;
    out.edge = mean_edge(body, around);
    out.reach = furthest(around, pinned.empty() ? std::vector{furthest(around, {0}).second} : pinned).first;
    out.vertices =
        pinned.empty() ? out.reach : std::max<double>(out.reach, hanging_vertices(body, around, held));
    return out;
}

double wanted_substeps(const Scene& scene)
{
    const std::string& method = scene.method.type;
    const double g = glm::length(scene.gravity);
    double most = kLeastSubsteps;
    if (method == "xpbd" || method == "pbd" || method == "vbd" || method == "implicit_euler")
        for (const Body& body : scene.bodies)
            most = std::max(most, std::ceil(scene.timestep / longest_substep(scene, body, g)));
    return most;
}

std::uint32_t automatic_substeps(const Scene& scene)
{
    return static_cast<std::uint32_t>(std::min<double>(wanted_substeps(scene), kMostSubsteps));
}

} // namespace taut
