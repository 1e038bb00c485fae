#include "geometry/crop.hpp"

#include "base/hash.hpp"
#include "io/footprint.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Axis { up, x, y, z };

/// A file, or rings written in place.
struct FootprintText {
    std::string path;
    io::FootprintRings rings;
};

} // namespace

template <>
struct OptionType<FootprintText> {
    static constexpr const char* name = "footprint";
    static constexpr Dimension dimension = Dimension::none;

    static bool parse(const Value& value, FootprintText& out, Problems& problems) {
        if (value.deferred) return true;
        if (value.is_scalar() && io::is_wkt(value.text)) return parse_text(value, out, problems);
        if (value.is_scalar() && !value.text.empty()) return out.path = value.text, true;
        if (!value.is_list() || value.items.empty()) return refuse(value, problems);
        const bool nested =
            value.items[0].is_list() && !value.items[0].items.empty() && value.items[0].items[0].is_list();
        if (!nested) return parse_ring(value, out, problems);
        bool good = true;
        for (const Value& ring : value.items) good &= parse_ring(ring, out, problems);
        return good;
    }
    static std::string print(const FootprintText& value) { return value.path; }
    static Json schema() {
        const Json point = {
            {"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
        const Json ring = {{"type", "array"}, {"items", point}, {"minItems", 3}};
        return {{"anyOf", Json::array({{{"type", "string"}}, ring, {{"type", "array"}, {"items", ring}}})}};
    }
    static std::optional<double> magnitude(const FootprintText&) { return {}; }

  private:
    static bool refuse(const Value& value, Problems& problems) {
        problems.add(
            value.mark, "E-TYPE",
            fmt::format("expected a footprint (a file, POLYGON ((0 0, 1 0, 1 1)), [[0, 0], [1, 0], [1, 1]], "
                        "or a list of such rings), found {}",
                        value.described()));
        return false;
    }
    static bool parse_text(const Value& value, FootprintText& out, Problems& problems) {
        try {
            out.rings = io::parse_wkt(value.text, "the footprint");
        } catch (const Error& error) {
            problems.add(value.mark, "E-WKT", error.diagnostics().front().message);
            return false;
        }
        return true;
    }
    static bool parse_ring(const Value& value, FootprintText& out, Problems& problems) {
        if (!value.is_list()) return refuse(value, problems);
        auto& ring = out.rings.emplace_back();
        for (const Value& p : value.items) {
            if (!p.is_list() || p.items.size() != 2) return refuse(p, problems);
            Vec2 at;
            if (!OptionType<double>::parse(p.items[0], at.x, problems) ||
                !OptionType<double>::parse(p.items[1], at.y, problems))
                return false;
            ring.push_back(at);
        }
        return true;
    }
};

namespace {

struct CropOptions {
    FootprintText footprint;
    Axis axis = Axis::up;
    CropBy by = CropBy::cut;
    polygon::Keep keep = polygon::Keep::inside;
    InsideBy inside_by = InsideBy::crossings;
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
}

std::size_t axis_of(const CropOptions& o, const Scene& scene) {
    if (o.axis == Axis::up) return scene.up == UpAxis::y ? 1 : 2;
    return o.axis == Axis::x ? 0 : o.axis == Axis::y ? 1 : 2;
}

Footprint footprint_of(const CropOptions& o, Context& context) {
    if (o.footprint.path.empty()) return Footprint(o.footprint.rings);
    const io::Input input = io::Input::open(context.places().input(o.footprint.path));
    context.run().record.inputs.push_back({input.name(), input.stored().size(), sha256(input.stored()), {}});
    return Footprint(io::read_footprint(input));
}

Scene run(Scene scene, const CropOptions& o, Context& context) {
    const Footprint footprint = footprint_of(o, context);
    CropSettings settings{axis_of(o, scene), {}, o.by, o.keep, o.inside_by, {}};
    std::size_t cut = 0, before = 0, after = 0;
    context.for_each_part(scene, [&](Part& part) {
        settings.to_world = part.skinned ? Transform{} : part.transform;
        settings.memory = part.cuts ? *part.cuts : CutMemory{};
        const std::size_t faces = part.mesh.face_count();
        CropResult r = crop(part.mesh, footprint, settings);
        context.ledger(part, r.fates);
        part.mesh = std::move(r.mesh);
        if (!r.memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        cut += r.cut_faces, before += faces, after += part.mesh.face_count();
        if (faces > 0 && part.mesh.face_count() == 0)
            context.warn("W-CROP-NOTHING", fmt::format("crop: nothing of part '{}' was kept", part.name),
                         "check the footprint's place and axis; info prints the bounds");
        else if (faces > 0 && !r.changed)
            context.warn(
                "W-CROP-ALL",
                fmt::format("crop: the outline does not meet part '{}', all of it was kept", part.name),
                "check the footprint's place and axis; info prints the bounds");
    });
    context.result() = {{"rings", footprint.rings().size()},
                        {"footprint_area", footprint.area()},
                        {"axis", std::string(1, "xyz"[settings.axis])},
                        {"cut_faces", cut},
                        {"faces_before", before},
                        {"faces_after", after}};
    return scene;
}

/// A footprint written in place is checked before anything runs.
void verify(const CropOptions& o, const Value& given, Problems& problems) {
    const Value* value = given.is_map() ? given.find("footprint") : &given;
    if (!value || value->deferred || !o.footprint.path.empty()) return;
    try {
        static_cast<void>(Footprint(o.footprint.rings));
    } catch (const Error& error) {
        const Diagnostic& d = error.diagnostics().front();
        problems.add(value->mark, d.id, "crop: " + d.message, d.hint);
    }
}

StageFiles files(const CropOptions& o) {
    if (o.footprint.path.empty()) return {};
    return {{PathText{o.footprint.path}}, {}};
}

const RegisterStage registered{make_stage<CropOptions>(
    {.name = "crop",
     .about = "Keeps what lies in a polygon seen along an axis, or outside it.",
     .details = "The footprint is a polygon with holes and islands, in the world's coordinates across the "
                "axis. What is in an "
                "odd number of its rings is inside, whichever way round they run; a last point that repeats "
                "the first may be "
                "there or not. A footprint that crosses itself is refused with the place.\n\n"
                "Cut at the outline, faces get points where the outline passes over them, one for each edge, "
                "shared by the "
                "faces there, so no crack opens; a face at a corner of the outline falls into a few more "
                "pieces than it must. "
                "Closed parts become open: a crop does not cap. New vertices and wedges are interpolated, "
                "pieces copy the "
                "attributes of their face. By whole faces, nothing is mixed; corners on the outline count to "
                "either side.\n\n"
                "Files: GeoJSON (Polygon, MultiPolygon, features and collections of them), WKT (POLYGON, "
                "MULTIPOLYGON), DXF as "
                "text (closed polylines and circles; arcs in segments of at most 5 degrees).\n\n"
                "Source: the note on points inside a polygon (1987).",
     .examples = {"crop: [[0, 0], [10, 0], [10, 5], [0, 5]]",
                  "crop: {footprint: \"POLYGON ((0 0, 4 0, 4 4, 0 4), (1 1, 2 1, 2 2, 1 2))\", by: whole}",
                  "crop: {footprint: parcel.geojson, keep: outside, axis: z}"}},
    declare, run, StageHooks<CropOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
