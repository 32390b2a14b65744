// Makes missing barriers and wrong colours visible: whatever the list leaves unordered runs in a random
// order, one element at a time. Work groups are shuffled as wholes; lanes keep their order.

#include "taut/runtime/cpu/runner.hpp"

#include <numeric>
#include <utility>
#include <vector>

namespace taut::cpu {
namespace {

/// splitmix64: the same order on every platform, which std::shuffle does not promise.
class Random
{
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// Uniform enough in 0..n-1 (multiply and shift; the bias is below n / 2^32).
    std::uint32_t below(std::uint32_t n)
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return static_cast<std::uint32_t>((z >> 32) * n >> 32);
    }

private:
    std::uint64_t state_;
};

class ShuffledRunner final : public Runner
{
public:
    explicit ShuffledRunner(std::uint64_t seed) : random_(seed) {}

    void run(std::span<Pass> passes, Way) override
    {
        shuffle(pass_order_, static_cast<std::uint32_t>(passes.size()));
        for (const std::uint32_t index : pass_order_)
        {
            const Pass& pass = passes[index];
            shuffle(element_order_, pass.elements());
            for (const std::uint32_t element : element_order_)
                pass.run(element, element + 1);
        }
    }

private:
    /// Fisher and Yates, from the end.
    void shuffle(std::vector<std::uint32_t>& order, std::uint32_t count)
    {
        order.resize(count);
        std::iota(order.begin(), order.end(), 0u);
        for (std::uint32_t last = count; last > 1; --last)
            std::swap(order[last - 1], order[random_.below(last)]);
    }

    Random random_;
    std::vector<std::uint32_t> pass_order_, element_order_;
};

} // namespace

std::unique_ptr<Runner> make_shuffled_runner(std::uint64_t seed)
{
    return std::make_unique<ShuffledRunner>(seed);
}

} // namespace taut::cpu
