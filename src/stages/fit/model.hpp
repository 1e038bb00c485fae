#pragma once
// Predicts bytes and difference of every choice from measured curves, and finds the best choice.

#include "stages/fit/trials.hpp"

namespace facetmill::fit_stage {

/// Bytes and mean squared difference, measured or predicted. Bytes may be relative.
struct Cost {
    double bytes = 0, error = 0;
};

/// A measured ratio of triangles, with the finest bits. Bytes do not include images.
struct MeasuredRatio {
    double keep = 1;
    Cost cost;
};
/// Measured bits of one attribute: the share of the bytes that they save, and the difference that they add.
struct MeasuredBits {
    int bits = 0;
    double saved = 0, error = 0;
};
/// A measured size and quality of the images of a role. Bytes count once, with the colours.
struct MeasuredImages {
    ImageChoice choice;
    Cost cost;
};

/// The measured curves. Each has the finest choice first.
struct Curves {
    std::vector<MeasuredRatio> ratios;
    std::vector<MeasuredBits> position, normal, uv;
    std::vector<MeasuredImages> colours, normals;
};

/// The best choices by the curves. Bytes and squared differences of independent changes add up. Between
/// measured ratios and qualities, both are interpolated.
class Model {
  public:
    /// weight: multiplies the measured differences of ratios, to find choices nearby.
    Model(const Curves& curves, double weight);

    /// The choice with the least difference within these bytes; none if no choice fits.
    [[nodiscard]] std::optional<Choice> best_within(double bytes) const;
    /// The choice with the fewest bytes within this difference; none if every choice differs more.
    [[nodiscard]] std::optional<Choice> smallest_within(double error) const;
    [[nodiscard]] Choice smallest() const;

  private:
    struct Shape {
        double keep;
        Bits bits;
        Cost cost;
    };
    struct Images {
        ImageChoice colours, normals;
        Cost cost;
    };
    static Choice choice_of(const Shape& shape, const Images& images);

    // Bytes ascend, and differences descend.
    std::vector<Shape> shapes_;
    std::vector<Images> images_;
};

} // namespace facetmill::fit_stage
