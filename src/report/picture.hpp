#pragma once
// Pictures of a run: the last moment, large, and a contact sheet of all moments under one camera.

#include "taut/runtime/vulkan/draw.hpp"
#include "taut/world/world.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// Where every vertex was at one time.
struct PictureMoment
{
    double time = 0;                   ///< s
    std::vector<glm::dvec3> positions; ///< m, bodies one after another, as World::positions() gives them
    /// The meshes at that time, where they are not those of the pictures' scene: cloth may tear.
    std::shared_ptr<const Scene> scene = nullptr;
};

struct PictureOptions
{
    std::uint32_t width = 1280, height = 960;          ///< pixels, of the picture
    std::uint32_t cell_width = 480, cell_height = 360; ///< pixels, of one moment on the contact sheet
    std::uint32_t columns = 4;
};

/// A three-quarter view from above (against gravity) that holds every vertex of every moment and every
/// collider that has an end; `margin` is the room around them, 1 = none. Of cloth that tears it holds the
/// parts that hang from pins, or the largest, and what is near them: scraps that fall far leave the picture.
/// Positions that are not finite are left out.
Shot frame_shot(const Scene& resolved, std::span<const PictureMoment> moments, std::uint32_t width,
                std::uint32_t height, double margin = 1.15);

struct FieldSurface; // field_surface.hpp

/// Draws scenes. Not thread-safe.
class Pictures
{
public:
    /// Draws on `device`, or on the best Vulkan device that draws if it is null or cannot. Throws
    /// Error{no_device} with the reason when there is none, Error{bad_input} for a scene without meshes.
    explicit Pictures(Scene resolved, std::shared_ptr<Device> device = nullptr, const PictureOptions& = {});

    /// For the contact sheet; the last one added is the picture.
    void add(PictureMoment moment);
    void capture(const World& world)
    {
        add({world.time(), world.positions(), std::make_shared<const Scene>(world.scene())});
    }

    Image draw(const PictureMoment& moment, const Shot& shot);

    /// A world in single precision on the device that draws is drawn from its own position buffer, without
    /// a copy; any other from World::positions(). Bitwise the same image either way. Solids with an embedded
    /// surface are shown by it, from positions.
    Image draw(const World& world, const Shot& shot);

    /// All moments in rows, each with its time. Throws Error{bad_input} when there are none.
    Image contact_sheet();

    /// Writes picture.png (of the last moment, or of `world` where it is now) and contact_sheet.png, and
    /// returns their names. Throws Error{io}, and Error{bad_input} when there are no moments.
    std::vector<std::string> write(const std::filesystem::path& folder, const World* world = nullptr);

    const Device& device() const { return *renderer_.device(); }

private:
    std::vector<Surface> cloth(const PictureMoment& moment) const;
    std::vector<Surface> cloth_in_place(const World& world) const;
    void add_colliders(std::vector<Surface>& surfaces, const Scene& scene, double time,
                       const Shot& shot);
    void finish_strands(std::vector<Surface>& surfaces, const Shot& shot) const;

    Scene scene_;
    PictureOptions options_;
    Renderer renderer_;
    std::vector<PictureMoment> moments_;
    /// Made once.
    std::map<std::shared_ptr<const DistanceField>, std::shared_ptr<const FieldSurface>> field_surfaces_;
};

} // namespace taut
