#pragma once
// Moves a surface onto another one, rigidly.

#include "geometry/spatial/face_tree.hpp"

namespace facetmill {

struct AlignSettings {
    bool from_axes = true;       ///< tries the principal axes first; otherwise starts where the surface is
    double keep = 0.9;           ///< share of the samples that count, the nearest; above 0, at most 1
    std::size_t samples = 20000; ///< spread evenly over the surface
    int iterations = 100;        ///< at most, after the start was chosen
    std::uint64_t seed = 1;
};

struct AlignResult {
    Transform move;               ///< a rotation and a translation
    double before = 0, after = 0; ///< root mean square distance of the samples that count
    double farthest = 0;          ///< the largest distance of these samples, after
    int iterations = 0;
    std::size_t starts = 0; ///< tried starts
    bool settled = false;
};

/// Finds the rotation and translation that brings the samples of `moving` nearest to `target`. The first
/// start is the current position. With from_axes, further starts are the 24 rotations that map the principal
/// axes to the axes of the target, in any order and with any signs. So symmetric shapes find the best of
/// their poses. Each start gets a few steps with few samples. If starts differ by less than a thousandth of
/// the diagonal, all samples decide between them. The best goes on with all, until a step moves them by less
/// than a hundred-millionth of the diagonal.
///
/// A step is the iterated closest point of Y. Chen and G. Medioni, "Object modelling by registration of
/// multiple range images" (1992): it minimises distances to the planes of the nearest faces. The farthest
/// samples are left out (D. Chetverikov et al., "The trimmed iterative closest point algorithm", 2002).
/// Mirror images do not match, because no step mirrors. Surfaces without area count as their vertices. The
/// identity if one surface has no points. Parallel; the result does not depend on the number of threads.
[[nodiscard]] AlignResult align(const Surface& moving, const Surface& target, const AlignSettings& settings);

} // namespace facetmill
