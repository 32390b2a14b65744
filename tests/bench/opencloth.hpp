#pragma once
// The position-based scene of opencloth as a serial program of its own: a sheet of 21 x 21 particles that two
// corners hold, over an ellipsoid and a floor. Written from the description in docs/methods/pbd.md.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace plain {

class Opencloth
{
public:
    Opencloth();
    void step();
    const std::vector<glm::vec3>& positions() const { return x_; }
    std::size_t stretch_count() const { return springs_.size(); }
    std::size_t bend_count() const { return bends_.size(); }
    float largest_stretch() const; ///< of the springs along rows and columns, l - L, m
    float deepest_in_ellipsoid() const; ///< in radii of it: 1 - |place in its own frame|, or less than 0

private:
    struct Spring
    {
        std::uint32_t a, b;
        float rest;
    };
    struct Bend
    {
        std::uint32_t a, b, p;
        float rest;
    };
    void add_spring(std::uint32_t a, std::uint32_t b);
    void add_bend(std::uint32_t a, std::uint32_t b, std::uint32_t p);
    void damp();
    void project_springs();
    void project_bends();
    void collide();

    std::vector<glm::vec3> x_, p_, v_;
    std::vector<float> w_; ///< inverse masses, 1/kg
    std::vector<Spring> springs_;
    std::vector<Bend> bends_;
    glm::mat4 ellipsoid_, into_ellipsoid_;
    std::size_t structural_ = 0;
};

} // namespace plain
