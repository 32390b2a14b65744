#include "taut/cli/pictures.hpp"

#include "taut/cli/output.hpp"
#include "taut/report/picture.hpp"

namespace taut::cli {

std::vector<std::uint64_t> snapshot_frames(std::uint64_t frames)
{
    constexpr std::uint64_t kSnapshots = 8; // two rows of four
    std::vector<std::uint64_t> list;
    for (std::uint64_t k = 0; k < kSnapshots; ++k)
    {
        const std::uint64_t frame = (k * frames + (kSnapshots - 1) / 2) / (kSnapshots - 1);
        if (list.empty() || list.back() != frame)
            list.push_back(frame);
    }
    return list;
}

std::vector<std::string> draw_pictures(const Scene& resolved, const std::vector<Snapshot>& snapshots,
                                       const std::filesystem::path& folder)
{
    try
    {
        Pictures pictures(resolved);
        for (const Snapshot& snapshot : snapshots)
            pictures.add({snapshot.time, snapshot.positions});
        return pictures.write(folder);
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::io || error.code() == ErrorCode::bad_input)
            throw;
        warn(std::string("no picture was drawn: ") + error.what());
        return {};
    }
}

} // namespace taut::cli
