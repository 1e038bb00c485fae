#pragma once
// The values of geometry/measure/measure.hpp for a mesh that comes in pieces: sums, and values that are added
// up afterwards.

#include "geometry/inspect/connectivity.hpp"
#include "geometry/measure/measure.hpp"
#include "mesh/power_scale.hpp"

namespace facetmill {

/// Sums over triangles as seen from a point near them, the common factors left out.
struct MassSums {
    double area = 0, volume = 0; ///< twice, six times
    Vec3 shell, solid;           ///< six times area times centroid; 24 times volume times centroid
    Symmetric sheet, spread;     ///< of the shell 24 times, of the solid 120 times
};

/// The mass of pieces that have each face once.
class MassPieces {
  public:
    /// bounds: of all pieces
    explicit MassPieces(const Box& bounds);
    void add(const Mesh& piece);
    /// closed: whether all pieces together are
    MassResult result(bool closed) const;

  private:
    PowerScale even_, axes_;
    bool plain_; ///< neither scales
    Vec3 even_from_, axes_from_;
    MassSums even_sums_, axes_sums_; ///< axes: unless plain
    std::size_t faces_ = 0;
};

// The following functions expect meshes whose boxes are not far from 1 in size: pieces of the whole mesh,
// scaled by even_scale. Undefined values are not finite. Parallel, and the same for any number of threads.

struct FaceValues {
    std::vector<double> area, angle, aspect_ratio; ///< [faces], [corners], [faces]
    FaceKinds kinds;
    Vec3 signed_area;
};
[[nodiscard]] FaceValues face_values(const Mesh& mesh);

struct EdgeValues {
    std::vector<double> length, turn; ///< [edges]
    EdgeResult counts;                ///< without statistics
};
/// turns: decide which edges count, as in connectivity_of; empty: all do. Others have no values.
[[nodiscard]] EdgeValues edge_values(const Mesh& mesh, const EdgeSettings& settings,
                                     std::span<const Turn> turns = {});

struct CurvatureValues {
    std::vector<double> gaussian, mean; ///< [vertices]
    double total = 0;
};
/// turns: vertices whose turn it is count; empty: all do. Others have no values.
[[nodiscard]] CurvatureValues curvature_values(const Mesh& mesh, std::span<const Turn> turns = {});

// Takes the scale out again.
void unscale(EdgeResult& r, const PowerScale& scale);
void unscale(FaceResult& r, const PowerScale& scale);
void unscale(CurvatureResult& r, const PowerScale& scale);

} // namespace facetmill
