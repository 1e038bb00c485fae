#pragma once
// The colours and texture points at the corners of an object. Private to threemf.

#include "io/threemf/model.hpp"
#include "mesh/mesh.hpp"

namespace facetmill::io::threemf {

/// The attributes of a triangle.
struct Kinds {
    bool coloured = false, textured = false;
};

/// Corners with different looks at a vertex become separate wedges.
class CornerLooks {
  public:
    explicit CornerLooks(std::size_t corners) : of_corner_(corners, 0) {}

    /// The look of a corner. Corners that are never set are white.
    void set(std::size_t corner, const Group& group, std::uint32_t index, const Kinds& kinds);

    /// Adds COLOR_0 and TEXCOORD_0 to a mesh with one wedge per vertex, if any corner has them.
    void add_to(Mesh& mesh);

  private:
    struct Look {
        Colour colour{255, 255, 255, 255};
        std::array<float, 2> point{}; ///< with v from the top
        auto operator<=>(const Look&) const = default;
    };
    std::vector<Look> looks_{Look{}};
    std::map<Look, std::uint32_t> numbers_{{Look{}, 0}};
    std::vector<std::uint32_t> of_corner_; ///< [corners] -> looks_
    bool any_coloured_ = false, any_textured_ = false;
};

} // namespace facetmill::io::threemf
