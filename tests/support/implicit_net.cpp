#include "support/implicit_net.hpp"

#include "support/dual.hpp"

#include <algorithm>

namespace taut::conformance {

HingeTerms hinge_terms(const std::array<glm::dvec3, 4>& x)
{
    HingeTerms out;
    std::array<Dual3<12>, 4> p;
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t k = 0; k < 3; ++k)
            p[v][k] = Dual<12>::variable(x[v][static_cast<int>(k)], 3 * v + k);
    const glm::dvec3 e = x[1] - x[0];
    const double edge = glm::length(e);
    const auto height = [&](const glm::dvec3& wing) {
        return edge > 0 ? glm::length(glm::cross(wing - x[0], e)) / edge : 0;
    };
    const double thin = std::min(height(x[2]), height(x[3]));
    const double size = std::max({edge, glm::length(x[2] - x[0]), glm::length(x[3] - x[0])});
    out.shaped = thin > 1e-5 * size;
    if (!out.shaped)
        return out;
    const Dual3<12> n1 = unit(cross(p[1] - p[0], p[2] - p[0])), n2 = unit(cross(p[3] - p[0], p[1] - p[0]));
    const Dual<12> angle = atan2(dot(cross(n1, n2), unit(p[1] - p[0])), dot(n1, n2));
    out.angle = angle.value;
    out.shape = (size / thin) * std::max(1.0, size / edge);
    for (std::size_t v = 0; v < 4; ++v)
        out.gradient[v] = {angle.slope[3 * v], angle.slope[3 * v + 1], angle.slope[3 * v + 2]};
    out.steep = (glm::length(out.gradient[2]) + glm::length(out.gradient[3])) * std::max(1.0, size / edge);
    return out;
}

template <typename Real>
HingeTerms hinge_terms(const Net<Real>& net, const layout::BendingConstraint<Real>& c)
{
    HingeTerms out = hinge_terms({glm::dvec3(0), net.between(c.edge0, c.edge1), net.between(c.edge0, c.wing0),
                                  net.between(c.edge0, c.wing1)});
    for (const std::uint32_t v : {c.edge1, c.wing0, c.wing1})
        out.shape *= net.reach(c.edge0, v);
    return out;
}

template <typename Real>
std::vector<std::uint32_t> make_table(Net<Real>& net, const std::vector<std::uint32_t>& corners,
                                      std::uint32_t arity, std::set<Place>& met, bool own)
{
    std::vector<std::vector<std::uint32_t>> at(net.count);
    std::set<std::uint32_t> counted;
    const auto place_of = [&](std::uint32_t row, std::uint32_t column) {
        if (!net.solved(column) || (net.diagonal_only && row != column))
            return kNowhere;
        const auto number = static_cast<std::uint32_t>(net.blocks.size());
        const auto [found, is_new] = net.blocks.try_emplace({row, column}, number / 32 * 288 + number % 32);
        return found->second | (met.insert({row, column}).second ? kFirst : 0u);
    };
    for (std::uint32_t v = 0; v < net.count; ++v)
        if (net.solved(v))
        {
            met.insert({v, v});
            place_of(v, v);
        }
    for (std::uint32_t k = 0; k < corners.size() / arity; ++k)
        for (std::uint32_t c = 0; c < arity; ++c)
        {
            const std::uint32_t v = corners[k * arity + c];
            if (!net.solved(v))
                continue;
            at[v].push_back((arity * k + c) | (counted.insert(k).second ? kFirst : 0u));
            for (std::uint32_t other = 0; other < arity; ++other)
                if (own || other != c)
                    at[v].push_back(place_of(v, corners[k * arity + other]));
        }
    std::vector<std::uint32_t> table;
    auto begin = 2 * (net.count + 1);
    for (std::uint32_t v = 0; v < net.count; ++v)
    {
        table.push_back(begin);
        table.push_back(net.solved(v) ? net.blocks.at({v, v}) : kNowhere);
        begin += static_cast<std::uint32_t>(at[v].size());
    }
    table.insert(table.end(), {begin, kNowhere});
    for (const auto& words : at)
        table.insert(table.end(), words.begin(), words.end());
    return table;
}

template <typename Real>
void make_tables(Net<Real>& net)
{
    std::vector<std::uint32_t> ends, corners;
    for (const auto& s : net.springs)
        ends.insert(ends.end(), {s.a, s.b});
    for (const auto& c : net.hinges)
        corners.insert(corners.end(), {c.edge0, c.edge1, c.wing0, c.wing1});
    std::set<std::uint32_t> used(ends.begin(), ends.end());
    used.insert(corners.begin(), corners.end());
    net.held.clear();
    for (std::uint32_t v = 0; v < net.count; ++v)
        net.held.insert(net.held.end(), 3, net.position[v].w > 0 && used.count(v) > 0 ? 0u : 1u);
    net.blocks.clear();
    std::set<Place> met;
    net.spring_table = make_table(net, ends, 2, met, false);
    net.hinge_table = make_table(net, corners, 4, met, true);
}

template <typename Real>
Net<Real> random_net(std::uint32_t count, std::uint64_t seed)
{
    Random random(seed);
    Net<Real> net;
    net.count = count;
    net.position = random.vec4s<Real>(count, 1, 0, 0);
    for (auto& x : net.position)
        x.w = random.inverse_mass<Real>();
    net.low = random.vec4s<Real>(count, 1e-7, 0, 1e-3);
    net.delta = random.vec4s<Real>(count, 1e-2, 0, 1e-3);
    net.predicted = random.vec4s<Real>(count, 1e-2, 0, 1e-3);
    net.step.substep = Real(0.01);
    const auto pick = [&] {
        std::array<std::uint32_t, 4> v{};
        for (std::size_t k = 0; k < 4;)
        {
            v[k] = random.below(count);
            k += std::count(v.begin(), v.begin() + static_cast<long>(k), v[k]) == 0 ? 1 : 0;
        }
        return v;
    };
    for (std::uint32_t k = 0; count >= 4 && k < 3 * count; ++k)
    {
        const auto v = pick();
        const Real rest = k % 7 == 6 ? Real(0) : random.uniform<Real>(0.1, 2);
        const Real damping = k % 3 == 0 ? random.uniform<Real>(0, 5) : Real(0);
        net.springs.push_back({v[0], v[1], rest, random.uniform<Real>(0, 1000), damping, k % 4});
        if (k % 5 == 0)
            net.springs.push_back(net.springs.back()); // twice between the same two
    }
    for (std::uint32_t k = 0; count >= 4 && k < count; ++k)
    {
        const auto v = pick();
        net.hinges.push_back({v[0], v[1], v[2], v[3], random.uniform<Real>(-1, 1), Real(0.25)});
    }
    if (count >= 60)
    {
        // A place for all of one spring of each kind, and a hinge without an edge.
        for (const std::uint32_t k : {0u, 6u, 8u})
        {
            const auto& s = net.springs[k];
            net.position[s.b] = {glm::vec<3, Real>(net.position[s.a]), net.position[s.b].w};
            net.delta[s.b] = {glm::vec<3, Real>(net.delta[s.a]), net.delta[s.b].w};
        }
        const auto& c = net.hinges[1];
        net.position[c.edge1] = {glm::vec<3, Real>(net.position[c.edge0]), net.position[c.edge1].w};
        net.delta[c.edge1] = {glm::vec<3, Real>(net.delta[c.edge0]), net.delta[c.edge1].w};
    }
    make_tables(net);
    return net;
}

template <typename Real>
SpringTerms spring_terms(const Net<Real>& net, const layout::Spring<Real>& s, bool damped)
{
    SpringTerms out;
    const glm::dvec3 d = net.between(s.b, s.a);
    const double l = glm::length(d), rest = double(s.rest_length), k = double(s.stiffness), h = net.h();
    const double c = damped ? double(s.damping) : 0;
    out.degenerate = l == 0 && rest > 0;
    if (l == 0)
    {
        if (rest == 0)
            out.block.add(glm::dmat3(h * h * k), h * h * k);
        return out;
    }
    const glm::dvec3 n = d / l;
    const auto moved = [&](std::uint32_t v) {
        return Net<Real>::wide(net.delta[v]) - Net<Real>::wide(net.low[v]);
    };
    const glm::dvec3 speed = (moved(s.a) - moved(s.b)) / h;
    const double reach = net.reach(s.b, s.a), closing = c * glm::dot(n, speed);
    out.force.add(-(k * (l - rest) + closing) * n,
                  (k * (l + rest) + c * (glm::length(moved(s.a)) + glm::length(moved(s.b))) / h) * reach);
    const glm::dmat3 nn = glm::outerProduct(n, n);
    out.block.add(h * h * k * (nn + std::max(0.0, 1 - rest / l) * (glm::dmat3(1) - nn)) +
                      h * double(s.damping) * nn,
                  (h * h * k * (1 + rest / l) + h * double(s.damping)) * reach);
    return out;
}

template <typename Real>
std::map<Place, SizedBlock> spring_system(const Net<Real>& net, std::uint32_t& degenerate)
{
    std::map<Place, SizedBlock> out;
    for (std::uint32_t v = 0; v < net.count; ++v)
        if (net.solved(v))
            out[{v, v}].add(glm::dmat3(net.mass(v)), net.mass(v));
    for (const auto& s : net.springs)
    {
        const SpringTerms t = spring_terms(net, s);
        degenerate += t.degenerate && (net.solved(s.a) || net.solved(s.b)) ? 1 : 0;
        for (const std::uint32_t row : {s.a, s.b})
            for (const std::uint32_t column : {s.a, s.b})
                if (net.solved(row) && net.solved(column) && (row == column || !net.diagonal_only))
                    out[{row, column}].add(row == column ? t.block.value : -t.block.value, t.block.size);
    }
    return out;
}

template <typename Real>
std::map<Place, SizedBlock> hinge_system(const Net<Real>& net, std::uint32_t& degenerate)
{
    std::map<Place, SizedBlock> out;
    for (const auto& c : net.hinges)
    {
        const HingeTerms t = hinge_terms(net, c);
        const auto v = corners_of(c);
        const bool acts = std::any_of(v.begin(), v.end(), [&](std::uint32_t i) { return net.solved(i); });
        degenerate += !t.shaped && acts ? 1 : 0;
        const double factor = net.h() * net.h() / double(c.compliance);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                if (net.solved(v[i]) && net.solved(v[j]) && (v[i] == v[j] || !net.diagonal_only))
                    out[{v[i], v[j]}].add(factor * glm::outerProduct(t.gradient[i], t.gradient[j]),
                                          factor * t.shape * t.steep * t.steep);
    }
    return out;
}

template <typename Real>
std::vector<Sized> product_of(const Net<Real>& net, const std::map<Place, SizedBlock>& blocks,
                              const std::vector<Real>& x)
{
    std::vector<Sized> y(net.count);
    for (const auto& [place, block] : blocks)
    {
        const auto* at = &x[3 * place.second];
        const glm::dvec3 v(at[0], at[1], at[2]);
        y[place.first].add(block.value * v, block.size * glm::length(v));
    }
    return y;
}

#define TAUT_NET_OF(Real)                                                                                    \
    template std::vector<std::uint32_t> make_table(Net<Real>&, const std::vector<std::uint32_t>&,            \
                                                   std::uint32_t, std::set<Place>&, bool);                   \
    template Net<Real> random_net(std::uint32_t, std::uint64_t);                                             \
    template void make_tables(Net<Real>&);                                                                   \
    template SpringTerms spring_terms(const Net<Real>&, const layout::Spring<Real>&, bool);                  \
    template HingeTerms hinge_terms(const Net<Real>&, const layout::BendingConstraint<Real>&);               \
    template std::map<Place, SizedBlock> spring_system(const Net<Real>&, std::uint32_t&);                    \
    template std::map<Place, SizedBlock> hinge_system(const Net<Real>&, std::uint32_t&);                     \
    template std::vector<Sized> product_of(const Net<Real>&, const std::map<Place, SizedBlock>&,             \
                                           const std::vector<Real>&);
TAUT_NET_OF(float)
TAUT_NET_OF(double)

} // namespace taut::conformance
