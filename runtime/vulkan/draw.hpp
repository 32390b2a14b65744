#pragma once
// Pictures of surfaces, without a window: shaded triangles and strands through a Vulkan graphics pipeline.
// Knows no physics. Positions may be the very buffer of a simulation on the same device.

#include "taut/runtime/device.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace taut {

/// What light does with a surface.
enum class Finish : std::uint32_t
{
    cloth = 0,  ///< two-sided, with a colour for each side
    solid = 1,  ///< one colour, a little shine
    ground = 2, ///< a checker of both colours that fades into the background far away
};

/// Triangles and strands over one list of positions.
struct Surface
{
    /// Four floats per vertex, m, the fourth ignored; a buffer of the drawing device. Null: `positions`.
    BufferPtr buffer;
    std::vector<glm::vec4> positions;
    std::vector<std::uint32_t> triangles; ///< three vertices each, counterclockwise seen from the front
    std::vector<std::uint32_t> lines;     ///< two vertices each
    float line_radius = 0.005f;           ///< m
    Finish finish = Finish::cloth;
    glm::vec3 front{0.8f}, back{0.8f}; ///< sRGB, 0..1
    float cell = 0.25f;                ///< ground: width of a cell of the checker, m
};

struct Camera
{
    glm::vec3 eye{0, 0, 5}, target{0}, up{0, 1, 0}; ///< m, world
    float fov = 0.6f;                               ///< vertical opening, radians
};

/// One picture: from where, how large, and the ball that holds what matters (light and shadow cover it).
struct Shot
{
    Camera camera;
    std::uint32_t width = 1280, height = 960;                                    ///< pixels
    glm::vec3 focus{0};                                                          ///< m
    float radius = 1;                                                            ///< m, > 0
    glm::vec3 sky_top{0.955f, 0.965f, 0.975f}, sky_bottom{0.80f, 0.825f, 0.85f}; ///< sRGB, 0..1
};

struct Image
{
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< sRGB, rows from the top
};

/// Draws on one Vulkan device. Not thread-safe.
class Renderer
{
public:
    /// Throws Error{unsupported} when `device` is no Vulkan device, or its queue or formats cannot draw.
    explicit Renderer(std::shared_ptr<Device> device);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Waits for earlier work of the device, draws and reads back. Throws Error{bad_input} for an index
    /// out of range, a size of 0 or a radius that is not positive, Error{limit} for a picture larger than
    /// the device allows.
    Image draw(const Shot& shot, std::span<const Surface> surfaces);

    const std::shared_ptr<Device>& device() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Whether a Renderer works on `device`.
bool can_draw(const Device& device);

/// The first Vulkan device that draws, hardware before software. Throws Error{no_device} with the reason.
std::shared_ptr<Device> open_drawing_device(const OpenOptions& options = {});

} // namespace taut
