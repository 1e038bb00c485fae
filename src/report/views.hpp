#pragma once
// The data of a run that only pages show: numbers with pictures.

#include "base/math/vec.hpp"
#include "geometry/measure/shape_histograms.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace facetmill::report {

/// Signed distances of a scene from an earlier scene, as colours. Lengths are in scene units.
struct DeviationView {
    std::string from;       ///< "the scene as loaded"
    std::string unit;       ///< empty: unknown
    bool posed = false;     ///< measured in the pose of the pictures, not in bind pose
    double diagonal = 0;    ///< diagonal of the earlier scene, the reference of percentages
    std::size_t points = 0; ///< sample points
    std::size_t caps = 0;   ///< unmeasured faces: they close cuts that the earlier scene lacks
    double low = 0, high = 0, mean = 0, rms = 0; ///< mean and rms of absolute distances, by area
    Vec3 worst;
    double worst_distance = 0;
    double limit = 0; ///< the colours go from -limit to limit
    std::vector<std::uint64_t>
        counts; ///< sample points in equal bins from -limit to limit; the outer bins include points beyond
    /// PNGs in base64: the whole, from behind, and the worst location; empty: omitted.
    std::string picture, behind, close;
};

/// A written scene, or the scene where a run ended.
struct OutputView {
    std::string name; ///< "out.glb", "the scene at 'validate'"
    std::string unit; ///< unit of lengths; empty: unknown
    std::size_t faces = 0;
    ShapeHistograms shape, input_shape; ///< input_shape: of the scene as loaded
    std::size_t input_faces = 0;        ///< 0: no scene was loaded
    std::optional<DeviationView> deviation;
    std::string no_deviation; ///< the reason if there is none
    bool differs = false;     ///< true if it differs from the scene as loaded
    std::string same_as{};    ///< the stage with the same deviation
};

} // namespace facetmill::report
