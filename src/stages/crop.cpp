#include "geometry/crop.hpp"

#include "mesh/placement.hpp"
#include "stage/cap_option.hpp"
#include "stage/footprint_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Axis { up, x, y, z };

struct CropOptions {
    FootprintOption footprint;
    Axis axis = Axis::up;
    CropBy by = CropBy::cut;
    polygon::Keep keep = polygon::Keep::inside;
    InsideBy inside_by = InsideBy::crossings;
    bool cap = false;
    std::string cap_material = "cap";
};

void declare(Declare<CropOptions>& d) {
    d.option("footprint", &CropOptions::footprint,
             "The polygon, in scene units: a GeoJSON, WKT or DXF file; WKT; a ring of points, or a list of "
             "rings, of "
             "which those within others are holes.")
        .required()
        .primary();
    d.choice<Axis>("axis", &CropOptions::axis,
                   {{"up", Axis::up, "the scene's up axis; z when it is not known"},
                    {"x", Axis::x, "the footprint is in y and z"},
                    {"y", Axis::y, "the footprint is in x and z"},
                    {"z", Axis::z, "the footprint is in x and y"}},
                   "The axis to look along.");
    d.choice<CropBy>("by", &CropOptions::by,
                     {{"cut", CropBy::cut, "faces are cut at the outline"},
                      {"whole", CropBy::whole, "faces that lie wholly on the kept side stay"},
                      {"centre", CropBy::centre, "faces whose corners' mean lies there stay"},
                      {"touching", CropBy::touching, "faces of which any part lies there stay"}},
                     "What happens to faces at the outline.");
    d.choice<polygon::Keep>(
        "keep", &CropOptions::keep,
        {{"inside", polygon::Keep::inside, "what lies in the polygon and not in its holes"},
         {"outside", polygon::Keep::outside, "the rest"}},
        "Which side stays.");
    d.choice<InsideBy>(
        "inside_by", &CropOptions::inside_by,
        {{"crossings", InsideBy::crossings, "how many edges lie to one side; exact and fast"},
         {"angles", InsideBy::angles, "the sum of the angles that the edges subtend"},
         {"half_planes", InsideBy::half_planes, "one side of all edges; for one convex ring"},
         {"angles_3d", InsideBy::angles_3d, "the sum of unsigned angles; for one convex ring"}},
        "How it is found whether a point is inside; all give the same.");
    declare_cap(d, &CropOptions::cap, &CropOptions::cap_material);
}

std::size_t axis_of(const CropOptions& o, const Scene& scene) {
    if (o.axis == Axis::up) return scene.up == UpAxis::y ? 1 : 2;
    return o.axis == Axis::x ? 0 : o.axis == Axis::y ? 1 : 2;
}

void warn(const Part& part, const CropResult& r, bool had_faces, Context& context) {
    warn_of_open("crop", part, r.open, context);
    constexpr const char* hint = "check the footprint's place and axis; info prints the bounds";
    if (had_faces && r.mesh.face_count() == 0)
        context.warn("W-CROP-NOTHING", fmt::format("crop: nothing of part '{}' was kept", part.name), hint);
    else if (had_faces && !r.changed)
        context.warn("W-CROP-ALL",
                     fmt::format("crop: the outline does not meet part '{}', all of it was kept", part.name),
                     hint);
}

Scene run(Scene scene, const CropOptions& o, Context& context) {
    const Footprint footprint = resolve_footprint(o.footprint, context);
    CropSettings settings;
    settings.axis = axis_of(o, scene), settings.by = o.by, settings.keep = o.keep;
    settings.inside_by = o.inside_by;
    if (o.cap) set_cap(settings, scene, o.cap_material);
    std::size_t cut = 0, before = 0, after = 0, caps = 0, open = 0;
    context.for_each_part(scene, [&](Part& part) {
        settings.to_world = effective(part);
        settings.memory = part.cuts ? *part.cuts : CutMemory{};
        const std::size_t faces = part.mesh.face_count();
        CropResult r = crop(part.mesh, footprint, settings);
        warn(part, r, faces > 0, context);
        context.ledger(part, r.fates);
        part.mesh = std::move(r.mesh);
        if (!r.memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        cut += r.cut_faces, before += faces, after += part.mesh.face_count();
        caps += r.cap_faces, open += r.open.size();
    });
    if (caps > 0) add_material(scene, o.cap_material);
    context.result() = {{"rings", footprint.rings().size()},
                        {"footprint_area", footprint.area()},
                        {"axis", std::string(1, "xyz"[settings.axis])},
                        {"cut_faces", cut},
                        {"cap_faces", caps},
                        {"open_contours", open},
                        {"faces_before", before},
                        {"faces_after", after}};
    return scene;
}

void verify(const CropOptions& o, const Value& given, Problems& problems) {
    const auto find = [&](const char* name) { return given.is_map() ? given.find(name) : nullptr; };
    const Value* footprint = given.is_map() ? find("footprint") : &given;
    if (footprint) verify_footprint(o.footprint, *footprint, "crop", problems);
    if (o.cap && o.by != CropBy::cut)
        problems.add(find("cap")->mark, "E-CROP",
                     "crop: walls stand on the outline, and by whole faces nothing is cut there",
                     "leave out cap, or take by: cut");
}

StageFiles files(const CropOptions& o) {
    if (o.footprint.path.empty()) return {};
    return {{PathText{o.footprint.path}}, {}};
}

const RegisterStage registered{make_stage<CropOptions>(
    {.name = "crop",
     .about = "Keeps what lies in a polygon seen along an axis, or outside it.",
     .details =
         "The footprint is a polygon with holes and islands, in the world's coordinates across the "
         "axis. What is in an "
         "odd number of its rings is inside, whichever way round they run; a last point that repeats "
         "the first may be "
         "there or not. A footprint that crosses itself is refused with the place.\n\n"
         "Cut at the outline, faces get points where the outline passes over them, one for each edge, "
         "shared by the "
         "faces there, so no crack opens; a face at a corner of the outline falls into a few more "
         "pieces than it must. "
         "With cap, a closed part stays closed: upright walls stand on the outline and on its holes, and "
         "those of the inside "
         "and the outside fit exactly. cut_id numbers the walls by the outline's segments, group by its "
         "rings. Without cap, "
         "closed parts become open. Positions that are 32-bit floats count as on the outline within one "
         "float's rounding "
         "of the part's bounds: the 0.1 of an STL is not that of a footprint. New vertices and wedges are "
         "interpolated, "
         "pieces copy the "
         "attributes of their face. By whole faces, nothing is mixed; corners on the outline count to "
         "either side.\n\n"
         "Files: GeoJSON (Polygon, MultiPolygon, features and collections of them), WKT (POLYGON, "
         "MULTIPOLYGON), DXF as "
         "text (closed polylines and circles; arcs in segments of at most 5 degrees).\n\n"
         "Source: the note on points inside a polygon (1987).",
     .examples = {"crop: [[0, 0], [10, 0], [10, 5], [0, 5]]",
                  "crop: {footprint: \"POLYGON ((0 0, 4 0, 4 4, 0 4), (1 1, 2 1, 2 2, 1 2))\", by: whole}",
                  "crop: {footprint: parcel.geojson, keep: outside, axis: z}",
                  "crop: {footprint: [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]], cap: true}"}},
    declare, run, StageHooks<CropOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
