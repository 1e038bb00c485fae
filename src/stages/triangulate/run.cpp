#include "geometry/triangulate/triangulate.hpp"

#include "base/portable_math.hpp"
#include "geometry/triangulate/face_kinds_fields.hpp"
#include "geometry/triangulate/pair_triangles.hpp"
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

struct TriangulatedPart {
    std::string part;
    FaceKinds kinds;
    std::size_t cut = 0, fans = 0;
    std::optional<std::size_t> quads, triangles; ///< of pairing
};

struct TriangulateReport {
    std::vector<TriangulatedPart> parts;
};

void declare_part(DeclareFields<TriangulatedPart>& d) {
    d.field("part", &TriangulatedPart::part, "Its name.");
    d.object("faces", &TriangulatedPart::kinds, "The faces that came in.", declare_face_kinds);
    d.field("cut", &TriangulatedPart::cut, "Faces that were cut into triangles.");
    d.field("fans", &TriangulatedPart::fans, "Those of them that were cut as fans, which may overlap.");
    d.field("quads", &TriangulatedPart::quads, "Pairs of triangles that became quads.")
        .only_when("quads are asked for");
    d.field("triangles", &TriangulatedPart::triangles, "Triangles that are left.")
        .only_when("quads are asked for");
}

void declare_report(DeclareFields<TriangulateReport>& d) {
    d.list("parts", &TriangulateReport::parts, "Each part that was triangulated.", declare_part);
}

Scene run(Scene scene, const TriangulateOptions& o, Context& context, TriangulateReport& report) {
    std::size_t fans = 0;
    context.for_each_part(scene, [&](Part& part) {
        auto result = triangulate(part.mesh);
        TriangulatedPart entry{part.name, result.kinds, result.cut, result.fans, {}, {}};
        fans += result.fans;
        part.mesh = std::move(result.mesh);
        if (o.to == To::quads) {
            auto paired = pair_triangles(part.mesh, {.cos_bend = cosine(o.bend.radians)});
            part.mesh = std::move(paired.mesh);
            entry.quads = paired.quads;
            entry.triangles = paired.triangles;
            result.fates = std::move(paired.fates);
        }
        context.ledger(part, result.fates);
        report.parts.push_back(std::move(entry));
    });
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
    declare, declare_report, run)};

} // namespace

} // namespace facetmill
