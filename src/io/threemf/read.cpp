#include "io/threemf/threemf.hpp"

#include "base/json.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "geometry/render/srgb.hpp"
#include "io/attributes.hpp"
#include "io/flatten.hpp"
#include "io/images/image_files.hpp"
#include "io/material_document.hpp"
#include "io/srgb_colours.hpp"
#include "io/text.hpp"
#include "io/threemf/corner_looks.hpp"
#include "io/threemf/model.hpp"
#include "io/threemf/rules.hpp"
#include "io/threemf/slicer.hpp"
#include "io/threemf/zip.hpp"
#include "mesh/lines.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

class SceneMaker {
  public:
    SceneMaker(const Input& input, const ReadSettings& settings, ReadLog& log)
        : name_(input.name()), settings_(settings), log_(log), archive_(input.bytes(), input.name()),
          volumes_(archive_, input.name()), document_(input.name()) {}

    Scene make() {
        main_ = main_model(archive_, name_);
        check_relations_of(archive_, name_, main_);
        model(main_);
        Model& main = models_.at(main_);
        if (!main.has_build) malformed(name_ + main_, 0, "E-3MF", "<model> has no <build>", hint_for_rules);
        volumes_.remove_from(main.objects, left_out_);
        scene_.unit = main.unit;
        scene_.up = UpAxis::z;
        std::vector<Use> items = main.items;
        if (items.empty()) {
            items = unused(main, main_);
            faults_.emplace_back("it builds no objects, so all objects that no other object uses are read");
        }
        for (const Use& item : items) check_item(item);
        place_items(items);
        if (scene_.parts.empty() && !left_out_.empty()) {
            reads_all_types_ = true;
            place_items(items);
        }
        keep_metadata(main);
        images_ = document_.images();
        if (!document_.empty()) scene_.documents.push_back(document_.finish());
        warn_of_types();
        warn_of_faults();
        warn_of_skipped();
        return std::move(scene_);
    }

    /// The images of the textures, after make().
    const std::vector<NamedImage>& images() const { return images_; }

  private:
    const Model& model(const std::string& path) {
        if (const auto known = models_.find(path); known != models_.end()) return known->second;
        const auto xml = archive_.file(path);
        if (!xml) malformed(name_, 0, "E-3MF", fmt::format("the archive has no model '{}'", path));
        constexpr double memory_per_byte = 2; // memory for positions and corners, per byte of their text
        require_memory(memory_per_byte * static_cast<double>(xml->size()), fmt::format("reading '{}'", name_),
                       "use a machine with more memory");
        return models_.emplace(path, read_model(*xml, name_, path, settings_.max_vertices)).first->second;
    }

    void place_items(const std::vector<Use>& items) {
        for (const Use& item : items)
            if (item.printed || reads_all_types_)
                place(item, {}, "");
            else
                ++left_out_["printable=0"];
    }

    /// The objects of a model without build items, except objects that are components of others.
    static std::vector<Use> unused(const Model& model, const std::string& path) {
        std::set<std::uint32_t> components;
        for (const auto& [id, object] : model.objects)
            for (const Use& use : object.components)
                if (use.object.path == path) components.insert(use.object.id);
        std::vector<Use> items;
        for (const auto& [id, object] : model.objects)
            if (!components.contains(id)) items.push_back({{path, id}, {}});
        return items;
    }

    /// Adds the parts of an object: its own mesh and its components. name: the enclosing object's name. It
    /// replaces the object's own name if the enclosing object has only this component.
    void place(const Use& use, const Transform& above, const std::string& name,
               bool is_name_of_instance = false) {
        constexpr std::size_t most_uses = 1'000'000, deepest = 32;
        if (++uses_ > most_uses)
            beyond_limit(name_, fmt::format("its components place more than {} objects", most_uses));
        const Model& there = model(use.object.path);
        const auto found = there.objects.find(use.object.id);
        if (found == there.objects.end())
            malformed(name_, 0, "E-3MF",
                      fmt::format("there is no object {} in '{}'", use.object.id, use.object.path),
                      hint_for_rules);
        if (open_.size() >= deepest || std::find(open_.begin(), open_.end(), use.object) != open_.end())
            malformed(name_, 0, "E-3MF",
                      fmt::format("object {} is a component of itself, or nested deeper than {} levels",
                                  use.object.id, deepest));
        const Object& object = found->second;
        if (object.type != "model" && !reads_all_types_) {
            ++left_out_[object.type];
            return;
        }
        const Transform world = above * use.transform;
        const std::string& named = object.name.empty() || is_name_of_instance ? name : object.name;
        if (!object.positions.empty()) add_part(use.object, object, world, named);
        open_.push_back(use.object);
        const bool instance = object.components.size() == 1 && !named.empty();
        for (const Use& component : object.components) {
            const std::string* purpose =
                use.object.path == main_ ? volumes_.purpose(use.object.id, component.object.id) : nullptr;
            if (purpose && !reads_all_types_)
                ++left_out_[*purpose];
            else
                place(component, world, named, instance);
        }
        open_.pop_back();
    }

    void add_part(const ObjectId& id, const Object& object, const Transform& world, const std::string& name) {
        const auto known = first_part_.find(id);
        vertices_ += object.positions.size();
        if (vertices_ > settings_.max_vertices) beyond_limit(name_, "too many vertices");
        if (known != first_part_.end() || !object.beams.empty())
            require_memory(bytes_of(object), "copying the meshes of items", "use a machine with more memory");
        Mesh mesh = known == first_part_.end() ? mesh_of(id, object) : scene_.parts[known->second].mesh;
        if (known == first_part_.end() && !object.beams.empty()) {
            mesh.lines = object.beams;
            static_cast<void>(split_lines(mesh)); // without vertices that only beams use
        }
        if (!object.corners.empty() || object.beams.empty()) {
            first_part_.emplace(id, scene_.parts.size());
            add_part(std::move(mesh), world, name);
        }
        if (object.beams.empty()) return;
        Mesh beams;
        beams.positions = object.positions;
        beams.lines = object.beams;
        add_part(split_lines(beams), world, name);
    }
    void add_part(Mesh mesh, const Transform& world, const std::string& name) {
        Part& part = scene_.parts.emplace_back();
        part.name = name;
        part.mesh = std::move(mesh);
        part.transform = world;
    }
    static double bytes_of(const Object& object) {
        return static_cast<double>(object.positions.size() * sizeof(Vec3) +
                                   (object.corners.size() + object.beams.size()) * sizeof(Index));
    }

    Mesh mesh_of(const ObjectId& id, const Object& object) {
        Mesh mesh;
        mesh.positions = object.positions;
        mesh.corners = object.corners;
        extras_ = object.part_number.empty() ? ""
                                             : Json{{"extras", {{part_number_key, object.part_number}}}}.dump(
                                                   -1, ' ', false, Json::error_handler_t::replace);
        if (object.properties.group == none && object.triangles.empty()) {
            primitive(mesh, none, {});
            finish_primitives(mesh, {});
            return mesh;
        }
        const Model& there = model(id.path);
        CornerLooks looks(mesh.corners.size());
        std::vector<std::uint32_t> primitives;
        primitives.reserve(mesh.face_count());
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            Properties p = object.triangles.empty() ? object.properties : object.triangles[f];
            if (p.index[0] == none) p = object.properties;
            if (p.group == none) p.group = object.properties.group;
            const auto group = there.groups.find(p.group);
            if (group == there.groups.end()) {
                primitives.push_back(primitive(mesh, none, {}));
                continue;
            }
            const Group& from = group->second;
            const Index own = from.textured()  ? texture(id.path, from.texture, there)
                              : from.materials ? material(id.path, p.group, p.index[0], from)
                                               : none;
            const Kinds kinds{!from.materials && !from.colours.empty(), from.textured() && own != none};
            primitives.push_back(primitive(mesh, own, kinds));
            for (std::size_t k = 0; k < 3; ++k) looks.set(3 * f + k, from, p.index.at(k), kinds);
        }
        if (mesh.primitives.size() == 1)
            mesh.primitives[0].attributes.clear(); // all triangles have the same attributes
        finish_primitives(mesh, std::move(primitives));
        looks.add_to(mesh);
        return mesh;
    }

    /// The index of the primitive with this material in the mesh, added if new. Triangles without colours do
    /// not list them, so that white does not hide their material.
    std::uint32_t primitive(Mesh& mesh, Index material, const Kinds& kinds) const {
        for (std::size_t p = mesh.primitives.size(); p-- > 0;) {
            const Primitive& known = mesh.primitives[p];
            if (known.material == material && known.lists("COLOR_0") == kinds.coloured &&
                known.lists("TEXCOORD_0") == kinds.textured)
                return static_cast<std::uint32_t>(p);
        }
        std::vector<std::string> attributes{"POSITION"};
        if (kinds.coloured) attributes.emplace_back("COLOR_0");
        if (kinds.textured) attributes.emplace_back("TEXCOORD_0");
        mesh.primitives.push_back({material, std::move(attributes), extras_});
        return static_cast<std::uint32_t>(mesh.primitives.size() - 1);
    }
    static void finish_primitives(Mesh& mesh, std::vector<std::uint32_t> of_face) {
        if (mesh.primitives.size() == 1) {
            const Primitive& only = mesh.primitives[0];
            if (only.material == none && only.json.empty()) mesh.primitives.clear();
        }
        if (mesh.primitives.size() > 1)
            mesh.attributes.push_back(
                {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(of_face)});
    }

    Index material(const std::string& path, std::uint32_t group, std::uint32_t index, const Group& from) {
        const auto [at, fresh] = materials_.try_emplace({path, group, index}, none);
        if (!fresh) return at->second;
        const Colour& c = from.colours[index];
        Json json = {{"name", from.names[index]},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {linear_of(c[0]), linear_of(c[1]), linear_of(c[2]), c[3] / 255.0}},
                       {"metallicFactor", 0}}}};
        if (c[3] < 255) json["alphaMode"] = "BLEND";
        at->second = static_cast<Index>(scene_.materials.size());
        scene_.materials.push_back(document_.add(std::move(json), 0));
        return at->second;
    }

    /// The material with the image of a texture; none, with a warning, if the image cannot be kept.
    Index texture(const std::string& path, std::uint32_t id, const Model& there) {
        const auto [at, fresh] = materials_.try_emplace({path, id, none}, none);
        const auto found = there.textures.find(id);
        if (!fresh || found == there.textures.end()) return at->second;
        const TextureImageFile& texture = found->second;
        const auto bytes = archive_.file(texture.path);
        const std::string type = bytes ? media_type(*bytes) : "";
        if (type != "image/png" && type != "image/jpeg") {
            log_.warnings.push_back(
                {Severity::warning, "W-IMAGE",
                 fmt::format("the texture '{}' {}", texture.path,
                             bytes ? "is neither PNG nor JPEG, and is not kept" : "is not in the archive"),
                 file_mark(name_), "export the file again with PNG or JPEG images"});
            return none;
        }
        const std::filesystem::path file = std::filesystem::path(texture.path).filename();
        Json json = {
            {"name", file.stem().generic_string()},
            {"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", document_.texture(file, *bytes, texture.clamp, false)}}},
              {"metallicFactor", 0}}}};
        if (const auto channels = image_colours(*bytes); channels && channels->alpha)
            json["alphaMode"] = "BLEND";
        at->second = static_cast<Index>(scene_.materials.size());
        scene_.materials.push_back(document_.add(std::move(json), 0));
        return at->second;
    }

    /// Metadata go into the document as glTF has them, so that every format that can keep them does.
    void keep_metadata(const Model& main) {
        for (const auto& [name, text] : main.metadata)
            if (!trimmed(text).empty()) {
                Json& asset = document_.asset();
                (name == "Copyright" ? asset["copyright"] : asset["extras"][name]) = trimmed(text);
            }
    }

    void check_item(const Use& item) {
        const auto& objects = model(item.object.path).objects;
        const auto found = objects.find(item.object.id);
        if (found != objects.end() && found->second.type == "other")
            malformed(name_ + main_, static_cast<std::int64_t>(item.line), "E-3MF",
                      fmt::format("<item> builds object {}, whose type is 'other', which 3MF does not allow",
                                  item.object.id),
                      hint_for_rules);
    }

    /// Supports, modifiers and similar objects, which are not part of the product.
    void warn_of_types() {
        if (left_out_.empty()) return;
        std::vector<std::string> words;
        words.reserve(left_out_.size());
        bool negative = false;
        for (const auto& [type, count] : left_out_) {
            words.push_back(fmt::format("{} {}", count, in_quotes(type)));
            negative = negative || lower_case(type).starts_with("negative");
        }
        std::string message =
            reads_all_types_
                ? fmt::format("the file has no object of type 'model': others are read as such ({})",
                              fmt::join(words, ", "))
                : fmt::format("objects that are not models are skipped: {}", fmt::join(words, ", "));
        log_.warnings.push_back(
            {Severity::warning, "W-SKIPPED", std::move(message), file_mark(name_),
             reads_all_types_ ? ""
             : negative       ? "to cut a negative volume away, make it a separate object in the slicer, "
                                "and subtract it with combine"
                              : "change their type in the program that wrote them"});
    }

    void warn_of_faults() {
        faults_.insert(faults_.end(), volumes_.faults().begin(), volumes_.faults().end());
        for (const auto& [path, model] : models_)
            for (const std::string& fault : model.faults) faults_.push_back(fault);
        constexpr std::size_t most = 8;
        for (std::size_t i = 0; i < std::min(most, faults_.size()); ++i)
            log_.warnings.push_back(
                {Severity::warning, "W-3MF", faults_[i], file_mark(name_), "export the file again", false});
    }

    void warn_of_skipped() {
        std::map<std::string, std::size_t> all;
        for (const auto& [path, model] : models_)
            for (const auto& [what, count] : model.skipped) all[what] += count;
        std::vector<std::string> words;
        words.reserve(all.size());
        for (const auto& [what, count] : all) words.push_back(fmt::format("{} ({})", what, count));
        if (const auto files = other_files(); !files.empty()) words.push_back("the files " + some_of(files));
        if (!words.empty())
            log_.warnings.push_back(
                {Severity::warning, "W-SKIPPED",
                 fmt::format("elements that cannot be kept are skipped: {}", fmt::join(words, ", ")),
                 file_mark(name_), ""});
    }

    /// Files of the archive that are not read, such as the settings of slicers. Pictures are previews.
    std::vector<std::string> other_files() const {
        std::vector<std::string> files = archive_.paths();
        for (std::string& path : files) path = lower_case(path);
        std::erase_if(files, [](const std::string& path) {
            constexpr std::string_view known[] = {"/", ".rels", ".model", ".png", ".jpg", ".jpeg"};
            return path == "[content_types].xml" ||
                   std::any_of(std::begin(known), std::end(known),
                               [&](std::string_view end) { return path.ends_with(end); });
        });
        return files;
    }

    struct MaterialId {
        std::string path;
        std::uint32_t group, index;
        auto operator<=>(const MaterialId&) const = default;
    };

    const std::string& name_;
    const ReadSettings& settings_;
    ReadLog& log_;
    Archive archive_;
    SlicerVolumes volumes_;
    MaterialDocument document_;
    std::vector<NamedImage> images_;
    Scene scene_;
    std::map<std::string, Model> models_;
    std::string main_;                           ///< the path of the main model
    std::map<ObjectId, std::size_t> first_part_; ///< the first part of each object, which repeated items copy
    std::map<MaterialId, Index> materials_;
    std::vector<ObjectId> open_;
    std::size_t uses_ = 0, vertices_ = 0;
    std::string extras_;                          ///< of the primitives of the object being read
    std::map<std::string, std::size_t> left_out_; ///< objects that are not printed, by type or purpose
    bool reads_all_types_ = false;
    std::vector<std::string> faults_; ///< broken rules of the specification
};

/// Recognises a zip archive whose content types list a model. All writers put the content types near the
/// start.
int sniff(Span bytes) {
    const std::string_view text = as_text(bytes);
    if (!text.starts_with("PK\3\4")) return 0;
    constexpr std::size_t near = 65536;
    const std::string_view tail = text.substr(text.size() > near ? text.size() - near : 0);
    return tail.find(".model") != std::string_view::npos ? 2 : 1;
}

/// The images of a file, and whether it has materials. Only reading the whole file finds them.
std::pair<std::vector<NamedImage>, bool> materials_of(const std::filesystem::path& path) {
    const Input input = Input::open(path);
    const ReadSettings settings;
    ReadLog ignored; // reading the file repeats these warnings
    SceneMaker maker(input, settings, ignored);
    const bool has_materials = !maker.make().materials.empty();
    return {maker.images(), has_materials};
}

/// Reads only the unit, which is at the start of the model.
void peek(const Input& input, FileHeader& header) {
    Archive archive(input.bytes(), input.name());
    const std::string path = main_model(archive, input.name());
    if (const auto xml = archive.file(path)) header.unit = unit_of_model(*xml, input.name(), path);
    if (input.path().empty()) return;
    header.images = [file = input.path()] { return materials_of(file).first; };
    header.has_materials = [file = input.path()] { return materials_of(file).second; };
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    return SceneMaker(input, settings, log).make();
}

namespace {
const RegisterCodec codec({
    .name = "3mf",
    .about = "3D Manufacturing Format: objects with units, colours and materials, placed for a build",
    .extensions = {"3mf"},
    .unit = Unit::mm,
    .up = UpAxis::z,
    .can = {.normals = false,
            .transforms = true,
            .full_precision = true,
            .attributes = "colours at corners, or materials; textures are read but not written"},
    .sniff = sniff,
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
    .peek = peek,
});
} // namespace

} // namespace facetmill::io::threemf
