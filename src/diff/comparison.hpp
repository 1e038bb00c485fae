#pragma once
// The comparison of two scenes for `facetmill diff`.

#include "diff/conversion.hpp"
#include "diff/items.hpp"
#include "diff/pictures.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/record.hpp"

#include <set>

namespace facetmill::report {

/// The sections of a comparison in display order.
inline constexpr const char* comparison_sections[] = {"counts",    "topology", "geometry", "attributes",
                                                      "materials", "parts",    "document"};

struct ComparisonSettings {
    std::set<std::string> ignored; ///< sections that are shown but do not affect the verdict
    DeviationSettings deviation;
    /// The allowed distance between the surfaces, in units of the first scene or percent of its diagonal.
    /// Without limits, the maximum is a ten-thousandth of a percent: the precision of float32 coordinates.
    struct Limit {
        double amount = 0;
        bool percent = false;
    };
    std::optional<Limit> maximum, rms, mean;
    double attribute_limit = 1e-6; ///< the allowed difference of attribute values
    std::optional<Origin> origin;  ///< none: the scenes have the units and axes that their files state
};

/// A line of the comparison.
struct Difference {
    std::string section, name;
    Json a, b;
    bool same = true;
    std::string note;       ///< "at most 0.5 %", "largest difference 0.2 at vertex 7"
    bool compared = true;   ///< false: it could not be compared, for the reason in the note
    bool of_places = false; ///< of a material: its location, not its properties
};

/// Content of a file that was not read, so it could not be compared.
struct LeftOut {
    bool of_a = false; ///< in the first file, else in the second
    std::string what;
};

/// The bytes of a file and its neighbours, by kind.
struct SizeOnDisk {
    std::uint64_t bytes = 0;
    io::ByteKinds kinds;
};

struct Comparison {
    std::vector<Difference> lines;                               ///< including equal ones
    std::optional<DeviationResult> deviation;                    ///< none if geometry is ignored
    const char *geometry_a = "nothing", *geometry_b = "nothing"; ///< surface, points, nothing
    std::vector<LeftOut> left_out;
    std::set<std::string> ignored;
    Properties properties_a, properties_b;
    std::vector<ItemChange> items; ///< parts and materials by name
    std::optional<SizeOnDisk> size_a = {}, size_b = {};
    std::string hint; ///< a unit or an up axis that would explain the geometric difference

    /// Whether a line that affects the verdict differs.
    bool differs() const;
    /// Whether nothing was left out, and all lines that affect the verdict were compared.
    bool complete() const;
};

/// Compares two scenes in world space; both must have the same convention. It compares the properties of
/// property_table(), and the deviation in both directions, of surfaces, or of points for a scene without
/// faces. Attributes are compared by name, domain and type, and by value if the element counts agree.
/// Materials are compared by name, look and faces, parts by name, and glTF documents by their content
/// besides meshes.
Comparison compare(const Scene& a, const Scene& b, const ComparisonSettings& settings = {});

/// {a, b, same, complete, left_out, sections: {counts: {same, decides, lines: [{name, a, b, same, compared,
/// note}]}, ...}, geometry_of: {a, b}, deviation}.
Json to_json(const Comparison& comparison, const std::string& name_a, const std::string& name_b);
/// A table; equal lines only with `all`.
std::string to_text(const Comparison& comparison, const std::string& name_a, const std::string& name_b,
                    bool all);
/// A self-contained page: the verdict, both scenes from the same camera with a slider, and both files side
/// by side. It lists added, removed and changed parts and materials, distances as colours, and the lines
/// that differ. Files have the shortest distinct names.
std::string to_html(const Comparison& comparison, const std::string& path_a, const std::string& path_b,
                    const ComparisonPictures& pictures);
/// "agree", "differ", "agree in everything that was compared".
std::string verdict_of(const Comparison& comparison);
/// "counts, geometry": the sections with a difference that affects the verdict.
std::string differs_in(const Comparison& comparison);
/// Tables for the description of a change; names as in to_html.
std::string to_markdown(const Comparison& comparison, const std::string& path_a, const std::string& path_b);
Json comparison_schema();

} // namespace facetmill::report
