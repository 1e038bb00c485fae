#pragma once
// Multiproperties of 3MF: several colours of a triangle that lie on each other. Private to threemf.

#include "io/threemf/model.hpp"

namespace facetmill::io::threemf {

struct Layers {
    std::vector<std::uint32_t> groups;              ///< from the lowest to the top
    std::vector<bool> multiply;                     ///< [groups from the second on] false: mixed by alpha
    std::vector<std::vector<std::uint32_t>> multis; ///< for each property its index into each group
};

/// The colours of the layers together. Layers of groups that are not read, such as textures, do not count.
/// name: of the model, for messages. Throws malformed (E-3MF) for an index beyond its group.
[[nodiscard]] Group blended(const Layers& layers, const std::map<std::uint32_t, Group>& groups,
                            const std::string& name);

} // namespace facetmill::io::threemf
