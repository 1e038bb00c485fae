#pragma once
// Texture coordinates for surfaces that have none: charts of low stretch, packed into one square.

#include "base/refusal.hpp"
#include "mesh/mesh.hpp"

#include <span>

namespace facetmill {

struct UnwrapSettings {
    /// The largest L2 stretch of a chart: 1 is isometric. See UnwrapStretch.
    double max_stretch = 1.1;
    std::size_t texture = 2048; ///< the side of the square, in texels
    /// Texels per unit of length in world space. Above 0, this gives the scale, and the square becomes the
    /// smallest power of two that holds all charts.
    double texels_per_unit = 0;
    std::size_t gutter = 4; ///< the least number of empty texels between charts
};

/// A mesh of triangles, and its transform to the world, where lengths are measured.
struct UnwrapInput {
    const Mesh* mesh = nullptr;
    Transform to_world = {};
};

/// Stretch after P. V. Sander, J. Snyder, S. J. Gortler and H. Hoppe, "Texture mapping progressive meshes"
/// (2001). A triangle maps from the texture to the surface with singular values G >= g, where charts are
/// scaled to their area on the surface. Its L2 stretch is sqrt((G^2 + g^2) / 2), and its largest stretch is
/// G. The L2 stretch of charts is the root of the mean square, weighted by area.
struct UnwrapStretch {
    double l2 = 1, largest = 1;
    double ratio = 1; ///< the largest G / g
};

/// Texture coordinates of a mesh.
struct UnwrappedMesh {
    std::vector<float> coordinates;  ///< [2 * corners] u and v, with v from the top
    std::vector<Index> corner_point; ///< [corners] point of the texture, numbered over all meshes
    std::vector<Index> face_chart;   ///< [faces] chart, numbered over all meshes
};

struct UnwrapLayout {
    std::vector<UnwrappedMesh> meshes;
    std::size_t charts = 0;
    UnwrapStretch stretch;
    double used = 0;            ///< the share of the square that charts cover
    double cut_length = 0;      ///< length of the edges between two faces that are apart in the texture
    double texels_per_unit = 0; ///< texels per unit of length
    std::size_t texture = 0;    ///< the side of the square, in texels
    std::size_t thin_faces = 0; ///< faces without area, or too thin: they get an area in the texture
};

/// Divides the surfaces of all meshes into charts, flattens each chart, and packs them into the unit square.
/// Charts first grow along features and curvature: the pair of neighbouring charts merges that is closest in
/// the metric of D. Cohen-Steiner, P. Alliez and M. Desbrun, "Variational shape approximation" (2004), pair
/// by pair as in M. Garland, A. Willmott and P. S. Heckbert, "Hierarchical face clustering on polygonal
/// surfaces" (2001). A chart is flattened as rigidly as possible (L. Liu, L. Zhang, Y. Xu, C. Gotsman and S.
/// J. Gortler, "A local/global approach to mesh parameterization", 2008). Then flat neighbours merge along
/// their border while the stretch allows it (after O. Sorkine, D. Cohen-Or, R. Goldenthal and D. Lischinski,
/// "Bounded-distortion piecewise mesh parameterization", 2002).
///
/// Guarantees, tested with exact arithmetic on the resulting coordinates: every face is in one chart and has
/// a positive area, in the orientation of the face. Charts do not overlap themselves or each other, and
/// `gutter` empty texels separate them. A chart is connected over edges; it is a disk, or a disk with holes.
/// A face with a corner at the same vertex twice is a chart by itself.
///
/// Any triangles are allowed. Edges with one, three or more faces, or whose faces disagree in orientation,
/// end charts. Throws a limit error (E-UNWRAP-FULL) if the charts do not fit with their gutters. The result
/// does not depend on the number of threads. About O(n log n).
[[nodiscard]] UnwrapLayout unwrap(std::span<const UnwrapInput> inputs, const UnwrapSettings& settings);

/// Gives the mesh the coordinates as TEXCOORD_{set}, in float32. Wedges whose corners have different points
/// in the texture are separated; all other attributes are copied. keep: existing sets from `set` on get the
/// next higher number; otherwise a set with this number is replaced. Returns the changes.
[[nodiscard]] AttributeChanges put_coordinates(Mesh& mesh, const UnwrappedMesh& coordinates, int set,
                                               bool keep);

} // namespace facetmill
