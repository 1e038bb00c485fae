#pragma once
// The scale of colours next to a picture, with its numbers.

#include "geometry/render/colour_scale.hpp"

namespace facetmill {

/// The width in pixels that the legend takes at the right. It is 0 if no legend is requested, or if no
/// numbers exist and identifiers are absent or too many. It is also 0 if the scene would get less than half
/// of the width, or if the height is too small for two numbers.
[[nodiscard]] int legend_width(const PictureSettings& settings, const ValueRange& range);

/// The picture with the legend to its right, as wide as the settings require. The legend has the attribute's
/// name and unit, the colours, and round numbers next to them. If the range does not cover all numbers, it
/// states how the range was chosen and the extremes. Identifiers get their colours. Requires that
/// legend_width() is not 0.
[[nodiscard]] Picture with_legend(const Picture& picture, const PictureSettings& settings,
                                  const ValueRange& range);

/// Round numbers in [low, high], at most `most`, in steps of 1, 2 or 5 times a power of ten. If fewer than
/// two exist, low and high.
[[nodiscard]] std::vector<double> round_numbers(double low, double high, std::size_t most);

/// Texts for ascending numbers, with at least four digits. More digits are used until each number is
/// accurate to a hundredth of the distance to its neighbours. Stops before a text becomes longer than
/// `letters`.
[[nodiscard]] std::vector<std::string> number_texts(const std::vector<double>& numbers, std::size_t letters);

} // namespace facetmill
