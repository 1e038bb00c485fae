#pragma once
// The colours of what a picture shows, before shading.

#include "geometry/render/canvas.hpp"

namespace facetmill {

/// The grey of surfaces without a colour of their own.
inline constexpr Colour plain_grey{0.72f, 0.74f, 0.78f};

/// The smallest and the largest finite value of the attribute's first component over the shown parts whose
/// attribute holds numbers, not identifiers; none when there is none. Sets found when any part has it.
std::optional<std::array<double, 2>> range_of(const Scene& scene, const PictureSettings& settings,
                                              bool& found);

/// The colours of one part.
class Painter {
  public:
    /// mesh is the part's, or its triangles; number counts the shown parts.
    Painter(const Mesh& mesh, const Scene& scene, const PictureSettings& settings, std::size_t number,
            const std::array<double, 2>& range);

    /// Of a wedge as a corner of the face; face none: of a vertex on its own.
    Colour of(Index face, Index wedge) const;
    bool double_sided(Index face) const { return look(face).double_sided; }
    bool by_normal() const { return by_normal_; }

  private:
    struct Look {
        Colour colour{};
        bool double_sided = false;
    };
    const Look& look(Index face) const;

    const Mesh& mesh_;
    const Attribute* colours_ = nullptr; ///< those of the mesh, when they count
    const Attribute* values_ = nullptr;  ///< the attribute to show instead
    std::array<double, 2> range_;
    bool by_normal_ = false;
    std::vector<Look> looks_; ///< by primitive
};

} // namespace facetmill
