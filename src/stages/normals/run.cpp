#include "base/math/portable_math.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/normals/tangents.hpp"
#include "geometry/normals/unit_vectors.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/reference_mesh.hpp"
#include "stage/stage.hpp"
#include "stages/normals/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::normals_stage {

namespace {

struct NormalsOptions {
    NormalKind method = NormalKind::smooth;
    Angle feature_angle{pi, "180deg"};
    std::optional<PathText> with;
    std::optional<std::int64_t> tangents; ///< the set of texture coordinates
};

void declare(Declare<NormalsOptions>& d) {
    d.choice<NormalKind>(
         "method", &NormalsOptions::method,
         {{"smooth", NormalKind::smooth,
           "the mean of the face normals around a vertex, weighted by the angles of the faces"},
          {"area", NormalKind::area,
           "the mean weighted by the areas of the faces: large faces stay flat next to narrow bevels"},
          {"flat", NormalKind::flat, "the normals of the faces"},
          {"keep", NormalKind::keep, "the normals of the scene, repaired if necessary"},
          {"none", NormalKind::none, "removes normals and tangents"}},
         "How to compute normals.")
        .primary();
    d.option(
         "feature_angle", &NormalsOptions::feature_angle,
         "Keeps edges sharp if the normals of their two faces differ by more than this angle, for example "
         "40deg.")
        .also_called("crease crease_angle angle auto_smooth smoothing_angle sharp")
        .between(0, 180);
    d.option("with", &NormalsOptions::with,
             "A mesh file. Each corner gets the normal at the nearest point of this mesh. Without normals in "
             "the file, the method computes them.")
        .also_called(with_synonyms)
        .also_called("from transfer");
    d.option(
         "tangents", &NormalsOptions::tangents,
         "Computes tangents with MikkTSpace for the texture coordinates with this number: 0 for TEXCOORD_0.")
        .also_called("tangent mikktspace uv uvs")
        .between(0, 63);
}

struct NormalsPart {
    std::string part;
    std::size_t seams = 0, mended = 0;
    std::optional<double> farthest;
};

struct NormalsReport {
    std::vector<NormalsPart> parts;
};

void declare_part(DeclareFields<NormalsPart>& d) {
    d.field("part", &NormalsPart::part, "The name of the part.");
    d.field("split_corners", &NormalsPart::seams,
            "The number of extra attribute tuples at vertices on sharp edges and other seams.");
    d.field("mended", &NormalsPart::mended,
            "Normals, tangents and sets of joint weights that did not have length or sum 1.");
    d.field("farthest", &NormalsPart::farthest, "The largest distance of a vertex from the other mesh.")
        .unit("scene units")
        .only_when("with is given");
}

void declare_report(DeclareFields<NormalsReport>& d) {
    d.list("parts", &NormalsReport::parts, "Each part.", declare_part).tallied("nothing to mend");
}

/// Replaces the normals of a part by the normals of another mesh. Returns the largest distance.
std::optional<double> take_normals(Part& part, const ReferenceMesh& other, Context& context) {
    const auto carried = other.carried_to(part);
    Attribute* own = part.mesh.find("NORMAL", Domain::wedge);
    const Attribute* found = carried ? carried->mesh.find("NORMAL", Domain::wedge) : nullptr;
    if (!own || !found || own->size() != found->size()) return {};
    own->data = found->data;
    own->normalised = found->normalised;
    context.attribute_changes(part, {{"NORMAL", Domain::wedge, AttributeChange::Kind::recomputed,
                                      "from the nearest points of another mesh"}});
    double farthest = 0;
    for (const double d : carried->sources.distances)
        if (std::isfinite(d)) farthest = std::max(farthest, d);
    return farthest;
}

void add_tangents(Part& part, int uv_set, Context& context) {
    if (!part.mesh.all_triangles()) part.mesh = triangles_of(part.mesh);
    const auto change = give_tangents(part.mesh, uv_set);
    if (!change) {
        context.warn("W-NO-TANGENTS",
                     fmt::format("part '{}' has no normals or no texture coordinates TEXCOORD_{}, so it gets "
                                 "no tangents",
                                 part.name, uv_set),
                     "set tangents to the number of its texture coordinates, or exclude the part with only");
        return;
    }
    for (Primitive& p : part.mesh.primitives)
        if (!p.attributes.empty() && p.lists("NORMAL") && !p.lists("TANGENT"))
            p.attributes.emplace_back("TANGENT");
    context.attribute_changes(part, {*change});
}

/// The other mesh with normals only.
std::unique_ptr<ReferenceMesh> reference(const NormalsOptions& o, const Scene& scene, Context& context) {
    if (!o.with) return nullptr;
    auto other = std::make_unique<ReferenceMesh>(*o.with, scene, context);
    Mesh& mesh = other->mesh();
    if (!mesh.find("NORMAL", Domain::wedge)) give_normals(mesh, o.method, o.feature_angle.radians);
    std::erase_if(mesh.attributes, [](const Attribute& a) { return a.name != "NORMAL"; });
    mesh.primitives.clear();
    return other;
}

Scene run(Scene scene, const NormalsOptions& o, Context& context, NormalsReport& report) {
    const auto other = reference(o, scene, context);
    context.for_each_part(scene, [&](Part& part) {
        NormalsPart result{part.name, 0, 0, {}};
        const bool has_faces = part.mesh.face_count() > 0;
        if (has_faces || o.method == NormalKind::none)
            context.attribute_changes(part, give_normals(part.mesh, o.method, o.feature_angle.radians));
        if (has_faces && other) result.farthest = take_normals(part, *other, context);
        if (has_faces && o.tangents) add_tangents(part, static_cast<int>(*o.tangents), context);
        AttributeChanges mended = scale_to_unit(part.mesh, result.mended);
        std::erase_if(mended, [](const AttributeChange& c) { return c.kind == AttributeChange::Kind::kept; });
        context.attribute_changes(part, mended);
        result.seams = part.mesh.wedge_count() - std::min(part.mesh.wedge_count(), part.mesh.vertex_count());
        report.parts.push_back(result);
    });
    return scene;
}

struct NormalsStage : StageOf<run> {
    StageFiles files() const override {
        return {o.with ? std::vector{*o.with} : std::vector<PathText>{}, {}};
    }
    void verify(const Value& given, Problems& problems) const override {
        const bool smooths = o.method == NormalKind::smooth || o.method == NormalKind::area;
        if (!smooths && given.is_map() && given.find("feature_angle"))
            add_refusal(Refusal{"feature_angle", "'feature_angle' needs the method smooth or area",
                                "add method: smooth"},
                        "normals", given, problems);
        if (!smooths && o.with)
            add_refusal(Refusal{"with", "'with' needs the method smooth or area", "add method: smooth"},
                        "normals", given, problems);
        if (o.method == NormalKind::none && o.tangents)
            add_refusal(Refusal{"tangents", "'tangents' needs normals", "add method: smooth"}, "normals",
                        given, problems);
    }
};

const RegisterStage registered = make_stage<NormalsStage>(
    {.name = "normals",
     .also_called = "normal shade_smooth shade_flat auto_smooth recompute_normals compute_normals "
                    "unweld_normals tangents mikktspace smooth_normals vertex_normals",
     .about = help::normals::about,
     .details = help::normals::details,
     .examples = {"normals", "normals: {feature_angle: 40deg}", "normals: flat", "normals: keep",
                  "normals: {method: area, tangents: 0}", "normals: {with: original.glb}"},
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::normals_stage
