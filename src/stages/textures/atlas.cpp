#include "stages/textures/atlas.hpp"

#include "geometry/edit/primitives.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/image_files.hpp"
#include "io/material_document.hpp"
#include "parallel/memory.hpp"
#include "stages/textures/atlas_images.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <set>

namespace facetmill::textures_stage {

namespace {

constexpr std::size_t default_side = 4096; ///< which all current devices support

/// Materials that can be merged.
struct AtlasGroup {
    std::vector<Index> materials;
    std::size_t textured = 0;
};

class AtlasMaker {
  public:
    AtlasMaker(Scene& scene, const TexturesOptions& o, Context& context)
        : scene_(scene), o_(o), context_(context),
          gutter_(std::bit_ceil(static_cast<std::size_t>(o.gutter))) {}

    AtlasesReport make() {
        report_.before = count();
        find_candidates();
        for (std::size_t p = 0; p < scene_.parts.size(); ++p)
            if (is_ours(scene_.parts[p])) mapped_.push_back(map_part(scene_.parts[p], p, candidates_));
        for (auto& [material, candidate] : candidates_) limit_extent(candidate);
        for (const AtlasGroup& group : groups()) merge(group);
        for (const auto& [material, candidate] : candidates_)
            if (!candidate.look.apart.empty())
                report_.apart.push_back({name_of_material(material), candidate.look.apart});
        drop_merged();
        erase_merged();
        report_.after = count();
        return std::move(report_);
    }

  private:
    bool is_ours(const Part& part) const {
        return part.mesh.face_count() > 0 && context_.selects(part, scene_);
    }

    std::string name_of_material(Index m) const {
        const std::string& name = scene_.materials[m].name;
        return name.empty() ? fmt::format("materials[{}]", m) : name;
    }

    AtlasCounts count() const;
    void find_candidates();
    void check_images(AtlasCandidate& candidate, const Material& material);
    void limit_extent(AtlasCandidate& candidate) const;
    std::vector<AtlasGroup> groups();
    void merge(const AtlasGroup& group);
    std::vector<AtlasTile> tiles_of(const AtlasGroup& group) const;
    AtlasPlan plan_of(AtlasLayout layout) const;
    io::Bytes encoded_map(const AtlasPlan& plan, AtlasMap map, MadeAtlas& made, const char* texture);
    std::string format_for(const AtlasPlan& plan, AtlasMap map) const;
    Material add_material(const AtlasPlan& plan, MadeAtlas& made);
    void use(const AtlasPlan& plan, Index material);
    void drop_merged();
    void erase_merged();
    const io::Bytes& image(Index material, std::size_t number) const {
        return images_[static_cast<std::size_t>(scene_.materials[material].document)][number].bytes;
    }

    Scene& scene_;
    const TexturesOptions& o_;
    Context& context_;
    std::size_t gutter_;
    AtlasesReport report_;
    AtlasCandidates candidates_;
    std::vector<MappedPart> mapped_;
    std::vector<std::vector<io::DocumentImage>> images_; ///< [documents of the input]
    std::map<std::pair<int, std::size_t>, std::pair<std::size_t, std::size_t>> sizes_; ///< 0: not readable
    std::set<Index> merged_;
};

AtlasCounts AtlasMaker::count() const {
    AtlasCounts counts;
    std::set<Index> materials;
    for (const Part& part : scene_.parts) {
        counts.draw_calls += draw_calls(part.mesh);
        for (const Primitive& p : part.mesh.primitives)
            if (p.material < scene_.materials.size()) materials.insert(p.material);
    }
    counts.materials = materials.size();
    for (const auto& document : scene_.documents)
        for (const io::DocumentImage& image : io::document_images(*document, {})) {
            ++counts.images;
            counts.bytes += image.bytes.size();
        }
    return counts;
}

void AtlasMaker::find_candidates() {
    std::vector<std::vector<io::AtlasMaterial>> looks;
    for (const auto& document : scene_.documents) {
        looks.push_back(io::atlas_materials(*document));
        images_.push_back(io::document_images(*document, {}));
    }
    for (const Part& part : scene_.parts) {
        if (!is_ours(part)) continue;
        for (const Primitive& p : part.mesh.primitives) {
            if (p.material >= scene_.materials.size() || candidates_.contains(p.material)) continue;
            const Material& material = scene_.materials[p.material];
            AtlasCandidate& candidate = candidates_[p.material];
            candidate.double_sided = material.double_sided;
            if (material.document < 0 || material.index < 0) {
                candidate.look.apart = "it has no texture";
                continue;
            }
            candidate.look =
                looks[static_cast<std::size_t>(material.document)][static_cast<std::size_t>(material.index)];
            check_images(candidate, material);
        }
    }
}

/// Decodes the images for their sizes.
void AtlasMaker::check_images(AtlasCandidate& candidate, const Material& material) {
    io::AtlasMaterial& look = candidate.look;
    const auto& images = images_[static_cast<std::size_t>(material.document)];
    for (auto* one : {&look.base, &look.normal, &look.rough, &look.occlusion, &look.emission}) {
        if (!*one || !look.apart.empty()) continue;
        const io::DocumentImage& image = images[(*one)->image];
        const auto [size, fresh] = sizes_.try_emplace({material.document, image.index});
        if (fresh)
            if (const auto decoded = io::decoded_image(image.bytes); decoded && !decoded->damaged)
                size->second = {decoded->width, decoded->height};
        (*one)->size = size->second;
        if (image.bytes.empty())
            look.apart = fmt::format("the image '{}' is missing", image.name);
        else if (size->second.first == 0)
            look.apart = fmt::format("the image '{}' cannot be read", image.name);
        else if (image.use.held)
            look.apart = fmt::format("the image '{}' has data other than colours", image.name);
    }
}

void AtlasMaker::limit_extent(AtlasCandidate& candidate) const {
    if (!candidate.look.apart.empty() || !candidate.look.any()) return;
    constexpr double rounding = 1e-3; // of a texture
    if (candidate.extent.copies() > static_cast<double>(o_.unroll) + rounding)
        candidate.look.apart = fmt::format("its texture repeats {:.3g} x {:.3g} times, more than unroll: {}",
                                           candidate.extent.side(0), candidate.extent.side(1), o_.unroll);
}

/// Groups of two or more materials, at least one with textures.
std::vector<AtlasGroup> AtlasMaker::groups() {
    using Kind = std::pair<std::string, bool>; // and whether it is double-sided
    std::map<Kind, std::map<std::string, AtlasGroup>> kinds;
    const auto maps_of = [](const io::AtlasMaterial& look) {
        return fmt::format("{}{}{}{}{}", look.base.has_value(), look.normal.has_value(),
                           look.rough || look.occlusion, look.emission.has_value(),
                           look.any()->sampling.nearest);
    };
    const auto kind_of = [](const AtlasCandidate& c) { return Kind(c.look.kind, c.double_sided); };
    for (const auto& [material, c] : candidates_)
        if (c.look.apart.empty() && c.look.any())
            kinds[kind_of(c)][maps_of(c.look)].materials.push_back(material);
    for (auto& [material, c] : candidates_) {
        if (!c.look.apart.empty() || c.look.any()) continue;
        const auto found = kinds.find(kind_of(c));
        if (found == kinds.end()) {
            c.look.apart = "it has no texture, and no textured material is of its kind";
            continue;
        }
        AtlasGroup* largest = nullptr;
        for (auto& [maps, group] : found->second) {
            if (group.textured == 0) group.textured = group.materials.size();
            if (!largest || group.textured > largest->textured) largest = &group;
        }
        largest->materials.push_back(material);
    }
    std::vector<AtlasGroup> all;
    for (auto& [kind, groups] : kinds)
        for (auto& [maps, group] : groups) {
            if (group.materials.size() > 1)
                all.push_back(std::move(group));
            else
                candidates_.at(group.materials.front()).look.apart =
                    "no other material has the same textures, alpha mode, sides and extensions";
        }
    std::sort(all.begin(), all.end(), [](const AtlasGroup& a, const AtlasGroup& b) {
        return a.materials.front() < b.materials.front();
    });
    return all;
}

/// Materials that use the same images in the same way share a tile.
std::vector<AtlasTile> AtlasMaker::tiles_of(const AtlasGroup& group) const {
    std::vector<AtlasTile> tiles;
    std::map<std::string, std::size_t> known;
    for (const Index m : group.materials) {
        const AtlasCandidate& c = candidates_.at(m);
        std::string key =
            fmt::format("{} {} {} {} {} {} {}", scene_.materials[m].document, fmt::join(c.look.colour, ","),
                        fmt::join(c.look.emissive, ","), c.look.metalness, c.look.roughness,
                        c.look.normal_scale, c.look.occlusion_strength);
        AtlasTile tile;
        for (const auto* one : c.look.textures()) {
            key += *one ? fmt::format(" {} {} {}", (*one)->image, int((*one)->sampling.wrap_u),
                                      int((*one)->sampling.wrap_v))
                        : " -";
            if (!*one) continue;
            tile.image_width = std::max(tile.image_width, (*one)->size.first);
            tile.image_height = std::max(tile.image_height, (*one)->size.second);
        }
        const auto [place, fresh] = known.try_emplace(key, tiles.size());
        if (fresh) tiles.push_back(tile);
        tiles[place->second].materials.push_back(m);
        tiles[place->second].extent.add(c.extent);
    }
    return tiles;
}

AtlasPlan AtlasMaker::plan_of(AtlasLayout layout) const {
    AtlasPlan plan;
    plan.layout = std::move(layout);
    plan.gutter = gutter_;
    for (const AtlasTile& tile : plan.layout.tiles)
        plan.looks.push_back(&candidates_.at(tile.materials.front()).look);
    find_common_factors(plan);
    plan.opaque = plan.common.kind.find("\"alphaMode\"") == std::string::npos;
    return plan;
}

void AtlasMaker::merge(const AtlasGroup& group) {
    const auto side = static_cast<std::size_t>(o_.max_size.value_or(default_side));
    auto layout = lay_out(tiles_of(group), side, gutter_);
    if (!layout) {
        for (const Index m : group.materials)
            candidates_.at(m).look.apart =
                fmt::format("{} materials do not fit into {} pixels", group.materials.size(), side);
        return;
    }
    const AtlasPlan plan = plan_of(*std::move(layout));
    const double texels = static_cast<double>(plan.layout.width) * static_cast<double>(plan.layout.height);
    require_memory(texels * 12 + 4.0 * static_cast<double>(io::max_pixels),
                   fmt::format("textures: an atlas of {} x {} pixels", plan.layout.width, plan.layout.height),
                   "use a smaller max_size");
    MadeAtlas made;
    made.material = report_.atlases.empty() ? "atlas" : fmt::format("atlas{}", report_.atlases.size() + 1);
    made.width = plan.layout.width;
    made.height = plan.layout.height;
    for (const AtlasTile& tile : plan.layout.tiles) {
        made.used += static_cast<double>(tile.width) * static_cast<double>(tile.height) / texels;
        for (const Index m : tile.materials) {
            made.materials.push_back(name_of_material(m));
            if (tile.halvings > 0) made.halved.push_back(name_of_material(m));
            merged_.insert(m);
        }
    }
    const auto material = static_cast<Index>(scene_.materials.size());
    scene_.materials.push_back(add_material(plan, made));
    use(plan, material);
    report_.atlases.push_back(std::move(made));
}

/// The format of all textures of the map, or PNG if they differ.
std::string AtlasMaker::format_for(const AtlasPlan& plan, AtlasMap map) const {
    std::set<std::string> formats;
    for (std::size_t i = 0; i < plan.looks.size(); ++i) {
        const io::AtlasMaterial& look = *plan.looks[i];
        const Index m = plan.layout.tiles[i].materials.front();
        const auto see = [&](const std::optional<io::AtlasTexture>& t) {
            if (t) formats.insert(io::media_type(image(m, t->image)));
        };
        if (map == AtlasMap::base) see(look.base);
        if (map == AtlasMap::normal) see(look.normal);
        if (map == AtlasMap::emission) see(look.emission);
        if (map == AtlasMap::surface) see(look.rough);
        if (map == AtlasMap::surface) see(look.occlusion);
    }
    return formats.size() == 1 ? *formats.begin() : "image/png";
}

io::Bytes AtlasMaker::encoded_map(const AtlasPlan& plan, AtlasMap map, MadeAtlas& made, const char* texture) {
    const io::Pixels pixels = draw_map(plan, map, [&](std::size_t tile, const io::AtlasTexture& t) {
        const Index m = plan.layout.tiles[tile].materials.front();
        return io::decoded_image(image(m, t.image)).value(); // check_images has decoded it before
    });
    const ImageSettings s = map == AtlasMap::normal    ? for_normals(o_)
                            : map == AtlasMap::surface ? for_data(o_)
                                                       : for_colours(o_);
    const std::string type = s.format == Format::keep ? format_for(plan, map) : "image/png";
    const io::LossSettings loss{s.quality, s.lossless, map == AtlasMap::normal || map == AtlasMap::surface};
    const bool encoded_again = s.format != Format::keep || o_.repack;
    io::Bytes bytes = type == "image/jpeg"   ? io::encoded_jpeg(pixels, loss)
                      : type == "image/webp" ? io::encoded_webp(pixels, loss)
                      : encoded_again        ? io::encoded_png_quickly(pixels)
                                             : io::encoded_png(pixels);
    made.images.push_back({texture, pixels.width, pixels.height, bytes.size()});
    return bytes;
}

Material AtlasMaker::add_material(const AtlasPlan& plan, MadeAtlas& made) {
    io::MaterialDocument document(made.material);
    const io::AtlasMaterial& c = plan.common;
    Json json = Json::parse(c.kind), pbr = Json::object();
    json["name"] = made.material;
    if (candidates_.at(plan.layout.tiles.front().materials.front()).double_sided) json["doubleSided"] = true;
    const bool nearest = std::any_of(plan.looks.begin(), plan.looks.end(), [](const auto* look) {
        return look->any() && look->any()->sampling.nearest;
    });
    const auto texture = [&](AtlasMap map, const char* name, const char* file) {
        io::Bytes bytes = encoded_map(plan, map, made, name);
        const std::string path =
            fmt::format("{}_{}{}", made.material, file, io::suffix_of_image(io::media_type(bytes)));
        return Json{{"index", document.texture(path, bytes, true, false, nearest)}};
    };
    const auto any = [&](std::optional<io::AtlasTexture> io::AtlasMaterial::*member) {
        return std::any_of(plan.looks.begin(), plan.looks.end(),
                           [&](const auto* look) { return (look->*member).has_value(); });
    };
    pbr["baseColorFactor"] = c.colour;
    pbr["metallicFactor"] = c.metalness;
    pbr["roughnessFactor"] = c.roughness;
    if (plan.needs(AtlasMap::base))
        pbr["baseColorTexture"] = texture(AtlasMap::base, "baseColorTexture", "base_colour");
    if (plan.needs(AtlasMap::surface)) {
        const bool occluded = any(&io::AtlasMaterial::occlusion);
        const Json surface = texture(AtlasMap::surface, "metallicRoughnessTexture", "surface");
        pbr["metallicRoughnessTexture"] = surface;
        if (occluded) json["occlusionTexture"] = surface;
        if (occluded && c.occlusion_strength != 1)
            json["occlusionTexture"]["strength"] = c.occlusion_strength;
    }
    if (plan.needs(AtlasMap::normal)) {
        json["normalTexture"] = texture(AtlasMap::normal, "normalTexture", "normal");
        if (c.normal_scale != 1) json["normalTexture"]["scale"] = c.normal_scale;
    }
    if (plan.needs(AtlasMap::emission))
        json["emissiveTexture"] = texture(AtlasMap::emission, "emissiveTexture", "emission");
    const double strength = std::max(1.0, *std::max_element(c.emissive.begin(), c.emissive.end()));
    if (c.emissive != std::array<double, 3>{0, 0, 0}) {
        json["emissiveFactor"] = Json::array();
        for (const double e : c.emissive) json["emissiveFactor"].push_back(e / strength);
    }
    if (strength > 1) json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    json["pbrMetallicRoughness"] = std::move(pbr);
    Material material = document.add(std::move(json), scene_.documents.size());
    scene_.documents.push_back(document.finish());
    return material;
}

/// The attribute as floats with two components; zeros if there is none.
std::vector<float> float_uvs(const Mesh& mesh, std::string_view name) {
    std::vector<float> values(2 * mesh.wedge_count());
    const Attribute* old = mesh.find(name, Domain::wedge);
    for (std::size_t w = 0; old && old->components == 2 && w < mesh.wedge_count(); ++w)
        for (int c = 0; c < 2; ++c)
            values[2 * w + static_cast<std::size_t>(c)] = static_cast<float>(old->value(w, c));
    return values;
}

void AtlasMaker::use(const AtlasPlan& plan, Index material) {
    constexpr std::string_view name = "TEXCOORD_0";
    std::map<Index, const AtlasTile*> tile_of;
    for (const AtlasTile& tile : plan.layout.tiles)
        for (const Index m : tile.materials) tile_of[m] = &tile;
    const Uv whole{static_cast<double>(plan.layout.width), static_cast<double>(plan.layout.height)};
    for (const MappedPart& mapped : mapped_) {
        Part& part = scene_.parts[mapped.part];
        Mesh& mesh = part.mesh;
        const auto is_merged = [&](const Primitive& p) { return tile_of.contains(p.material); };
        if (std::none_of(mesh.primitives.begin(), mesh.primitives.end(), is_merged)) continue;
        std::vector<float> uvs = float_uvs(mesh, name);
        for (std::size_t w = 0; w < mapped.material.size(); ++w) {
            const auto found = tile_of.find(mapped.material[w]);
            if (found == tile_of.end()) continue;
            const Uv at = found->second->place(mapped.uv[w]);
            for (std::size_t a = 0; a < 2; ++a) uvs[2 * w + a] = static_cast<float>(at[a] / whole[a]);
        }
        for (const Domain domain : {Domain::vertex, Domain::wedge, Domain::face}) mesh.drop(name, domain);
        mesh.attributes.push_back({std::string(name), Domain::wedge, Role::uv, 2, false, std::move(uvs)});
        for (Primitive& p : mesh.primitives) {
            if (!is_merged(p)) continue;
            p.material = material;
            if (!p.attributes.empty() && !p.lists(name)) p.attributes.emplace_back(name);
        }
        join_primitives(mesh);
        part.changed = true;
        context_.attribute_changes(
            part, {{std::string(name), Domain::wedge, AttributeChange::Kind::recomputed, "for the atlas"}});
    }
}

/// Erases the merged materials that no part uses any longer from the documents, with their textures and
/// images.
void AtlasMaker::drop_merged() {
    for (const Part& part : scene_.parts)
        for (const Primitive& p : part.mesh.primitives) merged_.erase(p.material);
    std::vector<std::set<std::size_t>> gone(images_.size());
    for (const Index m : merged_)
        gone[static_cast<std::size_t>(scene_.materials[m].document)].insert(
            static_cast<std::size_t>(scene_.materials[m].index));
    for (std::size_t d = 0; d < gone.size(); ++d) {
        if (gone[d].empty()) continue;
        io::DocumentOptimizer optimizer(*scene_.documents[d]);
        if (!optimizer.numbers_are_known()) continue;
        io::TidyRequest request;
        for (const Part& part : scene_.parts)
            if (part.document == static_cast<int>(d) && part.source_mesh >= 0)
                request.meshes.insert(static_cast<std::size_t>(part.source_mesh));
        request.all = request.meshes.empty(); // it only holds materials, or its meshes were merged
        for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
            const Material& material = scene_.materials[m];
            if (material.document == static_cast<int>(d) && material.index >= 0 &&
                !gone[d].contains(static_cast<std::size_t>(material.index)))
                request.materials.insert(static_cast<std::size_t>(material.index));
        }
        optimizer.forget_materials(request.meshes, gone[d]);
        io::renumber(scene_, static_cast<int>(d), optimizer.erase_unused(request));
        scene_.documents[d] = optimizer.finish(scene_.documents[d]);
    }
}

/// Erases these materials from the scene.
void AtlasMaker::erase_merged() {
    std::vector<Index> numbers(scene_.materials.size(), none);
    std::vector<Material> kept;
    kept.reserve(numbers.size());
    for (Index m = 0; m < numbers.size(); ++m) {
        if (merged_.contains(m)) continue;
        numbers[m] = static_cast<Index>(kept.size());
        kept.push_back(std::move(scene_.materials[m]));
    }
    scene_.materials = std::move(kept);
    for (Part& part : scene_.parts)
        for (Primitive& p : part.mesh.primitives)
            if (p.material < numbers.size()) p.material = numbers[p.material];
}

void declare_counts(DeclareFields<AtlasCounts>& d) {
    d.field("draw_calls", &AtlasCounts::draw_calls, "Primitives of all parts. Each needs a draw call.");
    d.field("materials", &AtlasCounts::materials, "Materials that parts use.");
    d.field("images", &AtlasCounts::images, "Images of all documents.");
    d.field("bytes", &AtlasCounts::bytes, "The size of these images.").unit("bytes");
}

void declare_made(DeclareFields<MadeAtlas>& d) {
    d.field("material", &MadeAtlas::material, "The name of the new material.");
    d.field("materials", &MadeAtlas::materials, "The materials that it replaces.");
    d.field("halved", &MadeAtlas::halved, "The materials whose textures were halved to fit into max_size.");
    d.field("width", &MadeAtlas::width, "The width of the atlas.").unit("pixels");
    d.field("height", &MadeAtlas::height, "The height of the atlas.").unit("pixels");
    d.field("used", &MadeAtlas::used, "The share of the atlas that textures cover.");
    d.list("images", &MadeAtlas::images, "The images of the atlas, before conversion to another format.",
           [](DeclareFields<AtlasImage>& i) {
               i.field("texture", &AtlasImage::texture, "The texture of the material.");
               i.field("width", &AtlasImage::width, "The width of the image.").unit("pixels");
               i.field("height", &AtlasImage::height, "The height of the image.").unit("pixels");
               i.field("bytes", &AtlasImage::bytes, "The size of the file.").unit("bytes");
           });
}

} // namespace

AtlasesReport make_atlases(Scene& scene, const TexturesOptions& o, Context& context) {
    AtlasesReport report = AtlasMaker(scene, o, context).make();
    for (const MadeAtlas& made : report.atlases)
        if (!made.halved.empty())
            context.warn(
                "W-TEXTURE-ATLAS",
                fmt::format("textures: the textures of these materials were halved to fit into the atlas: {}",
                            fmt::join(made.halved, ", ")),
                "use a larger max_size, up to 16384");
    return report;
}

void declare_atlases(DeclareFields<AtlasesReport>& d) {
    d.list("made", &AtlasesReport::atlases, "Each new material.", declare_made);
    d.list("apart", &AtlasesReport::apart, "Each material that was not merged.",
           [](DeclareFields<ApartMaterial>& a) {
               a.field("material", &ApartMaterial::material, "Its name, or its number in the scene.");
               a.field("reason", &ApartMaterial::reason, "Why it was not merged.");
           });
    d.object("before", &AtlasesReport::before, "The scene before merging.", declare_counts);
    d.object("after", &AtlasesReport::after, "The scene after merging, before images are converted.",
             declare_counts);
}

std::vector<std::string> lines_of(const AtlasesReport& r) {
    constexpr std::size_t most = 20;
    std::vector<std::string> lines;
    for (const MadeAtlas& made : r.atlases)
        lines.push_back(fmt::format("{}: {} materials in {} x {} pixels, {:.0f} % used", made.material,
                                    made.materials.size(), made.width, made.height, 100 * made.used));
    for (const ApartMaterial& apart : r.apart)
        if (lines.size() < most)
            lines.push_back(fmt::format("{} is not merged: {}", apart.material, apart.reason));
    if (r.atlases.size() + r.apart.size() > most) lines.push_back("more are listed in the report");
    lines.push_back(fmt::format("{} -> {} draw calls, {} -> {} materials, {} -> {} images",
                                r.before.draw_calls, r.after.draw_calls, r.before.materials,
                                r.after.materials, r.before.images, r.after.images));
    return lines;
}

} // namespace facetmill::textures_stage
