// Elements of Body::elements, the program's and those of fabrics: to records, and to passes of XPBD and PBD.
// Their kernels are those of any element (kernels/methods/).

#include "taut/plan/added_elements.hpp"

#include "taut/elements/element.hpp"
#include "taut/plan/coloured_set.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/pose.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

/// Those with a folder of kernels over elements.
constexpr MethodKind kMethodsOfElements[] = {MethodKind::xpbd, MethodKind::pbd, MethodKind::mass_spring,
                                             MethodKind::implicit_euler, MethodKind::vbd};

/// One element in plan vertices. corners <= 4.
struct Added
{
    std::array<std::uint32_t, 4> vertex{};
    std::span<const double> values;
};

std::string place(const Scene& scene, std::size_t body, std::size_t list)
{
    const Body& of = scene.bodies[body];
    const ElementKind* kind = find_element(of.elements[list].kind);
    const bool fabric = of.material.fabric.used && kind != nullptr && is_own(*kind);
    return "bodies[" + std::to_string(body) + "]" +
           (fabric ? ".material.fabric" : ".elements[" + std::to_string(list) + "]") +
           (of.name.empty() ? "" : " (of \"" + of.name + "\")");
}

void check_list(const std::string& where, const Body& body, const Body::Elements& list)
{
    const auto refuse = [&](const std::string& why) { throw Error(ErrorCode::bad_input, where + why); };
    const ElementKind* kind = find_element(list.kind);
    if (kind == nullptr)
        return refuse(".kind is \"" + list.kind + "\"; there are: " + known_elements());
    for (const Effect& effect : effect_table()) // passes, buffers and sets are told apart by it
        if (effect.name == kind->name)
            refuse(".kind is \"" + kind->name + "\", which an effect of Taut is called; rename the element");
    if (list.vertices.size() % kind->corners != 0)
        refuse(".vertices has " + std::to_string(list.vertices.size()) + " entries; \"" + kind->name +
               "\" takes " + std::to_string(kind->corners) + " an element");
    const std::size_t count = list.vertices.size() / kind->corners;
    if (list.values.size() != count * kind->values.size())
        refuse(".values has " + std::to_string(list.values.size()) + " entries; " + std::to_string(count) +
               " elements of " + std::to_string(kind->values.size()) + " values take " +
               std::to_string(count * kind->values.size()));
    for (std::size_t k = 0; k < list.values.size(); ++k)
        if (!std::isfinite(list.values[k]))
            refuse(".values[" + std::to_string(k) + "] (" + kind->values[k % kind->values.size()] +
                   ") is not finite");
    for (std::size_t k = 0; k < list.vertices.size(); k += kind->corners)
    {
        const auto first = list.vertices.begin() + static_cast<std::ptrdiff_t>(k);
        const std::set<std::uint32_t> distinct(first, first + kind->corners);
        if (distinct.size() < kind->corners || *distinct.rbegin() >= body.mesh.positions.size())
            refuse(".vertices of element " + std::to_string(k / kind->corners) + " must be " +
                   std::to_string(kind->corners) + " different vertices below " +
                   std::to_string(body.mesh.positions.size()));
    }
}

/// Methods that have kernels over elements, as far as this kind has them.
std::string methods_of(const ElementKind& kind)
{
    std::vector<std::string_view> out;
    for (const MethodKind method : kMethodsOfElements)
        if (has_kernel(kind, to_string(method)))
            out.push_back(to_string(method));
    return scene_file::listing(out);
}

/// Throws where the scene's method cannot move elements of this kind.
void check_method(const std::string& where, const Scene& scene, const ElementKind& kind)
{
    const MethodKind method = scene.method.type;
    const bool can = std::find(std::begin(kMethodsOfElements), std::end(kMethodsOfElements), method) !=
                     std::end(kMethodsOfElements);
    if (!has_kernel(kind, to_string(method)))
        throw Error(ErrorCode::unsupported,
                    where + ": method " + quoted(method) + " has no kernels for elements \"" + kind.name +
                        "\"; use " + methods_of(kind) +
                        (is_own(kind) || !can
                             ? ""
                             : ", or name it in the line \"//! methods\" of " + kind.name + ".glsl"));
    if (method == MethodKind::pbd && !pbd_is_coloured(scene))
        throw Error(ErrorCode::unsupported, where + ": method.scheme " + quoted(scene.method.scheme) +
                                                " does not move elements \"" + kind.name +
                                                "\"; use \"coloured\"");
}

/// Whether the method moves elements by their force, which a rigid one does not have.
bool needs_force(const Scene& scene)
{
    const MethodKind kind = scene.method.type;
    return kind != MethodKind::xpbd && kind != MethodKind::pbd;
}

void check_force(const std::string& where, const Body& body, const Body::Elements& list)
{
    const ElementKind& kind = *find_element(list.kind);
    const auto& x = start_of(body);
    for (std::size_t k = 0; k < list.vertices.size() / kind.corners; ++k)
        if (!std::isfinite(energy_of(kind, list, k, x)))
            throw Error(ErrorCode::unsupported,
                        where + ": element " + std::to_string(k) +
                            " has no finite energy where it starts, so no force (is it rigid?); change "
                            ".values, or use \"xpbd\"");
}

/// The elements of one kind of a body of which a corner moves.
std::vector<Added> acting(const PlanBuilder& b, std::size_t body, const ElementKind& kind)
{
    std::vector<Added> out;
    for (const Body::Elements& list : b.scene.bodies[body].elements)
    {
        const std::size_t values = kind.values.size();
        for (std::size_t k = 0; list.kind == kind.name && k < list.vertices.size() / kind.corners; ++k)
        {
            Added e;
            e.values = std::span(list.values).subspan(k * values, values);
            double moves = 0;
            for (std::uint32_t c = 0; c < kind.corners; ++c)
            {
                e.vertex[c] = b.vertex(body, list.vertices[k * kind.corners + c]);
                moves += b.inverse_mass[e.vertex[c]];
            }
            if (moves > 0)
                out.push_back(e);
        }
    }
    return out;
}

/// Records as kernels read them: corners, then values.
template <typename Real>
std::vector<std::byte> packed(const ElementKind& kind, const std::vector<Added>& elements)
{
    const std::size_t size =
        record_bytes(kind, sizeof(Real) == sizeof(double) ? Precision::float64 : Precision::float32);
    const std::size_t at = (4 * kind.corners + sizeof(Real) - 1) / sizeof(Real) * sizeof(Real);
    std::vector<std::byte> out(size * elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)
    {
        std::memcpy(out.data() + k * size, elements[k].vertex.data(), 4 * kind.corners);
        for (std::size_t v = 0; v < kind.values.size(); ++v)
        {
            const auto value = static_cast<Real>(elements[k].values[v]);
            std::memcpy(out.data() + k * size + at + v * sizeof(Real), &value, sizeof(Real));
        }
    }
    return out;
}

void prepare_kind(PlanBuilder& b, const ElementKind& kind)
{
    Coloured<Added> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const std::vector<Added> own = acting(b, body, kind);
        ConstraintGraph graph = body_graph(b, body, kind.corners);
        for (const Added& e : own)
            for (std::uint32_t c = 0; c < kind.corners; ++c)
                graph.vertices.push_back(e.vertex[c] - b.plan.body_start[body]);
        add_body(b, coloured, own, colour_greedy(graph, {0, true}));
    }
    std::vector<Added> flat;
    std::vector<std::uint32_t> table;
    ConstraintSet set = lay_out(kind.name, std::move(coloured), flat, table);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        set.buffer =
            b.add_buffer<std::byte>(set.kind, set.kind + " constraints", packed<decltype(zero)>(kind, flat));
    });
    add_set(b, set, std::move(table), {set.kind, b.method.kind == MethodKind::xpbd});
}

/// Kinds in the order in which the scene names them first.
std::vector<const ElementKind*> kinds_of(const Scene& scene)
{
    std::vector<const ElementKind*> out;
    for (const Body& body : scene.bodies)
        for (const Body::Elements& list : body.elements)
            if (const ElementKind* kind = find_element(list.kind);
                kind != nullptr && std::find(out.begin(), out.end(), kind) == out.end())
                out.push_back(kind);
    return out;
}

} // namespace

void check_added_elements(const Scene& scene, Refusals& out)
{
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        for (std::size_t k = 0; k < scene.bodies[b].elements.size(); ++k)
            out.attempt([&] {
                const Body& body = scene.bodies[b];
                const std::string where = place(scene, b, k);
                check_list(where, body, body.elements[k]);
                check_method(where, scene, *find_element(body.elements[k].kind));
                if (needs_force(scene))
                    check_force(where, body, body.elements[k]);
                if (body.material.tear_strain > 0)
                    throw Error(ErrorCode::unsupported,
                                where + ": a body with tear_strain " +
                                    "cannot have them, since tearing splits vertices");
            });
}

bool wants_added_elements(const Scene& scene) { return !kinds_of(scene).empty(); }

double energy_of(const ElementKind& kind, const Body::Elements& list, std::size_t element,
                 std::span<const glm::dvec3> x)
{
    std::array<glm::dvec3, 4> corner{};
    for (std::uint32_t c = 0; c < kind.corners; ++c)
        corner[c] = x[list.vertices[element * kind.corners + c]];
    const std::size_t values = kind.values.size();
    return kind.energy(std::span(corner).first(kind.corners),
                       std::span(list.values).subspan(element * values, values));
}

std::uint32_t AddedSet::count() const { return static_cast<std::uint32_t>(vertices.size()) / kind->corners; }

std::vector<AddedSet> added_sets(const PlanBuilder& b)
{
    std::vector<AddedSet> out;
    for (const ElementKind* kind : kinds_of(b.scene))
    {
        std::vector<Added> all;
        for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
            for (const Added& e : acting(b, body, *kind))
                all.push_back(e);
        if (all.empty())
            continue;
        AddedSet set{kind, {}, {}};
        for (const Added& e : all)
            set.vertices.insert(set.vertices.end(), e.vertex.begin(), e.vertex.begin() + kind->corners);
        with_real(b.plan.precision, [&](auto zero) { set.records = packed<decltype(zero)>(*kind, all); });
        out.push_back(std::move(set));
    }
    return out;
}

void prepare_added_elements(PlanBuilder& b)
{
    for (const ElementKind* kind : kinds_of(b.scene))
        prepare_kind(b, *kind);
}

void record_added_elements(PlanBuilder& b, const Moment& moment)
{
    for (const ElementKind* kind : kinds_of(b.scene))
        if (const ConstraintSet* set = find_set(b.plan, kind->name))
        {
            if (b.method.kind == MethodKind::xpbd)
                record_colours(b, *set, "xpbd_" + kind->name, kind->corners, moment);
            else // wholly, in every iteration: stiffnesses of pbd are those of materials
                record_pbd_sweep(b, *set, "pbd_" + kind->name, kind->corners, 1, moment);
        }
}

} // namespace taut
