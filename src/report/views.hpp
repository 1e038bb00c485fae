#pragma once
// Data of a run that only pages show: numbers with pictures.

#include "base/math/vec.hpp"
#include "geometry/measure/shape_histograms.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace facetmill::report {

/// Signed distances of a scene from an earlier one, as colours. Lengths are in scene units.
struct DeviationView {
    std::string from;       ///< "the scene as loaded"
    std::string unit;       ///< empty: unknown
    bool posed = false;     ///< distances are those in the pose that pictures show, not in bind pose
    double diagonal = 0;    ///< of the earlier scene: the basis of percentages
    std::size_t points = 0; ///< that were looked up
    std::size_t caps = 0;   ///< faces that are not measured: they close cuts that the earlier scene has not
    double low = 0, high = 0, mean = 0, rms = 0; ///< mean and rms of the amounts over the area
    Vec3 worst;
    double worst_distance = 0;
    double limit = 0;                  ///< the colours go from -limit to limit
    std::vector<std::uint64_t> counts; ///< of points of the area in equal bins from -limit to limit, where
                                       ///< the first and the last also have what lies beyond
    /// PNGs in base64: of the whole, from behind, and of the worst place; empty: left out.
    std::string picture, behind, close;
};

/// A scene that was written, or at which a run ended.
struct OutputView {
    std::string name; ///< "out.glb", "the scene at 'validate'"
    std::string unit; ///< of lengths; empty: unknown
    std::size_t faces = 0;
    ShapeHistograms shape, input_shape; ///< input: of the scene as loaded
    std::size_t input_faces = 0;        ///< 0: nothing was loaded
    std::optional<DeviationView> deviation;
    std::string no_deviation; ///< why no deviation exists
    bool differs = false;     ///< from the scene as loaded, wherever that is shown
    std::string same_as{};    ///< another stage with the same deviation
};

} // namespace facetmill::report
