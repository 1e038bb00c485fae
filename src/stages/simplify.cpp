#include "geometry/simplify.hpp"
#include "geometry/deviation.hpp"

#include "base/spelling.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Method = SimplifySettings::Method;
using Intersections = SimplifySettings::Intersections;
using Stop = SimplifyResult::Stop;

struct BoxOption {
    Vec3 min, max;
};

struct LockOptions {
    bool boundary = false, seams = false, group = false;
    std::optional<BoxOption> box;
};

struct ConstraintOptions {
    Angle normal_deviation = Angle::degrees(60);
    std::optional<double> aspect_ratio, roundness;
    std::optional<Length> hausdorff;
};

struct LevelOptions {
    std::vector<Ratio> ratios;
};

struct SimplifyOptions {
    std::optional<Ratio> ratio;
    std::optional<std::int64_t> faces, vertices;
    std::optional<Length> max_error;
    Method method = Method::quadric;
    LockOptions lock;
    Angle crease = Angle::degrees(30);
    Intersections self_intersections = Intersections::ignore;
    std::optional<LevelOptions> lods;
    ConstraintOptions constraints;
    bool measure = true, certify = false;
};

bool parse_lock(const Value& v, LockOptions& out, Problems& problems) {
    if (v.is_scalar() && v.text == "boundary") return out.boundary = true;
    if (v.is_scalar() && v.text == "seams") return out.seams = true;
    if (v.is_scalar() && v.text == "group") return out.group = true;
    problems.add(v.mark, "E-CHOICE", fmt::format("lock has no {}", v.described()),
                 v.text == "box" ? "a box needs its corners: lock: {box: {min: [0, 0, 0], max: [1, 1, 1]}}"
                                 : suggestion(v.text, {"boundary", "seams", "group"}));
    return false;
}

bool parse_locks(const Value& value, LockOptions& out, Problems& problems) {
    if (value.deferred) return true;
    Value words = value;
    if (value.is_scalar()) { // "boundary,seams", as the one-liner writes it
        words = Value::list({}, value.mark);
        for (std::size_t at = 0; at <= value.text.size();) {
            const auto end = std::min(value.text.find(',', at), value.text.size());
            words.items.push_back(Value::scalar(value.text.substr(at, end - at), value.mark));
            at = end + 1;
        }
    }
    bool good = words.is_list();
    if (!good) parse_lock(value, out, problems);
    for (const Value& word : words.items) good &= parse_lock(word, out, problems);
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

void declare_constraints(Declare<ConstraintOptions>& d) {
    d.option("normal_deviation", &ConstraintOptions::normal_deviation,
             "No face turns farther from the normal that it came with.")
        .between(0, 180);
    d.option("aspect_ratio", &ConstraintOptions::aspect_ratio,
             "No face gets a larger ratio of longest edge to height (a ratio, at least 1.16).")
        .at_least(1);
    d.option("roundness", &ConstraintOptions::roundness,
             "No face gets a smaller roundness: 1 is equilateral, 0 is flat (a share, without unit).")
        .between(0, 1);
    d.option("hausdorff", &ConstraintOptions::hausdorff,
             "No vertex that went is farther from the faces near by.")
        .above(0);
}

void declare_levels(Declare<LevelOptions>& d) {
    d.option(
         "ratios", &LevelOptions::ratios,
         "What remains at each level, from fine to coarse, of the triangles of each part: [100%, 50%, 10%].")
        .required();
    d.shorthand("a list of ratios", {{"type", "array"}},
                [](const Value& v, LevelOptions& out, Problems& problems) {
                    return OptionType<std::vector<Ratio>>::parse(v, out.ratios, problems);
                });
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
                      {"constrained", Method::constrained,
                       "quadric-endpoints under constraints, by OpenMesh; see constraints"},
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
    d.choice<Intersections>(
        "self_intersections", &SimplifyOptions::self_intersections,
        {{"ignore", Intersections::ignore, "not looked for"},
         {"count", Intersections::count, "pairs of faces that run into each other, counted before and after"},
         {"avoid", Intersections::avoid, "none is new: what would run into itself stays as it came"}},
        "What is done about faces that come to run into each other.");
    d.group("constraints", &SimplifyOptions::constraints,
            "For the method constrained: what no collapse may bring about.", declare_constraints);
    d.group(
        "lods", &SimplifyOptions::lods,
        "Levels of detail in place of one target: each is made from the one before, and all are parts of the "
        "scene: NAME, NAME.lod1, NAME.lod2, ...",
        declare_levels);
    d.option("measure", &SimplifyOptions::measure,
             "Measure the deviation from what came in, both ways, and report it.");
    d.option("certify", &SimplifyOptions::certify,
             "Also find a guaranteed upper bound of the deviation (it costs).");
    d.at_least_one({"ratio", "faces", "vertices", "max_error", "lods"});
}

/// What the declaration cannot say about levels.
void verify(const SimplifyOptions& o, const Value& given, Problems& problems) {
    if (o.method == Method::constrained && (o.max_error || o.lods))
        problems.add(given.mark, "E-CONFLICT", "simplify: constrained takes neither max_error nor lods",
                     "constraints: {hausdorff: 0.1%} bounds the error");
    if (!o.lods) return;
    const Value* lods = given.find("lods");
    const Mark& mark = lods ? lods->mark : given.mark;
    if (o.ratio || o.faces || o.vertices || o.max_error)
        problems.add(mark, "E-CONFLICT", "simplify: lods has its own targets",
                     "leave out ratio, faces, vertices and max_error");
    if (o.self_intersections == Intersections::avoid)
        problems.add(mark, "E-CONFLICT", "simplify: lods cannot avoid self-intersections",
                     "use self_intersections: count, or one simplify stage for each level");
    for (std::size_t i = 0; i < o.lods->ratios.size(); ++i) {
        const double ratio = o.lods->ratios[i].value;
        if (!(ratio > 0 && ratio <= 1))
            problems.add(mark, "E-RANGE", "simplify: lods: each ratio is 0 < x <= 1", "for example 50%");
        if (i > 0 && ratio > o.lods->ratios[i - 1].value)
            problems.add(mark, "E-RANGE", "simplify: lods: ratios go from fine to coarse",
                         "for example [100%, 50%, 10%]");
    }
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
    if (b.borders + b.topology + b.flips == 0) return "no collapse was left within the constraints";
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

Json distances(const DirectedDeviation& d, const DeviationResult& all) {
    Json json = {{"maximum", d.maximum},
                 {"rms", d.rms},
                 {"maximum_percent", all.percent(d.maximum)},
                 {"rms_percent", all.percent(d.rms)},
                 {"samples", d.samples + d.vertices}};
    if (d.bound) json["bound"] = *d.bound;
    return json;
}

/// In scene units, and in percent of the diagonal of the part as it came.
Json deviation_json(const DeviationResult& d) {
    Json json = {{"maximum", d.maximum()},
                 {"rms", d.rms()},
                 {"maximum_percent", d.percent(d.maximum())},
                 {"rms_percent", d.percent(d.rms())},
                 {"seed", d.seed},
                 {"from_given", distances(d.forward, d)},
                 {"from_result", distances(d.backward, d)}};
    if (d.bound()) json["bound"] = *d.bound(), json["bound_percent"] = d.percent(*d.bound());
    return json;
}

/// scale: from the part's lengths to the scene's.
Json described(const Part& part, const SimplifyResult& r, double scale) {
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
    if (r.measured) entry["rolled_back"] = r.rolled_back, entry["measurements"] = r.measurements;
    if (r.intersections_after)
        entry["self_intersections"] = {{"before", *r.intersections_before},
                                       {"after", *r.intersections_after},
                                       {"held_vertices", r.held}};
    return entry;
}

SimplifyLocks locks_of(const LockOptions& o, const Part& part) {
    SimplifyLocks lock{.boundary = o.boundary, .seams = o.seams, .groups = o.group};
    if (o.box) lock.box = WorldBox{Box{o.box->min, o.box->max}, part.skinned ? Transform{} : part.transform};
    return lock;
}

class Simplifier {
  public:
    Simplifier(Scene scene, const SimplifyOptions& o, Context& context)
        : scene_(std::move(scene)), o_(o), context_(context) {
        for (const auto& part : scene_.parts)
            if (context.selects(part, scene_))
                faces_ += triangle_count(part.mesh), vertices_ += part.mesh.vertex_count();
        if (o.constraints.hausdorff)
            hausdorff_ = context.resolve(*o.constraints.hausdorff, scene_, "constraints.hausdorff");
        if (o.max_error) max_error_ = context.resolve(*o.max_error, scene_, "max_error");
    }

    Scene run() {
        std::vector<Part> levels;
        context_.for_each_part(scene_, [&](Part& part) {
            if (o_.measure || o_.certify) before_ = surface_of(part);
            if (!o_.lods) return take(part, simplify(std::move(part.mesh), settings_for(part)));
            const Part base = part;
            auto results = simplify_levels(std::move(part.mesh), settings_for(part));
            for (std::size_t i = 0; i < results.size(); ++i) {
                Part level = base;
                if (i > 0) level.name += fmt::format(".lod{}", i);
                take(level, std::move(results[i]));
                if (i == 0)
                    part = std::move(level);
                else
                    level.changed = true, levels.push_back(std::move(level));
            }
        });
        for (Part& level : levels) scene_.parts.push_back(std::move(level));
        context_.result()["parts"] = std::move(parts_);
        return std::move(scene_);
    }

  private:
    SimplifySettings settings_for(const Part& part) const {
        SimplifySettings s{.method = o_.method,
                           .self_intersections = o_.self_intersections,
                           .lock = locks_of(o_.lock, part),
                           .crease = o_.crease.radians};
        if (o_.ratio) s.ratio = o_.ratio->value;
        s.faces = share(o_.faces, triangle_count(part.mesh), faces_);
        s.vertices = share(o_.vertices, part.mesh.vertex_count(), vertices_);
        s.constraints = {.least_cosine = cosine(o_.constraints.normal_deviation.radians),
                         .aspect_ratio = o_.constraints.aspect_ratio.value_or(0),
                         .roundness = o_.constraints.roundness.value_or(0),
                         .hausdorff = hausdorff_.value_or(0) / scale_of(part)};
        if (max_error_) s.max_error = *max_error_ / scale_of(part);
        if (o_.lods)
            for (const Ratio& ratio : o_.lods->ratios) s.levels.push_back(ratio.value);
        return s;
    }

    static double scale_of(const Part& part) {
        const double scale = part.skinned ? 1 : stretch(part.transform);
        return scale > 0 ? scale : 1;
    }

    void take(Part& part, SimplifyResult r) {
        part.mesh = std::move(r.mesh);
        context_.ledger(part, r.fates);
        Json entry = described(part, r, scale_of(part));
        if (o_.measure || o_.certify)
            entry["deviation"] =
                deviation_json(deviation(before_, surface_of(part), {.certify = o_.certify}));
        parts_.push_back(std::move(entry));
        warn(part, r, context_);
    }

    Scene scene_;
    const SimplifyOptions& o_;
    Context& context_;
    std::size_t faces_ = 0, vertices_ = 0; ///< of all parts selected
    std::optional<double> max_error_, hausdorff_;
    Surface before_; ///< the part at hand, as it came, in the world
    Json parts_ = Json::array();
};

Scene run(Scene scene, const SimplifyOptions& o, Context& context) {
    return Simplifier(std::move(scene), o, context).run();
}

const RegisterStage registered = make_stage<SimplifyOptions>(
    {.name = "simplify",
     .about = "Reduces the number of faces and keeps the shape, the topology and the attributes.",
     .details =
         "Edges are collapsed, cheapest first, until a target is met; with several targets the first one met "
         "stops the work, and the report names it, with the ratio achieved and what holds the edges that are "
         "left. Polygons are triangulated first. The method quadric measures the squared distance to the "
         "planes "
         "of all faces that a vertex stands for, weighted by area; shortest-edge is the note's. Collapses "
         "run in "
         "passes of equal threshold, so the order is that of the costs but for vertices that a pass has "
         "touched "
         "already.\n\n"
         "Guaranteed: a closed manifold stays closed and manifold, genus, components and boundary loops "
         "stay, no "
         "face turns by more than 60 degrees in a collapse, none becomes degenerate or doubled. Boundaries, "
         "UV "
         "seams, sharp normal seams and borders of materials and groups collapse only along themselves and "
         "stay "
         "matched; where several meet, the vertex stays. Non-manifold and inconsistently oriented places are "
         "left as they are. Isolated vertices are dropped.\n\n"
         "A vertex that moved has the attributes of the surface that came in, at the nearest point of the "
         "faces "
         "that it replaces, so textures do not slide; faces keep theirs. Wedges that differ in normals only "
         "are "
         "merged below the crease angle; a flat-shaded mesh gets the normals of its new faces.\n\n"
         "max_error is a bound on the measured deviation: 100,000 samples each way and all vertices, seed 1, "
         "as "
         "reported under deviation, in scene units and in percent of the part's diagonal. Points of the "
         "surface "
         "are followed while it is simplified, and what is above the bound in the end is taken back collapse "
         "by "
         "collapse. It takes many times as long as a ratio. lods makes one chain: each level is reached by "
         "further collapses from the one before. To write each level into a file of its own: write with "
         "only: \"*.lod1\".\n\n"
         "The method constrained keeps boundaries, seams and borders vertex by vertex.\n\n"
         "largest_error is, for quadric, the largest root mean square distance of a new vertex to its "
         "planes; "
         "for shortest-edge half the longest edge collapsed. A target at or above the input does nothing "
         "(W-SIMPLIFY-NOTHING); when no collapse is left the work stops and says why (W-SIMPLIFY-STOPPED). "
         "self_intersections: avoid holds what runs into itself as it came and does the rest again, up to 16 "
         "times; the count that is left is reported.\n\n"
         "Source: the note 'Surface simplification' (1997); M. Garland and P. Heckbert, 'Surface "
         "simplification "
         "using quadric error metrics' (1997).",
     .examples = {"simplify: 25%", "simplify: {faces: 5000, lock: [boundary, seams]}",
                  "simplify: {ratio: 5%, max_error: 0.1%}", "simplify: {lods: [100%, 50%, 10%]}",
                  "simplify: {ratio: 10%, method: shortest-edge}"}},
    declare, run, {.verify = verify});

} // namespace

} // namespace facetmill
