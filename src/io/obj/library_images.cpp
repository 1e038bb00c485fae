#include "io/obj/library_images.hpp"

#include "base/hash.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/images/image_faults.hpp"
#include "io/material_document.hpp"

#include <algorithm>

namespace facetmill::io::obj {

namespace fs = std::filesystem;

namespace {

/// The images in the order of a plan. If a document has only materials, these are the images that the
/// materials name; otherwise all.
std::vector<ImageFile> in_order(std::vector<ImageFile> files, const Json& document) {
    if (document.contains("meshes") || !document.contains("materials")) return files;
    std::vector<std::size_t> order;
    try {
        order = images_of_materials(document);
    } catch (const Json::exception&) { // a document of points, where texture references may be invalid
        return files;
    }
    std::vector<ImageFile> all;
    for (const std::size_t i : order)
        for (ImageFile& file : files)
            if (file.index == i) all.push_back(std::move(file));
    return all;
}

/// Whether a reader interprets the end of a line as this path. The path must not begin like an option, and
/// no blank or quote may be lost.
bool can_end_a_line(const std::string& path) {
    const auto is_control = [](unsigned char c) { return c < ' '; };
    return !path.empty() && !path.starts_with('-') && !path.starts_with('"') && !path.starts_with(' ') &&
           !path.ends_with(' ') && !path.ends_with('\\') &&
           std::none_of(path.begin(), path.end(), is_control);
}

} // namespace

LibraryImages::LibraryImages(const Scene& scene, const WriteSettings& settings)
    : scene_(scene), settings_(settings) {
    ImageNames names(settings.title, ImageNames::Spelling::plain);
    std::map<std::string, std::size_t> by_digest;
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        documents_.push_back(parse_json(scene.documents[d]->json, Broken::discarded));
        if (documents_[d].is_object()) add(d, names, by_digest);
    }
}

void LibraryImages::add(std::size_t document, ImageNames& names,
                        std::map<std::string, std::size_t>& by_digest) {
    const Document& of = *scene_.documents[document];
    for (ImageFile& file : in_order(image_files(of, documents_[document]), documents_[document])) {
        const auto [place, fresh] = by_digest.try_emplace(sha256(file.bytes), images_.size());
        places_[{document, file.index}] = place->second;
        if (!fresh) continue;
        Image& image = images_.emplace_back();
        image.type = media_type(file.bytes);
        const auto colours = image_colours(file.bytes);
        image.alpha = colours && colours->alpha;
        const auto lies = settings_.textures == Textures::reference && !file.uri.empty()
                              ? place_of_file(of, file.uri, settings_.directory)
                              : std::nullopt;
        image.copied = !lies || !has_bytes(lies->file, file.bytes);
        image.name = (image.copied ? names.add(file.relative) : lies->way).generic_string();
        image.planned = !file.uri.empty() || colours;
        image.spelled = can_end_a_line(image.name);
        image.bytes = std::move(file.bytes);
    }
}

const Json& LibraryImages::json(int document) { return documents_[static_cast<std::size_t>(document)]; }

const LibraryImages::Image* LibraryImages::find(int document, std::size_t index) const {
    const auto found = places_.find({static_cast<std::size_t>(document), index});
    return found == places_.end() ? nullptr : &images_[found->second];
}

const LibraryImages::Image* LibraryImages::named(const std::string& name) const {
    const auto found =
        std::find_if(images_.begin(), images_.end(), [&](const Image& image) { return image.name == name; });
    return found == images_.end() ? nullptr : &*found;
}

void LibraryImages::use(const Image& image) {
    images_[static_cast<std::size_t>(&image - images_.data())].used = true;
}

std::vector<OutputFile> LibraryImages::take_files() {
    std::vector<OutputFile> files;
    for (Image& image : images_)
        if (image.used && image.copied) files.push_back({fs::path(image.name), std::move(image.bytes)});
    return files;
}

std::vector<Diagnostic> LibraryImages::warnings() const {
    std::vector<Diagnostic> all;
    for (const Image& image : images_)
        if (const std::string fault = image.used ? image_fault(image.bytes) : ""; !fault.empty())
            all.push_back(warning_of_fault(image.name, fault));
    return all;
}

} // namespace facetmill::io::obj
