#pragma once
// The unshaded colours of the elements in a picture.

#include "geometry/render/canvas.hpp"

namespace facetmill {

/// The grey of surfaces without a colour of their own.
inline constexpr Colour plain_grey{0.72f, 0.74f, 0.78f};

/// A position on a face: the wedges of its corners and their weights, which sum to one. For a single vertex,
/// whose wedge may be unknown (none), the face is none.
struct FacePlace {
    Index face = none;
    std::array<Index, 3> wedges{none, none, none};
    Vec3 weights{1, 0, 0};
};

/// The attribute's element at corner k of the position; none if it has no element.
[[nodiscard]] inline Index element_at(const Attribute& a, const Mesh& mesh, const FacePlace& place,
                                      std::size_t k) {
    if (a.domain == Domain::face) return place.face;
    if (a.domain == Domain::wedge || place.wedges[k] == none) return place.wedges[k];
    return mesh.vertex_of_wedge(place.wedges[k]);
}

/// The first N components of an attribute, interpolated with the weights of a face position.
template <std::size_t N>
[[nodiscard]] std::array<float, N> mixed(const Attribute& a, const Mesh& mesh, const FacePlace& place) {
    std::array<float, N> sum{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Index i = place.weights[k] == 0 ? none : element_at(a, mesh, place, k);
        if (i == none) continue;
        for (std::size_t c = 0; c < N && c < static_cast<std::size_t>(a.components); ++c)
            sum[c] += static_cast<float>(place.weights[k] * a.value(i, static_cast<int>(c)));
    }
    return sum;
}

/// The colours of a part.
class Painter {
  public:
    /// mesh: the part's mesh, or its triangles. number: the part's number among the shown parts.
    Painter(const Mesh& mesh, const Scene& scene, const PictureSettings& settings, std::size_t number,
            const ValueRange& range);

    /// The colour and alpha without textures.
    Texel of(const FacePlace& place) const;
    /// The textures and other properties of the face's material; null if its material is not used.
    const MaterialLook* look(Index face) const { return primitive(face).look; }
    /// Whether the face's material has holes or blends, so that the face does not fully cover faces behind
    /// it.
    bool has_holes(Index face) const { return has_alpha(face, MaterialLook::Alpha::mask); }
    bool blends(Index face) const { return has_alpha(face, MaterialLook::Alpha::blend); }
    bool any_blends() const;
    /// The uniform colour of the face before shading; null if it varies: with a look, vertex colours, values
    /// or normals.
    const Texel* plain(Index face) const {
        const PrimitivePaint& paint = primitive(face);
        return values_ || by_normal_ || paint.coloured || paint.look ? nullptr : &paint.colour;
    }
    bool double_sided(Index face) const { return primitive(face).double_sided; }
    bool by_normal() const { return by_normal_; }

  private:
    struct PrimitivePaint {
        Texel colour{};
        bool double_sided = false;
        bool coloured = false; ///< colours_ apply too
        const MaterialLook* look = nullptr;
    };
    const PrimitivePaint& primitive(Index face) const {
        if (face == none || !primitive_of_face_) return primitives_.front();
        return primitives_[std::min<std::size_t>((*primitive_of_face_)[face], primitives_.size() - 1)];
    }
    bool has_alpha(Index face, MaterialLook::Alpha alpha) const {
        const MaterialLook* look = primitive(face).look;
        return look && look->alpha == alpha;
    }
    Texel of_value(const FacePlace& place) const;

    const Mesh& mesh_;
    const std::vector<std::uint32_t>* primitive_of_face_ = nullptr; ///< null: all faces belong to the first
    const Attribute* colours_ = nullptr; ///< the colours of the mesh, if they are used
    const Attribute* values_ = nullptr;  ///< the attribute shown instead of colours
    ValueRange range_;
    bool by_normal_ = false;
    std::vector<PrimitivePaint> primitives_;
};

} // namespace facetmill
