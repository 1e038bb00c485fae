#pragma once
// Parts that are split in two.

#include "mesh/scene.hpp"

#include <utility>
#include <vector>

namespace facetmill {

/// Collects the other sides of parts until all are cut, because the scene's parts must not move earlier.
class BothSides {
  public:
    explicit BothSides(Scene& scene) : scene_(scene) {}

    /// The part gets the first name and keeps its mesh; a copy with the other name and mesh follows it.
    void part_in_two(Part& part, const char* name, const char* other_name, Mesh other) {
        Part copy = part;
        copy.name += other_name;
        part.name += name;
        copy.mesh = std::move(other);
        copy.changed = true;
        others_.emplace_back(static_cast<std::size_t>(&part - scene_.parts.data()), std::move(copy));
    }
    /// Inserts the other sides into the scene.
    void insert() {
        for (std::size_t k = others_.size(); k-- > 0;)
            scene_.parts.insert(scene_.parts.begin() + static_cast<std::ptrdiff_t>(others_[k].first) + 1,
                                std::move(others_[k].second));
        others_.clear();
    }

  private:
    Scene& scene_;
    std::vector<std::pair<std::size_t, Part>>
        others_; ///< pairs of the preceding part's index and the new part
};

} // namespace facetmill
