#pragma once
// The scale of colours next to a picture, with its numbers.

#include "geometry/render/colour_scale.hpp"

namespace facetmill {

/// How many of the settings' pixels the legend takes at the right; 0 where there is none: when it is not
/// wanted, when there are no numbers and no or many identifiers, where it would leave less than half of the
/// width for the scene, and where the height has no room for two numbers.
[[nodiscard]] int legend_width(const PictureSettings& settings, const ValueRange& range);

/// The picture with the legend to its right, as wide as the settings say: the attribute's name and unit, the
/// colours, round numbers beside them, and where the range is not all of the numbers, how it was chosen and
/// how far they go; of identifiers their colours. legend_width() is not 0.
[[nodiscard]] Picture with_legend(const Picture& picture, const PictureSettings& settings,
                                  const ValueRange& range);

/// Round numbers in [low, high], at most `most` of them, at least two apart by 1, 2 or 5 times a power of
/// ten; low and high themselves when there are none such.
[[nodiscard]] std::vector<double> round_numbers(double low, double high, std::size_t most);

/// The numbers, which ascend, with four digits or as many more as it takes to say each to a hundredth of the
/// distance between neighbours, as long as no text is longer than `letters`.
[[nodiscard]] std::vector<std::string> number_texts(const std::vector<double>& numbers, std::size_t letters);

} // namespace facetmill
