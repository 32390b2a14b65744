#pragma once
// A sheet of links as btSoftBody of Bullet. The only place of the benches that includes Bullet.

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace bench {

/// What both engines are given. Lengths of links are those between `places`.
struct BulletSheet
{
    std::vector<double> places; ///< x y z of each vertex, m
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        links;                       ///< in the order in which Bullet projects them
    std::vector<std::uint32_t> pins; ///< vertices of no inverse mass; all others 1 kg
    double timestep = 0;             ///< s, of a world step
    int iterations = 1;              ///< piterations of each
    double damping = 0; ///< 1/s; Bullet takes 1 - exp(-damping timestep) of each velocity at each step
};

/// One soft body in a soft-rigid world, with nothing else in it and collisions of the body switched off. kLST
/// is 1: each projection moves a link the whole way to its length, to first order. One thread.
class BulletCloth
{
public:
    explicit BulletCloth(const BulletSheet& sheet);
    ~BulletCloth();
    BulletCloth(const BulletCloth&) = delete;
    BulletCloth& operator=(const BulletCloth&) = delete;

    /// One step of the world.
    void step();
    /// x y z of each vertex, m.
    std::vector<double> places() const;
    /// Bullet's version times a hundred: 324.
    static int version();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace bench
