#pragma once
// A Jacobi iteration of position-based dynamics, for the tests of its kernels: input with several constraints
// of each kind at a vertex, the lists that the kernels read, and the iterate in fp64.

#include "support/catch.hpp"
#include "support/pbd_cases.hpp"

namespace taut::conformance {

/// Which constraints a Jacobi iteration has besides springs, and the shares of each kind.
struct JacobiCase
{
    bool hinges = false, volumes = false, chebyshev = false;
    float stretch = 0.75f, bend = 0.3f, volume = 0.6f;

    std::string variant() const
    {
        std::string out = hinges ? "hinges" : "";
        if (volumes)
            out += out.empty() ? "volumes" : "_volumes";
        if (chebyshev)
            out += out.empty() ? "chebyshev" : "_chebyshev";
        return out;
    }
};

/// Every combination.
inline JacobiCase jacobi_case()
{
    JacobiCase of;
    of.hinges = GENERATE(false, true);
    of.volumes = GENERATE(false, true);
    of.chebyshev = GENERATE(false, true);
    return of;
}

/// Where the constraints of each vertex stand, appended to `words`: offsets into them, then entries
/// (element * corners + corner). Returns where the offsets begin.
template <typename Element>
std::uint32_t add_at_vertices(std::vector<std::uint32_t>& words, const std::vector<Element>& elements,
                              std::size_t vertices, std::size_t corners)
{
    std::vector<std::vector<std::uint32_t>> lists(vertices);
    for (std::uint32_t k = 0; k < elements.size(); ++k)
    {
        std::array<std::uint32_t, 4> ids{};
        std::memcpy(ids.data(), &elements[k], corners * sizeof(std::uint32_t));
        for (std::uint32_t corner = 0; corner < corners; ++corner)
            lists[ids[corner]].push_back(static_cast<std::uint32_t>(corners * k + corner));
    }
    const auto begin = static_cast<std::uint32_t>(words.size());
    auto next = static_cast<std::uint32_t>(begin + vertices + 1);
    for (const auto& list : lists)
    {
        words.push_back(next);
        next += static_cast<std::uint32_t>(list.size());
    }
    words.push_back(next);
    for (const auto& list : lists)
        words.insert(words.end(), list.begin(), list.end());
    return begin;
}

/// The lists of all kinds, as pbd_node and pbd_average read them.
struct AtVertices
{
    std::vector<std::uint32_t> words;
    std::uint32_t hinges = 0, volumes = 0;
};

template <typename Real>
AtVertices at_vertices(const PbdInput<Real>& in)
{
    AtVertices out;
    add_at_vertices(out.words, in.spring, in.position.size(), 2);
    out.hinges = add_at_vertices(out.words, in.hinge, in.position.size(), 4);
    out.volumes = add_at_vertices(out.words, in.tetrahedron, in.position.size(), 4);
    return out;
}

/// What one Jacobi iteration gives: the average of the requests times `relaxation`, and Chebyshev's step if
/// omega is not 1.
template <typename Real>
struct JacobiReference
{
    Field next;
    Events events = {};

    JacobiReference(const PbdInput<Real>& in, const JacobiCase& of, float relaxation, float omega,
                    bool report)
    {
        State s = pbd_state(in, report);
        const std::size_t n = in.position.size();
        std::vector<glm::dvec3> sum(n);
        std::vector<double> size(n), number(n);
        const auto add = [&](const Request& r) {
            events[TAUT_EVENT_DEGENERATE] += report && r.degenerate ? 1 : 0;
            for (std::size_t v = 0; v < r.vertices; ++v)
            {
                sum[r.vertex[v]] += r.push[v];
                size[r.vertex[v]] += r.size[v];
                number[r.vertex[v]] += 1;
            }
        };
        for (const auto& c : in.spring)
            add(request(s, c, of.stretch));
        if (of.hinges)
            for (const auto& c : in.hinge)
                add(request(s, c, of.bend));
        if (of.volumes)
            for (const auto& c : in.tetrahedron)
                add(request(s, c, of.volume));
        for (std::size_t v = 0; v < n; ++v)
        {
            const double w = s.position[v].w, o = static_cast<double>(omega);
            const double factor = number[v] > 0 ? w * static_cast<double>(relaxation) / number[v] : 0;
            const glm::dvec3 here(s.delta[v]), two_back(in.before[v]);
            glm::dvec3 x = here + sum[v] * factor;
            double scale = factor > 0 ? glm::length(here) + factor * size[v] : 0;
            if (omega != 1.0f && w > 0)
            {
                scale = o * (scale + glm::length(x) + glm::length(two_back));
                x = two_back + (x - two_back) * o;
            }
            for (int axis = 0; axis < 4; ++axis)
                next.add(axis < 3 ? x[axis] : s.delta[v].w, axis < 3 ? scale : 0);
        }
    }
};

/// Springs, hinges and tetrahedra in several colours, so that vertices have several of each; special ones.
template <typename Real>
PbdInput<Real> jacobi_input(std::uint32_t count, std::uint64_t seed)
{
    Random random(seed);
    PbdInput<Real> in;
    add_hinge_colour(in, random, std::max(count / 8, 1u));
    plant_hinges(in, 0, static_cast<std::uint32_t>(in.hinge.size()));
    const auto special = static_cast<std::uint32_t>(special_hinges().size());
    for (std::uint32_t k = special, n = static_cast<std::uint32_t>(in.hinge.size()); k < n; ++k)
    {
        Bend<Real> c = in.hinge[k]; // turned: its two wings exchanged for its edge, and as a tetrahedron
        in.tetrahedron.push_back({c.edge0, c.edge1, c.wing0, c.wing1, Real(0.0625), Real(0)});
        std::swap(c.edge0, c.wing0);
        c.rest_angle = Real(0.1);
        in.hinge.push_back(c);
    }
    const auto first = static_cast<std::uint32_t>(in.tetrahedron.size());
    add_volume_colour(in, random, std::max(count / 8, 1u));
    plant_volumes(in, first, static_cast<std::uint32_t>(in.tetrahedron.size()) - first);
    for (std::uint32_t k = first, n = static_cast<std::uint32_t>(in.tetrahedron.size()); k < n; ++k)
    {
        Volume<Real> c = in.tetrahedron[k]; // once more, inverted
        std::swap(c.c, c.d);
        in.tetrahedron.push_back(c);
    }
    while (in.position.size() < count) // alone, held or not
    {
        in.position.push_back(random.vec4<Real>(1, random.inverse_mass<Real>()));
        in.delta.push_back(random.vec4<Real>(1e-2, Real(1e-3)));
    }
    for (int colour = 0; colour < 3; ++colour)
        add_spring_colour(in, random, static_cast<std::uint32_t>(in.position.size() / 2));
    in.before = random.vec4s<Real>(in.position.size(), 1e-2, 0, 0);
    return in;
}

template <typename Real>
Buffers jacobi_buffers(const PbdInput<Real>& in)
{
    return {{"position", bytes_of(in.position)},
            {"delta", bytes_of(in.delta)},
            {"next", bytes_of(in.before)},
            {"events", no_events()},
            {"at", bytes_of(at_vertices(in).words)},
            {"spring", bytes_of(in.spring)},
            {"hinge", bytes_of(in.hinge)},
            {"tetrahedron", bytes_of(in.tetrahedron)}};
}

} // namespace taut::conformance
