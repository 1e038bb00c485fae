#include "base/math/portable_math.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/normals/tangents.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/flatten.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "parallel/memory.hpp"
#include "stage/read_recorded.hpp"
#include "stages/bake/help.hpp"
#include "stages/bake/material.hpp"
#include "stages/bake/numbers_image.hpp"
#include "stages/bake/options.hpp"

#include <fmt/format.h>

namespace facetmill::bake_stage {

namespace {

struct BakeReport {
    std::int64_t size = 0;
    std::size_t source_faces = 0, covered = 0, missed = 0, overlapping = 0, without_texels = 0, bytes = 0;
    double distance = 0, mean = 0, farthest = 0, agreeing = 0;
    std::vector<std::string> maps;
    std::optional<NumberRange> height, thickness;
};

std::vector<std::string> lines_of(const BakeReport& r) {
    const double share =
        r.covered == 0 ? 0 : 100.0 * static_cast<double>(r.missed) / static_cast<double>(r.covered);
    return {fmt::format("{} x {} pixels from {}: {} ({})", r.size, r.size, counted(r.source_faces, "face"),
                        fmt::join(r.maps, ", "), sized(r.bytes)),
            fmt::format("the surfaces are {:.4g} apart, at most {:.4g}; rays reach {:.4g}; {} of texels hit "
                        "nothing",
                        r.mean, r.farthest, r.distance, percentage(share))};
}

void declare_range(DeclareFields<NumberRange>& d) {
    d.field("black", &NumberRange::least, "The number of black.").unit("scene units");
    d.field("white", &NumberRange::largest, "The number of white.").unit("scene units");
}

void declare_report(DeclareFields<BakeReport>& d) {
    d.field("size", &BakeReport::size, "The sides of the textures.").unit("pixels");
    d.field("maps", &BakeReport::maps, "The textures of the material, by their names in glTF.");
    d.field("bytes", &BakeReport::bytes, "The size of the images.").unit("bytes");
    d.field("source_faces", &BakeReport::source_faces, "Triangles of the source.");
    d.field("mean_distance", &BakeReport::mean, "The mean distance of the surface from the source.")
        .unit("scene units");
    d.field("farthest", &BakeReport::farthest, "The largest distance between both, either way.")
        .unit("scene units");
    d.field("distance", &BakeReport::distance, "How far rays reach.").unit("scene units");
    d.field("agreeing", &BakeReport::agreeing,
            "The share of points whose nearest face of the source looks in a similar direction.");
    d.field("covered_texels", &BakeReport::covered, "Texels on the surface.");
    d.field("missed_texels", &BakeReport::missed,
            "Texels whose rays hit nothing. They have the values of the nearest point.");
    d.field("overlapping_faces", &BakeReport::overlapping, "Faces that share texels with others.");
    d.field("faces_without_texels", &BakeReport::without_texels,
            "Faces that are too small for a texel centre.");
    d.object("height", &BakeReport::height, "The range of heights.", declare_range)
        .only_when("height is given");
    d.object("thickness", &BakeReport::thickness, "The range of thicknesses.", declare_range)
        .only_when("thickness is given");
    d.tell(lines_of);
}

/// Joins all parts with faces as triangles in world space.
BakeSource source_of(const Scene& scene, Context& context) {
    BakeSource source;
    source.mesh = triangles_of(*io::WorldMesh(scene));
    if (source.mesh.face_count() == 0)
        throw Error(ErrorKind::stage, "E-BAKE-SOURCE", "bake: there is no surface to take values from",
                    "load a mesh with faces before bake, or give one as from");
    std::vector<Diagnostic> warnings;
    io::MaterialResolver resolver(std::size_t{2} << 30, io::MaterialResolver::Extent::all);
    source.looks = *resolver.materials(scene, warnings);
    for (const Diagnostic& w : warnings) context.warn(w.id, "bake: " + w.message, w.hint);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        source.double_sided.push_back(scene.materials[m].double_sided);
        if (scene.materials[m].document < 0) source.looks[m].metalness = 0;
    }
    prepare_bake_source(source);
    return source;
}

[[noreturn]] void refuse_coordinates(const std::string& part, const std::string& why) {
    throw Error(ErrorKind::stage, "E-BAKE-UV", fmt::format("bake: part '{}' {}", part, why),
                "use unwrap before bake, to give it texture coordinates");
}

/// Gives a part triangles, normals and tangents.
void prepare(Part& part, Context& context) {
    Mesh& mesh = part.mesh;
    if (!mesh.all_triangles()) mesh = triangles_of(mesh);
    if (!mesh.find("TEXCOORD_0", Domain::wedge))
        refuse_coordinates(part.name, "has no texture coordinates TEXCOORD_0");
    if (const std::size_t outside = faces_outside_texture(mesh); outside > 0)
        refuse_coordinates(part.name, fmt::format("has {} outside of the unit square of the texture",
                                                  counted(outside, "face")));
    if (!mesh.find("NORMAL", Domain::wedge))
        context.attribute_changes(part, give_normals(mesh, NormalKind::smooth, pi));
    if (const auto change = give_tangents(mesh, 0)) context.attribute_changes(part, {*change});
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::colour)
            context.attribute_changes(
                part, {{a.name, a.domain, AttributeChange::Kind::dropped, "baked into the texture"}});
}

/// The parts in world space, with the attributes that baking needs.
Mesh target_of(const Scene& scene, const std::vector<std::size_t>& parts) {
    Mesh target;
    for (const std::size_t i : parts) {
        Mesh mesh = bare(scene.parts[i].mesh);
        for (const char* name : {"NORMAL", "TANGENT", "TEXCOORD_0"})
            if (const Attribute* a = scene.parts[i].mesh.find(name, Domain::wedge))
                mesh.attributes.push_back(*a);
        apply(mesh, scene.parts[i].transform);
        append(target, mesh);
    }
    return target;
}

void require_room(const BakeOptions& o) {
    // Four maps, their decoded neighbours, and the largest PNG that is being written.
    const double texels = static_cast<double>(o.size) * static_cast<double>(o.size);
    require_memory(texels * 56, fmt::format("bake: a texture of {} x {} pixels", o.size, o.size),
                   "use a smaller size");
}

BakeSettings settings_for(const BakeOptions& o, const BakeGap& gap, const Scene& scene, double diagonal,
                          Context& context) {
    BakeSettings s;
    s.size = static_cast<int>(o.size);
    s.samples = static_cast<int>(o.samples);
    s.dilation = static_cast<int>(o.dilation);
    s.occlusion_rays = static_cast<int>(o.occlusion_rays);
    // Between the measured points, the distance is a little larger.
    s.distance = o.distance ? context.resolve(*o.distance, scene, "distance")
                            : 1.25 * std::max(gap.farthest, gap.back) + 1e-5 * diagonal;
    if (o.occlusion_distance)
        s.occlusion_distance = context.resolve(*o.occlusion_distance, scene, "occlusion_distance");
    constexpr double most = 0.9; // the directions of a soup agree by chance, those of a scan nearly always
    s.any_side = o.facing == Facing::any || (o.facing == Facing::automatic && gap.agreeing < most);
    s.height = o.height.has_value();
    s.position = o.position.has_value();
    s.thickness = o.thickness.has_value();
    return s;
}

void warn(const BakedMaps& maps, const BakeGap& gap, double diagonal, Context& context) {
    constexpr double far = 0.05; // of the diagonal, on average
    if (gap.mean > far * diagonal)
        context.warn("W-BAKE-FAR",
                     fmt::format("bake: the surface is {:.4g} from the source on average, {} of its diagonal",
                                 gap.mean, percentage(100 * gap.mean / diagonal)),
                     "use align if a stage moved the scene, or give another file as from");
    if (maps.overlapping_faces > 0)
        context.warn("W-BAKE-OVERLAP",
                     fmt::format("bake: {} share texels, so they show the values of other faces",
                                 counted(maps.overlapping_faces, "face")),
                     "use unwrap before bake");
}

void put_files(const BakedMaps& maps, const Mesh& target, const BakeOptions& o, BakeReport& report,
               Context& context) {
    const auto side = static_cast<std::size_t>(maps.size);
    if (o.height) {
        report.height = range_of(maps.height);
        context.output(o.height->text, numbers_image(maps.height, 1, side, {*report.height}));
    }
    if (o.thickness) {
        report.thickness = range_of(maps.thickness);
        context.output(o.thickness->text, numbers_image(maps.thickness, 1, side, {*report.thickness}));
    }
    if (!o.position) return;
    const Box box = target.bounds();
    const std::vector<NumberRange> ranges = {
        {box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}};
    context.output(o.position->text, numbers_image(maps.position, 3, side, ranges));
}

Scene run(Scene scene, const BakeOptions& o, Context& context, BakeReport& report) {
    require_room(o);
    std::vector<std::size_t> parts;
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.face_count() == 0) return;
        prepare(part, context);
        parts.push_back(static_cast<std::size_t>(&part - scene.parts.data()));
    });
    if (parts.empty()) return scene;
    context.mark_uncacheable(); // it depends on the scene as loaded
    static const Scene nothing;
    const Scene* loaded = context.loaded_scene();
    const BakeSource source = o.from ? source_of(read_beside(*o.from, scene, context), context)
                                     : source_of(loaded ? *loaded : nothing, context);
    const FaceTree tree(surface_of(source.mesh));
    const Mesh target = target_of(scene, parts);
    const BakeGap gap = bake_gap(source.mesh, tree, target);
    const double diagonal = source.mesh.bounds().diagonal();
    const BakeSettings settings = settings_for(o, gap, scene, diagonal, context);
    const BakedMaps maps = bake(source, tree, target, settings);
    warn(maps, gap, diagonal, context);
    const BakedMaterial material = put_material(scene, parts, source, maps);
    drop_unused_materials(scene);
    report.size = o.size;
    report.source_faces = source.mesh.face_count();
    report.covered = maps.covered;
    report.missed = maps.missed;
    report.overlapping = maps.overlapping_faces;
    report.without_texels = maps.faces_without_texels;
    report.bytes = material.bytes;
    report.maps = material.maps;
    report.distance = settings.distance;
    report.mean = gap.mean;
    report.farthest = std::max(gap.farthest, gap.back);
    report.agreeing = gap.agreeing;
    put_files(maps, target, o, report, context);
    return scene;
}

struct BakeStage : StageOf<run> {
    StageFiles files() const override {
        StageFiles files;
        if (o.from) files.inputs.push_back(*o.from);
        for (const auto& path : {o.height, o.position, o.thickness})
            if (path) files.outputs.push_back(*path);
        return files;
    }
    bool takes_from_load() const override { return !o.from; }
};

const RegisterStage registered = make_stage<BakeStage>(
    {.name = "bake",
     .also_called = "bake_textures texture_bake render_to_texture normal_map ao ambient_occlusion "
                    "project_textures transfer_texture vertex_colours_to_texture",
     .about = help::bake::about,
     .details = help::bake::details,
     .examples = {"bake: 2048", "bake: {size: 1024, samples: 2, distance: 1%}",
                  "bake: {from: scan.glb, occlusion_rays: 0}", "bake: {size: 2048, height: height.png}"},
     .changes_images = true,
     .lines = LinesPolicy::pass},
    declare_bake, declare_report);

} // namespace

} // namespace facetmill::bake_stage
