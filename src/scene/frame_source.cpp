#include "taut/scene/frame_source.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/raw_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

namespace fs = std::filesystem;

namespace taut {
namespace {

using scene_file::RawMesh;
using Triangle = std::array<std::uint32_t, 3>;

/// Digits compare as numbers, so that mesh_2 comes before mesh_10.
bool before(const std::string& a, const std::string& b)
{
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size())
    {
        if (!digit(a[i]) || !digit(b[j]))
        {
            if (a[i] != b[j])
                return a[i] < b[j];
            ++i, ++j;
            continue;
        }
        const auto number = [&](const std::string& text, std::size_t& at) {
            std::size_t begin = at;
            while (at < text.size() && digit(text[at]))
                ++at;
            while (begin + 1 < at && text[begin] == '0')
                ++begin;
            return text.substr(begin, at - begin);
        };
        const std::string left = number(a, i), right = number(b, j);
        if (left != right)
            return left.size() != right.size() ? left.size() < right.size() : left < right;
    }
    return a.size() - i < b.size() - j || (a.size() - i == b.size() - j && a < b);
}

/// Of a mesh, by its file.
std::vector<std::string> skipped_messages(const std::string& file, const RawMesh& mesh)
{
    std::vector<std::string> messages = skipped_texts(mesh.skipped);
    for (std::string& text : messages)
        text.insert(0, file + ' ');
    return messages;
}

class Folder : public FrameSource
{
public:
    explicit Folder(const fs::path& folder)
    {
        std::error_code failed;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
            if (entry.path().extension() == ".obj")
                files_.push_back(entry.path());
        if (failed)
            throw Error(ErrorCode::io, folder.string() + " cannot be read: " + failed.message());
        if (files_.empty())
            throw Error(ErrorCode::bad_input,
                        folder.string() + " has no file that ends in .obj; name a folder of frames");
        std::sort(files_.begin(), files_.end(), [](const fs::path& a, const fs::path& b) {
            return before(a.filename().string(), b.filename().string());
        });
        RawMesh mesh = scene_file::read_raw_mesh(files_.front());
        messages_ = skipped_messages(files_.front().string(), mesh);
        triangles_ = std::move(mesh.triangles);
    }

    std::size_t frames() const override { return files_.size(); }
    const std::vector<Triangle>& triangles() const override { return triangles_; }
    std::vector<glm::dvec3> positions(std::size_t frame) override
    {
        RawMesh mesh = scene_file::read_raw_mesh(files_.at(frame));
        if (mesh.triangles != triangles_)
            throw Error(ErrorCode::bad_input, name(frame) + ": its faces are not those of " + name(0) +
                                                  "; frames must be of one mesh");
        return std::move(mesh.positions);
    }
    std::string name(std::size_t frame) const override { return files_.at(frame).string(); }
    std::vector<std::string> messages() const override { return messages_; }

private:
    std::vector<fs::path> files_;
    std::vector<Triangle> triangles_;
    std::vector<std::string> messages_;
};

constexpr std::size_t kCacheHead = 32; ///< bytes: signature, version, points, start, rate, samples

class PointCache : public FrameSource
{
public:
    PointCache(const fs::path& cache, std::size_t vertices, std::vector<Triangle> triangles,
               const std::string& mesh, std::vector<std::string> messages = {})
        : file_(cache.string()),
          triangles_(std::move(triangles)),
          messages_(std::move(messages))
    {
        static_assert(std::endian::native == std::endian::little, "bytes of a point cache are little endian");
        std::error_code failed;
        const std::uintmax_t bytes = fs::file_size(cache, failed);
        stream_.open(cache, std::ios::binary);
        if (failed || !stream_)
            throw Error(ErrorCode::io, file_ + " cannot be read");
        std::array<char, kCacheHead> head{};
        stream_.read(head.data(), head.size());
        if (!stream_ || std::memcmp(head.data(), "POINTCACHE2", 12) != 0 || word(head, 12) != 1)
            throw Error(ErrorCode::bad_input, file_ +
                                                  " is no point cache: it must begin with \"POINTCACHE2\", a "
                                                  "zero byte and the version 1");
        points_ = word(head, 16);
        samples_ = word(head, 28);
        if (points_ != vertices)
            throw Error(ErrorCode::bad_input, file_ + " moves " + std::to_string(points_) + " vertices; " +
                                                  mesh + " has " + std::to_string(vertices));
        const std::uintmax_t wanted = kCacheHead + std::uintmax_t(points_) * samples_ * 12;
        if (samples_ == 0 || bytes < wanted)
            throw Error(ErrorCode::bad_input, file_ + " has " + std::to_string(bytes) + " bytes; " +
                                                  std::to_string(samples_) + " frames take " +
                                                  std::to_string(wanted) + ", and there must be one");
    }

    std::size_t frames() const override { return samples_; }
    const std::vector<Triangle>& triangles() const override { return triangles_; }
    std::vector<glm::dvec3> positions(std::size_t frame) override
    {
        std::vector<float> values(std::size_t{3} * points_);
        stream_.seekg(static_cast<std::streamoff>(kCacheHead + frame * values.size() * sizeof(float)));
        stream_.read(reinterpret_cast<char*>(values.data()),
                     static_cast<std::streamsize>(values.size() * sizeof(float)));
        if (!stream_)
            throw Error(ErrorCode::io, name(frame) + " cannot be read");
        std::vector<glm::dvec3> positions(points_);
        for (std::size_t v = 0; v < positions.size(); ++v)
            positions[v] = {values[3 * v], values[3 * v + 1], values[3 * v + 2]};
        return positions;
    }
    std::string name(std::size_t frame) const override { return file_ + ", frame " + std::to_string(frame); }
    std::vector<std::string> messages() const override { return messages_; }

private:
    static std::uint32_t word(const std::array<char, kCacheHead>& head, std::size_t at)
    {
        std::uint32_t value = 0;
        std::memcpy(&value, &head[at], sizeof value);
        return value;
    }

    std::string file_;
    std::ifstream stream_;
    std::vector<Triangle> triangles_;
    std::vector<std::string> messages_;
    std::uint32_t points_ = 0, samples_ = 0;
};

} // namespace

std::unique_ptr<FrameSource> open_frame_folder(const fs::path& folder)
{
    return std::make_unique<Folder>(folder);
}

std::unique_ptr<FrameSource> open_point_cache(const fs::path& cache, const fs::path& mesh)
{
    RawMesh moved = scene_file::read_raw_mesh(mesh);
    return std::make_unique<PointCache>(cache, moved.positions.size(), std::move(moved.triangles),
                                        mesh.string(), skipped_messages(mesh.string(), moved));
}

std::unique_ptr<FrameSource> open_point_cache(const fs::path& cache, std::size_t vertices,
                                              std::vector<Triangle> triangles, const std::string& mesh)
{
    return std::make_unique<PointCache>(cache, vertices, std::move(triangles), mesh);
}

} // namespace taut
