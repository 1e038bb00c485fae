#pragma once
// Histograms as inline SVG. All text is plain; numbers are rounded, so that pages stay small.

#include "geometry/measure/shape_histograms.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

/// A row of bars from left to right.
struct BarChart {
    std::string id;                        ///< no other of the page may have it
    std::string title;                     ///< "Smallest angle"
    std::string description = {};          ///< for those who cannot see it: what the bars say, in words
    std::vector<double> heights = {};      ///< of the bars, any scale; negative: none
    std::vector<std::string> colours = {}; ///< of the bars; empty: all in that of the page
    std::vector<double> outline = {};      ///< a line over the bars, of as many; empty: none
    std::vector<std::pair<double, std::string>> ticks =
        {};             ///< 0 to 1 from left to right, and what is written there
    bool scale = false; ///< a strip of the colours below the bars
};

/// <svg role="img"> with a title and a description, as wide as its place.
std::string svg_of(const BarChart& chart);

} // namespace facetmill::report
