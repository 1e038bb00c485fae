#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/drawn_box.hpp"
#include "stages/write/cells.hpp"
#include "stages/write/file.hpp"
#include "stages/write/fit.hpp"
#include "stages/write/help.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace facetmill::write_stage {

namespace {

/// A part that is temporarily in the written scene: its index in the scene, and its state before.
struct Lent {
    std::size_t part;
    Transform transform;
    bool changed;
    std::optional<Mesh> mesh{}; ///< the scene's mesh, if the file gets other faces, normals or tangents
    std::optional<std::vector<Vec3>> positions{}; ///< the scene's positions, if the file uses another origin
};

/// Triangulates the written parts and saves the scene's own meshes in `lent`.
void make_triangles(Scene& out, std::vector<Lent>& lent) {
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Part& part = out.parts[k];
        if (part.mesh.all_triangles()) continue;
        Mesh triangles = triangles_of(part.mesh);
        lent[k].mesh = std::exchange(part.mesh, std::move(triangles));
        part.changed = true;
    }
}

/// Computes normals of the written parts and saves the scene's own meshes in `lent`.
void give_normals(Scene& out, std::vector<Lent>& lent, const WriteOptions& o, Context& context) {
    if (o.normals == NormalKind::keep) return;
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Part& part = out.parts[k];
        if (part.mesh.face_count() == 0 && o.normals != NormalKind::none)
            continue; // points and lines have no faces to compute normals from
        if (!lent[k].mesh) lent[k].mesh = part.mesh;
        context.attribute_changes(
            part, give_normals(part.mesh, o.normals, o.feature_angle ? o.feature_angle->radians : pi));
        part.changed = true;
    }
}

/// Computes tangents of the written parts and saves the scene's own meshes in `lent`.
void give_tangents_to_all(Scene& out, std::vector<Lent>& lent, const WriteOptions& o, Context& context) {
    if (o.tangents == Tangents::keep) return;
    const auto uvs = normal_map_uvs(out);
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Mesh before = out.parts[k].mesh;
        if (give_tangents(out.parts[k], uvs, o, context) && !lent[k].mesh) lent[k].mesh = std::move(before);
    }
}

/// Makes the written parts fit the purpose in the precision of the file.
void keep_fit(Scene& out, std::vector<Lent>& lent, const Purpose& purpose, const io::Codec& codec,
              const io::WriteSettings& settings, Context& context) {
    auto replaced = make_fit(out, purpose, codec, settings, context);
    for (std::size_t k = 0; k < lent.size(); ++k) {
        if (!replaced[k]) continue;
        if (lent[k].positions) replaced[k]->positions = *std::exchange(lent[k].positions, std::nullopt);
        if (!lent[k].mesh) lent[k].mesh = std::move(replaced[k]);
    }
}

void declare_order(DeclareFields<io::VertexCacheUse>& d) {
    using Use = io::VertexCacheUse;
    const auto per = [](std::size_t Use::*transforms, std::size_t Use::*of) {
        return [=](const Use& use) {
            return static_cast<double>(use.*transforms) /
                   static_cast<double>(std::max(use.*of, std::size_t{1}));
        };
    };
    d.field("acmr_before", per(&Use::before, &Use::triangles),
            "Average vertex transforms per triangle (ACMR) with a cache of 16 vertices, in the order of the "
            "scene.");
    d.field("acmr", per(&Use::after, &Use::triangles),
            "ACMR in the written order. The best value is about 0.5.");
    d.field("atvr_before", per(&Use::before, &Use::vertices),
            "How often each vertex is transformed (ATVR), in the order of the scene.");
    d.field("atvr", per(&Use::after, &Use::vertices), "ATVR in the written order. The best value is 1.");
}

void declare_tiles_written(DeclareFields<io::TilesWritten>& d) {
    using Tiles = io::TilesWritten;
    d.field("tiles", &Tiles::tiles, "The number of tiles. Each tile is a file.");
    d.field("leaves", &Tiles::leaves,
            "The number of tiles without children. Together they contain all triangles.");
    d.field("levels", &Tiles::levels, "The largest number of tiles on a path from the root to a leaf.");
    d.field("largest", &Tiles::largest, "The number of triangles in the largest tile.");
    d.field("error", &Tiles::error, "The geometric error of the root, in metres.");
}

/// The names of the written formats with that capability.
std::vector<std::string> formats_with(bool io::Capabilities::*what) {
    std::vector<std::string> names;
    for (const io::Codec& codec : io::codecs())
        if (codec.write && codec.can.*what) names.push_back(codec.name);
    return names;
}

bool is_of_points(const Part& part) {
    return part.mesh.vertex_count() > 0 && part.mesh.face_count() == 0 && part.mesh.line_count() == 0;
}

/// The kinds of parts that a written file does not get.
struct LeftOut {
    bool lines = false, points = false;

    bool operator()(const Part& part) const {
        return part.mesh.line_count() > 0 ? lines : points && is_of_points(part);
    }
};

/// Points are left out only if there are faces; without faces, the format holds them or the stage fails.
LeftOut left_out(const Scene& scene, const io::Codec& codec, const Context& context) {
    const bool faces = std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return part.mesh.face_count() > 0 && context.selects(part, scene);
    });
    return {!codec.can.lines, faces && !codec.can.points_and_faces};
}

/// Warns of parts of one kind that are left out.
void warn_of_left_out(const std::vector<std::string>& names, bool lines, const WriteOptions& o,
                      const io::Codec& codec, Context& context) {
    if (names.empty()) return;
    const auto formats = formats_with(lines ? &io::Capabilities::lines : &io::Capabilities::points_and_faces);
    context.warn(lines ? "W-LINES" : "W-SKIPPED",
                 fmt::format("'{}': {} cannot store {}, so {} {} skipped: {}", o.path.text, codec.name,
                             lines ? "lines" : "points next to faces", counted(names.size(), "part"),
                             names.size() == 1 ? "is" : "are", fmt::join(names, ", ")),
                 fmt::format("{} can store {}", fmt::join(formats, ", "), lines ? "lines" : "both"));
}

/// Warns of parts left out because of their kind. Throws stage (E-EMPTY) if there are lines and no other
/// part.
void tell_left_out(const Scene& scene, const Scene& out, const LeftOut& goes, const WriteOptions& o,
                   const io::Codec& codec, Context& context) {
    std::vector<std::string> lines, points;
    for (const Part& part : scene.parts)
        if (goes(part) && context.selects(part, scene))
            (part.mesh.line_count() > 0 ? lines : points).push_back(part.name);
    if (!lines.empty() && out.parts.empty())
        throw Error(
            ErrorKind::stage, "E-EMPTY",
            fmt::format("there is nothing to write to '{}': the scene has lines and no faces", o.path.text),
            fmt::format("{} can store lines", fmt::join(formats_with(&io::Capabilities::lines), ", ")),
            context.where());
    warn_of_left_out(lines, true, o, codec, context);
    warn_of_left_out(points, false, o, codec, context);
}

/// Throws stage (E-EMPTY) unless the format can store the scene's points or lines.
void check_points(const Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context) {
    const bool any = std::any_of(scene.parts.begin(), scene.parts.end(),
                                 [](const Part& part) { return part.mesh.vertex_count() > 0; });
    const bool lines = std::any_of(scene.parts.begin(), scene.parts.end(),
                                   [](const Part& part) { return part.mesh.line_count() > 0; });
    if ((any && codec.can.points) || (lines && codec.can.lines)) {
        if (o.file.draco.on && !codec.can.always_draco)
            context.warn("W-DRACO",
                         fmt::format("'{}' is not compressed: in {}, Draco compresses faces only, and the "
                                     "scene has none",
                                     o.path.text, codec.name),
                         codec.can.honours("meshopt") ? "meshopt: true compresses points and lines" : "");
        return;
    }
    if (io::is_without_meshes(scene))
        throw Error(ErrorKind::stage, "E-EMPTY",
                    fmt::format("there is nothing to write to '{}': the scene has no meshes, and {} "
                                "stores nothing else",
                                o.path.text, codec.name),
                    fmt::format("{} can store nodes, cameras and animations",
                                fmt::join(formats_with(&io::Capabilities::documents), ", ")),
                    context.where());
    const std::vector<std::string> formats = formats_with(&io::Capabilities::points);
    throw Error(
        ErrorKind::stage, "E-EMPTY",
        fmt::format("there is nothing to write to '{}': the scene has {}", o.path.text,
                    any ? "points and no faces" : "neither faces nor points"),
        any ? fmt::format("{} can store points", fmt::join(formats, ", "))
            : "check the result of the stages before; the common key when: {vertices: {min: 1}} skips an "
              "empty write",
        context.where());
}

/// Rounding depends on the bounds, so vertices that nothing draws must not widen them. Features that are
/// numbered by vertex keep all vertices.
void drop_unused_vertices(Scene& out, std::vector<Lent>& lent) {
    const auto by_vertex = [](const Primitive& p) {
        return p.json.find("EXT_mesh_features") != std::string::npos;
    };
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Part& part = out.parts[k];
        const auto& primitives = part.mesh.primitives;
        if (!has_unused_vertices(part.mesh) || std::any_of(primitives.begin(), primitives.end(), by_vertex))
            continue;
        if (!lent[k].mesh) lent[k].mesh = part.mesh;
        drop_unused(part.mesh);
        part.changed = true;
    }
}

/// Logs the number of faces that are written as triangles, unless all faces are triangles.
void say_of_triangles(const Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context) {
    if (codec.can.polygons && !o.triangulate) return;
    std::size_t larger = 0;
    for (const Part& part : scene.parts)
        if (!part.mesh.all_triangles())
            for (Index f = 0; f < part.mesh.face_count(); ++f) larger += part.mesh.face_size(f) > 3;
    if (larger > 0)
        context.say(
            fmt::format("{} with more than three corners written as triangles", counted(larger, "face")));
}

} // namespace

void declare_write_report(DeclareFields<WriteReport>& d) {
    d.field("factor", &WriteReport::factor, "The factor that the unit of the file applied to lengths.")
        .only_when("the factor is not 1");
    d.field("up", &WriteReport::up, "The up axis of the file.")
        .only_when("the scene was rotated for the file");
    d.field("fits", &WriteReport::fits,
            "The purpose of an earlier check that the file also passed when it was read back.")
        .only_when("an earlier check had a purpose");
    d.object("origin", &WriteReport::origin, "The origin of the coordinates in the file.",
             [](DeclareFields<OriginReport>& f) {
                 f.field("offset", &OriginReport::offset, "The point in the scene's units.");
                 f.field("parts", &OriginReport::parts, "The number of parts whose nodes are at this point.");
             })
        .only_when("the origin was moved");
    const auto bits = [](DeclareFields<WriteReport::Bits>& b) {
        b.field("position_bits", &WriteReport::Bits::position_bits,
                "Bits of each coordinate. If parts differ, the largest number.");
        b.field("least", &WriteReport::Bits::least, "The smallest number of bits of any part.")
            .only_when("the parts have different numbers of bits");
        b.field("why", &WriteReport::Bits::why, "The reason for this number of bits.");
    };
    d.object("draco", &WriteReport::draco, "The rounding of positions.", bits)
        .only_when("the file is compressed by Draco");
    d.object("quantize", &WriteReport::quantize, "The rounding of positions.", bits)
        .only_when("attributes are stored as small integers");
    d.object("order", &WriteReport::order, "How well the order of triangles suits a vertex cache.",
             declare_order)
        .only_when("the triangles were reordered");
    d.object("tiles", &WriteReport::tiles, "The tree of tiles.", declare_tiles_written)
        .only_when("a tileset was written");
}

namespace {

Scene run(Scene scene, const WriteOptions& o, Context& context, WriteReport& report) {
    const io::Codec* codec = codec_of(o);
    if (!codec || !codec->write)
        throw Error(ErrorKind::usage, "E-FORMAT", fmt::format("the suffix of '{}' is unknown", o.path.text),
                    {}, context.where());
    // Moves the parts into the written scene, so that no mesh is copied; they are moved back afterwards.
    Scene out{{}, scene.materials, scene.unit, scene.up, scene.documents};
    std::vector<Lent> lent;
    const LeftOut goes = left_out(scene, *codec, context);
    const bool document = codec->can.documents && io::is_without_meshes(scene);
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (context.selects(scene.parts[i], scene) && !goes(scene.parts[i]))
            lent.push_back({i, scene.parts[i].transform, scene.parts[i].changed});
    for (const auto& l : lent) out.parts.push_back(std::move(scene.parts[l.part]));
    tell_left_out(scene, out, goes, o, *codec, context);
    if (out.face_count() == 0 && !document) check_points(out, o, *codec, context);
    ProgressSteps steps({1, 4, 5});
    say_of_triangles(out, o, *codec, context);
    const std::shared_ptr<const Purpose> purpose = context.trail().purpose;
    if (codec->can.polygons ? o.triangulate : purpose != nullptr) make_triangles(out, lent);
    give_normals(out, lent, o, context);
    give_tangents_to_all(out, lent, o, context);
    const std::filesystem::path target = context.places().output(o.path.text);
    io::WriteSettings settings = settings_of(o, *codec, target);
    if (settings.draco.on || settings.quantize.on || settings.meshopt.on) drop_unused_vertices(out, lent);
    if (codec->can.transforms && o.precision != WriteOptions::Precision::full) {
        std::map<std::size_t, std::vector<Vec3>> moved;
        report.origin = move_origin(out, o.origin, context, moved);
        for (auto& [k, positions] : moved) lent[k].positions = std::move(positions);
    }
    to_convention(out, o, *codec, context, report);
    if (may_need_full(o, *codec, out.bounds()))
        settings.double_positions = needs_full(moved_by_floats(out), out.bounds(), context);
    choose_bits(settings, *codec, out, report);
    if (purpose && !settings.double_positions && !codec->can.honours("tiles")) {
        keep_fit(out, lent, *purpose, *codec, settings, context);
        settings.drawn.reset(); // repairs may have moved vertices
    }
    settings.draco.keep_decoded = context.reads_back();
    steps.next();
    const io::Written written = codec->write(out, settings);
    if (written.cache.triangles > 0) report.order = written.cache;
    report.tiles = written.tiles;
    steps.next();
    for (const auto& w : written.warnings)
        if (w.severity == Severity::note)
            context.say(w.message);
        else
            context.warn(w.id, w.message, w.hint);
    if (!out.parts.empty()) context.attribute_changes(out.parts.front(), written.changes);
    WrittenScene file = stage_files(written, o.path.text, *codec, out, settings, context);
    file.is_whole = lent.size() == scene.parts.size();
    if (purpose && !codec->can.honours("tiles") && check_fit(file, *purpose, out, settings, context))
        report.fits = purpose->name;
    context.wrote(std::move(file));
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Part& back = scene.parts[lent[k].part] = std::move(out.parts[k]);
        back.transform = lent[k].transform;
        back.changed = lent[k].changed;
        if (lent[k].positions) back.mesh.positions = std::move(*lent[k].positions);
        if (lent[k].mesh) back.mesh = std::move(*lent[k].mesh);
    }
    return scene;
}

struct WriteStage : StageOf<run> {
    StageFiles files() const override { return files_of_write(o); }
    void verify(const Value& given, Problems& problems) const override { verify_write(o, given, problems); }
    /// A format with polygons needs no triangulation, so crossing faces stay.
    CrossingFacePolicy crossing_faces() const override {
        const io::Codec* codec = codec_of(o);
        return codec && (o.triangulate || !codec->can.polygons) ? CrossingFacePolicy::name
                                                                : CrossingFacePolicy::keep;
    }
    void on_cells(CellFlow& flow, Context& context) const override { write_on_cells(o, flow, context); }
    std::optional<std::string> why_not_on_cells() const override { return write_stage::why_not_on_cells(o); }
};

const RegisterStage registered = make_stage<WriteStage>(
    {.name = "write",
     .also_called = "save export output convert",
     .about = help::write::about,
     .details = help::write::details,
     .examples = {"write: part.glb", "write: {path: part.glb, draco: true}",
                  "write: {path: part.glb, quantize: true}", "write: {path: print.stl, unit: mm, up: z}",
                  "write: {path: web.glb, normals: smooth, feature_angle: 40deg}",
                  "write: {path: out/tileset.json, tiles: 3d, draco: true}"},
     .tells = true,
     .keeps_scene = true,
     .writes_scene = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all, // the scene passes through unchanged, so nothing is compared
     .crossing_faces = CrossingFacePolicy::name,
     .roles = {.writes_in_unit = "unit"}},
    declare_write, declare_write_report);

} // namespace

} // namespace facetmill::write_stage
