#include "stages/measure/face_table.hpp"

#include "base/text/words.hpp"
#include "geometry/measure/measure.hpp"
#include "io/csv.hpp"

#include <fmt/format.h>
#include <functional>

namespace facetmill::measure_stage {

namespace {

struct Row {
    const std::string& part;
    Index face;
    std::size_t corners;
    const PolygonResult& polygon;
};

/// Related columns, and their help text.
struct Columns {
    std::vector<const char*> names;
    const char* help;
    std::function<void(const Row&, std::vector<std::string>&)> cells;
};

using Cells = std::vector<std::string>;

void add(Cells& cells, const Vec3& v) {
    for (std::size_t i = 0; i < 3; ++i) cells.push_back(io::csv_number(v[i]));
}

/// Empty for a polygon without moments.
template <class Number>
void add_moment(Cells& cells, const Row& row, Number&& number) {
    cells.push_back(row.polygon.moments ? io::csv_number(number(*row.polygon.moments)) : "");
}

template <polygon::SecondMoments polygon::Moments::*About>
void add_moments(const Row& row, Cells& cells) {
    add_moment(cells, row, [](const polygon::Moments& m) { return (m.*About).x; });
    add_moment(cells, row, [](const polygon::Moments& m) { return (m.*About).y; });
    add_moment(cells, row, [](const polygon::Moments& m) { return (m.*About).xy; });
}

void add_principal(const Row& row, Cells& cells) {
    add_moment(cells, row, [](const polygon::Moments& m) { return m.axes.largest; });
    add_moment(cells, row, [](const polygon::Moments& m) { return m.axes.smallest; });
    const auto& moments = row.polygon.moments;
    const Vec3 major = moments ? row.polygon.frame.direction(moments->axes.major) : Vec3{};
    for (std::size_t i = 0; i < 3; ++i) cells.push_back(moments ? io::csv_number(major[i]) : "");
}

const std::vector<Columns>& columns() {
    static const std::vector<Columns> all{
        {{"part"}, "the name of the part", [](const Row& r, Cells& c) { c.push_back(io::csv_text(r.part)); }},
        {{"face"}, "from 0", [](const Row& r, Cells& c) { c.push_back(std::to_string(r.face)); }},
        {{"corners"}, "how many", [](const Row& r, Cells& c) { c.push_back(std::to_string(r.corners)); }},
        {{"area"}, "", [](const Row& r, Cells& c) { c.push_back(io::csv_number(r.polygon.area)); }},
        {{"x", "y", "z"}, "the centroid", [](const Row& r, Cells& c) { add(c, r.polygon.centroid); }},
        {{"nx", "ny", "nz"}, "the unit normal", [](const Row& r, Cells& c) { add(c, r.polygon.normal); }},
        {{"off_plane"},
         "the largest distance of a corner from the plane",
         [](const Row& r, Cells& c) { c.push_back(io::csv_number(r.polygon.off_plane)); }},
        {{"kind"},
         "triangle, quad, convex, concave, complex, self_intersecting or degenerate",
         [](const Row& r, Cells& c) { c.push_back(polygon::to_string(r.polygon.kind)); }},
        {{"planar"},
         "false if a corner is farther from the plane than float32 rounding can explain",
         [](const Row& r, Cells& c) { c.push_back(r.polygon.planar ? "true" : "false"); }},
        {{"signed_area"},
         "positive if anticlockwise, seen from the positive side of the axis nearest to the normal",
         [](const Row& r, Cells& c) { c.push_back(io::csv_number(r.polygon.signed_area)); }},
        {{"ix_centroid", "iy_centroid", "ixy_centroid"},
         "the second moments of area about the centroid",
         add_moments<&polygon::Moments::about_centroid>},
        {{"ix_origin", "iy_origin", "ixy_origin"},
         "about the point of the plane nearest to the origin",
         add_moments<&polygon::Moments::about_origin>},
        {{"largest", "smallest", "major_x", "major_y", "major_z"},
         "the principal second moments, and the axis of the largest",
         add_principal},
    };
    return all;
}

} // namespace

std::string face_table_head() {
    std::string head;
    for (const Columns& group : columns())
        for (const char* name : group.names) append_item(head, name, ",");
    return head + "\n";
}

std::string face_table_rows(const std::string& part, const Mesh& mesh) {
    std::string table;
    std::vector<Vec3> corners;
    Cells cells;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        corners.clear();
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) corners.push_back(mesh.point(c));
        const PolygonResult polygon = measure_polygon(corners);
        cells.clear();
        for (const Columns& group : columns()) group.cells({part, f, corners.size(), polygon}, cells);
        table += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return table;
}

std::string face_table_help() {
    std::vector<std::string> told;
    for (const Columns& group : columns()) {
        std::string text = fmt::format("{}", fmt::join(group.names, " "));
        if (*group.help) text += fmt::format(" ({})", group.help);
        told.push_back(std::move(text));
    }
    return fmt::format("{}", fmt::join(told, ", "));
}

} // namespace facetmill::measure_stage
