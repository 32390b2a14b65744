#include "taut/cli/pictures.hpp"

#include "taut/runtime/base/error.hpp"

namespace taut::cli {

std::vector<std::uint64_t> moment_frames(std::uint64_t frames)
{
    constexpr std::uint64_t kMoments = 12;
    std::vector<std::uint64_t> list;
    for (std::uint64_t k = 0; k < kMoments; ++k)
    {
        const std::uint64_t frame = (k * frames + (kMoments - 1) / 2) / (kMoments - 1);
        if (list.empty() || list.back() != frame)
            list.push_back(frame);
    }
    return list;
}

std::vector<std::string> draw_pictures(const World& world, std::shared_ptr<Device> device,
                                       const std::vector<PictureMoment>& moments,
                                       const std::filesystem::path& folder, std::string& why_not)
{
    try
    {
        Pictures pictures(world.scene(), std::move(device));
        for (const PictureMoment& moment : moments)
            pictures.add(moment);
        return pictures.write(folder, &world);
    }
    catch (const Error& error)
    {
        // What was simulated is sound without a picture of it; a disk that is full is another matter.
        if (error.code() == ErrorCode::io)
            throw;
        why_not = std::string("no pictures: ") + error.what();
        return {};
    }
}

} // namespace taut::cli
