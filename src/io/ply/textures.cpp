#include "io/ply/textures.hpp"

#include "io/images/image_files.hpp"

#include <fmt/format.h>

namespace facetmill::io::ply {

namespace {

/// The image's bytes. None, with a warning, if the image cannot be read or glTF does not support its type.
std::optional<Bytes> texture_bytes(const Input& input, const std::string& texture, ReadLog& log) {
    auto bytes = read_image(input, relative_path_of(texture), texture, "TextureFile", log);
    const std::string type = bytes ? media_type(*bytes) : "";
    if (!bytes || type == "image/png" || type == "image/jpeg") return bytes;
    log.warnings.push_back(
        {Severity::warning, "W-IMAGE",
         fmt::format("the texture '{}' is neither PNG nor JPEG, as glTF requires, and is not kept", texture),
         file_mark(input.name()), "convert the image to PNG or JPEG"});
    return {};
}

} // namespace

std::optional<Material> material_of(MaterialDocument& document, const Input& input,
                                    const std::string& texture, ReadLog& log) {
    const auto bytes = texture_bytes(input, texture, log);
    if (!bytes) return {};
    const auto relative = relative_path_of(texture);
    return document.add({{"name", relative->stem().generic_string()},
                         {"pbrMetallicRoughness",
                          {{"baseColorTexture", {{"index", document.texture(*relative, *bytes, false)}}},
                           {"metallicFactor", 0}}}},
                        0);
}

} // namespace facetmill::io::ply
