#include "geometry/triangulate/triangulate.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "geometry/triangulate/face_kinds_fields.hpp"
#include "stage/stage.hpp"
#include "stages/triangulate/help.hpp"

namespace facetmill::triangulate_stage {

namespace {

enum class To { triangles, quads };

struct TriangulateOptions {
    To to = To::triangles;
    Angle feature_angle = Angle::degrees(10);
};

void declare(Declare<TriangulateOptions>& d) {
    d.choice<To>("to", &TriangulateOptions::to,
                 {{"triangles", To::triangles, "every face becomes triangles"},
                  {"quads", To::quads, "pairs of triangles then become quads, the most square pairs first"}},
                 "The faces to make.")
        .primary();
    d.option("feature_angle", &TriangulateOptions::feature_angle,
             "With to: quads, keeps feature edges. An edge is a feature if the normals of its two faces "
             "differ by more than this angle.")
        .between(0, 90);
}

struct TriangulatedPart {
    std::string part;
    FaceKinds kinds;
    std::size_t cut = 0, fans = 0, filled = 0;
    std::optional<std::size_t> quads = {}, triangles = {}; ///< counts of pairing
};

struct TriangulateReport {
    std::vector<TriangulatedPart> parts;
};

void declare_part(DeclareFields<TriangulatedPart>& d) {
    d.field("part", &TriangulatedPart::part, "The name of the part.");
    d.object("faces", &TriangulatedPart::kinds, "The faces of the input.", declare_face_kinds);
    d.field("cut", &TriangulatedPart::cut, "Faces that were cut into triangles.");
    d.field("fans", &TriangulatedPart::fans, "Faces that were cut as fans, which may overlap.");
    d.field("filled", &TriangulatedPart::filled,
            "Self-intersecting faces that were filled by winding number.");
    d.field("quads", &TriangulatedPart::quads, "Pairs of triangles that became quads.")
        .only_when("quads are requested");
    d.field("triangles", &TriangulatedPart::triangles, "Triangles that remain.")
        .only_when("quads are requested");
}

void declare_report(DeclareFields<TriangulateReport>& d) {
    d.list("parts", &TriangulateReport::parts, "Each triangulated part.", declare_part);
}

Scene run(Scene scene, const TriangulateOptions& o, Context& context, TriangulateReport& report) {
    std::size_t fans = 0, overlapping = 0;
    context.for_each_part(scene, [&](Part& part) {
        const CrossingFaces filled = fill_crossing_faces(part.mesh);
        auto result = triangulate(filled.mesh ? *filled.mesh : part.mesh);
        if (filled.mesh) result.changes = changes_in_sequence(filled.changes, std::move(result.changes));
        TriangulatedPart entry{.part = part.name,
                               .kinds = filled.mesh ? face_kinds(part.mesh) : result.kinds,
                               .cut = result.cut + filled.filled,
                               .fans = result.fans,
                               .filled = filled.filled};
        overlapping += filled.overlapping;
        fans += result.fans;
        part.mesh = std::move(result.mesh);
        if (o.to == To::quads) {
            auto paired = pair_triangles(part.mesh, {.min_cosine = cosine(o.feature_angle.radians)});
            part.mesh = std::move(paired.mesh);
            entry.quads = paired.quads;
            entry.triangles = paired.triangles;
            result.changes = std::move(paired.changes);
        }
        context.attribute_changes(part, result.changes);
        report.parts.push_back(std::move(entry));
    });
    warn_of_fans({.fans = fans, .overlapping = overlapping}, context);
    return scene;
}

const RegisterStage registered = make_stage<StageOf<run>>(
    {.name = "triangulate",
     .also_called = "tessellate tessellation",
     .about = help::triangulate::about,
     .details = help::triangulate::details,
     .examples = {"triangulate", "triangulate: quads", "triangulate: {to: quads, feature_angle: 5deg}"},
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::triangulate_stage
