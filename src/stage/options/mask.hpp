#pragma once
// The option `mask` of the shaping stages.

#include "geometry/edit/mask.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The group's fields, for Declare::group.
void declare_mask(Declare<MaskSettings>& d);

/// Its help.
inline constexpr const char* mask_help =
    "Which vertices move, and what share of the way: those whose faces all have the material and the group, "
    "times the attribute.";

/// The masks of the parts that a stage works on, and a warning when they leave nothing to move anywhere.
class MaskOfParts {
  public:
    MaskOfParts(const Scene& scene, const std::optional<MaskSettings>& settings)
        : scene_(scene), settings_(settings) {}

    /// vertex_mask of the part; empty without settings.
    std::vector<double> of(const Part& part);
    /// Warns (W-MASK) when no vertex of any part was selected.
    void warn_if_idle(Context& context) const;

  private:
    const Scene& scene_;
    const std::optional<MaskSettings>& settings_;
    std::size_t vertices_ = 0, selected_ = 0;
};

} // namespace facetmill
