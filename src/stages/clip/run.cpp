#include "stage/both_sides.hpp"
#include "stage/options/box.hpp"
#include "stage/options/cap.hpp"
#include "stage/options/plane.hpp"
#include "stage/options/snap.hpp"
#include "stage/stage.hpp"
#include "stages/clip/help.hpp"

#include <fmt/format.h>

namespace facetmill::clip_stage {

namespace {

enum class Space { world, local };

struct ClipOptions {
    std::optional<PlaneOption> plane;
    std::vector<PlaneOption> planes;
    std::optional<BoxOption> box;
    Space space = Space::world;
    Keep keep = Keep::front;
    bool cap = false;
    std::string cap_material = "cap";
    bool triangulate = false;
    Coplanar coplanar = Coplanar::keep;
    Snap snap = Snap::automatic;
};

struct PartsToClip {
    ClipSettings settings; ///< the same for all; planes, memory and the caps' primitive are set part by part
    std::string cap_material;
    const char *front = ".front", *back = ".back"; ///< added to the names of both sides
};

struct ClipReport {
    std::optional<std::vector<Plane>> planes; ///< in the world
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0, on_plane = 0, snapped = 0, remembered = 0;
};

void declare(Declare<ClipOptions>& d) {
    d.group("plane", &ClipOptions::plane, "The plane to clip by.", declare_plane).primary();
    d.option("planes", &ClipOptions::planes, "Several planes, each as for plane; one after the other.");
    d.group("box", &ClipOptions::box, "A box to clip by; its front is the inside.", declare_box);
    d.exactly_one({"plane", "planes", "box"});
    d.choice<Keep>(
        "keep", &ClipOptions::keep,
        {{"inside", Keep::front, "of a box: the same as front"},
         {"outside", Keep::back, "of a box: the same as back"},
         {"front", Keep::front, "what lies on the side that the normal points to, or inside the box"},
         {"back", Keep::back, "what lies on the other side, or around the box"},
         {"both", Keep::both,
          "both, as parts NAME.front and NAME.back (NAME.inside, NAME.outside); with several planes the back "
          "is everything that is not in front of all of them"}},
        "Which side is kept.");
    declare_cap(d, &ClipOptions::cap, &ClipOptions::cap_material);
    d.option("triangulate", &ClipOptions::triangulate,
             "Cut all faces into triangles; without this, a cut triangle may become a quad.");
    d.choice<Space>(
        "space", &ClipOptions::space,
        {{"world", Space::world, "planes and boxes stand in the scene"},
         {"local", Space::local, "they stand in each part's own space, before its node's transform"}},
        "What coordinates, centre and extent refer to.");
    d.choice<Coplanar>("coplanar", &ClipOptions::coplanar,
                       {{"keep", Coplanar::keep, "they stay"}, {"drop", Coplanar::drop, "they go"}},
                       "What is done with faces of open parts that lie in the plane. Those of closed parts "
                       "are kept when they face away from what is kept.");
    declare_snap(d, &ClipOptions::snap, "a plane");
}

/// The value of an option as written, or the whole.
const Value& written(const Value& given, const char* name) {
    const Value* value = given.is_map() ? given.find(name) : nullptr;
    return value ? *value : given;
}

std::vector<Plane> resolved(const ClipOptions& o, const Scene& scene, Context& context, const Part* local) {
    std::vector<Plane> planes;
    if (o.box) planes = planes_of(*o.box);
    if (o.plane) planes.push_back(resolve_plane(*o.plane, scene, context, "plane", local));
    for (const PlaneOption& p : o.planes) planes.push_back(resolve_plane(p, scene, context, "planes", local));
    return planes;
}

/// Adds E-PLANE and E-BOX for what is none.
void verify(const ClipOptions& o, const Value& given, Problems& problems) {
    const Value& planes = written(given, "planes");
    if (o.plane) verify_plane(*o.plane, written(given, "plane").mark, problems);
    if (o.box) verify_box(*o.box, written(given, "box").mark, problems);
    if (given.is_map() && given.find("planes") && planes.is_list() && planes.items.empty())
        problems.add(planes.mark, "E-PLANE", "'planes' is empty", "for example planes: [z=0, x=centre]");
    for (std::size_t i = 0; i < o.planes.size(); ++i) {
        const bool listed = planes.is_list() && i < planes.items.size();
        verify_plane(o.planes[i], listed ? planes.items[i].mark : given.mark, problems);
    }
}

/// The planes to clip by, in a scene.
class Cutter {
  public:
    /// Throws usage (E-UNIT, E-PLANE), as planes_for does.
    Cutter(const ClipOptions& o, const Scene& scene, Context& context)
        : options_(o), scene_(scene), context_(context) {
        if (o.space == Space::world) world_ = resolved(o, scene, context, nullptr);
    }
    /// With space: world, as they stand in the scene.
    const std::vector<Plane>& world() const { return world_; }
    /// In the part's own space.
    std::vector<Plane> planes_for(const Part& part) const {
        if (options_.space == Space::local) return resolved(options_, scene_, context_, &part);
        std::vector<Plane> planes = world_;
        for (Plane& p : planes) p = pulled_back(p, part.transform);
        return planes;
    }

  private:
    const ClipOptions& options_;
    const Scene& scene_;
    Context& context_;
    std::vector<Plane> world_;
};

void declare_plane_field(DeclareFields<Plane>& d) {
    d.field("normal", &Plane::normal, "The direction of its front.");
    d.field("through", &Plane::through, "A point on it.");
    d.field("offset", &Plane::offset, "Its distance from that point along the normal.").unit("scene units");
}

void declare_report(DeclareFields<ClipReport>& d) {
    d.list("planes", &ClipReport::planes, "The planes, in the world.", declare_plane_field)
        .only_when("they stand in the world (space: world)");
    d.field("cut_faces", &ClipReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &ClipReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &ClipReport::open_contours,
            "Contours that were not capped because they are open.");
    d.field("on_plane", &ClipReport::on_plane, "Vertices that lie on a plane.");
    d.field("snapped", &ClipReport::snapped, "Those that do so within the rounding of float32.");
    d.field("remembered", &ClipReport::remembered, "Those that an earlier clip placed there.");
}

/// What users should know of a clip: open contours, everything kept, nothing kept.
void warn(const Part& part, const ClipResult& r, bool had_faces, Context& context) {
    warn_of_open("clip", part, r.open, context);
    if (!r.changed && had_faces)
        context.warn("W-CLIP-ALL",
                     fmt::format("clip: no plane cuts part '{}'; all of it was kept", part.name),
                     "check the position and direction of the plane; info prints the bounds");
    if (had_faces && r.front.face_count() + r.back.face_count() == 0)
        context.warn("W-CLIP-NOTHING", fmt::format("clip: nothing of part '{}' was kept", part.name),
                     "check the position and direction of the plane; keep: back keeps the other side");
}

/// Clips the parts selected by the cutter's planes; with Keep::both the back of each comes behind it. Warns
/// of open contours (W-CAP-OPEN), of parts that no plane met (W-CLIP-ALL) and of which nothing is left
/// (W-CLIP-NOTHING).
ClipReport clip_parts(Scene& scene, const Cutter& cutter, const PartsToClip& how, Context& context) {
    ClipSettings settings = how.settings;
    if (settings.cap) set_cap(settings, scene, how.cap_material);
    BothSides sides(scene);
    ClipReport report;
    if (!cutter.world().empty()) report.planes = cutter.world();
    context.for_each_part(scene, [&](Part& part) {
        const bool had_faces = part.mesh.face_count() > 0;
        settings.planes = cutter.planes_for(part);
        settings.memory = part.cuts ? *part.cuts : CutMemory{};
        ClipResult r = clip(std::move(part.mesh), settings);
        warn(part, r, had_faces, context);
        context.attribute_changes(part, r.changes);
        report.cut_faces += r.cut_faces;
        report.cap_faces += r.cap_faces;
        report.open_contours += r.open.size();
        report.on_plane += r.on_plane;
        report.snapped += r.snapped;
        report.remembered += r.remembered;
        if (!r.memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        part.mesh = {};
        if (settings.keep == Keep::both) sides.part_in_two(part, how.front, how.back, std::move(r.back));
        part.mesh = std::move(settings.keep == Keep::back ? r.back : r.front);
    });
    if (report.cap_faces > 0) add_material(scene, how.cap_material);
    sides.insert();
    return report;
}

Scene run(Scene scene, const ClipOptions& o, Context& context, ClipReport& report) {
    PartsToClip how;
    how.settings.keep = o.keep;
    how.settings.convex = o.box || (o.keep == Keep::both && o.planes.size() > 1);
    how.settings.cap = o.cap;
    how.settings.triangulate = o.triangulate;
    how.settings.coplanar = o.coplanar;
    how.settings.snap = o.snap == Snap::automatic;
    how.cap_material = o.cap_material;
    if (o.box) {
        how.front = ".inside";
        how.back = ".outside";
    }
    report = clip_parts(scene, Cutter(o, scene, context), how, context);
    return scene;
}

const RegisterStage clip_stage = make_stage<ClipOptions>(
    {.name = "clip",
     .about = help::clip::about,
     .details = help::clip::details,
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}",
                  "clip: {planes: [x=20%, y=20%], keep: both, cap: true}",
                  "clip: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}, cap: true}",
                  "clip: {box: {centre: [0, 0, 0], size: [2, 1, 1], angle: 30deg}, keep: outside}"},
     .may_lose = MayLose::all,
     .crossing_faces = CrossingFacePolicy::fill},
    declare, declare_report, run, StageHooks<ClipOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill::clip_stage
