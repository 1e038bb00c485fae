#pragma once
// How far moves may draw out faces, before all of them are looked at.

#include "geometry/crumple/tested_sheet.hpp"

namespace facetmill {

/// Of the longest edge of a face. Where most faces are drawn out much, a sample of them (all in some of the
/// cubes that space is cut into) is tried at max_stretch, half of it and so on, until no more than an eighth
/// have trouble: else a round would lower most places, after looking at very many pairs. A pure function of
/// the sheets.
double first_stretch(std::span<const CrumpleSheet> sheets, const std::vector<TestSheet>& tests,
                     const std::vector<std::uint8_t>& levels, std::size_t max_pairs);

} // namespace facetmill
