#include "geometry/unwrap/unwrap.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "options/mark_at.hpp"
#include "stage/stage.hpp"
#include "stages/unwrap/help.hpp"

#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::unwrap_stage {

namespace {

struct UnwrapOptions {
    std::int64_t texture = 2048, gutter = 4, set = 0;
    std::optional<double> texels_per_m;
    double max_stretch = 1.1;
    bool keep = false;
};

void declare(Declare<UnwrapOptions>& d) {
    d.option("texture", &UnwrapOptions::texture, "The side of the square texture, in texels.")
        .also_called("size resolution texture_size")
        .between(16, 16384)
        .primary();
    d.option("texels_per_m", &UnwrapOptions::texels_per_m,
             "The number of texels per metre, in place of texture. The texture becomes the smallest power of "
             "two that holds all charts, at most 16384.")
        .also_called("texel_density density")
        .above(0);
    d.option("gutter", &UnwrapOptions::gutter, "The least number of empty texels between two charts.")
        .also_called("padding margin island_margin")
        .between(0, 256);
    d.option("max_stretch", &UnwrapOptions::max_stretch,
             "The largest L2 stretch of a chart: 1 means no stretch. Smaller values give more charts.")
        .also_called("stretch distortion")
        .above(1)
        .at_most(10);
    d.option("set", &UnwrapOptions::set, "The number of the set: 0 for TEXCOORD_0, 1 for light maps.")
        .also_called("uv uv_set channel uv_channel")
        .between(0, 62);
    d.option(
        "keep", &UnwrapOptions::keep,
        "Keeps existing sets from this number on: each moves up by one, and textures refer to it there.");
}

struct UnwrapReport {
    std::size_t parts = 0, charts = 0, texture = 0, thin_faces = 0;
    double used = 0, l2_stretch = 1, largest_stretch = 1, largest_ratio = 1, cut_length = 0;
    double texels_per_unit = 0;
    std::optional<double> texels_per_m;
};

void declare_report(DeclareFields<UnwrapReport>& d) {
    d.field("parts", &UnwrapReport::parts, "The number of unwrapped parts.");
    d.field("charts", &UnwrapReport::charts, "The number of charts.");
    d.field("texture", &UnwrapReport::texture, "The side of the square texture.").unit("texels");
    d.field("used", &UnwrapReport::used, "The share of the square that charts cover.");
    d.field("l2_stretch", &UnwrapReport::l2_stretch, "The L2 stretch of all charts; 1 means no stretch.");
    d.field("largest_stretch", &UnwrapReport::largest_stretch,
            "The largest growth of a length from the texture to the surface (Linf stretch).");
    d.field("largest_ratio", &UnwrapReport::largest_ratio,
            "The largest ratio of the growth of lengths in two directions of a face.");
    d.field("cut_length", &UnwrapReport::cut_length,
            "The length of the edges between two faces that are apart in the texture.")
        .unit("scene units");
    d.field("texels_per_unit", &UnwrapReport::texels_per_unit, "Texels per unit of length.");
    d.field("texels_per_m", &UnwrapReport::texels_per_m, "Texels per metre.")
        .only_when("the scene has a unit");
    d.field("thin_faces", &UnwrapReport::thin_faces,
            "Faces without area, or lower than a thousandth of their length; not counted in the stretch.");
    d.tell([](const UnwrapReport& r) {
        return std::vector{fmt::format("{}, {:.1f} % of {} x {} texels, L2 stretch {:.4g}, at most {:.4g}",
                                       counted(r.charts, "chart"), 100 * r.used, r.texture, r.texture,
                                       r.l2_stretch, r.largest_stretch)};
    });
}

UnwrapSettings settings_of(const UnwrapOptions& o, const Scene& scene) {
    UnwrapSettings s;
    s.texture = static_cast<std::size_t>(o.texture);
    s.gutter = static_cast<std::size_t>(o.gutter);
    s.max_stretch = o.max_stretch;
    if (!o.texels_per_m) return s;
    if (metres(scene.unit) == 0)
        throw Error(ErrorKind::usage, "E-UNIT", "unwrap: 'texels_per_m' needs a scene with a unit",
                    "use load: {unit: mm}, or give the size of the texture");
    s.texels_per_unit = *o.texels_per_m * metres(scene.unit);
    return s;
}

void drop_tangents(Part& part, Context& context) {
    if (!part.mesh.drop("TANGENT", Domain::wedge)) return;
    for (Primitive& p : part.mesh.primitives) std::erase(p.attributes, "TANGENT");
    context.attribute_changes(part, {{"TANGENT", Domain::wedge, AttributeChange::Kind::dropped,
                                      "depends on the texture coordinates"}});
}

/// The materials of documents that parts use: selected parts, or the others.
std::set<Index> materials_of(const Scene& scene, const Context& context, bool selected) {
    std::set<Index> used;
    for (const Part& part : scene.parts) {
        if (context.selects(part, scene) != selected) continue;
        for (const Primitive& p : part.mesh.primitives)
            if (p.material < scene.materials.size() && scene.materials[p.material].document >= 0)
                used.insert(p.material);
    }
    return used;
}

/// With keep, textures follow the set that they use. Otherwise, warns about textures that no longer fit.
void settle_textures(Scene& scene, const UnwrapOptions& o, Context& context) {
    const std::set<Index> others = materials_of(scene, context, false);
    std::map<int, io::DocumentOptimizer> documents;
    std::vector<std::string> misfits;
    for (const Index m : materials_of(scene, context, true)) {
        const Material& material = scene.materials[m];
        const auto index = static_cast<std::size_t>(material.index);
        auto& document =
            documents
                .try_emplace(material.document, *scene.documents[static_cast<std::size_t>(material.document)])
                .first->second;
        const std::set<int> uvs = document.needs_of(index).uvs;
        const bool fits = o.keep ? uvs.lower_bound(static_cast<int>(o.set)) == uvs.end()
                                 : !uvs.contains(static_cast<int>(o.set));
        if (fits) continue;
        if (o.keep && !others.contains(m))
            document.move_uvs_up(index, static_cast<int>(o.set));
        else
            misfits.push_back(material.name);
    }
    for (auto& [number, document] : documents) {
        auto& place = scene.documents[static_cast<std::size_t>(number)];
        if (o.keep) place = document.finish(place);
    }
    if (misfits.empty()) return;
    context.warn("W-UNWRAP-TEXTURES",
                 fmt::format("unwrap: {} made for other texture coordinates: {}",
                             misfits.size() == 1 ? "the textures of a material were"
                                                 : "the textures of some materials were",
                             fmt::join(misfits, ", ")),
                 o.keep ? "unwrap all parts that use the material together"
                        : "use keep: true, or bake new textures, or remove the textures");
}

/// glTF numbers the sets of a part from 0, without gaps.
void require_lower_sets(const Part& part, std::int64_t set) {
    for (std::int64_t lower = 0; lower < set; ++lower)
        if (!part.mesh.find(fmt::format("TEXCOORD_{}", lower), Domain::wedge))
            throw Error(
                ErrorKind::usage, "E-UNWRAP-SET",
                fmt::format("unwrap: set {} of part '{}' needs a set {} before it", set, part.name, lower),
                fmt::format("use set: {}, or unwrap that set first", lower));
}

Scene run(Scene scene, const UnwrapOptions& o, Context& context, UnwrapReport& report) {
    const UnwrapSettings settings = settings_of(o, scene);
    std::vector<Part*> parts;
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.face_count() == 0) return;
        require_lower_sets(part, o.set);
        parts.push_back(&part);
    });
    std::vector<UnwrapInput> inputs;
    inputs.reserve(parts.size());
    for (Part* part : parts) {
        if (!part->mesh.all_triangles()) part->mesh = triangles_of(part->mesh);
        inputs.push_back({&part->mesh, part->transform});
    }
    const UnwrapLayout layout = unwrap(inputs, settings);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        context.attribute_changes(
            *parts[i], put_coordinates(parts[i]->mesh, layout.meshes[i], static_cast<int>(o.set), o.keep));
        drop_tangents(*parts[i], context);
    }
    settle_textures(scene, o, context);
    report = {parts.size(),
              layout.charts,
              layout.texture,
              layout.thin_faces,
              layout.used,
              layout.stretch.l2,
              layout.stretch.largest,
              layout.stretch.ratio,
              layout.cut_length,
              layout.texels_per_unit,
              {}};
    if (metres(scene.unit) > 0) report.texels_per_m = layout.texels_per_unit / metres(scene.unit);
    return scene;
}

struct UnwrapStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        if (given.is_map() && given.find("texture") && o.texels_per_m)
            add_refusal(Refusal{"texels_per_m", "'texels_per_m' gives the size of the texture",
                                "remove texture or texels_per_m"},
                        "unwrap", given, problems);
    }
};

const RegisterStage registered = make_stage<UnwrapStage>(
    {.name = "unwrap",
     .also_called = "uv uvs uv_unwrap smart_uv smart_project xatlas parametrize parameterize lightmap "
                    "texture_coordinates",
     .about = help::unwrap::about,
     .details = help::unwrap::details,
     .examples = {"unwrap", "unwrap: 1024", "unwrap: {texels_per_m: 512, gutter: 8}",
                  "unwrap: {max_stretch: 1.02, keep: true}", "unwrap: {set: 1}"},
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::unwrap_stage
