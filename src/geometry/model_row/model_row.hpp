#pragma once
// The measures of a model for tables with a row per model or part. The columns are declared once, for
// batches, for measure, and for their help.

#include "geometry/inspect/inspect.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

struct ModelRowSettings {
    /// In radians: a face overhangs if it looks down and its slope against the plate is below this angle.
    double overhang_angle = 0.78539816339744830962;
    bool walls = true; ///< measures the smallest wall, which takes the longest
};

/// The measured values of a model, in the order of model_columns().
struct ModelRow {
    std::vector<std::optional<double>> values; ///< empty: not measured
    std::string unit;                          ///< the unit of lengths

    bool measured() const { return !values.empty(); }
};

struct ModelColumn {
    std::string_view name;  ///< the key in JSON and the heading in CSV
    std::string_view title; ///< the heading in tables for people
    std::string_view help;
    PropertyKind kind = PropertyKind::length;

    bool is_count() const { return kind == PropertyKind::count; }
};
[[nodiscard]] std::span<const ModelColumn> model_columns();

/// The measures of all parts together, in world space.
[[nodiscard]] ModelRow model_row(const Scene& scene, const ModelRowSettings& settings);
/// The measures of a part. The scene gives the unit and the up axis.
[[nodiscard]] ModelRow model_row(const Scene& scene, const Part& part, const ModelRowSettings& settings);

} // namespace facetmill
