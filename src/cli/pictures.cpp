#include "taut/cli/pictures.hpp"

namespace taut::cli {

std::vector<std::uint64_t> snapshot_frames(std::uint64_t frames)
{
    constexpr std::uint64_t kSnapshots = 12;
    std::vector<std::uint64_t> list;
    for (std::uint64_t k = 0; k < kSnapshots; ++k)
    {
        const std::uint64_t frame = (k * frames + (kSnapshots - 1) / 2) / (kSnapshots - 1);
        if (list.empty() || list.back() != frame)
            list.push_back(frame);
    }
    return list;
}

std::vector<std::string> draw_pictures(const Scene&, const std::vector<Snapshot>&,
                                       const std::filesystem::path&)
{
    return {};
}

} // namespace taut::cli
