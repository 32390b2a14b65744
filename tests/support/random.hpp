#pragma once
// Random test data: the same on every machine and standard library. Print the seed where a test fails.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace taut::conformance {

class Random
{
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
    bool chance(double probability) { return uniform(0, 1) < probability; }

    /// In [low, high), as the nearest value of T.
    template <typename T = double>
    T uniform(double low, double high)
    {
        return static_cast<T>(low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53);
    }

    template <typename T>
    glm::vec<4, T> vec4(double size, T w)
    {
        const T x = uniform<T>(-size, size), y = uniform<T>(-size, size), z = uniform<T>(-size, size);
        return {x, y, z, w};
    }

    template <typename T>
    std::vector<glm::vec<4, T>> vec4s(std::size_t n, double size, double w_low, double w_high)
    {
        std::vector<glm::vec<4, T>> values;
        for (std::size_t i = 0; i < n; ++i)
        {
            const T w = uniform<T>(w_low, w_high);
            values.push_back(vec4<T>(size, w));
        }
        return values;
    }

    /// Inverse masses over three decades; one vertex in ten is held (0).
    template <typename T>
    T inverse_mass()
    {
        static constexpr double kSteps[] = {0.1, 0.7, 1, 5, 30, 100};
        return chance(0.1) ? T(0) : static_cast<T>(kSteps[below(6)] * uniform(0.5, 1));
    }

    /// 0..n-1 in random order.
    std::vector<std::uint32_t> shuffled(std::uint32_t n)
    {
        std::vector<std::uint32_t> order(n);
        for (std::uint32_t i = 0; i < n; ++i)
            order[i] = i;
        for (std::uint32_t i = n; i > 1; --i)
            std::swap(order[i - 1], order[below(i)]);
        return order;
    }

private:
    std::mt19937_64 engine_;
};

} // namespace taut::conformance
