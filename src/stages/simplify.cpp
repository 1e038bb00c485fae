#include "geometry/simplify.hpp"

#include "base/spelling.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Method = SimplifySettings::Method;
using Stop = SimplifyResult::Stop;

struct BoxOption {
    Vec3 min, max;
};

struct LockOptions {
    bool boundary = false, seams = false, group = false;
    std::optional<BoxOption> box;
};

struct SimplifyOptions {
    std::optional<Ratio> ratio;
    std::optional<std::int64_t> faces, vertices;
    std::optional<Length> max_error;
    Method method = Method::quadric;
    LockOptions lock;
    Angle crease = Angle::degrees(30);
};

bool parse_locks(const Value& value, LockOptions& out, Problems& problems) {
    if (value.deferred) return true;
    bool good = true;
    const auto one = [&](const Value& v) {
        if (v.is_scalar() && v.text == "boundary") return out.boundary = true;
        if (v.is_scalar() && v.text == "seams") return out.seams = true;
        if (v.is_scalar() && v.text == "group") return out.group = true;
        problems.add(v.mark, "E-CHOICE", fmt::format("lock has no {}", v.described()),
                     v.text == "box"
                         ? "a box needs its corners: lock: {box: {min: [0, 0, 0], max: [1, 1, 1]}}"
                         : suggestion(v.text, {"boundary", "seams", "group"}));
        return good = false;
    };
    if (value.is_list())
        for (const Value& item : value.items) one(item);
    else
        one(value);
    return good;
}

void declare_lock(Declare<LockOptions>& d) {
    d.option("boundary", &LockOptions::boundary, "The vertices of the boundary stay, all of them.");
    d.option("seams", &LockOptions::seams, "The vertices of seams and of borders of materials stay.");
    d.option("group", &LockOptions::group, "The vertices of borders between the groups of an OBJ file stay.");
    d.group("box", &LockOptions::box, "The vertices within this box stay, in world space.",
            [](Declare<BoxOption>& box) {
                box.option("min", &BoxOption::min, "The lowest corner, in scene units.").required();
                box.option("max", &BoxOption::max, "The highest corner, in scene units.").required();
            });
    const Json words = {{"enum", {"boundary", "seams", "group"}}};
    d.shorthand("boundary, seams or group, or a list of them",
                {{"anyOf", Json::array({words, {{"type", "array"}, {"items", words}}})}}, parse_locks);
}

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
    d.option("max_error", &SimplifyOptions::max_error,
             "As far as the deviation from what came in, measured both ways, stays within this.")
        .above(0);
    d.choice<Method>("method", &SimplifyOptions::method,
                     {{"quadric", Method::quadric,
                       "least squared distance to the planes of the faces; vertices go where that is least"},
                      {"quadric-endpoints", Method::quadric_endpoints,
                       "the same, but no vertex moves: those that remain are some of those that came in"},
                      {"shortest-edge", Method::shortest_edge,
                       "the shortest edge goes, and the rest meets at its midpoint"}},
                     "Which edge goes next.");
    d.group("lock", &SimplifyOptions::lock,
            "What stays vertex by vertex. Boundaries, seams and borders that are not locked collapse along "
            "themselves only.",
            declare_lock);
    d.option(
         "crease", &SimplifyOptions::crease,
         "Seams that only normals make are merged where the faces meet at less than this angle; flat-shaded "
         "meshes stay flat-shaded. 0 keeps every normal seam.")
        .between(0, 180);
    d.at_least_one({"ratio", "faces", "vertices", "max_error"});
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
    case Stop::max_error:
        return "max_error";
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

/// The greatest stretch of lengths from a part to the world: exact for similarities, never too small.
double stretch(const Transform& t) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += t.m[i][j] * t.m[i][j];
    const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
    const double xx = dot(x, x), slack = 1e-9 * sum;
    const bool similar = std::abs(dot(y, y) - xx) < slack && std::abs(dot(z, z) - xx) < slack &&
                         std::abs(dot(x, y)) < slack && std::abs(dot(y, z)) < slack &&
                         std::abs(dot(z, x)) < slack;
    return std::sqrt(similar ? xx : sum);
}

std::string held_by(const SimplifyResult::Blocked& b) {
    return fmt::format(
        "of the edges left, {} are held by borders and locks, {} by topology, {} would flip a face",
        b.borders, b.topology, b.flips);
}

void warn(const Part& part, const SimplifyResult& r, Context& context) {
    if (r.stop == Stop::nothing)
        context.warn(
            "W-SIMPLIFY-NOTHING",
            fmt::format("part '{}' has {} triangles and {} vertices, at or below the target: nothing to do",
                        part.name, r.faces_before, r.vertices_before));
    if (r.stop == Stop::stuck)
        context.warn("W-SIMPLIFY-STOPPED",
                     fmt::format("part '{}' stopped at {} triangles, above the target: {}", part.name,
                                 r.faces_after, held_by(r.blocked)),
                     "ask for more faces, or free what holds them: no locks, fewer seams, a clean mesh");
}

/// scale: from the part's lengths to the scene's.
void report(const Part& part, const SimplifyResult& r, double scale, Json& parts) {
    Json entry = {
        {"part", part.name},
        {"normals", spelled(r.shading)},
        {"merged_wedges", r.merged_wedges},
        {"triangles_before", r.faces_before},
        {"triangles_after", r.faces_after},
        {"vertices_before", r.vertices_before},
        {"vertices_after", r.vertices_after},
        {"ratio", r.faces_before > 0 ? Json(double(r.faces_after) / double(r.faces_before)) : Json()},
        {"stopped_by", spelled(r.stop)},
        {"largest_error", r.largest_error * scale},
        {"collapses", r.collapses},
        {"blocked_edges",
         {{"borders", r.blocked.borders},
          {"topology", r.blocked.topology},
          {"flips", r.blocked.flips},
          {"error", r.blocked.error}}}};
    if (r.measured) {
        entry["rolled_back"] = r.rolled_back;
        entry["measurements"] = r.measurements;
    }
    parts.push_back(std::move(entry));
}

SimplifyLocks locks_of(const LockOptions& o, const Part& part) {
    SimplifyLocks lock{.boundary = o.boundary, .seams = o.seams, .groups = o.group};
    if (o.box) lock.box = WorldBox{Box{o.box->min, o.box->max}, part.transform};
    return lock;
}

Scene run(Scene scene, const SimplifyOptions& o, Context& context) {
    std::size_t all_faces = 0, all_vertices = 0;
    for (const auto& part : scene.parts)
        if (context.selects(part, scene))
            all_faces += triangle_count(part.mesh), all_vertices += part.mesh.vertex_count();
    std::optional<double> max_error;
    if (o.max_error) max_error = context.resolve(*o.max_error, scene, "max_error");
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        SimplifySettings settings{
            .method = o.method, .lock = locks_of(o.lock, part), .crease = o.crease.radians};
        const double scale = part.skinned ? 1 : stretch(part.transform);
        if (o.ratio) settings.ratio = o.ratio->value;
        settings.faces = share(o.faces, triangle_count(part.mesh), all_faces);
        settings.vertices = share(o.vertices, part.mesh.vertex_count(), all_vertices);
        if (max_error) settings.max_error = *max_error / scale;
        SimplifyResult r = simplify(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        report(part, r, scale, parts);
        warn(part, r, context);
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
     .examples = {"simplify: 25%", "simplify: {faces: 5000, lock: [boundary, seams]}",
                  "simplify: {ratio: 5%, max_error: 0.1%}", "simplify: {ratio: 10%, method: shortest-edge}"}},
    declare, run);

} // namespace

} // namespace facetmill
