#pragma once
// Multiproperties of 3MF: several colours or textures of a triangle that lie on each other. Private to
// threemf.

#include "io/threemf/model.hpp"

namespace facetmill::io::threemf {

struct Layers {
    std::vector<std::uint32_t> groups;              ///< from the lowest to the top
    std::vector<bool> multiply;                     ///< [groups from the second on] false: mixed by alpha
    std::vector<std::vector<std::uint32_t>> multis; ///< for each property its index into each group
    std::size_t line = 0;
};

/// The colours of the layers together. The highest texture stays a texture if the layers above it multiply
/// it; it hides the layers below unless it multiplies them. Other layers, whose groups are not read or whose
/// textures have no place, do not count: adds them to model.skipped. An index beyond its group leaves out the
/// layer, and is a fault of the model.
[[nodiscard]] Group blended(const Layers& layers, Model& model);

} // namespace facetmill::io::threemf
