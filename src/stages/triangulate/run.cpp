#include "geometry/triangulate/triangulate.hpp"

#include "base/portable_math.hpp"
#include "geometry/triangulate/pair_triangles.hpp"
#include "report/face_kinds.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class To { triangles, quads };

struct TriangulateOptions {
    To to = To::triangles;
    Angle bend = Angle::degrees(10);
};

void declare(Declare<TriangulateOptions>& d) {
    d.choice<To>("to", &TriangulateOptions::to,
                 {{"triangles", To::triangles, "every face becomes triangles"},
                  {"quads", To::quads, "then pairs of triangles become quads, the squarest first"}},
                 "What faces become.")
        .primary();
    d.option("bend", &TriangulateOptions::bend,
             "How much the halves of a quad may be bent from each other (with to: quads).")
        .between(0, 90);
}

Scene run(Scene scene, const TriangulateOptions& o, Context& context) {
    Json parts = Json::array();
    std::size_t fans = 0;
    context.for_each_part(scene, [&](Part& part) {
        auto result = triangulate(part.mesh);
        Json entry = {{"part", part.name},
                      {"faces", report::face_kinds_json(result.kinds)},
                      {"cut", result.cut},
                      {"fans", result.fans}};
        fans += result.fans;
        part.mesh = std::move(result.mesh);
        if (o.to == To::quads) {
            auto paired = pair_triangles(part.mesh, {.cos_bend = cosine(o.bend.radians)});
            part.mesh = std::move(paired.mesh);
            entry["quads"] = paired.quads;
            entry["triangles"] = paired.triangles;
            result.fates = std::move(paired.fates);
        }
        context.ledger(part, result.fates);
        parts.push_back(std::move(entry));
    });
    context.result()["parts"] = std::move(parts);
    if (fans > 0)
        context.warn(
            "W-FANS",
            fmt::format(
                "{} faces that intersect themselves or have no area were cut as fans, whose triangles may "
                "overlap",
                fans));
    return scene;
}

const RegisterStage registered{make_stage<TriangulateOptions>(
    {.name = "triangulate",
     .about = "Cuts faces of any kind into triangles, or pairs triangles to quads.",
     .details =
         "Every face of n corners becomes n - 2 triangles without new points, so that closed stays closed. "
         "Convex quads are "
         "cut along the shorter diagonal; convex and concave faces, and faces with holes joined by "
         "coincident edges, by "
         "constrained Delaunay triangulation of the corners seen along the coordinate axis nearest to the "
         "face's normal. "
         "That is the projection for faces that are not planar as well. Faces that intersect themselves are "
         "filled by "
         "winding: a fan whose triangles add up, at every point, to how often the face winds around it.\n\n"
         "The report counts the faces that came in by kind (triangle, quad, convex, concave, complex, "
         "self-intersecting, "
         "degenerate) and those that are not planar, with the largest deviation. Vertices, wedges and their "
         "attributes stay "
         "as they are; face attributes are copied. Source: the note on polygon types.",
     .examples = {"triangulate", "triangulate: quads", "triangulate: {to: quads, bend: 5deg}"}},
    declare, run)};

} // namespace

} // namespace facetmill
