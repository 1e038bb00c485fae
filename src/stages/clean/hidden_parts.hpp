#pragma once
// The step hidden of clean: faces that no ray from outside reaches, in what viewers show of a scene.

#include "geometry/hidden/hidden.hpp"
#include "stages/clean/options.hpp"
#include "stages/clean/report.hpp"

namespace facetmill::clean_stage {

/// The hidden faces of each part; empty without hidden: true.
///
/// Parts are tested in the pose and at all the instances that viewers show. A face is hidden if it is hidden
/// at every instance. Parts that an animation or a morph target moves, and parts that viewers do not draw,
/// keep their faces and hide nothing.
class HiddenOfParts {
  public:
    HiddenOfParts(const CleanOptions& o, const Scene& scene, Context& context);

    /// Removes the hidden faces of the part with this number.
    std::optional<HiddenCounts> remove(Part& part, std::size_t number) const;

  private:
    void add_parts(const Scene& shown, const std::vector<std::uint8_t>& judged, Surface& all);

    HiddenFaces found_;
    std::vector<Index> first_;        ///< [parts] number of the first face
    std::vector<std::uint8_t> keeps_; ///< [parts] 1: all faces stay
};

} // namespace facetmill::clean_stage
