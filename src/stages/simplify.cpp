#include "geometry/simplify.hpp"

#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Boundary = SimplifySettings::Boundary;
using Method = SimplifySettings::Method;
using Stop = SimplifyResult::Stop;

struct SimplifyOptions {
    std::optional<Ratio> ratio;
    std::optional<std::int64_t> faces, vertices;
    Method method = Method::quadric;
    Boundary boundary = Boundary::along;
    Angle crease = Angle::degrees(30);
};

void declare(Declare<SimplifyOptions>& d) {
    d.option("ratio", &SimplifyOptions::ratio,
             "What remains, as a ratio of the triangles of each part: 25%, or 0.25.")
        .above(0)
        .at_most(1)
        .primary();
    d.option("faces", &SimplifyOptions::faces,
             "At most so many triangles (a count), shared among the parts in proportion to their own.")
        .at_least(1);
    d.option("vertices", &SimplifyOptions::vertices,
             "At most so many vertices (a count), shared among the parts in proportion to their own.")
        .at_least(1);
    d.choice<Method>("method", &SimplifyOptions::method,
                     {{"quadric", Method::quadric,
                       "least squared distance to the planes of the faces; vertices go where that is least"},
                      {"shortest-edge", Method::shortest_edge,
                       "the shortest edge goes, and the rest meets at its midpoint"}},
                     "Which edge goes next.");
    d.choice<Boundary>("boundary", &SimplifyOptions::boundary,
                       {{"along", Boundary::along, "boundary edges collapse along the boundary only"},
                        {"locked", Boundary::locked, "every boundary vertex stays"}},
                       "What the boundary of an open surface does.");
    d.option(
         "crease", &SimplifyOptions::crease,
         "Seams that only normals make are merged where the faces meet at less than this angle; flat-shaded "
         "meshes stay flat-shaded. 0 keeps every normal seam.")
        .between(0, 180);
    d.at_least_one({"ratio", "faces", "vertices"});
}

const char* spelled(Stop stop) {
    switch (stop) {
    case Stop::nothing:
        return "nothing to do";
    case Stop::ratio:
        return "ratio";
    case Stop::faces:
        return "faces";
    case Stop::vertices:
        return "vertices";
    default:
        return "stuck";
    }
}

const char* spelled(NormalSeams::Shading shading) {
    switch (shading) {
    case NormalSeams::Shading::smoothed:
        return "seams merged";
    case NormalSeams::Shading::faceted:
        return "flat shading kept";
    default:
        return "as given";
    }
}

/// A part's share of a count that is meant for all, rounded down; a part may have none.
std::optional<std::size_t> share(std::optional<std::int64_t> whole, std::size_t own, std::size_t all) {
    if (!whole) return {};
    if (own == all || all == 0) return static_cast<std::size_t>(*whole);
    return static_cast<std::size_t>(static_cast<double>(*whole) *
                                    (static_cast<double>(own) / static_cast<double>(all)));
}

std::size_t triangle_count(const Mesh& mesh) { return mesh.corner_count() - 2 * mesh.face_count(); }

void report(const Part& part, const SimplifyResult& r, Json& parts, Context& context) {
    parts.push_back(
        {{"part", part.name},
         {"normals", spelled(r.shading)},
         {"merged_wedges", r.merged_wedges},
         {"triangles_before", r.faces_before},
         {"triangles_after", r.faces_after},
         {"vertices_before", r.vertices_before},
         {"vertices_after", r.vertices_after},
         {"stopped_by", spelled(r.stop)},
         {"largest_error", r.largest_error},
         {"blocked_edges",
          {{"borders", r.blocked.borders}, {"topology", r.blocked.topology}, {"flips", r.blocked.flips}}}});
    if (r.stop == Stop::nothing)
        context.warn(
            "W-SIMPLIFY-NOTHING",
            fmt::format("part '{}' has {} triangles and {} vertices, at or below the target: nothing to do",
                        part.name, r.faces_before, r.vertices_before));
    if (r.stop == Stop::stuck)
        context.warn(
            "W-SIMPLIFY-STOPPED",
            fmt::format("part '{}' stopped at {} triangles, above the target: of the edges left, {} are held "
                        "by borders, {} by topology, {} would flip a face",
                        part.name, r.faces_after, r.blocked.borders, r.blocked.topology, r.blocked.flips),
            "ask for more faces, or free what holds them: boundary: along, fewer seams, a clean mesh");
}

Scene run(Scene scene, const SimplifyOptions& o, Context& context) {
    std::size_t all_faces = 0, all_vertices = 0;
    for (const auto& part : scene.parts)
        if (context.selects(part, scene))
            all_faces += triangle_count(part.mesh), all_vertices += part.mesh.vertex_count();
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        SimplifySettings settings{.method = o.method, .boundary = o.boundary, .crease = o.crease.radians};
        if (o.ratio) settings.ratio = o.ratio->value;
        settings.faces = share(o.faces, triangle_count(part.mesh), all_faces);
        settings.vertices = share(o.vertices, part.mesh.vertex_count(), all_vertices);
        SimplifyResult r = simplify(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        report(part, r, parts, context);
    });
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<SimplifyOptions>(
    {.name = "simplify",
     .about = "Reduces the number of faces and keeps the shape, the topology and the attributes.",
     .details = "Edges are collapsed, cheapest first, until a target is met; with several targets the first "
                "one met stops "
                "the work, and the report names it. Polygons are triangulated first. The method quadric "
                "measures the squared "
                "distance to the planes of all faces that a vertex stands for, weighted by area; "
                "shortest-edge is the "
                "note's. Collapses run in passes of equal threshold, so the order is that of the costs but "
                "for vertices that "
                "a pass has touched already.\n\n"
                "Guaranteed: a closed manifold stays closed and manifold, genus, components and boundary "
                "loops stay, no face "
                "turns by more than 60 degrees in a collapse, none becomes degenerate or doubled. "
                "Boundaries, UV and normal "
                "seams and borders of materials collapse only along themselves and stay matched; where "
                "several meet, the "
                "vertex stays. Non-manifold and inconsistently oriented places are left as they are. "
                "Isolated vertices are dropped.\n\n"
                "A vertex that moved has the attributes of the surface that came in, at the nearest point of "
                "the faces that it replaces, so textures do not slide; faces keep theirs. Wedges that differ "
                "in normals only are merged below the crease angle; a flat-shaded mesh gets the normals of "
                "its new faces. largest_error is, for quadric, the largest root mean square "
                "distance of a new "
                "vertex to its planes; for shortest-edge half the longest edge collapsed; in the part's "
                "units. A target at "
                "or above the input does nothing (W-SIMPLIFY-NOTHING); when no collapse is left the work "
                "stops and says why "
                "(W-SIMPLIFY-STOPPED).\n\n"
                "Source: the note 'Surface simplification' (1997); M. Garland and P. Heckbert, 'Surface "
                "simplification using "
                "quadric error metrics' (1997).",
     .examples = {"simplify: 25%", "simplify: {faces: 5000, boundary: locked}",
                  "simplify: {ratio: 10%, method: shortest-edge}"}},
    declare, run);

} // namespace

} // namespace facetmill
