#include "options/other_names.hpp"

#include "base/text/spelling.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct OtherNames {
    std::string_view option;
    std::vector<std::string_view> words;
    std::string_view how =
        {}; ///< extra words if the name alone does not explain the spelling, or the difference
    std::string_view beside = {}; ///< an option that must be known, too
};

/// Made when somebody asks, not at each start. A row counts where its option is known.
const std::vector<OtherNames>& other_names() {
    static const std::vector<OtherNames> all{
        {"closed", {"watertight", "is_watertight", "water_tight", "airtight", "solid", "is_closed"}},
        {"edge_manifold",
         {"non_manifold", "nonmanifold", "non_manifold_edges"},
         "(edge_manifold: true), which says the opposite"},
        {"vertex_manifold", {"non_manifold_vertices"}, "(vertex_manifold: true), which says the opposite"},
        {"edge_manifold", {"manifold", "is_manifold", "2_manifold"}},
        {"vertex_manifold", {"manifold", "is_manifold", "2_manifold"}},
        {"boundary_loops", {"holes", "hole_count", "open_boundaries"}},
        {"boundary_edges", {"open_edges", "border_edges", "naked_edges"}},
        {"self_intersections",
         {"self_intersecting", "self_intersection", "intersections", "overlapping_faces"}},
        {"degenerate_faces", {"degenerate", "degenerates", "zero_area", "slivers"}},
        {"duplicate_faces", {"duplicates", "doubles"}},
        {"isolated_vertices", {"unreferenced", "unreferenced_vertices", "unused_vertices", "loose_vertices"}},
        {"oriented", {"winding", "consistent_winding", "is_winding_consistent"}},
        {"oriented", {"flipped"}, "(oriented: true), which says the opposite"},
        {"outward_oriented", {"normals_outward", "outward"}},
        {"outward_oriented", {"inside_out", "inverted"}, "(outward_oriented: true), which says the opposite"},
        {"euler", {"euler_number", "euler_characteristic"}},
        {"components", {"shells", "bodies", "islands", "body_count", "connected_components"}},
        {"faces",
         {"polygons", "polys", "tris", "triangles", "face_count", "num_faces", "target_faces",
          "target_face_count", "targetfacenum", "count", "polycount"}},
        {"vertices", {"points", "verts", "vertex_count", "num_vertices", "target_vertices"}},
        {"bounds", {"bbox", "bounding_box", "aabb", "extents"}},
        {"max_extent", {"size", "dimensions"}},
        {"wall_thickness", {"thickness", "min_thickness", "minimum_thickness"}},
        {"unit", {"units", "scale_unit", "convert_to", "to_unit"}},
        {"up", {"up_axis", "upaxis", "y_up", "z_up"}},
        {"ratio", {"percent", "percentage", "target_ratio", "fraction", "target", "keep"}},
        {"ratio", {"reduction", "target_reduction"}, "ratio, the share that stays and not the one that goes"},
        {"max_error", {"error", "tolerance", "threshold", "epsilon", "deviation", "max_deviation"}},
        {"lock",
         {"preserve_boundary", "preserve_border", "lock_border", "lock_boundary", "preserve_borders",
          "keep_boundary"},
         "lock: {boundary: true}"},
        {"topology", {"preserve_topology", "preservetopology"}, "(topology: keep)"},
        {"holes", {"fill_holes", "close_holes", "fill", "fill_hole"}, "holes: {method: smooth}"},
        {"weld", {"merge_vertices", "weld_vertices", "merge_close_vertices", "merge", "weld_distance"}},
        {"duplicates", {"remove_duplicates", "remove_doubles", "dedup"}},
        {"isolated", {"remove_unreferenced", "remove_isolated", "unreferenced"}},
        {"components", {"keep_largest", "largest", "largest_component"}, "components: {keep: 1}", "isolated"},
        {"translate", {"move", "offset", "translation", "position"}},
        {"rotate",
         {"rotation", "rotate_x", "rotate_y", "rotate_z", "rx", "ry", "rz"},
         "rotate: {angle: 90, axis: [0, 0, 1]}"},
        {"plane", {"normal", "axis", "origin", "at"}, "(plane: z=0)"},
        {"cap", {"close", "capped", "fill", "fill_cut"}},
        {"draco", {"compress", "compression", "use_draco", "compressed"}},
        {"format", {"type", "file_type", "filetype", "output_format"}},
        {"ascii", {"binary"}, "(ascii: false), which is the default"},
        {"path", {"file", "filename", "output", "out", "input", "in", "svg", "dxf", "csv"}},
        {"iterations", {"steps", "passes", "iters", "n"}},
        {"passes", {"iterations", "levels", "level", "depth"}},
        {"lambda", {"strength", "factor", "weight"}},
        {"thickness", {"distance", "offset", "width", "amount", "wall"}},
        {"spacing", {"layer_height", "layer", "step", "distance", "interval"}},
        {"count", {"slices", "number", "layers"}},
        {"max_edge", {"edge_length", "target_length", "target_edge_length", "max_edge_length"}},
        {"max_size", {"resize", "resolution", "texture_size"}},
        {"fit",
         {"size", "resize", "fit_to", "max_size", "longest", "normalize", "normalise", "height"},
         "(fit: 120mm)"},
        {"with", {"other", "mesh", "path", "file", "tool"}},
        {"view", {"camera", "direction"}},
        {"attributes", {"areas"}, "attributes: area"},
        {"attributes", {"curvature", "curvatures"}, "attributes: [mean_curvature, gaussian_curvature]"},
        {"attribute", {"scalar", "scalars", "field", "scalar_field"}},
        {"colours", {"colors", "color_by"}},
        {"background", {"bg"}},
    };
    return all;
}

bool among(std::string_view name, const std::vector<std::string>& known) {
    return std::find(known.begin(), known.end(), name) != known.end();
}

std::string as_in_table(std::string_view word) {
    std::string same = lower_case(std::string(word));
    std::replace(same.begin(), same.end(), '-', '_');
    return same;
}

/// The rows of the word whose options are known.
std::vector<const OtherNames*> rows_of(std::string_view other_name, const std::vector<std::string>& known) {
    const std::string word = as_in_table(other_name);
    std::vector<const OtherNames*> rows;
    for (const auto& row : other_names())
        if (std::find(row.words.begin(), row.words.end(), word) != row.words.end() &&
            among(row.option, known) && (row.beside.empty() || among(row.beside, known)))
            rows.push_back(&row);
    return rows;
}

std::vector<std::string> options_in(const std::vector<const OtherNames*>& rows) {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const OtherNames* row : rows) names.emplace_back(row->option);
    return names;
}

} // namespace

std::vector<std::string> options_called(std::string_view other_name, const std::vector<std::string>& known) {
    return options_in(rows_of(other_name, known));
}

std::vector<std::string> options_of_same_value(std::string_view other_name,
                                               const std::vector<std::string>& known) {
    auto rows = rows_of(other_name, known);
    std::erase_if(rows, [](const OtherNames* row) { return !row->how.empty(); });
    return options_in(rows);
}

bool means_report(std::string_view option) {
    constexpr std::string_view words[] = {"report",   "reports", "junit",       "junit_xml",
                                          "junitxml", "xunit",   "html_report", "sarif"};
    return std::find(std::begin(words), std::end(words), as_in_table(option)) != std::end(words);
}

std::string hint_for_option(std::string_view word, const std::vector<std::string>& known,
                            std::string otherwise) {
    std::string names;
    for (const OtherNames* row : rows_of(word, known)) {
        if (!row->how.empty()) return fmt::format("here it is {}", row->how);
        names += fmt::format("{}'{}'", names.empty() ? "" : " or ", row->option);
    }
    if (!names.empty()) return fmt::format("'{}' is called {} here", word, names);
    if (means_report(word))
        return "a report is written by the command: --report FILE.xml (JUnit), .json, .html, .md or .txt "
               "before "
               "the first stage, or report: FILE.xml in a pipeline file";
    return otherwise.empty() ? suggestion(word, known) : did_you_mean(word, known, std::move(otherwise));
}

} // namespace facetmill
