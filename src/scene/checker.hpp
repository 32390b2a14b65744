#pragma once
// Collects what is wrong with a scene: one place for the wording of ranges.

#include "taut/runtime/base/shown.hpp"
#include "taut/scene/scene.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

/// Largest magnitude of any value: more does not fit the float arithmetic of the kernels.
inline constexpr double kMaxValue = 1e30;
/// Most vertices of a generated body; a typing error should not fill the machine's memory.
inline constexpr double kMaxVertices = 1 << 26;

using taut::shown;
std::string shown(const glm::dvec3& value);

/// Appends issues whose fields start with a path.
class Checker
{
public:
    Checker(std::vector<SceneIssue>& issues, std::string path) : issues_(issues), path_(std::move(path)) {}

    /// A checker for a member ("material") or an element ("pins", 3).
    Checker at(std::string_view member) const;
    Checker at(std::string_view member, std::size_t index) const;

    void error(std::string_view member, const std::string& text, ErrorCode code = ErrorCode::bad_input) const;
    void warning(std::string_view member, const std::string& text) const;

    /// Finite, and at most kMaxValue in magnitude.
    bool finite(std::string_view member, double value, std::string_view unit) const;
    bool finite(std::string_view member, const glm::dvec3& value, std::string_view unit) const;
    void positive(std::string_view member, double value, std::string_view unit) const;
    void not_negative(std::string_view member, double value, std::string_view unit) const;
    void range(std::string_view member, std::uint32_t value, std::uint32_t low, std::uint32_t high) const;
    void word(std::string_view member, const std::string& value,
              std::span<const std::string_view> known) const;

private:
    std::string join(std::string_view member) const;

    std::vector<SceneIssue>& issues_;
    std::string path_;
};

/// Indices of pins, springs, masses and start positions against the number of vertices.
void check_counts(const Body& body, std::size_t vertex_count, const Checker& out);

/// Words and ranges of a shape, and of a body's material. `solid`: it has tetrahedra.
void check_shape(const Shape& shape, const Checker& out);
void check_material(const Material& material, bool solid, const Checker& out);

/// Words and ranges of the method's settings, and of the wind.
void check_method(const MethodSettings& method, const Checker& out);
void check_wind(const Wind& wind, const Checker& out);

} // namespace taut::scene_file
