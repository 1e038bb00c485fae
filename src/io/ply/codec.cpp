#include "io/codec.hpp"

#include "io/images/image_files.hpp"
#include "io/material_document.hpp"
#include "io/ply/ply.hpp"
#include "io/ply/table.hpp"
#include "io/ply/textures.hpp"
#include "io/srgb_colours.hpp"
#include "io/stated.hpp"
#include "io/write_options.hpp"

#include <algorithm>

namespace facetmill::io::ply {

namespace {

/// Whether the element has this property.
bool has_property(const Header& header, std::string_view element, std::string_view name) {
    for (const auto& e : header.elements)
        if (e.name == element)
            for (const auto& p : e.properties)
                if (p.name == name) return true;
    return false;
}

bool has_elements(const Header& header, std::string_view element) {
    return std::any_of(header.elements.begin(), header.elements.end(),
                       [&](const Element& e) { return e.name == element && e.count > 0; });
}

bool has_texture_points(const Header& header) {
    for (const auto& [u, v] : texture_points)
        if (has_property(header, "vertex", u) && has_property(header, "vertex", v)) return true;
    return has_property(header, "face", "texcoord");
}

/// Lists the images. If faces have texture numbers, it lists all images, because only reading the whole file
/// finds the used numbers.
std::vector<NamedImage> images_of(const std::filesystem::path& path,
                                  const std::vector<std::filesystem::path>& asset_roots) {
    const Input input = Input::open(path).with_asset_roots(asset_roots);
    const Header header = read_header(input);
    ReadLog ignored; // reading the file repeats these warnings
    MaterialDocument document(input.name());
    const bool numbered = has_property(header, "face", "texnumber");
    const std::size_t n =
        numbered ? header.textures.size() : std::min<std::size_t>(header.textures.size(), 1);
    for (std::size_t i = 0; i < n; ++i) material_of(document, input, header.textures[i], ignored);
    return document.images();
}

const RegisterCodec codec({
    .name = "ply",
    .about = "Stanford polygon file, text or binary; all attributes are kept",
    .extensions = {"ply"},
    .can = {.polygons = true,
            .points = true,
            .points_and_faces = true,
            .lines = true,
            .full_precision = true,
            .options = {{"ascii", &WriteSettings::ascii}, {"big_endian", &WriteSettings::big_endian}},
            .attributes = "all, one value at a vertex"},
    .sniff =
        [](Span bytes) {
            const std::string_view text = as_text(bytes);
            return text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ") ? 2 : 0;
        },
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
    .peek =
        [](const Input& input, FileHeader& header) {
            const Header read = read_header(input);
            take_stated(header, read.stated);
            for (const auto& texture : read.textures)
                if (const auto relative = relative_path_of(texture))
                    if (const auto path = path_below(input, *relative)) header.files.push_back(*path);
            header.parts = {""};
            if (has_elements(read, "edge") && has_property(read, "edge", "vertex1") &&
                has_property(read, "edge", "vertex2"))
                header.parts.emplace_back(part_of_lines);
            if (read.textures.empty() || !has_texture_points(read) || input.path().empty()) return;
            header.images = [path = input.path(), roots = input.asset_roots()] {
                return images_of(path, roots);
            };
            header.has_materials = [images = header.images] { return !images().empty(); };
        },
});
} // namespace

} // namespace facetmill::io::ply

void facetmill::io::declare_encoding(Declare<WriteSettings>& d) {
    d.option("ascii", &WriteSettings::ascii, "Writes PLY and STL as text instead of binary.")
        .also_called("binary", "(ascii: false), which is the default");
    d.option("big_endian", &WriteSettings::big_endian,
             "Writes binary PLY with the most significant byte first.");
}
