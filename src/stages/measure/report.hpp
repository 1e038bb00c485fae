#pragma once
// The report of measure.

#include "geometry/measure/measure.hpp"
#include "options/fields.hpp"
#include "stages/measure/options.hpp"

namespace facetmill::measure_stage {

struct PrincipalInertia {
    std::array<double, 3> moments{};
    std::array<Vec3, 3> axes{};
    std::array<std::optional<double>, 3> radii{};
};

/// A solid filled with the density.
struct MeasuredSolid {
    double volume = 0, mass = 0;
    std::optional<Vec3> centroid;
    std::array<Vec3, 3> inertia{};
    std::optional<PrincipalInertia> principal;
};
[[nodiscard]] MeasuredSolid measured(const SolidMass& solid, double density);

/// A quantity kept as an attribute.
struct KeptAttribute {
    std::string name, unit, elements; ///< elements is "faces" or "vertices"
    std::size_t missing = 0;          ///< the count of elements without a number
    Statistics values;                ///< statistics of the elements with a number
};

struct MeasuredPart {
    std::string part;
    ShellMass shell;
    std::optional<MeasuredSolid> solid;
    FaceResult faces;
    EdgeResult edges;
    CurvatureResult curvature;
    std::vector<KeptAttribute> attributes{};
};

struct MeasureReport {
    std::string unit;
    double density = 1;
    struct Total {
        ShellMass shell;
        std::optional<MeasuredSolid> solid;
    } total;
    std::vector<MeasuredPart> parts;
};
void declare_measure_report(DeclareFields<MeasureReport>& d);

void warn_of_inside_out(const std::string& part, const MassResult& mass, Context& context);
/// If closed shells count space twice, replaces their solid by the correct one, and warns (W-SHELLS).
void correct_for_shells(const std::string& part, const Mesh& mesh, MassResult& mass, Context& context);
/// The tables of measure: of faces, as CSV, or of models.
struct MeasureTables {
    std::string faces;
    std::vector<Json> models = {}; ///< flat rows
};
/// Writes the files that the options name.
void write_results(const MeasureOptions& o, const MeasureReport& report, const MeasureTables& tables,
                   Context& context);

} // namespace facetmill::measure_stage
