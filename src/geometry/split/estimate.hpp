#pragma once
// Estimates the result of a split before it is built.

#include "geometry/split/split.hpp"

namespace facetmill {

/// The numbers of triangles, quads and larger faces, and the corners of the larger faces, from pass to pass.
struct SplitCensus {
    double triangles = 0, quads = 0, larger = 0, larger_corners = 0;

    explicit SplitCensus(const Mesh& mesh);
    double corners() const { return 3 * triangles + 4 * quads + larger_corners; }
    double faces() const { return triangles + quads + larger; }
    /// Replaces the numbers by the largest possible numbers after a pass. n: SplitSettings::grid.
    void pass(SplitMethod method, double n);

  private:
    void set(double t, double q, double l, double c) {
        triangles = t;
        quads = q;
        larger = l;
        larger_corners = c;
    }
};

/// Throws a limit error (E-LIMIT, E-MEMORY) if this many corners, with the mesh's attributes, exceed the
/// index range or the memory.
void refuse_giant_split(const Mesh& mesh, double corners, const SplitWords& words);

} // namespace facetmill
