#include "io/gltf/write.hpp"

#include "io/gltf/container.hpp"
#include "io/gltf/files.hpp"
#include "io/gltf/patch.hpp"

#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

Json empty_document() {
    return {{"asset", {{"version", "2.0"}, {"generator", "facetmill " FACETMILL_VERSION}}},
            {"scene", 0},
            {"scenes", Json::array({Json::object()})}};
}

std::string percent_encoded(const std::string& name) {
    static constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    std::string out;
    for (const char c : name) {
        if (plain.find(c) != std::string_view::npos)
            out += c;
        else
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

Bytes to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void drop_unused_draco(Builder& builder) {
    bool used = false;
    for (std::size_t m = 0; m < count_of(builder.json(), "meshes"); ++m)
        for (const auto& primitive : builder.json()["meshes"][m]["primitives"])
            used = used || (primitive.contains("extensions") &&
                            primitive["extensions"].contains("KHR_draco_mesh_compression"));
    if (!used) builder.drop_extension("KHR_draco_mesh_compression");
}

/// The images that the written document names, as files beside it.
void add_images(Patch& patch) {
    for (std::size_t i = 0; i < count_of(patch.builder.json(), "images"); ++i) {
        const auto uri = item(patch.builder.json(), "images", i).find("uri");
        if (!uri || is_data_uri(uri->text())) continue;
        const auto found = patch.files.find(uri->text());
        const auto path = relative_path(uri->text());
        if (found == patch.files.end() || !path) {
            patch.warn("W-IMAGE", fmt::format("{}: the image \"{}\" was not read and is not copied",
                                              uri->path(), uri->text()));
            continue;
        }
        const bool there = std::any_of(patch.written.files.begin(), patch.written.files.end(),
                                       [&](const OutputFile& f) { return f.name == *path; });
        if (!there) patch.written.files.push_back({*path, found->second});
    }
}

void add_main_files(Patch& patch, Bytes buffer, bool binary) {
    const std::string stem = patch.settings.title.empty() ? "scene" : patch.settings.title;
    Json& json = patch.builder.json();
    if (binary) {
        patch.written.files.push_back({stem + ".glb", join_glb(to_string(json), buffer)});
        return;
    }
    std::string name = stem + ".bin";
    if (!buffer.empty()) {
        for (int n = 2; patch.files.count(name); ++n)
            name = fmt::format("{}.{}.bin", stem, n); // an image's name
        Json first = {{"uri", percent_encoded(name)}};
        first.update(json["buffers"][0]);
        json["buffers"][0] = std::move(first);
    }
    patch.written.files.push_back(
        {stem + ".gltf", to_bytes(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n")});
    if (!buffer.empty()) patch.written.files.push_back({name, std::move(buffer)});
}

/// What a second document has besides meshes and materials does not come along.
void warn_of_losses(Patch& patch) {
    for (std::size_t d = 1; d < patch.scene.documents.size(); ++d) {
        const Json other = parse_document(patch.scene.documents[d]->json);
        std::vector<std::string> lost;
        for (const char* list : {"animations", "skins", "cameras", "extensions"})
            if (other.contains(list) && !other[list].empty()) lost.push_back(list);
        if (!lost.empty())
            patch.warn("W-MERGED",
                       fmt::format("of '{}' only the meshes and materials are written, without its {}",
                                   patch.scene.documents[d]->name, fmt::join(lost, ", ")),
                       "write each file's parts by themselves to keep them");
    }
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings, bool binary) {
    Written written;
    const Document* document = scene.documents.empty() ? nullptr : scene.documents[0].get();
    Builder builder(document ? parse_document(document->json) : empty_document(),
                    document ? &document->buffers : nullptr);
    Patch patch{scene, settings, builder, written, document ? 0 : -1};
    if (document) patch.files = document->files;
    if (settings.draco.on && settings.mesh_manifold)
        patch.warn("W-MANIFOLD",
                   "EXT_mesh_manifold is not written under Draco, which renumbers what it names");
    claim_placements(patch);
    const auto mesh_of_part = patch_meshes(patch);
    patch_levels(patch, patch_nodes(patch, mesh_of_part));
    drop_dead_meshes(patch, mesh_of_part);
    drop_unused_draco(builder);
    warn_of_losses(patch);
    Bytes buffer = builder.finish(written.warnings);
    add_main_files(patch, std::move(buffer), binary);
    add_images(patch);
    return written;
}

} // namespace facetmill::io::gltf
