#include "geometry/crop/crop.hpp"
#include "options/mark_at.hpp"
#include "stage/bind_pose.hpp"
#include "stage/both_sides.hpp"
#include "stage/context.hpp"
#include "stage/options/cap.hpp"
#include "stage/options/footprint.hpp"
#include "stage/options/kept_parts.hpp"
#include "stage/options/snap.hpp"
#include "stage/stage.hpp"
#include "stages/crop/help.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::crop_stage {

namespace {

struct PartsToCrop {
    CropSettings settings; ///< shared by all parts, except transform, memory and the caps' primitive
    bool triangulate = false;
    bool both = false; ///< keeps the inside, and the outside as a separate part after it
    std::string cap_material;
};

struct CropReport {
    std::size_t rings = 0;
    double footprint_area = 0;
    std::string axis;
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0, snapped = 0, faces_before = 0,
                faces_after = 0;
    KeptParts kept;
};

enum class CropKeep { inside, outside, both };

struct CropOptions {
    FootprintOption footprint;
    ViewAxis axis = ViewAxis::up;
    CropBy by = CropBy::cut;
    CropKeep keep = CropKeep::inside;
    InsideBy inside_by = InsideBy::crossings;
    bool cap = false;
    std::string cap_material = "cap";
    bool triangulate = false;
    Snap snap = Snap::automatic;
};

void declare(Declare<CropOptions>& d) {
    d.option(
         "footprint", &CropOptions::footprint,
         "The polygon: a GeoJSON, WKT or DXF file, WKT text, a ring of points, or a list of rings. A ring "
         "inside another is a hole. Coordinates are in scene units, unless a DXF gives its own unit.")
        .required()
        .primary();
    declare_view_axis(d, &CropOptions::axis);
    d.choice<CropBy>(
        "by", &CropOptions::by,
        {{"cut", CropBy::cut, "cut faces at the outline"},
         {"whole", CropBy::whole, "keep whole faces that are entirely on the kept side"},
         {"centre", CropBy::centre,
          "keep whole faces whose centroid (the mean of their corners) is on the kept side"},
         {"overlapping", CropBy::overlapping, "keep whole faces that are at least partly on the kept side"}},
        "How to handle faces at the outline.");
    d.choice<CropKeep>("keep", &CropOptions::keep,
                       {{"inside", CropKeep::inside, "the area inside the polygon, without its holes"},
                        {"outside", CropKeep::outside, "everything else"},
                        {"both", CropKeep::both, "both sides, as parts NAME.inside and NAME.outside"}},
                       "The side to keep.");
    d.choice<InsideBy>(
        "inside_by", &CropOptions::inside_by,
        {{"crossings", InsideBy::crossings, "count the edges that a ray crosses; exact and fast"},
         {"angles", InsideBy::angles, "add up the angles that the edges subtend"},
         {"half_planes", InsideBy::half_planes,
          "check that the point is on the same side of all edges; for one convex ring"},
         {"angles_3d", InsideBy::angles_3d, "add up unsigned angles; for one convex ring"}},
        "The test for points inside the polygon. All methods give the same result.");
    declare_cap(d, &CropOptions::cap, &CropOptions::cap_material);
    declare_triangulate(d, &CropOptions::triangulate);
    declare_snap(d, &CropOptions::snap, "the outline");
}

void declare_report(DeclareFields<CropReport>& d) {
    d.field("rings", &CropReport::rings, "Rings of the footprint.");
    d.field("footprint_area", &CropReport::footprint_area, "The area inside the footprint.")
        .unit("square scene units");
    d.field("axis", &CropReport::axis, "The viewing axis: x, y or z.");
    d.field("cut_faces", &CropReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &CropReport::cap_faces, "Faces of the walls on the outline.");
    d.field("open_contours", &CropReport::open_contours,
            "Contours that were not capped because they are open.");
    d.field("snapped", &CropReport::snapped,
            "Vertices that count as on the outline because they are within the rounding of float32.");
    d.field("faces_before", &CropReport::faces_before, "Faces of the input.");
    d.field("faces_after", &CropReport::faces_after,
            "Faces of the result. With keep: both, the sum of both sides.");
    declare_kept_parts(d, &CropReport::kept);
}

class CropRun {
  public:
    CropRun(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context)
        : scene_(scene), footprint_(footprint), triangulate_(how.triangulate), both_(how.both),
          settings_(how.settings), context_(context), sides_(scene) {
        if (settings_.cap) set_cap(settings_, scene, how.cap_material);
    }

    CropReport run(const std::string& cap_material) {
        report_.rings = footprint_.rings().size();
        report_.footprint_area = footprint_.area();
        report_.axis = std::string(1, "xyz"[settings_.axis]);
        context_.for_each_part(scene_, [&](Part& part) { crop_part(part); });
        warn();
        if (report_.cap_faces > 0) add_material(scene_, cap_material);
        sides_.insert();
        return report_;
    }

  private:
    void crop_part(Part& part) {
        settings_.to_world = part.transform;
        settings_.memory = part.cuts ? *part.cuts : CutMemory{};
        const std::size_t faces = part.mesh.face_count();
        std::vector<CropResult> sides;
        if (both_)
            sides = crop_both(part.mesh, footprint_, settings_);
        else
            sides.push_back(crop(part.mesh, footprint_, settings_));
        note(part, sides, faces);
        const double diagonal = length(part.transform.vector(part.mesh.bounds().extent()));
        warn_of_snapping(part.name, {sides[0].snapped, sides[0].snapped_by, diagonal}, "the outline",
                         context_);
        report_.faces_before += faces;
        report_.cut_faces += sides[0].cut_faces;
        report_.snapped += sides[0].snapped;
        CutMemory memory;
        for (CropResult& r : sides) {
            if (triangulate_ && !r.mesh.all_triangles()) r.mesh = triangulated(r.mesh);
            report_.faces_after += r.mesh.face_count();
            report_.cap_faces += r.cap_faces;
            report_.open_contours += r.open.size();
            context_.attribute_changes(part, r.changes);
            memory.add_all(std::move(r.memory.entries));
        }
        if (!memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(memory));
        part.mesh = {};
        if (both_) sides_.part_in_two(part, ".inside", ".outside", std::move(sides[1].mesh));
        part.mesh = std::move(sides[0].mesh);
    }

    std::string where_they_are() const {
        return fmt::format("the footprint reaches from {}, the {} from {}", bounds_of(footprint_).text(),
                           report_.kept.all() == 1 ? "part" : "scene", emptied_.text());
    }

    void note(const Part& part, const std::vector<CropResult>& sides, std::size_t faces) {
        const bool cloud = faces == 0 && part.mesh.vertex_count() > 0;
        std::size_t left = 0;
        bool changed = false;
        for (const CropResult& r : sides) {
            warn_of_open("crop", part, r.open, context_);
            const std::size_t kept = cloud ? r.mesh.vertex_count() : r.mesh.face_count();
            left += kept;
            changed |= kept > 0 && r.changed;
        }
        const std::size_t had = cloud ? part.mesh.vertex_count() : faces;
        report_.kept.add(part, had, left, changed);
        if (had > 0 && left == 0) emptied_.add(bounds_of(part, settings_.axis));
    }

    void warn() {
        const char* hint = hint_for_missed(bounds_of(footprint_), emptied_);
        const KeptParts& kept = report_.kept;
        if (kept.are_all_emptied())
            context_.warn(
                "W-CROP-NOTHING",
                fmt::format("crop: nothing of {} was kept: {}", kept.all_of_them(), where_they_are()), hint);
        else if (kept.are_all_untouched())
            context_.warn(
                "W-CROP-ALL",
                fmt::format("crop: the outline does not cut {}, which stays whole", kept.all_of_them()),
                hint);
    }

    Scene& scene_;
    const Footprint& footprint_;
    bool triangulate_, both_;
    CropSettings settings_;
    Context& context_;
    BothSides sides_;
    FlatBounds emptied_; ///< the bounding box of the parts that were removed completely
    CropReport report_;
};

/// Crops the selected parts. Warns about open contours (W-CAP-OPEN), an outline that meets no part
/// (W-CROP-ALL), and an empty result (W-CROP-NOTHING).
CropReport crop_parts(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context) {
    return CropRun(scene, footprint, how, context).run(how.cap_material);
}

Scene run(Scene scene, const CropOptions& o, Context& context, CropReport& report) {
    warn_of_bind_pose(scene, context);
    PartsToCrop how;
    how.settings.axis = axis_of(o.axis, scene.up);
    how.settings.by = o.by;
    how.settings.inside_by = o.inside_by;
    how.settings.keep = o.keep == CropKeep::outside ? polygon::Keep::outside : polygon::Keep::inside;
    how.settings.cap = o.cap;
    how.settings.snap = o.snap == Snap::automatic;
    how.triangulate = o.triangulate;
    how.both = o.keep == CropKeep::both;
    how.cap_material = o.cap_material;
    report = crop_parts(scene, resolve_footprint(o.footprint, scene.unit, context), how, context);
    return scene;
}

struct CropStage : StageOf<run> {
    StageFiles files() const override {
        if (o.footprint.path.empty()) return {};
        return {{PathText{o.footprint.path}}, {}};
    }
    void verify(const Value& given, Problems& problems) const override {
        const Value* footprint = given.is_map() ? given.find("footprint") : &given;
        if (footprint) verify_footprint(o.footprint, *footprint, "crop", problems);
        if (o.cap && o.by != CropBy::cut)
            add_refusal(Refusal{"cap",
                                "'cap' needs a cut at the outline, so it cannot be used with whole faces",
                                "remove cap, or use by: cut"},
                        "crop", given, problems);
    }
    /// Faces kept whole do not change, so they need no triangulation.
    CrossingFacePolicy crossing_faces() const override {
        return o.by == CropBy::cut ? CrossingFacePolicy::fill : CrossingFacePolicy::keep;
    }
};

const RegisterStage registered = make_stage<CropStage>(
    {.name = "crop",
     .about = help::crop::about,
     .details = help::crop::details,
     .examples = {"crop: [[0, 0], [10, 0], [10, 5], [0, 5]]",
                  "crop: {footprint: \"POLYGON ((0 0, 4 0, 4 4, 0 4), (1 1, 2 1, 2 2, 1 2))\", by: whole}",
                  "crop: {footprint: parcel.geojson, keep: outside, axis: z}",
                  "crop: {footprint: parcel.geojson, keep: both, cap: true}",
                  "crop: {footprint: [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]], cap: true}"},
     .may_lose = MayLose::all,
     .crossing_faces = CrossingFacePolicy::fill},
    declare, declare_report);

} // namespace

} // namespace facetmill::crop_stage
