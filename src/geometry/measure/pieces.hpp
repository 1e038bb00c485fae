#pragma once
// Measures a mesh in pieces: the values of geometry/measure/measure.hpp as sums, or as values to be added up
// later.

#include "geometry/inspect/connectivity.hpp"
#include "geometry/measure/measure.hpp"
#include "mesh/power_scale.hpp"

namespace facetmill {

/// Sums over triangles relative to a nearby point, without the common factors.
struct MassSums {
    double area = 0, volume = 0; ///< twice the area, six times the volume
    Vec3 shell, solid;           ///< six times area times centroid; 24 times volume times centroid
    Symmetric sheet, spread;     ///< 24 times the shell's spread, 120 times the solid's
};

/// Sums the mass of pieces, which together contain each face once.
class MassPieces {
  public:
    /// bounds: the box of all pieces
    explicit MassPieces(const Box& bounds);
    void add(const Mesh& piece);
    /// closed: whether the whole mesh is closed
    MassResult result(bool closed) const;

  private:
    PowerScale even_, axes_;
    bool plain_; ///< the mesh needs no scaling
    Vec3 even_from_, axes_from_;
    MassSums even_sums_, axes_sums_; ///< the sums by axes_ are used unless plain_
    std::size_t faces_ = 0;
};

// The following functions expect pieces of the whole mesh, scaled by even_scale to a box of size near 1.
// Undefined values are not finite. Parallel; results do not depend on the number of threads.

struct FaceValues {
    std::vector<double> area, angle, aspect_ratio; ///< [faces], [corners], [faces]
    FaceKinds kinds;
    Vec3 signed_area;
};
[[nodiscard]] FaceValues face_values(const Mesh& mesh);

struct EdgeValues {
    std::vector<double> length, turn; ///< [edges]
    EdgeResult counts;                ///< counts only, without statistics
};
/// turns: select the edges that get values, as in connectivity_of; empty: all edges.
[[nodiscard]] EdgeValues edge_values(const Mesh& mesh, const EdgeSettings& settings,
                                     std::span<const Turn> turns = {});

struct CurvatureValues {
    std::vector<double> gaussian, mean; ///< [vertices]
    double total = 0;
};
/// turns: select the vertices that get values; empty: all vertices.
[[nodiscard]] CurvatureValues curvature_values(const Mesh& mesh, std::span<const Turn> turns = {});

// Converts the values back to unscaled coordinates.
void unscale(EdgeResult& r, const PowerScale& scale);
void unscale(FaceResult& r, const PowerScale& scale);
void unscale(CurvatureResult& r, const PowerScale& scale);

} // namespace facetmill
