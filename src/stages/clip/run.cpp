#include "cells/partition/gather.hpp"
#include "cells/process/inspect_cells.hpp"
#include "stage/bind_pose.hpp"
#include "stage/both_sides.hpp"
#include "stage/options/box.hpp"
#include "stage/options/cap.hpp"
#include "stage/options/kept_parts.hpp"
#include "stage/options/plane.hpp"
#include "stage/options/snap.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/stage.hpp"
#include "stage/world_outline.hpp"
#include "stages/clip/help.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

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
    ClipSettings settings; ///< shared by all parts, except planes, memory and the caps' primitive
    std::string cap_material;
    const char *front = ".front", *back = ".back"; ///< added to the names of both sides
    bool by_box = false;                           ///< for messages
};

struct ClipReport {
    std::optional<std::vector<Plane>> planes; ///< in world space
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0, on_plane = 0, snapped = 0, remembered = 0;
    KeptParts kept;
};

void declare(Declare<ClipOptions>& d) {
    d.group("plane", &ClipOptions::plane, "The plane to clip by.", declare_plane)
        .also_called(plane_synonyms, plane_is)
        .primary();
    d.option("planes", &ClipOptions::planes,
             "Several planes, each written as for plane. They clip one after the other.");
    d.group("box", &ClipOptions::box, "A box to clip by. Its inside is the front.", declare_box);
    d.exactly_one({"plane", "planes", "box"});
    d.choice<Keep>(
        "keep", &ClipOptions::keep,
        {{"inside", Keep::front, "for a box: the same as front"},
         {"outside", Keep::back, "for a box: the same as back"},
         {"front", Keep::front, "the side that the normal points to, or the inside of the box"},
         {"back", Keep::back, "the other side, or the outside of the box"},
         {"both", Keep::both,
          "both sides, as parts NAME.front and NAME.back (for a box, NAME.inside and NAME.outside). With "
          "several planes, the back is everything that is not in front of all of them"}},
        "The side to keep.");
    declare_cap(d, &ClipOptions::cap, &ClipOptions::cap_material);
    declare_triangulate(d, &ClipOptions::triangulate);
    d.choice<Space>("space", &ClipOptions::space,
                    {{"world", Space::world, "the scene's coordinates"},
                     {"local", Space::local, "each part's own coordinates, before its node transform"}},
                    "The space of planes and boxes, and of centre and extent.");
    d.choice<Coplanar>(
        "coplanar", &ClipOptions::coplanar,
        {{"keep", Coplanar::keep, "keep these faces"}, {"drop", Coplanar::drop, "remove these faces"}},
        "How to handle faces of open parts that lie in the plane. Faces of closed parts are kept if they "
        "face away from the kept side.");
    declare_snap(d, &ClipOptions::snap, "a plane");
}

/// The option's value as written, or the whole map.
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

/// The planes that clip a scene.
class Cutter {
  public:
    /// Throws a usage error (E-UNIT, E-PLANE), as planes_for does.
    Cutter(const ClipOptions& o, const Scene& scene, Context& context)
        : options_(o), scene_(scene), context_(context) {
        if (o.space == Space::world) world_ = resolved(o, scene, context, nullptr);
    }
    /// The planes in world space; empty with space: local.
    const std::vector<Plane>& world() const { return world_; }
    /// The planes in the part's own space.
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
    d.field("normal", &Plane::normal, "The direction of the front.");
    d.field("through", &Plane::through, "A point. It is on the plane if offset is 0.");
    d.field("offset", &Plane::offset, "The signed distance of that point from the plane, along the normal.")
        .unit("scene units");
}

void declare_report(DeclareFields<ClipReport>& d) {
    d.list("planes", &ClipReport::planes, "The planes in world space.", declare_plane_field)
        .only_when("the planes are in world space (space: world)");
    d.field("cut_faces", &ClipReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &ClipReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &ClipReport::open_contours,
            "Contours that were not capped because they are open.");
    d.field("on_plane", &ClipReport::on_plane, "Vertices on a plane.");
    d.field("snapped", &ClipReport::snapped,
            "Vertices that count as on a plane because they are within the rounding of float32.");
    d.field("remembered", &ClipReport::remembered, "Vertices that an earlier clip placed on the same plane.");
    declare_kept_parts(d, &ClipReport::kept);
}

/// Warns if the whole scene was kept, or nothing.
void warn(const KeptParts& kept, const PartsToClip& how, Context& context) {
    const std::string look = fmt::format("check the position and {} (facetmill info prints the bounds)",
                                         how.by_box ? "size of the box" : "direction of the plane");
    if (kept.are_all_untouched())
        context.warn("W-CLIP-ALL",
                     fmt::format("clip: {} {}, which stays whole",
                                 how.by_box ? "the box does not cut" : "no plane cuts", kept.all_of_them()),
                     look);
    if (!kept.are_all_emptied()) return;
    const bool front = how.settings.keep == Keep::front;
    const char* other = how.by_box ? (front ? "rest (keep: outside)" : "inside (keep: inside)")
                                   : (front ? "other side (keep: back)" : "other side (keep: front)");
    context.warn("W-CLIP-NOTHING", fmt::format("clip: nothing of {} was kept", kept.all_of_them()),
                 fmt::format("{}, or keep the {}", look, other));
}

/// Clips the selected parts by the cutter's planes. With Keep::both, each part's back follows its front.
/// Warns about open contours (W-CAP-OPEN), planes that meet no part (W-CLIP-ALL), and an empty result
/// (W-CLIP-NOTHING).
ClipReport clip_parts(Scene& scene, const Cutter& cutter, const PartsToClip& how, Context& context) {
    ClipSettings settings = how.settings;
    if (settings.cap) set_cap(settings, scene, how.cap_material);
    BothSides sides(scene);
    ClipReport report;
    if (!cutter.world().empty()) report.planes = cutter.world();
    context.for_each_part(scene, [&](Part& part) {
        const bool cloud = part.mesh.face_count() == 0;
        const auto size = [cloud](const Mesh& m) { return cloud ? m.vertex_count() : m.face_count(); };
        const std::size_t had = size(part.mesh);
        settings.planes = cutter.planes_for(part);
        settings.memory = part.cuts ? *part.cuts : CutMemory{};
        const double diagonal = part.mesh.bounds().diagonal();
        ClipResult r = clip(std::move(part.mesh), settings);
        warn_of_open("clip", part, r.open, context);
        report.kept.add(part, had, size(r.front) + size(r.back), r.changed);
        warn_of_snapping(part.name, {r.snapped, r.snapped_by, diagonal}, "a plane", context);
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
    warn(report.kept, how, context);
    if (report.cap_faces > 0) add_material(scene, how.cap_material);
    sides.insert();
    return report;
}

PartsToClip parts_to_clip(const ClipOptions& o) {
    PartsToClip how;
    how.settings.keep = o.keep;
    how.settings.convex = o.box || (o.keep == Keep::both && o.planes.size() > 1);
    how.settings.cap = o.cap;
    how.settings.triangulate = o.triangulate;
    how.settings.coplanar = o.coplanar;
    how.settings.snap = o.snap == Snap::automatic;
    how.cap_material = o.cap_material;
    how.by_box = o.box.has_value();
    if (o.box) {
        how.front = ".inside";
        how.back = ".outside";
    }
    return how;
}

Scene run(Scene scene, const ClipOptions& o, Context& context, ClipReport& report) {
    warn_of_bind_pose(scene, context);
    report = clip_parts(scene, Cutter(o, scene, context), parts_to_clip(o), context);
    return scene;
}

/// Selects the faces of cells that a clip may keep or cut. Other faces touch neither the kept side nor its
/// caps.
class Reached {
  public:
    Reached(std::vector<Plane> planes, const PartsToClip& how, const Box& box)
        : planes_(std::move(planes)), keep_(how.settings.keep), convex_(how.settings.convex) {
        // The caps of a plane depend on all faces that earlier planes kept, so only the first plane can
        // exclude faces.
        if (how.settings.cap && planes_.size() > 1) {
            if (keep_ == Keep::back && convex_)
                planes_.clear();
            else
                planes_.resize(1);
        }
        // Points within float32 rounding of a plane, well below a millionth, count as on the plane.
        constexpr double near = 1e-6;
        double size = box.longest_side();
        for (const Vec3& p : {box.min, box.max})
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        for (const Plane& p : planes_) margin_.push_back(near * size * length(p.normal));
    }

    bool operator()(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double away = keep_ == Keep::front ? -1 : 1; // the sign of the removed side
        bool all = !planes_.empty(), any = false;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const double s[] = {side(planes_[i], a), side(planes_[i], b), side(planes_[i], c)};
            const bool beyond =
                std::all_of(std::begin(s), std::end(s), [&](double x) { return away * x > margin_[i]; });
            in_plane_ |=
                std::all_of(std::begin(s), std::end(s), [&](double x) { return std::abs(x) <= margin_[i]; });
            all &= beyond;
            any |= beyond;
        }
        return !(keep_ == Keep::back && convex_ ? all : any);
    }
    /// Whether any face was in a plane, within the margin.
    bool in_plane() const { return in_plane_; }

  private:
    std::vector<Plane> planes_;
    std::vector<double> margin_;
    Keep keep_;
    bool convex_, in_plane_ = false;
};

/// The treatment of faces in the plane depends on whether the part is closed. The gathered faces alone may
/// not show this.
void check_faces_in_plane(const CellFlow& flow, const Mesh& some) {
    if (inspect(some).closed == cells::inspect_cells(*flow.partition, {}, flow.means).closed) return;
    throw Error(ErrorKind::usage, "E-CELLS",
                "clip: a face lies in the plane, so the cut needs the whole mesh in memory",
                "move the plane a little, or give more memory");
}

struct ClipStage : StageOf<run> {
    /// Adds E-PLANE for invalid planes and E-BOX for an invalid box.
    void verify(const Value& given, Problems& problems) const override {
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
    /// Loads only the faces that the planes reach, and clips them.
    void on_cells(CellFlow& flow, Context& context) const override;
    std::optional<std::string> why_not_on_cells() const override {
        if (o.keep == Keep::both) return "keep: both does not reduce the mesh";
        if (o.space == Space::local) return "space: local needs the part in memory";
        return {};
    }
};

void ClipStage::on_cells(CellFlow& flow, Context& context) const {
    const PartsToClip how = parts_to_clip(o);
    Scene outline = flow.outline();
    const Scene world = world_outline(flow);
    const Cutter cutter(o, world, context);
    const Box box = outline.parts.front().mesh.bounds();
    Reached reached(cutter.planes_for(outline.parts.front()), how, box);
    Mesh some = cells::gathered(*flow.partition, std::ref(reached), flow.means);
    if (reached.in_plane()) check_faces_in_plane(flow, some);
    flow.partition.reset();
    // The corners of the whole box give the same snapping tolerance as the whole mesh.
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            for (const double z : {box.min.z, box.max.z}) some.positions.push_back({x, y, z});
    for (Attribute& a : some.attributes) a.resize(some.count(a.domain));
    Scene scene{{}, {}, outline.unit, outline.up, {}};
    Part& part = scene.parts.emplace_back(outline.parts.front());
    part.mesh = std::move(some);
    part.changed = true;
    const ClipReport report = clip_parts(scene, cutter, how, context);
    for (Part& clipped : scene.parts) drop_unused(clipped.mesh);
    context.report(*info->result, &report);
    flow.scene = std::move(scene);
}

const RegisterStage registered = make_stage<ClipStage>(
    {.name = "clip",
     .also_called = "cut trim slice_plane",
     .about = help::clip::about,
     .details = help::clip::details,
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}",
                  "clip: {planes: [x=20%, y=20%], keep: both, cap: true}",
                  "clip: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}, cap: true}",
                  "clip: {box: {centre: [0, 0, 0], size: [2, 1, 1], angle: 30deg}, keep: outside}"},
     .may_lose = MayLose::all,
     .crossing_faces = CrossingFacePolicy::fill,
     .ends_cells = true},
    declare, declare_report);

} // namespace

} // namespace facetmill::clip_stage
