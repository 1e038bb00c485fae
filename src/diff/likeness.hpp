#pragma once
// How different two scenes look, measured in rendered pictures.

#include "geometry/render/render.hpp"
#include "mesh/scene.hpp"

namespace facetmill::report {

/// Pictures of a scene from several sides, with its textures and lighting, to compare other scenes with.
///
/// The cameras fit the scene, and are used for every other scene too. Skinned and morphed parts are posed, as
/// before any animation plays.
class Likeness {
  public:
    enum class Views {
        six,  ///< above the four corners, above and below
        eight ///< above and below the four corners
    };
    /// pixels: the sides of each picture. The pictures are rendered here, and the scene is not kept.
    Likeness(const Scene& scene, int pixels, Views views = Views::six);

    /// The mean squared difference of a pixel, from 0 to 1. It is the mean over red, green and blue in sRGB,
    /// over a black and a white background, and over the pixels of all pictures that either scene covers.
    /// Squared differences of independent changes add up. The square root is a share of the full range.
    [[nodiscard]] double difference(const Scene& other) const;

    struct Comparison {
        double difference = 0; ///< as above
        /// The mean structural similarity of the brightness on white, over windows of 8 x 8 pixels with a
        /// covered pixel; 1 for equal pictures. Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image Quality
        /// Assessment: From Error Visibility to Structural Similarity" (2004).
        double similarity = 1;
        Picture sheet; ///< a row for each view: the scene, the other, and four times their difference
    };
    [[nodiscard]] Comparison compared(const Scene& other) const;

  private:
    std::vector<PictureSettings> settings_; ///< of each picture, without materials
    std::vector<Picture> pictures_;
};

} // namespace facetmill::report
