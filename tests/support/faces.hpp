#pragma once
// What the tests of triangles against colliders share: random triangles, and in fp64 from the written rules
// where a point of one is pushed, corner by corner.

#include "support/turned.hpp"

#include "taut/kernels/shared/face_state.h"

#include <array>
#include <optional>

namespace taut::conformance {

/// Input of a face kernel, apart from the colliders.
template <typename Real>
struct Faces
{
    std::vector<glm::vec<4, Real>> position, delta, slot; ///< slot: so many a triangle, and some more
    std::vector<std::uint32_t> corner, which, state;
    layout::StepValues<Real> step{};
    std::uint32_t count = 0, colliders = 0, listed = 1, substep = 0, substeps = 1;
    std::uint32_t look = 1, first = 1, again = 0;

    std::uint32_t slots() const { return 3 + listed; } ///< a triangle
    /// Whether a triangle meets the collider in that place of the list.
    bool meets(std::uint32_t t, std::uint32_t k) const
    {
        return (which[listed + corner[4 * t + 3] + k / 32] >> (k % 32) & 1) != 0;
    }
    template <typename Params>
    Params params() const
    {
        return {count, colliders, listed, substep, substeps, look, first, again};
    }
    /// In the first sweep of a time step, of a substep, of a later iteration, and in a later sweep.
    void set_sweep(std::uint32_t kind)
    {
        look = kind == 0;
        first = kind < 2;
        again = kind == 3;
    }
};

/// A triangle in the frame of a collider, and what was pushed so far.
struct RefFace
{
    std::array<glm::dvec3, 3> p, e; ///< m, at the start and the end of the substep
    std::array<double, 3> w;
    glm::dvec3 share{0};
    glm::dvec4 taken{0}; ///< impulses of friction in the substep so far, w = sum of mu times pushes, kg m
    double gap_kept = 0, depenetration = 0, friction = 0;
    double size = 0;    ///< of the numbers that were rounded, times what angles make of it, m
    double impulse = 0; ///< of those in `taken`, kg m
    bool open = false;  ///< a rounding could decide otherwise

    glm::dvec3 at_start(const glm::dvec3& b) const { return p[0] * b.x + p[1] * b.y + p[2] * b.z; }
    glm::dvec3 at_end(const glm::dvec3& b) const { return e[0] * b.x + e[1] * b.y + e[2] * b.z; }
    void doubt(double margin) { open = open || std::abs(margin) < 2e-4; }
};

/// The point b, `gap` above the surface, goes out along the normal to where it may, and is held by friction.
inline void ref_press(RefFace& f, const glm::dvec3& normal, double before, double gap, const glm::dvec3& b)
{
    const double back = std::max(f.depenetration, before - gap);
    const double push = std::min(0.0, before + back) - gap;
    f.doubt(push);
    double weight = 0, most = 0;
    for (int k = 0; k < 3; ++k)
    {
        weight += f.w[static_cast<std::size_t>(k)] * b[k] * b[k];
        most = std::max(most, f.w[static_cast<std::size_t>(k)] * b[k]);
    }
    weight = std::max(weight, most / 2);
    if (!(push > 0) || !(weight > 0))
        return;
    const glm::dvec3 travel = f.at_end(b) - f.at_start(b);
    const glm::dvec3 stop = (travel - normal * glm::dot(normal, travel)) / weight + glm::dvec3(f.taken);
    const double length = glm::length(stop), limit = f.taken.w + f.friction * push / weight;
    const glm::dvec3 held = length > limit ? stop * (limit / length) : stop;
    const glm::dvec3 impulse = normal * (push / weight) - (held - glm::dvec3(f.taken));
    for (int k = 0; k < 3; ++k)
        f.e[static_cast<std::size_t>(k)] += impulse * (f.w[static_cast<std::size_t>(k)] * b[k]);
    f.size += (glm::length(travel) + push) * most / weight + (length + glm::length(f.taken)) * most;
    f.impulse += f.size / weight + length + glm::length(f.taken);
    f.taken = glm::dvec4(held, limit);
    f.share += b;
}

/// The nearest point of a triangle to the origin.
struct Nearest
{
    glm::dvec3 b{0};
    bool inside = false; ///< not on a border
    double margin = 0;   ///< from being told otherwise, of 1
};

inline Nearest nearest_on(const std::array<glm::dvec3, 3>& t)
{
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double determinant = uu * vv - uv * uv, ru = -glm::dot(u, t[0]), rv = -glm::dot(v, t[0]);
    const double s = (ru * vv - rv * uv) / determinant, r = (rv * uu - ru * uv) / determinant;
    Nearest out{{1 - s - r, s, r},
                s > 0 && r > 0 && s + r < 1,
                std::min({std::abs(s), std::abs(r), std::abs(1 - s - r)})};
    if (out.inside)
        return out;
    double least = 1e300;
    for (int k = 0; k < 3; ++k)
    {
        const glm::dvec3 from = t[static_cast<std::size_t>(k)],
                         side = t[static_cast<std::size_t>((k + 1) % 3)] - from;
        const double share = std::clamp(-glm::dot(from, side) / glm::dot(side, side), 0.0, 1.0);
        const double distance = glm::length(from + side * share);
        if (distance < least)
        {
            least = distance;
            out.b = glm::dvec3(0);
            out.b[k] = 1 - share;
            out.b[(k + 1) % 3] = share;
        }
    }
    return out;
}

inline glm::dvec3 normal_of(const std::array<glm::dvec3, 3>& t)
{
    return glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
}

/// Whether a held corner is where `height` is below 0; then nothing is pushed.
template <typename Height>
bool ref_stuck(RefFace& f, const Height& height)
{
    bool stuck = false;
    for (std::size_t k = 0; k < 3; ++k)
        if (f.w[k] == 0)
        {
            f.doubt(height(f.e[k]));
            stuck = stuck || height(f.e[k]) < 0;
        }
    return stuck;
}

/// What a small area makes of a rounding in a normal.
inline double turn_of(const std::array<glm::dvec3, 3>& t)
{
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
    const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(u - v, u - v)});
    return longest / glm::length(glm::cross(u, v));
}

/// A ball of radius r about o, which may have gone through.
inline void ref_ball(RefFace& f, const glm::dvec3& o, double r)
{
    const std::array<glm::dvec3, 3> before{f.p[0] - o, f.p[1] - o, f.p[2] - o};
    const std::array<glm::dvec3, 3> after{f.e[0] - o, f.e[1] - o, f.e[2] - o};
    const double height_before = glm::dot(normal_of(before), before[0]);
    const double height_after = glm::dot(normal_of(after), after[0]);
    Nearest near = nearest_on(after);
    glm::dvec3 normal = glm::normalize(f.at_end(near.b) - o);
    f.doubt(glm::length(f.at_end(near.b) - o)); // no direction
    if (height_before * height_after < 0)
    {
        const double t = height_before / (height_before - height_after);
        std::array<glm::dvec3, 3> met{};
        for (std::size_t k = 0; k < 3; ++k)
            met[k] = before[k] + (after[k] - before[k]) * t;
        const Nearest through = nearest_on(met);
        f.doubt(through.margin);
        if (through.inside)
        {
            near = through;
            normal = normal_of(after) * (height_before < 0 ? -1.0 : 1.0);
        }
    }
    f.doubt(height_before);
    f.doubt(height_after);
    const double height = glm::dot(normal, f.at_end(near.b) - o) - r;
    f.doubt(height);
    f.size *= 1 + turn_of(after);
    if (height < 0)
        ref_press(f, normal, glm::length(f.at_start(near.b) - o) - r, height, near.b);
}

/// Random triangles in a cube, each of three corners near each other, which share no vertices in any order.
template <typename Real>
Faces<Real> random_faces(Random& random, std::uint32_t count, std::uint32_t colliders, double size,
                         double edge, double speed)
{
    Faces<Real> in;
    in.count = count;
    in.colliders = colliders;
    in.listed = colliders > 1 ? colliders - 1 : 1;
    const std::uint32_t words = (in.listed + 31) / 32;
    const auto put = [&](const glm::dvec3& x) {
        in.position.emplace_back(glm::vec<3, Real>(x), random.inverse_mass<Real>());
    };
    for (std::uint32_t t = 0; t < count; ++t)
    {
        const glm::dvec3 middle(random.vec4<double>(size, 0)), way(random.vec4<double>(speed, 0));
        const double kept = random.uniform(0, 0.02);
        for (int k = 0; k < 3; ++k)
        {
            put(middle + glm::dvec3(random.vec4<double>(edge, 0)));
            in.delta.emplace_back(glm::vec<3, Real>(way + glm::dvec3(random.vec4<double>(0.2 * speed, 0))),
                                  static_cast<Real>(kept));
            in.corner.push_back(3 * t + static_cast<std::uint32_t>(k));
        }
        in.corner.push_back(words * (t % 11 == 7 ? 2 : t % 3 == 2 ? 1 : 0));
        in.state.push_back(random.below(4));
    }
    for (std::uint32_t j = 0; j < colliders; ++j)
        if (j != 1) // one that triangles do not meet
            in.which.push_back(j);
    in.which.resize(in.listed + 3 * words,
                    0); // most meet all that are listed, some the last alone, some none
    for (std::uint32_t k = 0; k < in.listed; ++k)
        in.which[in.listed + k / 32] |= 1u << (k % 32);
    in.which[in.listed + words + (in.listed - 1) / 32] |= 1u << ((in.listed - 1) % 32);
    in.slot = random.vec4s<Real>(in.slots() * std::size_t(count) + 4, 0.01, 0, 0.05);
    in.step.depenetration = Real(0.05);
    in.step.substep = Real(0.01);
    in.step.gravity_y = Real(-9.81);
    return in;
}

template <typename Real>
std::array<glm::dvec3, 3> corners_of(const Faces<Real>& in, const std::vector<glm::vec<4, Real>>& of,
                                     std::uint32_t t)
{
    return {glm::dvec3(of[in.corner[4 * t]]), glm::dvec3(of[in.corner[4 * t + 1]]),
            glm::dvec3(of[in.corner[4 * t + 2]])};
}

/// Whether a triangle is looked at: in the first sweep of a time step all, in the first of a substep those
/// that may come near in the time step, and later those that the first has pushed.
template <typename Real>
bool is_asked(const Faces<Real>& in, std::uint32_t t)
{
    const std::uint32_t told = in.state[t];
    if (in.again != 0)
        return told == TAUT_FACE_PUSHED || told == TAUT_FACE_FREE;
    return in.look != 0 || told != TAUT_FACE_FAR;
}

template <typename Real, typename Record>
Buffers inputs_of(const Faces<Real>& in, const std::vector<Record>& records)
{
    return {{"corner", bytes_of(in.corner)}, {"position", bytes_of(in.position)},
            {"delta", bytes_of(in.delta)},   {"collider", bytes_of(records)},
            {"which", bytes_of(in.which)},   {"step_values", bytes_of(std::vector{in.step})},
            {"slot", bytes_of(in.slot)},     {"state", bytes_of(in.state)}};
}

/// What a triangle's slots must be: `face(triangle, places, ways so far, collider's number)` of each listed
/// collider in turn adds to the ways and to `share`.
template <typename Real, typename FaceOf>
RefFace expect_slots(Field& slot, const Faces<Real>& in, std::uint32_t t, FaceOf face)
{
    const auto guess = corners_of(in, in.delta, t);
    auto d = guess;
    RefFace f;
    for (std::size_t k = 0; k < 3; ++k)
        f.w[k] = static_cast<double>(in.position[in.corner[4 * t + k]].w);
    f.gap_kept = static_cast<double>(in.delta[in.corner[4 * t]].w);
    f.depenetration = static_cast<double>(in.step.depenetration);
    const auto* was = &in.slot[in.slots() * t];
    std::vector<glm::dvec4> taken(was + 3, was + in.slots());
    for (std::uint32_t k = 0; k < in.listed && is_asked(in, t); ++k)
        if (in.meets(t, k))
        {
            f.taken = in.first != 0 ? glm::dvec4(0) : taken[k];
            face(f, corners_of(in, in.position, t), d, in.which[k]);
            taken[k] = f.taken;
        }
    const bool moved = f.share != glm::dvec3(0);
    const auto add = [&](double value, double scale) { slot.add(value, f.open ? kAnyFinite : scale); };
    for (std::size_t k = 0; k < 3; ++k)
    {
        for (int axis = 0; axis < 3; ++axis)
            add(moved ? (d[k] - guess[k])[axis] : static_cast<double>(was[k][axis]), moved ? f.size : 0);
        add(moved ? f.share[static_cast<int>(k)] : static_cast<double>(was[k].w), moved ? f.size : 0);
    }
    const bool open = in.look != 0 && !moved; // it may be far, and not be looked at
    for (const glm::dvec4& held : taken)
        for (int axis = 0; axis < 4; ++axis)
            add(held[axis], open ? kAnyFinite : is_asked(in, t) ? f.impulse + glm::length(held) : 0);
    return f;
}

/// What is said of a triangle. Nothing where that is open, and where it is asked whether it comes near at
/// all: then only the pushed ones are sure to.
template <typename Real>
std::optional<std::uint32_t> expected_state(const Faces<Real>& in, std::uint32_t t, const RefFace& f)
{
    const bool pushed = f.share != glm::dvec3(0);
    if (!is_asked(in, t))
        return in.state[t];
    if (f.open || (in.look != 0 && !pushed))
        return std::nullopt;
    return pushed ? TAUT_FACE_PUSHED : in.again != 0 ? TAUT_FACE_FREE : TAUT_FACE_NEAR;
}

/// How many triangles are said to be something else.
inline std::size_t wrong_states(const std::vector<std::optional<std::uint32_t>>& expected, const Buffers& out)
{
    const auto told = values_of<std::uint32_t>(out.at("state"));
    std::size_t wrong = 0;
    for (std::size_t t = 0; t < told.size(); ++t)
        wrong += expected[t] && *expected[t] != told[t];
    return wrong;
}

/// Checks the kernel on every executor.
template <typename Real, typename Record, typename FaceOf>
void check_faces(const Faces<Real>& in, const KernelInfo& kernel, Bytes params,
                 const std::vector<Record>& records, FaceOf face)
{
    Case c;
    c.precision = precision_of<Real>();
    c.in = inputs_of(in, records);
    c.launches = {{&kernel, std::move(params), in.count}};
    Field& slot = c.expected["slot"];
    std::vector<std::optional<std::uint32_t>> states;
    std::uint32_t open = 0, pushed = 0;
    for (std::uint32_t t = 0; t < in.count; ++t)
    {
        const RefFace f = expect_slots(slot, in, t, face);
        states.push_back(expected_state(in, t, f));
        open += f.open;
        pushed += f.share != glm::dvec3(0);
    }
    for (std::size_t n = in.slots() * std::size_t(in.count); n < in.slot.size(); ++n)
        for (int axis = 0; axis < 4; ++axis)
            slot.add(static_cast<double>(in.slot[n][axis]), 0);
    CAPTURE(open, pushed);
    CHECK(open * 10 <= in.count + 9); // else the reference would say nothing
    if (in.count > 100 && in.look != 0)
        CHECK(pushed >= 5);
    look_on_every_device(c, [&](const Buffers& out) { CHECK(wrong_states(states, out) == 0); });
}

/// The same of a shape that turns: `shape(face, record)` in its frame.
template <typename Real, typename Record, typename Shape>
void check_turned_faces(const Faces<Real>& in, const KernelInfo& kernel, Bytes params,
                        const std::vector<Record>& poses, Shape shape)
{
    check_faces(
        in, kernel, std::move(params), poses,
        [&](RefFace& f, const std::array<glm::dvec3, 3>& x, std::array<glm::dvec3, 3>& d, std::uint32_t j) {
            const Record& record = poses[(in.substep + 1) * in.colliders + j];
            const Frame start = frame_of(poses[in.substep * in.colliders + j]), end = frame_of(record);
            double size = glm::length(start.centre) + glm::length(end.centre);
            for (std::size_t k = 0; k < 3; ++k)
            {
                f.p[k] = start.inside(x[k]);
                f.e[k] = end.inside(x[k] + d[k]);
                size += 2 * glm::length(x[k]) + glm::length(d[k]);
            }
            const auto before = f.e;
            const glm::dvec3 taken(f.taken);
            f.taken =
                glm::dvec4(glm::dot(taken, end.x), glm::dot(taken, end.y), glm::dot(taken, end.z), f.taken.w);
            f.size += size;
            f.friction = static_cast<double>(record.friction);
            shape(f, record);
            for (std::size_t k = 0; k < 3; ++k)
                d[k] += end.turned(f.e[k] - before[k]);
            f.taken = glm::dvec4(end.turned(glm::dvec3(f.taken)), f.taken.w);
        });
}

} // namespace taut::conformance
