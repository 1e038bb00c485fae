#pragma once
// The options of measure.

#include "geometry/quantities/quantities.hpp"
#include "stage/stage.hpp"

namespace facetmill::measure_stage {

/// The name of a quantity that measure keeps as an attribute.
struct QuantityName {
    const Quantity* quantity = nullptr;
};

/// The object that a row of a table describes.
enum class Per { face, part, scene };

struct MeasureOptions {
    double density = 1;
    Angle feature_angle = Angle::degrees(30);
    std::vector<QuantityName> attributes;
    std::optional<PathText> with;
    std::optional<double> missing;
    Per per = Per::face;
    Angle overhang_angle = Angle::degrees(45);
    std::vector<PathText> path;
};

void declare_measure(Declare<MeasureOptions>& d);
/// Checks the formats of the files, which the declaration cannot express.
void verify_measure(const MeasureOptions& o, const Value& given, Problems& problems);
[[nodiscard]] StageFiles files_of_measure(const MeasureOptions& o);

/// Whether the file is a table, instead of all results as JSON.
bool is_table(const PathText& path);
/// Whether a file lists faces, or models (parts or the scene).
bool lists_faces(const MeasureOptions& o);
bool lists_models(const MeasureOptions& o);

/// Whether an attribute compares with the scene as loaded.
bool is_from_load(const MeasureOptions& o);

} // namespace facetmill::measure_stage

namespace facetmill {

template <>
struct OptionType<measure_stage::QuantityName> {
    static constexpr OptionKind kind = OptionKind::text;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, measure_stage::QuantityName& out, Problems& problems);
    static std::string print(const measure_stage::QuantityName& name);
    static Json schema();
    static std::optional<double> magnitude(const measure_stage::QuantityName&) { return {}; }
};

} // namespace facetmill
