#pragma once
// Blends transparent materials over opaque surfaces.

#include "geometry/render/shader.hpp"

namespace facetmill {

/// The blending triangles of a band of rows, shaded at their visible samples.
class Layers {
  public:
    static constexpr std::size_t most = 16; ///< layers per sample; deeper layers are dropped
    /// Deep layers are dropped above this number of bytes. If the visible layers (at most `most` for each
    /// sample of a band) need more, the limit is twice their size.
    static constexpr std::size_t bytes = std::size_t{64} << 20;

    /// numbers: the numbers of the blending triangles in the band. last: see Shader::colour.
    Layers(const std::vector<std::uint32_t>& numbers, int first_row, int last_row, const Canvas& canvas,
           const SceneDrawing& drawing, const Shader& shader, LastFacings& last);

    /// Blends the layers over the pixel's samples, from back to front. Colours are multiplied by alpha.
    void lay_over(int x, int y, std::array<Texel, Canvas::samples * Canvas::samples>& shades) const;

  private:
    struct Layer {
        std::uint32_t pixel = 0, number = 0; ///< the pixel, counted from the band's first
        float depth = 0;
        std::uint8_t samples = 0; ///< a bit for each of the pixel's samples
        Texel shade{};
    };
    void add(std::uint32_t number, const PartDrawing& part, const Canvas& canvas, const Shader& shader,
             LastFacings& last);
    void sort_and_cut();

    std::vector<Layer> layers_; ///< sorted by pixel, then from front to back
    int first_, last_, width_;  ///< range of sample rows; pixels per row
};

} // namespace facetmill
