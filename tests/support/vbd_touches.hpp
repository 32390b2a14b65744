#pragma once
// What the tests of vbd_touch share: what is in the way of a vertex, in fp64 from the written rules.

#include "support/contacts.hpp"

#include "taut/kernels/vbd_touch_plane.hpp"

#include <optional>

namespace taut::conformance {

/// Kernels of all shapes have one interface.
using TouchParams = kernels::vbd_touch_plane::Params;

inline constexpr double kNothingNear = 1e30;

/// Where a launch stands: no shape came before; the surfaces lie behind 3 a vertex that it leaves alone,
/// instead of behind the guesses, which it writes.
struct TouchLaunch
{
    bool first = true, apart = false;

    std::uint32_t surfaces(std::uint32_t count) const { return apart ? 3 * count : count; }
};

/// Of one vertex. Sizes are those of the numbers that were rounded.
struct InTheWay
{
    double height = kNothingNear, height_size = 0;
    std::optional<Touch> nearest; ///< none: what was there before stays
    bool hits = false;            ///< the guess goes below any surface of this launch
    bool near = false;            ///< or comes near one
    bool open = false;            ///< a rounding could decide otherwise
};

/// `height`: of what came before. Surfaces that the guess stays outside of are moved out by twice its way as
/// seen from them, and count where it comes nearer; the height that counts is that of the guess over the
/// surface, or, from below, over where the vertex was. The least one wins, the first of equal ones.
template <typename Real, typename TouchOf>
InTheWay in_the_way(const Contacts<Real>& in, std::uint32_t i, double height, TouchOf touch)
{
    constexpr double kDoubt = 1024 * std::numeric_limits<Real>::epsilon();
    const glm::dvec3 x(in.position[i]), d(in.delta[i]);
    const double kept = static_cast<double>(in.delta[i].w);
    InTheWay out;
    out.height = height;
    for (std::uint32_t j = 0; j < in.colliders; ++j)
    {
        Touch t = touch(x, d, kept, j);
        const auto doubtful = [&] { // a shape that nothing came to says 0 of both
            const bool away = t.gap == 0 && t.gap_before == 0;
            return t.size == kAnyFinite || (!away && std::abs(t.gap) < kDoubt * t.size);
        };
        out.open = out.open || doubtful();
        const bool hit = t.gap < 0;
        out.hits = out.hits || hit;
        const double margin = hit ? 0 : 2 * glm::length(d - t.shift);
        if (margin > 0)
        {
            t = touch(x, d, kept + margin, j);
            t.size += margin;
            out.open = out.open || doubtful();
        }
        if (!(t.gap < 0))
            continue;
        const double over = t.gap + margin - std::min(0.0, t.gap_before + margin);
        const bool counts = over < out.height + kDoubt * (t.size + out.height_size);
        out.open = out.open || (counts && !hit && std::abs(t.gap - t.gap_before) < kDoubt * t.size);
        if (!hit && !(t.gap < t.gap_before))
            continue;
        out.near = true;
        out.open = out.open || std::abs(over - out.height) < kDoubt * (t.size + out.height_size);
        if (!(over < out.height))
            continue;
        out.height = over;
        out.height_size = t.size;
        out.nearest = t;
    }
    return out;
}

/// Vertices in a cube of half width `size`, and guesses over three decades of lengths, up to some 2 m, or of
/// none at all.
template <typename Real>
Contacts<Real> random_guesses(Random& random, std::uint32_t count, std::uint32_t colliders, double size)
{
    auto in = random_contacts<Real>(random, count, colliders, size, 1.2);
    for (auto& d : in.delta)
    {
        const double shorter = random.chance(0.1) ? 0 : std::pow(10, random.uniform(-3, 0));
        d = {glm::vec<3, Real>(d) * static_cast<Real>(shorter), d.w};
    }
    in.step.inverse_substep = Real(240);
    in.substeps = 4;
    in.substep = count % 4;
    return in;
}

/// Guesses, and surfaces of shapes that came before: of some vertices none.
template <typename Real>
std::vector<glm::vec<4, Real>> surfaces_before(Random& random, std::uint32_t count, std::uint32_t surfaces)
{
    auto contacts = random.vec4s<Real>(surfaces + 3 * count + 7, 0.3, -0.3, 0.3);
    for (std::uint32_t i = 0; i < count; ++i)
        if (random.chance(0.5))
        {
            const std::size_t at = surfaces + 3 * std::size_t{i};
            contacts[at] = contacts[at + 1] = glm::vec<4, Real>(Real(0));
            contacts[at + 2].x = static_cast<Real>(kNothingNear);
        }
    return contacts;
}

/// Runs `touch(vertex position, displacement, gap kept, collider index)` of every vertex and collider and
/// checks the kernel on every executor. `colliders`: their buffers. Vertices of which a rounding could decide
/// otherwise become held: such are written, but not counted.
template <typename Real, typename TouchOf>
void check_touches(Contacts<Real> in, Random& random, const TouchLaunch& launch, const KernelInfo& kernel,
                   const Buffers& colliders, TouchOf touch)
{
    const std::uint32_t n = in.count, surfaces = launch.surfaces(n);
    const auto contacts = surfaces_before<Real>(random, n, surfaces);
    std::vector<std::uint32_t> support, touched{5, 0, 7};
    for (std::size_t i = 0; i < in.position.size(); ++i)
        support.push_back(random.below(6));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"touched", bytes_of(touched)}};
    Field& field = c.expected["contacts"];
    for (const auto& v : contacts)
        for (int k = 0; k < 4; ++k)
            field.add(static_cast<double>(v[k]), 0);
    const auto set = [&](std::size_t at, int k, double value, double size) {
        field.value[4 * at + static_cast<std::size_t>(k)] = value;
        field.scale[4 * at + static_cast<std::size_t>(k)] = size;
    };
    std::uint32_t open = 0, near = 0;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const std::size_t at = surfaces + 3 * std::size_t{i};
        const double before = static_cast<double>(launch.first ? Real(kNothingNear) : contacts[at + 2].x);
        InTheWay way = in_the_way(in, i, before, touch);
        near += way.near ? 1 : 0;
        if (support[i] % 2 == 1) // of a body with something held
        {
            way.nearest.reset();
            way.height = before;
            way.height_size = 0;
        }
        open += way.open ? 1 : 0;
        if (way.open)
            in.position[i].w = 0;
        const auto w = static_cast<double>(in.position[i].w), rate = double(in.step.inverse_substep);
        touched[support[i] / 2] += way.hits && w > 0 ? 1 : 0;
        const glm::dvec3 d(in.delta[i]);
        for (int k = 0; k < 3 && launch.first && !launch.apart; ++k)
            set(i, k, d[k], 0);
        if (launch.first && !launch.apart)
            set(i, 3, w > 0 ? rate * rate / w : 0, w > 0 ? rate * rate / w : 0);
        for (int k = 0; k < 4; ++k)
        {
            set(at + 2, k, k == 0 ? way.height : 0, k == 0 ? way.height_size : 0);
            if (launch.first && !way.nearest)
                set(at, k, 0, 0), set(at + 1, k, 0, 0);
        }
        if (way.nearest)
        {
            const Touch& t = *way.nearest;
            const double length = glm::length(d), shift = glm::length(t.shift);
            for (int k = 0; k < 3; ++k)
            {
                set(at, k, t.normal[k], t.normal_size);
                set(at + 1, k, t.shift[k], t.size + 2 * length + shift);
            }
            set(at, 3, glm::dot(t.normal, d) - way.height, t.size + (1 + t.normal_size) * length);
            set(at + 1, 3, t.friction, 0);
        }
        for (std::size_t k = 0; k < 12 && way.open; ++k)
            field.scale[4 * at + k] = kAnyFinite;
    }
    c.in["position"] = bytes_of(in.position);
    c.in["delta"] = bytes_of(in.delta);
    c.in["step_values"] = bytes_of(std::vector{in.step});
    c.in["contacts"] = bytes_of(contacts);
    c.in["support"] = bytes_of(support);
    c.in.insert(colliders.begin(), colliders.end());
    c.launches = {make_launch(
        kernel,
        TouchParams{n, in.colliders, in.substep, in.substeps, launch.first, surfaces, launch.apart ? 0u : 1u},
        n)};
    CHECK(open * 20 <= n); // else the reference would say nothing
    CHECK((n < 60 || (near > n / 10 && near < n - n / 10)));
    look_on_every_device(
        c, [&](const Buffers& out) { CHECK(values_of<std::uint32_t>(out.at("touched")) == touched); });
}

} // namespace taut::conformance
