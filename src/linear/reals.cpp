#include "taut/linear/reals.hpp"

namespace taut::linear {

void write_reals(Device& device, const BufferPtr& buffer, std::span<const double> values, Precision precision,
                 std::uint64_t at)
{
    if (values.empty())
        return;
    if (precision == Precision::float64)
        return device.write<double>(buffer, values, at * 8);
    const std::vector<float> rounded(values.begin(), values.end());
    device.write<float>(buffer, rounded, at * 4);
}

std::vector<double> read_reals(Device& device, const BufferPtr& buffer, std::size_t count,
                               Precision precision, std::uint64_t at)
{
    if (precision == Precision::float64)
        return device.read<double>(buffer, count, at * 8);
    const std::vector<float> values = device.read<float>(buffer, count, at * 4);
    return {values.begin(), values.end()};
}

std::vector<double> as_pairs(std::span<const double> values)
{
    std::vector<double> pairs;
    pairs.reserve(2 * values.size());
    for (const double value : values)
    {
        const auto high = static_cast<double>(static_cast<float>(value));
        pairs.push_back(high);
        pairs.push_back(value - high);
    }
    return pairs;
}

} // namespace taut::linear
