#pragma once
// Hard cases that several methods are put to in the same way.

#include "hard/cases.hpp"

namespace taut::hard {

/// C02: 10,000 springs of one hub, of 100 kg, along a screw; of their compliance, m/N.
inline Body star(double compliance)
{
    std::vector<glm::dvec3> places = {{0, 0, 0}};
    for (int k = 0; k < 10000; ++k)
        places.emplace_back(std::cos(k * 0.1), std::sin(k * 0.1), 1e-4 * k);
    Body out = particles(places, 1e-3);
    out.vertex_masses[0] = 100;
    for (std::uint32_t k = 1; k <= 10000; ++k)
        out.springs.push_back({0, k, 1, compliance});
    return out;
}

/// C03, C06: a vertex alone, two joined by two equal springs, and two joined by one as stiff as both; under
/// gravity.
inline Scene loner_and_twins(Scene settings)
{
    Body twins = particles({{0, 0, 0}, {1.5, 0, 0}}), one = twins;
    twins.springs = {{0, 1, 1, 1e-2}, {0, 1, 1, 1e-2}};
    one.springs = {{0, 1, 1, 0.5e-2}};
    settings.gravity = {0, -9.81, 0};
    settings.bodies = {particles({{0, 3, 0}}), twins, one};
    return settings;
}

/// After a second the loner has fallen, and the twins are one spring.
inline void check_loner_and_twins(const World& world)
{
    const auto x = world.positions();
    CHECK(3 - x[0].y == Approx(9.81 / 2).epsilon(1e-5));
    CHECK(glm::distance(x[1], x[2]) == Approx(glm::distance(x[3], x[4])).epsilon(1e-5));
    check_sound(world);
}

/// B02, B03: two vertices a hair apart, or in one place, whose spring is 0.1 m long, fall beside hanging
/// cloth and do it no harm. `by` makes a scene one of the method.
template <typename Method>
void check_pair_beside_cloth(const Method& by, double compliance, const std::shared_ptr<Device>& device)
{
    for (const double apart : {0.0, 1e-15, 1e-20, 1e-30, 1e-45})
    {
        INFO(apart);
        Scene two = by(test::hanging(4));
        Body pair = particles({{0, 0, 0}, {apart, 0, 0}}, 0.1);
        pair.springs = {{0, 1, 0.1, compliance}};
        two.bodies.push_back(pair);
        World both(two, device), solo(by(test::hanging(4)), device);
        run(both, 30);
        run(solo, 30);
        const auto x = both.positions(), y = solo.positions();
        const double gap = glm::distance(x[25], x[26]);
        check_sound(both, gap < 1e-10 ? Words{"degenerate"} : Words{});
        if (apart == 0)
            CHECK(measure(both).warnings.at("degenerate") == 30);
        CHECK(gap < 0.3);
        CHECK(std::equal(y.begin(), y.end(), x.begin()));
    }
}

/// B18, B19: a second of `near` 10 km from the origin, to ten times the error that it has there, and in
/// lengths of 1/1024 m, to the last bit.
inline void check_far_and_in_units(const Scene& near)
{
    const glm::dvec3 away(1e4, -1e4, 1e4);
    Scene exact = near, far = near, large = near;
    exact.method.precision = Precision::float64;
    World truth(exact, test_device("cpu:serial"));
    run(truth, 60);
    for (glm::dvec3& x : far.bodies[0].mesh.positions)
        x += away;
    large.gravity *= 1024.0;
    large.bodies[0].material.density /= 1024.0 * 1024;
    large.bodies[0].material.bending_stiffness *= 1024.0 * 1024;
    for (glm::dvec3& x : large.bodies[0].mesh.positions)
        x *= 1024.0;
    on_every_device([&](const auto& device) {
        World at_origin(near, device), at_distance(far, device), in_units(large, device);
        for (World* world : {&at_origin, &at_distance, &in_units})
            run(*world, 60);
        auto moved = at_distance.positions(), scaled = in_units.positions();
        for (std::size_t v = 0; v < moved.size(); ++v)
        {
            moved[v] -= away;
            scaled[v] /= 1024.0;
        }
        const double origin = largest_distance(at_origin.positions(), truth.positions());
        const double distance = largest_distance(moved, truth.positions());
        note("B18", *device, "error at the origin, m", origin);
        note("B18", *device, "error at 1e4 m, m", distance);
        CHECK(distance < 10 * origin + 1e-7);
        CHECK(scaled == at_origin.positions());
    });
}

} // namespace taut::hard
