#pragma once
// Histograms as inline SVG. All texts are plain; numbers are rounded to keep pages small.

#include "geometry/measure/shape_histograms.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

/// A row of bars from left to right.
struct BarChart {
    std::string id;                        ///< unique in the page
    std::string title;                     ///< "Smallest angle"
    std::string description = {};          ///< alternative text: the contents in words
    std::vector<double> heights = {};      ///< heights of the bars, in any scale; negative: no bar
    std::vector<std::string> colours = {}; ///< colours of the bars; empty: the page's colour for all
    std::vector<double> outline = {};      ///< a line over the bars, with the same count; empty: none
    std::vector<std::pair<double, std::string>> ticks = {}; ///< position from 0 to 1, left to right, and text
    bool scale = false;                                     ///< adds a strip of the colours below the bars
};

/// Makes <svg role="img"> with a title and a description, as wide as its container.
[[nodiscard]] std::string svg_of(const BarChart& chart);

} // namespace facetmill::report
