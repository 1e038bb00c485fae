#include "stages/simplify/options.hpp"

#include "base/math/portable_math.hpp"
#include "base/text/spelling.hpp"
#include "geometry/inspect/inspect.hpp"
#include "options/lists.hpp"
#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill::simplify_stage {

namespace {

using Method = SimplifySettings::Method;
using Topology = SimplifySettings::Topology;
using Intersections = SimplifySettings::Intersections;

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
    const Value words = listed(value);
    bool good = words.is_list();
    if (!good) parse_lock(value, out, problems);
    for (const Value& word : words.items) good &= parse_lock(word, out, problems);
    return good;
}

void declare_lock(Declare<LockOptions>& d) {
    d.option("boundary", &LockOptions::boundary, "Keeps all boundary vertices.");
    d.option("seams", &LockOptions::seams, "Keeps the vertices of seams and of borders between materials.");
    d.option("group", &LockOptions::group,
             "Keeps the vertices of borders between the groups of an OBJ file.");
    d.group("box", &LockOptions::box,
            "Keeps the vertices in this box, in world space. Parts with animated nodes are placed at their "
            "largest scale, skinned parts in their bind pose.",
            declare_box);
    const Json words = {{"enum", {"boundary", "seams", "group"}}};
    d.shorthand(ShortForm::list, "boundary, seams or group, or a list of them",
                {{"anyOf", Json::array({words, {{"type", "array"}, {"items", words}}})}}, parse_locks);
}

void declare_weights(Declare<AttributeWeights>& d) {
    d.option("uv", &AttributeWeights::uv,
             "The weight of texture coordinates. A texture that slides by a length counts as this many times "
             "a surface that moves by that length.")
        .at_least(0);
    d.option("normal", &AttributeWeights::normal,
             "The weight of normals. A difference of 1 counts as a surface that moves by this percentage of "
             "the part's diagonal.")
        .at_least(0);
    d.option("colour", &AttributeWeights::colour,
             "The weight of colours. A difference of full intensity counts as a surface that moves by this "
             "percentage of the part's diagonal.")
        .at_least(0);
    d.option("skin", &AttributeWeights::skin,
             "The weight of skin weights. A difference of 1 counts as a surface that moves by this "
             "percentage of the part's diagonal.")
        .at_least(0);
    d.shorthand(ShortForm::number, "one number for all; 0 uses only the shape", OptionType<double>::schema(),
                [](const Value& v, AttributeWeights& out, Problems& problems) {
                    double all = 0;
                    if (!OptionType<double>::parse(v, all, problems)) return false;
                    out = {all, all, all, all};
                    if (all >= 0) return true;
                    problems.add(v.mark, "E-RANGE", "weights must be at least 0");
                    return false;
                });
}

void declare_constraints(Declare<ConstraintOptions>& d) {
    d.option("normal_deviation", &ConstraintOptions::normal_deviation,
             "The largest angle between the normal of a face and its original normal.")
        .between(0, 180);
    d.option("aspect_ratio", &ConstraintOptions::aspect_ratio,
             "The largest aspect ratio of a face, as in validate. 1 means equal sides.")
        .at_least(1);
    d.option("roundness", &ConstraintOptions::roundness,
             "The smallest roundness of a face. 1 is equilateral, 0 is degenerate.")
        .between(0, 1);
    d.option("hausdorff", &ConstraintOptions::hausdorff,
             "The largest distance of a removed vertex from the faces near it.")
        .above(0);
}

void declare_levels(Declare<LevelOptions>& d) {
    d.option("ratios", &LevelOptions::ratios,
             "The ratio of remaining triangles at each level, from fine to coarse: [100%, 50%, 10%].")
        .required();
    d.shorthand(ShortForm::list, "a list of ratios", {{"type", "array"}},
                [](const Value& v, LevelOptions& out, Problems& problems) {
                    return OptionType<std::vector<Ratio>>::parse(listed(v), out.ratios, problems);
                });
}

/// An option that is a length, or off.
void declare_max_quadric_error(Declare<SimplifyOptions>& d) {
    Option& o = d.option("max_quadric_error", &SimplifyOptions::max_quadric_error,
                         "Limits the error when ratio, faces, vertices or lods ask for too few triangles. It "
                         "limits the root mean square distance of a new vertex to the planes that it "
                         "represents. of part refers to the diagonal of the part's bounding box in its local "
                         "space. off and max_error remove the limit. For quadric and quadric-endpoints.")
                    .above(0)
                    .option();
    o.parse = [plain = o.parse](const Option& self, const Value& v, void* target, Problems& problems) {
        if (!v.is_scalar() || v.deferred || !(v.text == "off" || v.as_bool() == false))
            return plain(self, v, target, problems);
        static_cast<SimplifyOptions*>(target)->max_quadric_error.reset();
        return true;
    };
    o.schema = {{"anyOf", Json::array({o.schema, {{"enum", {"off", false}}}})}};
}

void declare_share(Declare<SimplifyOptions>& d) {
    using Share = SimplifyOptions::Share;
    d.choice<Share>(
        "share", &SimplifyOptions::share,
        {{"error", Share::error,
          "collapse edges of all parts in a single order of cost until all parts together meet the target"},
         {"equal", Share::equal, "each part separately meets the ratio, or its share of faces and vertices"}},
        "How several parts share a target. cluster and constrained always use equal.");
}

void declare_targets(Declare<SimplifyOptions>& d) {
    d.option("ratio", &SimplifyOptions::ratio,
             "The ratio of remaining triangles, for all parts together: 25%, or 0.25.")
        .also_called("percent percentage target_ratio fraction target keep")
        .also_called("reduction target_reduction",
                     "ratio, the share that remains, not the share that is removed")
        .above(0)
        .at_most(1)
        .primary();
    d.option("faces", &SimplifyOptions::faces,
             "The maximum number of remaining triangles, for all parts together.")
        .also_called(property_named("faces")->also_called)
        .at_least(1);
    d.option("vertices", &SimplifyOptions::vertices,
             "The maximum number of remaining vertices, for all parts together.")
        .also_called(property_named("vertices")->also_called)
        .at_least(1);
    d.option(
         "max_error", &SimplifyOptions::max_error,
         "The largest deviation from the input, measured in both directions. It applies to the rest pose of "
         "skinned and morphed parts. W-REST-POSE warns if one of at most 32 sampled poses deviates more.")
        .also_called("error tolerance threshold epsilon deviation max_deviation")
        .above(0);
    declare_share(d);
    declare_max_quadric_error(d);
}

/// Declares the settings that the algorithm uses without conversion.
void declare_settings(Declare<SimplifySettings>& d) {
    d.choice<Method>(
        "method", &SimplifySettings::method,
        {{"quadric", Method::quadric,
          "the smallest squared distance to the planes of the faces; new vertices are placed at the minimum"},
         {"quadric-endpoints", Method::quadric_endpoints,
          "the same, but vertices do not move, so all remaining vertices come from the input"},
         {"constrained", Method::constrained, "quadric-endpoints with limits, by OpenMesh; see constraints"},
         {"shortest-edge", Method::shortest_edge, "collapse the shortest edge to its midpoint"},
         {"cluster", Method::cluster,
          "merge all vertices in a grid cell: very fast, for previews; topology may change"}},
        "The method that selects the next edge.");
    d.choice<Topology>("topology", &SimplifySettings::topology,
                       {{"keep", Topology::keep, "preserve genus, components and boundary loops"},
                        {"allow", Topology::allow,
                         "small components may vanish, holes may close and handles may be pinched off; the "
                         "report counts them"}},
                       "Whether the topology may change.")
        .also_called("preserve_topology preservetopology", "(topology: keep)");
    d.group("weights", &SimplifySettings::weights,
            "The weights of attributes in the error of the quadric methods, relative to the shape. 0 ignores "
            "an attribute.",
            declare_weights);
    d.choice<Intersections>(
         "self_intersections", &SimplifySettings::self_intersections,
         {{"ignore", Intersections::ignore, "do not search for intersections"},
          {"count", Intersections::count, "count intersecting pairs of faces before and after"},
          {"avoid", Intersections::avoid, "remove fewer faces where new intersections would appear"}},
         "How to handle faces that would intersect.")
        .also_called(property_named("self_intersections")->also_called);
}

/// Collects conflicts: options that only other methods use, and options without effect.
class Conflicts {
  public:
    Conflicts(const Value& given, Problems& problems) : given_(given), problems_(problems) {}

    const Mark& mark(const char* name) const { return mark_at(given_, name); }
    bool has(const char* name) const { return given_.find(name); }
    void refuse(bool when, const char* name, const char* what, const char* hint) {
        if (when) add_refusal(Refusal{name, what, hint}, "simplify", given_, problems_);
    }

  private:
    const Value& given_;
    Problems& problems_;
};

} // namespace

bool has_quadrics(const SimplifyOptions& o) {
    return o.settings.method == Method::quadric || o.settings.method == Method::quadric_endpoints;
}

bool shares_by_error(const SimplifyOptions& o) {
    return o.share == SimplifyOptions::Share::error && (o.ratio || o.faces || o.vertices || o.lods) &&
           (has_quadrics(o) || o.settings.method == Method::shortest_edge);
}

void declare_simplify(Declare<SimplifyOptions>& d) {
    declare_targets(d);
    d.embed(&SimplifyOptions::settings, declare_settings);
    d.group("lock", &SimplifyOptions::lock,
            "Vertices to keep. Unlocked boundaries, seams and borders collapse only along themselves.",
            declare_lock)
        .also_called(
            "preserve_boundary preserve_border lock_border lock_boundary preserve_borders keep_boundary",
            "lock: {boundary: true}");
    d.option("feature_angle", &SimplifyOptions::feature_angle,
             "Merges seams that differ only in normals if the normals of the two faces differ by less than "
             "this angle. Flat-shaded meshes stay flat-shaded. 0 keeps every such seam.")
        .between(0, 180);
    d.group("constraints", &SimplifyOptions::constraints,
            "Limits for the method constrained. No collapse may exceed them.", declare_constraints);
    d.group("lods", &SimplifyOptions::lods,
            "Makes levels of detail instead of meeting one target. Each level starts from the previous one. "
            "All levels become parts of the scene: NAME, NAME.lod1, NAME.lod2, ... write: {lods: true} "
            "stores them in one glTF as MSFT_lod.",
            declare_levels);
    d.option("measure", &SimplifyOptions::measure,
             "Measures and reports the deviation from the input, in both directions.");
    d.option("certify", &SimplifyOptions::certify,
             "Also finds a guaranteed upper bound of the deviation. This takes time.");
    d.at_least_one({"ratio", "faces", "vertices", "max_error", "lods"});
}

void verify_simplify(const SimplifyOptions& o, const Value& given, Problems& problems) {
    Conflicts conflicts(given, problems);
    SimplifySettings s = simplify_settings(o);
    if (o.lock.box) s.lock.body.emplace_back(); // verify_box checks its corners
    for (const Refusal& refusal : o.lods ? check_simplify_levels(s) : check_simplify_settings(s))
        add_refusal(refusal, "simplify", given, problems);
    conflicts.refuse(o.settings.method != Method::constrained && conflicts.has("constraints"), "constraints",
                     "constraints need the method constrained", "use method: constrained");
    conflicts.refuse(!has_quadrics(o) && conflicts.has("weights"), "weights",
                     "weights need the method quadric or quadric-endpoints",
                     "use method: quadric, the default");
    const bool limited = o.max_quadric_error && conflicts.has("max_quadric_error");
    conflicts.refuse(!has_quadrics(o) && limited, "max_quadric_error",
                     "max_quadric_error needs the method quadric or quadric-endpoints",
                     "use method: quadric, the default");
    conflicts.refuse(o.max_error && limited, "max_quadric_error",
                     "max_error replaces max_quadric_error, so only one can be given", "remove one of them");
    if (conflicts.has("share") && o.share == SimplifyOptions::Share::error)
        add_refusal(check_simplify_sharing({.method = o.settings.method}), "simplify", given, problems);
    if (o.lock.box) verify_box(*o.lock.box, conflicts.mark("lock"), problems);
}

SimplifySettings simplify_settings(const SimplifyOptions& o) {
    SimplifySettings s = o.settings;
    s.lock = {.boundary = o.lock.boundary, .seams = o.lock.seams, .groups = o.lock.group};
    s.feature_angle = o.feature_angle.radians;
    if (o.ratio) s.ratio = o.ratio->value;
    s.faces = o.faces;
    s.vertices = o.vertices;
    if (o.max_error) s.max_error = o.max_error->amount;
    const ConstraintOptions& c = o.constraints;
    s.constraints = {.least_cosine = cosine(c.normal_deviation.radians),
                     .aspect_ratio = c.aspect_ratio.value_or(0),
                     .roundness = c.roundness.value_or(0),
                     .hausdorff = c.hausdorff ? c.hausdorff->amount : 0};
    if (o.lods)
        for (const Ratio& ratio : o.lods->ratios) s.levels.push_back(ratio.value);
    return s;
}

} // namespace facetmill::simplify_stage
