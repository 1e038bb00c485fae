#include "report/viewer.hpp"

#include "base/text/words.hpp"
#include "geometry/preview/preview.hpp"
#include "geometry/render/render.hpp"
#include "geometry/spatial/signed_distances.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/png.hpp"
#include "report/deviation_view.hpp"
#include "report/viewer_data.hpp"
#include "report/viewer_script.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr std::size_t all_faces = 150000,
                      most_faces = 40000; ///< maximum numbers of faces: in total, and per scene
constexpr std::size_t most_scenes = 6;    ///< number of scenes that get a share of the faces
/// Limits for the text in a page of 3 MB: all scenes with their textures, and the textures.
constexpr std::size_t most_bytes = 1200000, most_texture_bytes = 500000;
constexpr int largest_texture = 512; ///< pixels along a side

/// The largest of the sizes.
double largest_of(const std::vector<float>& distances) {
    float largest = 0;
    for (const float x : distances) largest = std::max(largest, std::abs(x));
    return static_cast<double>(largest);
}

/// The first mipmap level within the size limit.
io::Pixels pixels_of(const TextureImage& image, int largest) {
    const auto fits = std::find_if(image.levels.begin(), image.levels.end(), [&](const auto& level) {
        return std::max(level.width, level.height) <= largest;
    });
    const auto& level = fits == image.levels.end() ? image.levels.back() : *fits;
    return {static_cast<std::size_t>(level.width), static_cast<std::size_t>(level.height), level.rgba, false};
}

const char* word_of(TextureWrap wrap) {
    return wrap == TextureWrap::clamp ? "clamp" : wrap == TextureWrap::mirror ? "mirror" : "repeat";
}

const char* word_of(MaterialLook::Alpha alpha) {
    return alpha == MaterialLook::Alpha::mask    ? "mask"
           : alpha == MaterialLook::Alpha::blend ? "blend"
                                                 : "opaque";
}

/// Vertices of faces other than caps, which have exact distances.
std::vector<Index> measured_vertices(const Preview& preview) {
    const Mesh& mesh = preview.mesh;
    std::vector<std::uint8_t> measured(mesh.vertex_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (const Index w : mesh.face_wedges(f))
            measured[mesh.vertex_of_wedge(w)] |= !preview.paints[mesh.primitive_of(f)].cap;
    std::vector<Index> vertices;
    for (Index v = 0; v < measured.size(); ++v)
        if (measured[v]) vertices.push_back(v);
    return vertices;
}

/// The distances of vertices, and the range of the colour scale.
struct Distances {
    std::vector<float> all; ///< [vertices] or empty; 0 for unmeasured vertices
    double largest = 0, scale = 1;
};

Distances distances_of(const Preview& preview, const FaceTree& tree) {
    const Mesh& mesh = preview.mesh;
    const std::vector<Index> vertices = measured_vertices(preview);
    Distances out;
    if (vertices.empty()) return out;
    std::vector<Vec3> points;
    points.reserve(vertices.size());
    for (const Index v : vertices) points.push_back(mesh.positions[v]);
    const std::vector<float> found = signed_distances(tree, points);
    out.largest = largest_of(found);
    const double most = colour_limit(found, out.largest, box_of(mesh.positions).diagonal());
    out.scale = most > 0 ? most : 1;
    out.all.resize(mesh.vertex_count());
    for (std::size_t i = 0; i < vertices.size(); ++i) out.all[vertices[i]] = found[i];
    return out;
}

/// True if two scenes look the same in the view.
bool look_alike(const Json& a, const Json& b) {
    for (const char* key : {"data", "groups", "origin", "size", "up", "front"})
        if (a[key] != b[key]) return false;
    return true;
}

Json list_of(const Vec3& v) { return {v.x, v.y, v.z}; }

} // namespace

ViewedScenes::ViewedScenes(std::size_t expected)
    : faces_(std::min(most_faces, all_faces / std::clamp<std::size_t>(expected, 1, most_scenes))) {}

void ViewedScenes::stand_as(const Camera& camera, UpAxis up) {
    first_ = camera;
    first_up_ = up;
}

void ViewedScenes::add_before(const Scene& scene, const std::string& name,
                              const std::shared_ptr<const ResolvedMaterials>& materials) {
    auto json = packed(scene, name, materials, {});
    if (!json) return;
    (*json)["before"] = true;
    scenes_.push_back(std::move(*json));
}

void ViewedScenes::add_after(const Scene& scene, const std::string& name,
                             const std::shared_ptr<const ResolvedMaterials>& materials,
                             const ViewedFrom& from) {
    if (bytes_ > most_bytes * 3 / 4 || scenes_.size() > most_scenes) {
        ++left_out_;
        return;
    }
    auto json = packed(scene, name, materials, from);
    if (!json) return;
    (*json)["before"] = false;
    (*json)["reference"] = from.name;
    if (!scenes_.empty()) {
        Json& last = scenes_.back();
        if (look_alike(last, *json)) {
            if (last["name"] != name) last["name"] = last["name"].get<std::string>() + ", " + name;
            last["before"] = false;
            return;
        }
    }
    scenes_.push_back(std::move(*json));
}

std::optional<Json> ViewedScenes::packed(const Scene& given, const std::string& name,
                                         const std::shared_ptr<const ResolvedMaterials>& materials,
                                         const ViewedFrom& from) {
    const auto posed = io::posed(given);
    const Scene& scene = posed ? *posed : given;
    const Preview preview = preview_of(scene, {faces_, materials, from.last_cap});
    if (preview.mesh.vertex_count() == 0) return {};
    Distances distances;
    if (from.tree && !from.tree->empty()) distances = distances_of(preview, *from.tree);
    PackedMesh mesh = report::packed(preview, distances.all, distances.scale);
    // A scene without an up axis uses the axis of its file, otherwise the axis of the first scene.
    const UpAxis up = scene.up == UpAxis::unknown ? from.file_up : scene.up;
    const Camera camera = first_ && first_up_ == up ? *first_
                          : up == scene.up          ? camera_of(scene)
                          : up == UpAxis::z         ? Camera{.up = {0, 0, 1}, .front = {0, -1, 0}, .seen = {}}
                                                    : Camera{.up = {0, 1, 0}, .front = {0, 0, 1}, .seen = {}};
    if (!first_) stand_as(camera, up);
    Json json = {{"name", name},
                 {"faces", preview.faces},
                 {"lines", preview.all_lines},
                 {"points", preview.all_dots},
                 {"up", list_of(camera.up)},
                 {"front", list_of(camera.front)},
                 {"unit", scene.unit == Unit::unknown ? "" : to_string(scene.unit)},
                 {"groups", Json::array()}};
    json.update(mesh.json);
    if (!distances.all.empty()) {
        json["deviation"] = distances.scale;
        json["largest"] = distances.largest;
    }
    const bool textures = preview.mesh.find("TEXCOORD_0", Domain::wedge) != nullptr;
    for (const PackedGroup& g : mesh.groups)
        json["groups"].push_back(group(scene, g.paint, g.faces, textures, materials.get()));
    bytes_ += json["data"].get_ref<const std::string&>().size();
    return json;
}

Json ViewedScenes::group(const Scene& scene, const PreviewPaint& paint, std::size_t count, bool textures,
                         const ResolvedMaterials* materials) {
    const Index material = paint.material;
    const MaterialLook* look = materials && material < materials->size() ? &(*materials)[material] : nullptr;
    const double grey[3] = {0.72, 0.74, 0.78}; // the grey of pictures
    Json base = Json::array();
    for (std::size_t c = 0; c < 4; ++c)
        base.push_back(look ? static_cast<double>(look->base[c]) : paint.coloured || c == 3 ? 1.0 : grey[c]);
    const auto alpha = look ? look->alpha : MaterialLook::Alpha::opaque;
    Json image;
    if (look && look->base_texture && textures)
        image = texture(look->base_texture, alpha != MaterialLook::Alpha::opaque);
    return {{"count", count},
            {"base", std::move(base)},
            {"coloured", paint.coloured},
            {"cap", paint.cap},
            {"texture", std::move(image)},
            {"alpha", word_of(alpha)},
            {"cutoff", look ? static_cast<double>(look->cutoff) : 0.5},
            {"unlit", look && look->unlit},
            {"double_sided", material < scene.materials.size() && scene.materials[material].double_sided}};
}

/// The index of the texture in the page; null if there is no room.
Json ViewedScenes::texture(const Texture& texture, bool with_alpha) {
    const TextureKey key{texture.image.get(), texture.wrap_u, texture.wrap_v, texture.nearest, with_alpha};
    if (const auto known = images_.find(key); known != images_.end()) return known->second;
    io::Pixels pixels;
    std::string text;
    for (int largest = largest_texture; largest >= 64; largest /= 2) {
        pixels = pixels_of(*texture.image, largest);
        const bool opaque = !with_alpha || io::is_opaque(pixels);
        text = (opaque ? "data:image/jpeg;base64," : "data:image/webp;base64,") +
               io::base64(opaque ? io::encoded_jpeg(pixels, {}) : io::encoded_webp(pixels, {}));
        if (texture_bytes_ + text.size() <= most_texture_bytes) break;
        text.clear();
    }
    Json place;
    if (!text.empty()) {
        place = textures_.size();
        texture_bytes_ += text.size();
        bytes_ += text.size();
        textures_.push_back({{"src", std::move(text)},
                             {"wrap", {word_of(texture.wrap_u), word_of(texture.wrap_v)}},
                             {"nearest", texture.nearest}});
    }
    kept_.push_back(texture.image);
    images_.emplace(key, place);
    return place;
}

Json ViewedScenes::json() const {
    if (scenes_.empty()) return nullptr;
    return {{"scenes", scenes_},
            {"textures", textures_},
            {"left_out",
             left_out_ == 0 ? "" : fmt::format("{} not shown here.", counted(left_out_, "further output"))}};
}

std::string viewer_section(const Json& viewed) {
    if (viewed.is_null()) return {};
    std::string text;
    for (const char c : viewed.dump(-1, ' ', true, Json::error_handler_t::replace))
        if (c == '<')
            text += "\\u003c"; // escapes "<", so that no name ends the script element
        else
            text += c;
    return fmt::format("<section class=\"viewer\" hidden>\n<h2>3D view</h2>\n"
                       "<script type=\"application/json\">{}</script>\n</section>\n<script>{}</script>\n",
                       text, viewer_script());
}

} // namespace facetmill::report
