#include "io/gltf/optimize/document_optimizer.hpp"

#include "base/hash.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/document/accessor_uses.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/item_references.hpp"
#include "io/gltf/document/node_references.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/gltf.hpp"

#include <algorithm>

namespace facetmill::io {

using namespace gltf;

namespace {

using Visit = std::function<void(Json&)>;

/// For each item, the first item with the same text.
std::vector<std::size_t> first_equal(const std::vector<std::string>& written) {
    std::map<std::string, std::size_t> known;
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < written.size(); ++i)
        first.push_back(known.try_emplace(written[i], i).first->second);
    return first;
}

std::vector<std::string> texts_of(const Json& document, const char* list, bool keep_names) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < count_of(document, list); ++i) {
        Json item = document[list][i];
        if (!keep_names && item.is_object()) item.erase("name");
        all.push_back(to_string(item));
    }
    return all;
}

/// A text for each image with its bytes and all its other properties.
std::vector<std::string> image_texts(const Document& source, const Json& document) {
    std::vector<std::string> all;
    for (const Bytes& bytes : image_bytes(source, document)) {
        Json said = document["images"][all.size()];
        if (!bytes.empty() && said.is_object())
            for (const char* key : {"name", "uri", "bufferView", "mimeType"}) said.erase(key);
        all.push_back(to_string(said) + sha256(bytes));
    }
    return all;
}

void follow(const std::vector<std::size_t>& first, Json& reference) {
    const auto old = reference.get<std::size_t>();
    if (old < first.size()) reference = first[old];
}

/// Nodes with more than a transform, nodes outside the scene (their children must not change), and the
/// descendants of both.
std::set<std::size_t> bound_nodes(Json& document) {
    std::set<std::size_t> bound;
    const auto frames = node_frames(document);
    const bool all = count_of(document, "scenes") > 1 || has_unknown_extensions(document) ||
                     uses_extension(document, "KHR_animation_pointer");
    const std::vector<bool> shown = shown_nodes(document);
    visit_named_nodes(document, [&](Json& r) { bound.insert(r.get<std::size_t>()); });
    for (const std::size_t n : parents_first(frames)) {
        const Json& node = document["nodes"][n];
        const int parent = frames[n].parent;
        if (all || !shown[n] || has_additions(node) || node.contains("camera") || node.contains("weights") ||
            (parent >= 0 && bound.contains(static_cast<std::size_t>(parent))))
            bound.insert(n);
    }
    return bound;
}

/// Meshes with more than triangles without morph targets.
std::set<std::size_t> bound_meshes(const Json& document) {
    std::set<std::size_t> bound;
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m) {
        const Json& mesh = document["meshes"][m];
        bool more = has_additions(mesh) || mesh.contains("weights");
        for (const Json& primitive : mesh["primitives"])
            more |= primitive.contains("targets") || !makes_triangles(JsonCursor(primitive, ""));
        if (more) bound.insert(m);
    }
    return bound;
}

} // namespace

DocumentOptimizer::DocumentOptimizer(const Document& document)
    : document_(document), json_(parse_document(document.json)), before_(json_) {
    known_ = !has_unknown_extensions(json_) && !uses_extension(json_, "EXT_lights_image_based") &&
             !uses_extension(json_, "KHR_animation_pointer");
}

std::vector<std::size_t> DocumentOptimizer::merge_equal(bool keep_names) {
    const std::size_t count = count_of(json_, "materials");
    std::vector<std::size_t> first(count);
    for (std::size_t m = 0; m < count; ++m) first[m] = m;
    const auto images = first_equal(image_texts(document_, json_));
    visit_image_references(json_, [&](Json& r) { follow(images, r); });
    const auto samplers = first_equal(texts_of(json_, "samplers", false));
    visit_sampler_references(json_, [&](Json& r) { follow(samplers, r); });
    const auto textures = first_equal(texts_of(json_, "textures", false));
    visit_texture_references(json_, [&](Json& r) { follow(textures, r); });
    if (uses_extension(json_, "KHR_materials_variants")) return first;
    first = first_equal(texts_of(json_, "materials", keep_names));
    visit_material_references(json_, [&](Json& r) { follow(first, r); });
    return first;
}

const std::vector<Bytes>& DocumentOptimizer::buffers() {
    if (added_.empty()) return document_.buffers;
    all_buffers_ = document_.buffers;
    all_buffers_.insert(all_buffers_.end(), added_.begin(), added_.end());
    return all_buffers_;
}

std::size_t DocumentOptimizer::merge_equal_accessors(bool keep_names) {
    if (may_name_accessors(json_)) return 0;
    Source source(json_, buffers());
    const std::size_t count = count_of(json_, "accessors");
    std::vector<unsigned> uses(count); // a bit for each kind: the validator forbids an accessor with several
    each_accessor_use(json_, [&](AccessorUse use, const std::string&, const JsonCursor& reference) {
        uses[reference.index(count, "accessor")] |= 1U << static_cast<unsigned>(use);
    });
    std::vector<std::string> said(count);
    std::map<std::string, std::size_t> alike;
    for (std::size_t a = 0; a < count; ++a) {
        Json item = json_["accessors"][a];
        if (!item.contains("bufferView") || item.contains("sparse") ||
            (keep_names && item.contains("name")) || has_additions(item) ||
            source.without_bytes(item["bufferView"].get<std::size_t>()))
            continue;
        for (const char* key : {"name", "bufferView", "byteOffset", "min", "max"}) item.erase(key);
        const Json& view = json_["bufferViews"][json_["accessors"][a]["bufferView"].get<std::size_t>()];
        said[a] = fmt::format("{}{} {}", to_string(item), to_string(view.value("target", Json())), uses[a]);
        ++alike[said[a]];
    }
    for (std::size_t a = 0; a < count; ++a) {
        if (said[a].empty() || alike[said[a]] < 2) {
            said[a] = std::to_string(a);
            continue;
        }
        const Json reference = a;
        const AttributeData data =
            decode(source, accessor(source, JsonCursor(reference, "accessors[" + std::to_string(a) + "]")));
        said[a] +=
            std::visit([](const auto& numbers) { return sha256(std::as_bytes(std::span(numbers))); }, data);
    }
    const auto first = first_equal(said);
    for (std::size_t a = 0; a < count; ++a) // the remaining accessor gets the bounds
        for (const char* key : {"min", "max"})
            if (first[a] != a && json_["accessors"][a].contains(key))
                json_["accessors"][first[a]][key] = json_["accessors"][a][key];
    visit_accessor_references(json_, [&](Json& r) { follow(first, r); });
    std::size_t merged = 0;
    for (std::size_t a = 0; a < count; ++a) merged += first[a] != a;
    return merged;
}

/// Drops minima and maxima of accessors, which glTF requires only for positions and times.
void DocumentOptimizer::drop_bounds() {
    const std::vector<bool> needed = accessors_needing_bounds(json_);
    for (std::size_t a = 0; a < needed.size(); ++a)
        for (const char* key : {"min", "max"})
            if (!needed[a]) json_["accessors"][a].erase(key);
}

std::set<std::size_t> DocumentOptimizer::unnamed(const char* list, References references,
                                                 const std::set<std::size_t>& named) {
    const auto without_name = [&](Json& document) {
        std::set<std::size_t> dead;
        for (std::size_t i = 0; i < count_of(document, list); ++i) dead.insert(i);
        references(document, [&](Json& r) { dead.erase(r.get<std::size_t>()); });
        return dead;
    };
    std::set<std::size_t> dead = without_name(json_);
    for (const std::size_t i : named) dead.erase(i);
    if (!all_) // calls once per list, so that indices still have their old values
        for (const std::size_t i : without_name(before_)) dead.erase(i);
    return dead;
}

std::size_t DocumentOptimizer::erase(const char* list, References references,
                                     const std::set<std::size_t>& dead) {
    if (dead.empty()) return 0;
    erase_items(json_[list], dead, [&](const Visit& visit) { references(json_, visit); });
    if (json_[list].empty()) json_.erase(list);
    return dead.size();
}

TidyNumbers DocumentOptimizer::erase_unused(const TidyRequest& request) {
    TidyNumbers numbers;
    all_ = request.all;
    for (const std::size_t n : request.emptied)
        for (const char* key : {"mesh", "weights"}) json_["nodes"][n].erase(key);
    visit_mesh_references(json_, [&](Json& r) {
        const auto equal = request.equal_meshes.find(r.get<std::size_t>());
        if (equal != request.equal_meshes.end()) r = equal->second;
    });
    const std::size_t nodes = count_of(json_, "nodes"), meshes = count_of(json_, "meshes"),
                      materials = count_of(json_, "materials");
    std::set<std::size_t> dead_nodes, dead_meshes, dead_materials;
    if (known_) {
        dead_nodes = erase_empty_nodes(json_, request.emptied);
        erased_.nodes += dead_nodes.size();
        dead_meshes = unnamed("meshes", visit_mesh_references, request.meshes);
        erased_.meshes += erase("meshes", visit_mesh_references, dead_meshes);
        if (!uses_extension(json_, "KHR_materials_variants"))
            dead_materials = unnamed("materials", visit_material_references, request.materials);
        erased_.materials += erase("materials", visit_material_references, dead_materials);
        const auto tidy = [&](const char* list, References references) {
            return erase(list, references, unnamed(list, references, {}));
        };
        erased_.textures += tidy("textures", visit_texture_references);
        erased_.samplers += tidy("samplers", visit_sampler_references);
        erased_.images += tidy("images", visit_image_references);
    }
    if (!may_name_accessors(json_)) {
        erased_.accessors += erase("accessors", visit_accessor_references,
                                   unnamed("accessors", visit_accessor_references, {}));
        erase("bufferViews", visit_view_references, unnamed("bufferViews", visit_view_references, {}));
        if (all_) drop_bounds();
    }
    numbers.nodes = numbers_without(nodes, dead_nodes);
    numbers.meshes = numbers_without(meshes, dead_meshes);
    numbers.materials = numbers_without(materials, dead_materials);
    return numbers;
}

std::shared_ptr<const Document> DocumentOptimizer::finish(const std::shared_ptr<const Document>& before) {
    drop_nulls(json_);
    if (json_ == before_) return before;
    auto out = std::make_shared<Document>(document_);
    out->json = to_string(json_);
    for (const Bytes& bytes : added_) out->buffers.push_back(bytes);
    drop_unnamed_files(out->files, json_);
    return out;
}

std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentOptimizer>& documents) {
    const std::vector<PartView> views = part_views(scene);
    std::vector<bool> bound(views.size());
    std::vector<std::set<std::size_t>> nodes; // [documents] bound nodes
    std::vector<std::set<std::size_t>> meshes;
    for (DocumentOptimizer& document : documents) {
        nodes.push_back(bound_nodes(document.json_));
        meshes.push_back(bound_meshes(document.json_));
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Part& part = scene.parts[i];
        const auto d = static_cast<std::size_t>(part.document);
        bound[i] = views[i].animated || part.skinned ||
                   (part.document >= 0 && part.node >= 0 &&
                    nodes[d].contains(static_cast<std::size_t>(part.node))) ||
                   (part.document >= 0 && part.source_mesh >= 0 &&
                    meshes[d].contains(static_cast<std::size_t>(part.source_mesh)));
    }
    return bound;
}

void renumber(Scene& scene, int document, const TidyNumbers& numbers) {
    const auto follow = [](int& i, const std::vector<int>& all) {
        if (i >= 0 && static_cast<std::size_t>(i) < all.size()) i = all[static_cast<std::size_t>(i)];
    };
    for (Part& part : scene.parts) {
        if (part.document != document) continue;
        follow(part.node, numbers.nodes);
        follow(part.source_mesh, numbers.meshes);
    }
    for (Material& material : scene.materials)
        if (material.document == document) follow(material.index, numbers.materials);
}

} // namespace facetmill::io
