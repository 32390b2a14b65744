#pragma once
// What the tests of colliders that turn share: frames by plain formulas, and the way of a point in them.

#include "support/contacts.hpp"

#include <glm/trigonometric.hpp>

#include <cmath>

namespace taut::conformance {

struct Frame
{
    glm::dvec3 centre{0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    glm::dvec3 inside(const glm::dvec3& p) const
    {
        const glm::dvec3 d = p - centre;
        return {glm::dot(d, x), glm::dot(d, y), glm::dot(d, z)};
    }
    glm::dvec3 turned(const glm::dvec3& own) const { return own.x * x + own.y * y + own.z * z; }
};

/// Turned by `angle` about a unit axis.
inline Frame make_frame(const glm::dvec3& centre, const glm::dvec3& axis, double angle)
{
    const auto turn = [&](const glm::dvec3& v) {
        return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
               axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
    };
    return {centre, turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

/// A collider that goes and turns steadily, seen at the ends of substeps.
struct Drift
{
    glm::dvec3 centre{0}, way{0}, axis{0, 1, 0}; ///< m; m a substep; of length 1
    double turn = 0;                             ///< rad a substep

    Frame at(std::uint32_t substep) const
    {
        return make_frame(centre + way * double(substep), axis, 1 + turn * substep);
    }
};

inline Drift random_drift(Random& random)
{
    Drift out;
    out.centre = glm::dvec3(random.vec4<double>(1, 0));
    out.way = glm::dvec3(random.vec4<double>(0.1, 0));
    out.axis = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
    out.turn = random.uniform(0, 0.2);
    return out;
}

template <typename Real, template <typename> typename Record>
void put_frame(Record<Real>& c, const Frame& f)
{
    const auto r = [](double v) { return static_cast<Real>(v); };
    c.centre_x = r(f.centre.x), c.centre_y = r(f.centre.y), c.centre_z = r(f.centre.z);
    c.x_x = r(f.x.x), c.x_y = r(f.x.y), c.x_z = r(f.x.z);
    c.y_x = r(f.y.x), c.y_y = r(f.y.y), c.y_z = r(f.y.z);
    c.z_x = r(f.z.x), c.z_y = r(f.z.y), c.z_z = r(f.z.z);
}

/// As the kernel gets it: rounded.
template <typename Record>
Frame frame_of(const Record& c)
{
    return {{c.centre_x, c.centre_y, c.centre_z},
            {c.x_x, c.x_y, c.x_z},
            {c.y_x, c.y_y, c.y_z},
            {c.z_x, c.z_y, c.z_z}};
}

/// A vertex in the frame of a collider during a substep.
struct Way
{
    glm::dvec3 a{0}, e{0}; ///< own coordinates at the start and the end
    Frame end;
    double terms = 0; ///< size of what made them

    double length() const { return glm::length(e - a); }
    glm::dvec3 at(double t) const { return a + (e - a) * t; }
};

template <typename Real, typename Record>
Way way_of(const std::vector<Record>& poses, const Contacts<Real>& in, std::uint32_t j, const glm::dvec3& x,
           const glm::dvec3& d)
{
    const Frame start = frame_of(poses[in.substep * in.colliders + j]);
    Way way;
    way.end = frame_of(poses[(in.substep + 1) * in.colliders + j]);
    way.a = start.inside(x);
    way.e = way.end.inside(x + d);
    way.terms = 2 * glm::length(x) + glm::length(d) + glm::length(start.centre) +
                glm::length(way.end.centre);
    return way;
}

/// What friction sees: the collider's point under the vertex went along, so what is left is the own way.
inline void add_slide(Touch& t, const Way& way, const glm::dvec3& d)
{
    t.shift = d - way.end.turned(way.e - way.a);
}

/// First time in [0, 1] at which a convex `outside(t)` is 0, from where it is positive; 2 = never. `least`
/// becomes its least value.
template <typename Outside>
double time_of_entry(const Outside& outside, double& least)
{
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) // thirds: convex, so the least value lies in what is kept
    {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (outside(a) <= outside(b) ? high : low) = outside(a) <= outside(b) ? b : a;
    }
    least = outside(low);
    if (!(least < 0))
        return 2;
    double before = 0, after = low;
    for (int i = 0; i < 200; ++i)
    {
        const double middle = (before + after) / 2;
        (outside(middle) > 0 ? before : after) = middle;
    }
    return before;
}

} // namespace taut::conformance
