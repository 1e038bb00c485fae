#pragma once
// The projection of the world to a picture.

#include "geometry/render/render.hpp"

namespace facetmill {

/// Maps world to samples: x right, y down, z towards the viewer, 0 at the centre of the visible scene. In
/// perspective, z grows with the inverse of the distance, so that planes stay planes.
struct View {
    Vec3 right, up, towards;
    bool has_extent = false; ///< false if the visible scene is a point or empty; the scale is then arbitrary
    double scale = 0, x = 0, y = 0, z = 0; ///< maps the scene's centre to the canvas' centre
    /// In perspective: the viewer's position along the axes in world units, the distance to the scene's
    /// centre in samples, and the canvas point straight ahead.
    std::optional<Vec3> eye;
    double distance = 0, ahead_x = 0, ahead_y = 0;

    Vec3 of(const Vec3& p) const;
    /// The position of a canvas point before perspective: x right, y down, z towards the viewer, in samples
    /// at the depth of the scene's centre. In parallel projection it is the point itself.
    Vec3 place(const Vec3& seen) const;
    /// The inverse of the distance from the viewer, up to a factor. Interpolation weights are multiplied
    /// with it.
    double nearness(double depth) const { return eye ? depth + distance : 1; }
    /// A direction in the world along the canvas' axes.
    Vec3 direction(const Vec3& d) const { return {dot(d, right), -dot(d, up), dot(d, towards)}; }
    /// The unit vector from a position to the viewer.
    Vec3 to_viewer(const Vec3& place) const;
};

/// The view for a canvas with this many samples.
[[nodiscard]] View view_of(const Scene& scene, const PictureSettings& settings, int width, int height);

} // namespace facetmill
