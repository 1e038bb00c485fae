#pragma once
// The shaded colours of points of the canvas.

#include "geometry/render/drawing.hpp"

namespace facetmill {

/// Caches the normals of recently shaded triangles, because neighbouring pixels often show the same
/// triangle. Each thread has its own cache.
class LastFacings {
  public:
    struct Facing {
        std::uint32_t number = none; ///< number of the triangle
        bool front = false;          ///< true if its outer side is visible
        Vec3 normal;                 ///< Shader::facing_normal
    };
    /// The cache slot for this triangle. It may contain another triangle.
    Facing& at(std::uint32_t number) { return all_[number % all_.size()]; }

  private:
    std::vector<Facing> all_ = std::vector<Facing>(1024);
};

/// Shades points of triangles and vertices drawn on a canvas.
class Shader {
  public:
    Shader(const SceneDrawing& drawing, const View& view, const PictureSettings& settings)
        : drawing_(drawing), view_(view), settings_(settings) {}

    /// The linear colour and alpha (1 unless the material blends) of the element with this number at (x, y)
    /// of the canvas. open: the visible share of the sky, 0 to 1. last: a cache used only for this drawing.
    Texel colour(std::uint32_t number, double x, double y, float open, LastFacings& last) const;

    /// Whether a material with holes is solid at (x, y).
    bool is_solid(const PartDrawing& part, const CanvasTriangle& t, Index face, double x, double y) const;

    /// The unit normal of the triangle towards the viewer, along the canvas' axes.
    Vec3 facing_normal(const std::array<Vec3, 3>& corners) const;

  private:
    struct Spot; // a surface point with values that are needed repeatedly

    Texel base_colour(const Spot& spot, bool inside) const;
    Texel textured(const Spot& spot, const Texture& texture) const;
    const LastFacings::Facing& facing(std::uint32_t number, const PartDrawing& part, LastFacings& last) const;
    Vec3 normal_at(const Spot& spot, const Vec3& facing) const;
    Vec3 bumped(const Spot& spot, const Vec3& normal) const;
    std::optional<std::pair<Vec3, Vec3>> tangents(const Spot& spot, const Vec3& normal) const;
    double in_light(const Vec3& normal, bool right_side) const;
    Texel plain(const Texel& paint, const LastFacings::Facing& facing, bool double_sided, float open) const;
    double lit(const Spot& spot, const Vec3& normal) const;
    Colour of_direction(const Spot& spot, const Vec3& facing) const;

    const SceneDrawing& drawing_;
    const View& view_;
    const PictureSettings& settings_;
};

} // namespace facetmill
