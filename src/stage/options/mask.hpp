#pragma once
// The options `mask` and `caps` of the shaping stages: they select the vertices that move.

#include "geometry/edit/mask.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The group's fields, for Declare::group.
void declare_mask(Declare<MaskSettings>& d);

/// The help of the group.
inline constexpr const char* mask_help =
    "Limits the movement of vertices. A vertex moves if all its faces have the given material and group. The "
    "attribute scales the movement of each vertex.";

/// Whether the caps of cuts may move.
enum class Caps { fixed, free };

template <class Options>
void declare_caps(Declare<Options>& d, Caps Options::*caps) {
    d.template choice<Caps>("caps", caps,
                            {{"fixed", Caps::fixed, "the caps and the edges of the cut stay planar"},
                             {"free", Caps::free, "vertices of caps move like all others"}},
                            "How to handle the vertices of caps, the faces with which clip, crop and tile "
                            "close their cuts (face attribute cut_id).");
}

/// The masks of the selected parts, with a warning if they leave no vertex to move.
class MaskOfParts {
  public:
    MaskOfParts(const Scene& scene, const std::optional<MaskSettings>& settings, Caps caps)
        : scene_(scene), settings_(settings), caps_(caps) {}

    /// vertex_mask of the part, with 0 for fixed caps; empty if all vertices move.
    std::vector<double> of(const Part& part);
    /// Warns (W-MASK) if the mask leaves no vertex of any part to move.
    void warn_if_idle(Context& context) const;

  private:
    const Scene& scene_;
    const std::optional<MaskSettings>& settings_;
    Caps caps_;
    std::size_t vertices_ = 0, selected_ = 0, moving_ = 0; ///< counts for parts with a mask
};

} // namespace facetmill
