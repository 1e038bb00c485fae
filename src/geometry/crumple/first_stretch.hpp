#pragma once
// The initial limit of the stretch of faces, before all faces are examined.

#include "geometry/crumple/tested_sheet.hpp"

namespace facetmill {

/// The initial stretch limit, relative to the longest edge of a face. If most faces are stretched much, a
/// sample (all faces in some of the cubes that divide space) is tested at max_stretch, half of it and so on,
/// until at most an eighth of the sample intersects. Otherwise a round would lower most positions, after
/// examining very many pairs. A pure function of the sheets.
[[nodiscard]] double first_stretch(std::span<const CrumpleSheet> sheets, const std::vector<TestSheet>& tests,
                                   const std::vector<std::uint8_t>& levels, std::size_t max_pairs);

} // namespace facetmill
