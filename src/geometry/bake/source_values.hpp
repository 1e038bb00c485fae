#pragma once
// The values that a source shows at points of its faces.

#include "geometry/bake/bake.hpp"

#include <span>

namespace facetmill::baking {

/// A numeric attribute as floats, to read it quickly.
struct FloatColumn {
    std::vector<float> numbers;
    std::size_t components = 0;
    Domain domain = Domain::wedge;

    FloatColumn() = default;
    explicit FloatColumn(const Attribute* a);
    explicit operator bool() const { return components > 0; }
};

/// A point of a face of the source.
struct SourcePlace {
    Index face = none;
    std::array<double, 3> weights{};
};

/// How the position in the source changes from texel to texel, right and down.
struct TexelSteps {
    Vec3 right, down;
};

struct SourceValues {
    Texel base{0, 0, 0, 1}; ///< linear
    std::array<float, 3> emission{};
    float occlusion = 1, roughness = 1, metalness = 0;
    bool has_occlusion = false; ///< a texture gave the occlusion
    Vec3 normal;                ///< unit length, in world space
    Vec3 facet;                 ///< the normal of the face, unit length or zero
};

/// Reads values. The source must outlive it.
class SourceReader {
  public:
    explicit SourceReader(const BakeSource& source);

    SourceValues at(const SourcePlace& place, const TexelSteps& steps) const;
    bool is_double_sided(Index face) const { return sides_[face] != 0; }

  private:
    struct Point;
    template <std::size_t N>
    std::array<double, N> mixed(const FloatColumn& column, const Point& point) const;
    Texel sampled(const Texture& texture, const Point& point) const;
    Vec3 normal(const Point& point, const MaterialLook& look) const;

    const BakeSource& source_;
    FloatColumn colours_, normals_, tangents_;
    std::vector<FloatColumn> uvs_;
    std::vector<MaterialLook> looks_;       ///< by primitive
    std::vector<std::uint8_t> coloured_;    ///< by primitive: vertex colours apply
    std::vector<std::uint32_t> primitives_; ///< [faces]; empty: all are the first
    std::vector<std::uint8_t> sides_;       ///< [faces] both sides are visible
};

} // namespace facetmill::baking
