#pragma once
// How different two scenes look, measured in rendered pictures.

#include "geometry/render/render.hpp"
#include "mesh/scene.hpp"

namespace facetmill::report {

/// Pictures of a scene from six sides, with its textures and lighting, to compare other scenes with.
///
/// The cameras are above the four corners, above and below. They fit the scene, and are used for every other
/// scene too. Skinned and morphed parts are posed, as before any animation plays.
class Likeness {
  public:
    /// pixels: the sides of each picture. The pictures are rendered here, and the scene is not kept.
    Likeness(const Scene& scene, int pixels);

    /// The mean squared difference of a pixel, from 0 to 1. It is the mean over red, green and blue in sRGB,
    /// over a black and a white background, and over the pixels of all pictures that either scene covers.
    /// Squared differences of independent changes add up. The square root is a share of the full range.
    [[nodiscard]] double difference(const Scene& other) const;

  private:
    std::vector<PictureSettings> settings_; ///< of each picture, without materials
    std::vector<Picture> pictures_;
};

} // namespace facetmill::report
