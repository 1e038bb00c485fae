#include "io/threemf/model.hpp"

#include "base/text/words.hpp"
#include "io/text.hpp"
#include "io/threemf/rules.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    constexpr std::string_view blanks = " \t\r\n";
    for (std::size_t at = text.find_first_not_of(blanks); at != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(blanks, end);
    }
    return words;
}

class ModelReader {
  public:
    ModelReader(const std::string& archive, const std::string& path, std::size_t max_vertices)
        : name_(archive + path), path_(path), max_vertices_(max_vertices) {}

    Model read(Span xml) {
        read_xml(xml, name_, handler());
        if (!is_model_) malformed(name_, 0, "E-3MF", "expected <model> as the outermost element");
        for (const auto& [id, group] : model_.groups)
            if (group.textured() && !model_.textures.contains(group.texture))
                model_.faults.push_back(
                    fmt::format("the texture {} of group {} does not exist", group.texture, id));
        check_composites(resources_, name_);
        for (const auto& [id, layers] : layers_) check_layers(layers, resources_, name_);
        for (const auto& [id, object] : model_.objects) check(id, object);
        return std::move(model_);
    }

    XmlHandler handler() {
        return {
            [this](const Element& e) { start(e); }, [this] { end(); },
            [this](std::string_view prefix, std::string_view space) { spaces_[std::string(prefix)] = space; },
            [this](std::string_view text) { metadata_text(text); }};
    }
    Unit unit() const { return model_.unit; }

    void start(const Element& e) {
        const std::string_view parent = open_.empty() ? std::string_view() : open_.back();
        const bool known = skipping_ == 0 && is_known(e, parent);
        if (!known) {
            if (skipping_++ > 0) return;
            ++model_.skipped[std::string(e.name)];
            if (parent == "resources") other_resource(e);
            return;
        }
        open_.emplace_back(e.name);
        if (e.name == "vertex")
            vertex(e);
        else if (e.name == "triangle")
            triangle(e);
        else if (e.name == "model")
            model(e);
        else if (e.name == "object")
            object(e);
        else if (e.name == "component")
            object_->components.push_back(use(e));
        else if (e.name == "item")
            item(e);
        else if (e.name == "basematerials" || e.name == "colorgroup" || e.name == "texture2dgroup")
            group(e);
        else if (e.name == "texture2d")
            texture(e);
        else if (e.name == "tex2coord")
            group_->points.push_back({static_cast<float>(real(e, "u")), static_cast<float>(real(e, "v"))});
        else if (e.name == "base")
            base(e);
        else if (e.name == "multiproperties")
            layers(e);
        else if (e.name == "multi")
            layers_of_->multis.push_back(naturals(e, "pindices"));
        else if (e.name == "color")
            group_->colours.push_back(colour(e, "color"));
        else if (e.name == "metadata")
            metadata(e);
        else
            start_rare(e);
    }

  private:
    void start_rare(const Element& e) {
        if (e.name == "beam")
            beam(e);
        else if (e.name == "beamlattice")
            ++model_.skipped["radii of beams"];
        else if (e.name == "build")
            model_.has_build = true;
        else if (e.name == "vertices" || e.name == "triangles")
            note_attributes(e, {});
    }

    void beam(const Element& e) {
        if (object_->beams.size() >= none - 2) beyond_limit(name_, "too many beams");
        for (const char* end : {"v1", "v2"}) object_->beams.push_back(natural(e, end));
    }

    [[noreturn]] void fail(const Element& e, const std::string& message, std::string hint = {}) const {
        malformed(name_, static_cast<std::int64_t>(e.line), "E-3MF", message, std::move(hint));
    }
    [[noreturn]] void breaks_rule(const Element& e, const std::string& message) const {
        fail(e, message, hint_for_rules);
    }
    std::string_view need(const Element& e, const char* attribute) const {
        const auto value = e.find(attribute);
        if (!value) breaks_rule(e, fmt::format("<{}> has no attribute '{}'", e.name, attribute));
        return *value;
    }
    double real(const Element& e, const char* attribute, std::string_view text) const {
        text = trimmed(text);
        const char* at = text.data();
        double value = 0;
        if (!scan_real(at, text.data() + text.size(), value) || at != text.data() + text.size())
            fail(e, fmt::format("<{}> has {}={}, expected a number", e.name, attribute, in_quotes(text)));
        return value;
    }
    double real(const Element& e, const char* attribute) const {
        return real(e, attribute, need(e, attribute));
    }
    std::uint32_t natural(const Element& e, const char* attribute, std::string_view text) const {
        text = trimmed(text);
        std::uint32_t value = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || stop != text.data() + text.size() || value == none)
            fail(e, fmt::format("<{}> has {}={}, expected a whole number from 0 on", e.name, attribute,
                                in_quotes(text)));
        return value;
    }
    std::uint32_t natural(const Element& e, const char* attribute) const {
        return natural(e, attribute, need(e, attribute));
    }
    std::uint32_t natural_or(const Element& e, const char* attribute, std::uint32_t otherwise) const {
        const auto text = e.find(attribute);
        return text ? natural(e, attribute, *text) : otherwise;
    }

    /// Reads twelve numbers: the columns of the usual matrix, because 3MF multiplies row vectors from the
    /// left.
    Transform transform(const Element& e) const {
        Transform t;
        const auto given = e.find("transform");
        if (!given) return t;
        std::string_view rest = *given;
        for (std::size_t k = 0; k < 12; ++k) {
            rest = trimmed(rest);
            const auto stop = std::min(rest.find_first_of(" \t"), rest.size());
            if (stop == 0) fail(e, fmt::format("a transform has 12 numbers, found {}", k));
            t.m[k % 3][k / 3] = real(e, "transform", rest.substr(0, stop));
            rest = rest.substr(stop);
        }
        if (!trimmed(rest).empty()) fail(e, "a transform has 12 numbers, found more");
        return t;
    }
    Use use(const Element& e) const {
        const auto path = e.find(fmt::format("{}|path", production_space));
        return {{path ? std::string(*path) : path_, natural(e, "objectid")}, transform(e), true, e.line};
    }

    void item(const Element& e) {
        model_.items.push_back(use(e));
        model_.items.back().printed = e.find("printable").value_or("1") != "0";
        if (!e.find("partnumber").value_or("").empty()) ++model_.skipped["partnumber of item"];
    }

    /// "#RRGGBB" or "#RRGGBBAA".
    Colour colour(const Element& e, const char* attribute) const {
        const std::string_view text = trimmed(need(e, attribute));
        Colour c{0, 0, 0, 255};
        bool good = (text.size() == 7 || text.size() == 9) && text[0] == '#';
        for (std::size_t k = 0; good && k < text.size() / 2; ++k) {
            const char* at = text.data() + 1 + 2 * k;
            const auto [stop, error] = std::from_chars(at, at + 2, c.at(k), 16);
            good = error == std::errc{} && stop == at + 2;
        }
        if (!good)
            fail(e, fmt::format("<{}> has {}={}, expected #RRGGBB or #RRGGBBAA", e.name, attribute,
                                in_quotes(text)));
        return c;
    }

    void end() {
        if (skipping_ > 0)
            --skipping_;
        else
            open_.pop_back();
    }

    /// Whether the reader supports the element inside this parent.
    bool is_known(const Element& e, std::string_view parent) const {
        static constexpr std::pair<std::string_view, std::string_view> core[] = {
            {"", "model"},
            {"model", "metadata"},
            {"model", "resources"},
            {"resources", "basematerials"},
            {"basematerials", "base"},
            {"resources", "object"},
            {"object", "mesh"},
            {"mesh", "vertices"},
            {"vertices", "vertex"},
            {"mesh", "triangles"},
            {"triangles", "triangle"},
            {"object", "components"},
            {"components", "component"},
            {"model", "build"},
            {"build", "item"},
            {"multiproperties", "multi"}}; // without its prefix in samples of the 3MF Consortium
        static constexpr std::pair<std::string_view, std::string_view> colours[] = {
            {"resources", "colorgroup"},     {"colorgroup", "color"},
            {"resources", "texture2d"},      {"resources", "texture2dgroup"},
            {"texture2dgroup", "tex2coord"}, {"resources", "multiproperties"},
            {"multiproperties", "multi"}};
        static constexpr std::pair<std::string_view, std::string_view> lattices[] = {
            {"mesh", "beamlattice"}, {"beamlattice", "beams"}, {"beams", "beam"}};
        const std::pair here(parent, e.name);
        if (e.space == lattice_space)
            return std::find(std::begin(lattices), std::end(lattices), here) != std::end(lattices);
        if (e.space == material_space)
            return std::find(std::begin(colours), std::end(colours), here) != std::end(colours);
        return e.space == core_space && std::find(std::begin(core), std::end(core), here) != std::end(core);
    }

    void model(const Element& e) {
        is_model_ = true;
        const std::string_view unit = e.find("unit").value_or("millimeter");
        const auto* const known = std::find_if(std::begin(unit_names), std::end(unit_names),
                                               [&](const UnitName& u) { return u.name == unit; });
        if (known == std::end(unit_names)) fail(e, fmt::format("there is no unit {}", in_quotes(unit)));
        model_.unit = known->unit;
        for (const std::string_view prefix : words_of(e.find("requiredextensions").value_or(""))) {
            const std::string& space = spaces_[std::string(prefix)];
            if (std::find(std::begin(known_spaces), std::end(known_spaces), space) == std::end(known_spaces))
                malformed(name_, static_cast<std::int64_t>(e.line), "E-EXTENSION",
                          fmt::format("the extension '{}' ({}) is required but not supported", prefix, space),
                          "export it without the extension, as a plain mesh");
        }
        if (e.find("http://www.w3.org/XML/1998/namespace|space"))
            model_.faults.push_back(
                fmt::format("line {}: <model> has xml:space, which 3MF does not allow", e.line));
    }

    /// Keeps metadata, except entries that describe the file. Names with a prefix are settings of programs.
    void metadata(const Element& e) {
        const std::string_view name = need(e, "name");
        if (!metadata_.emplace(name).second)
            model_.faults.push_back(
                fmt::format("line {}: there are two metadata {}: the last counts", e.line, in_quotes(name)));
        if (std::find(std::begin(metadata_names), std::end(metadata_names), name) != std::end(metadata_names))
            model_.metadata.emplace_back(name, "");
        else if (name != "Application" && name != "ModificationDate")
            ++model_.skipped[fmt::format("metadata {}", in_quotes(name))];
        reads_metadata_ = !model_.metadata.empty() && model_.metadata.back().first == name;
    }
    void metadata_text(std::string_view text) {
        if (skipping_ > 0 || open_.empty() || open_.back() != "metadata" || !reads_metadata_) return;
        constexpr std::size_t most = 65536;
        std::string& all = model_.metadata.back().second;
        all.append(text.substr(0, most - std::min(most, all.size())));
    }

    /// Notes the kind of the resource with this id.
    void claim(const Element& e, std::uint32_t id, ResourceKind kind) {
        const auto [at, fresh] = resources_.try_emplace(id, Resource{kind, e.line, none});
        if (fresh) return;
        if (kind == ResourceKind::object && at->second.kind == kind)
            breaks_rule(e, fmt::format("there are two objects {}", id));
        breaks_rule(e, fmt::format("two resources have the id {}, which must be unique", id));
    }
    /// Resources that are not read.
    void other_resource(const Element& e) {
        const auto id = e.find("id");
        if (!id) return;
        const std::uint32_t number = natural(e, "id", *id);
        const bool composites = e.name == "compositematerials" && e.space == material_space;
        claim(e, number, composites ? ResourceKind::composites : ResourceKind::other);
        if (!composites) return;
        resources_[number].materials = natural(e, "matid");
        static_cast<void>(naturals(e, "matindices"));
    }

    void object(const Element& e) {
        const std::uint32_t id = natural(e, "id");
        claim(e, id, ResourceKind::object);
        object_ = &model_.objects[id];
        object_->name = e.find("name").value_or("");
        object_->part_number = e.find("partnumber").value_or("");
        object_->type = trimmed(e.find("type").value_or("model"));
        constexpr std::string_view types[] = {"model", "solidsupport", "support", "surface", "other"};
        if (std::find(std::begin(types), std::end(types), object_->type) == std::end(types))
            breaks_rule(e, fmt::format("object {} has the type {}, expected model, solidsupport, support, "
                                       "surface or other",
                                       id, in_quotes(object_->type)));
        if (e.find("pindex") && !e.find("pid"))
            breaks_rule(e, fmt::format("object {} has a pindex without a pid", id));
        object_->properties.group = natural_or(e, "pid", none);
        object_->properties.index.fill(natural_or(e, "pindex", object_->properties.group == none ? none : 0));
    }

    void vertex(const Element& e) {
        if (++vertices_ > max_vertices_ || object_->positions.size() >= none - 1)
            beyond_limit(name_, "too many vertices");
        // A later check finds all coordinates that are not finite.
        object_->positions.push_back({real(e, "x"), real(e, "y"), real(e, "z")});
    }

    /// Names the attributes that are not read. Slicers paint supports, seams and filaments on triangles.
    void note_attributes(const Element& e, std::initializer_list<std::string_view> own) {
        for (const char** a = e.attributes; *a; a += 2) {
            std::string_view name(*a);
            if (std::find(own.begin(), own.end(), name) != own.end()) continue;
            if (const auto bar = name.rfind('|'); bar != std::string_view::npos) name.remove_prefix(bar + 1);
            ++model_.skipped[fmt::format("{} of {}", name, e.name)];
        }
    }
    void triangle(const Element& e) {
        for (const char* corner : {"v1", "v2", "v3"}) object_->corners.push_back(natural(e, corner));
        if (object_->corners.size() >= none - 3) beyond_limit(name_, "too many triangles");
        note_attributes(e, {"v1", "v2", "v3", "p1", "p2", "p3", "pid"});
        Properties p;
        p.index[0] = natural_or(e, "p1", none);
        if (p.index[0] == none) {
            if (!object_->triangles.empty()) object_->triangles.emplace_back();
            return;
        }
        p.group = natural_or(e, "pid", none);
        p.index[1] = natural_or(e, "p2", p.index[0]);
        p.index[2] = natural_or(e, "p3", p.index[0]);
        object_->triangles.resize(object_->corners.size() / 3 - 1);
        object_->triangles.push_back(p);
    }

    void group(const Element& e) {
        const std::uint32_t id = natural(e, "id");
        const bool materials = e.name == "basematerials";
        claim(e, id,
              materials                ? ResourceKind::materials
              : e.name == "colorgroup" ? ResourceKind::colours
                                       : ResourceKind::points);
        group_ = &model_.groups[id];
        group_->materials = materials;
        if (e.name == "texture2dgroup") group_->texture = natural(e, "texid");
    }
    void texture(const Element& e) {
        const std::uint32_t id = natural(e, "id");
        claim(e, id, ResourceKind::texture);
        const std::string_view type = trimmed(e.find("contenttype").value_or("image/png"));
        if (type != "image/png" && type != "image/jpeg")
            breaks_rule(e,
                        fmt::format("texture2d {} has the content type {}, expected image/png or image/jpeg",
                                    id, in_quotes(type)));
        TextureImageFile& texture = model_.textures[id];
        texture.path = need(e, "path");
        const auto style = [&](const char* attribute) { return e.find(attribute).value_or("wrap"); };
        texture.clamp = style("tilestyleu") == "clamp" && style("tilestylev") == "clamp";
        for (const char* attribute : {"tilestyleu", "tilestylev"})
            if (style(attribute) != "wrap" && !texture.clamp)
                ++model_.skipped[fmt::format("{} {}", attribute, style(attribute))];
    }
    void base(const Element& e) {
        group_->names.emplace_back(e.find("name").value_or(""));
        group_->colours.push_back(colour(e, "displaycolor"));
    }

    std::vector<std::uint32_t> naturals(const Element& e, const char* attribute) const {
        std::vector<std::uint32_t> numbers;
        for (const std::string_view word : words_of(need(e, attribute)))
            numbers.push_back(natural(e, attribute, word));
        return numbers;
    }
    static constexpr std::size_t most_layers = 64; ///< each multi has a property of each layer

    void layers(const Element& e) {
        const std::uint32_t id = natural(e, "id");
        claim(e, id, ResourceKind::layers);
        layers_of_ = &layers_[id];
        layers_of_->line = e.line;
        layers_of_->groups = naturals(e, "pids");
        if (layers_of_->groups.size() > most_layers)
            fail(e, fmt::format("multiproperties have more than {} layers", most_layers));
        for (const std::string_view method : words_of(e.find("blendmethods").value_or("")))
            layers_of_->multiply.push_back(method == "multiply");
    }

    /// Checks that the vertices and properties that triangles name exist.
    void check(std::uint32_t id, const Object& object) {
        for (std::size_t c = 0; c < object.corners.size(); ++c)
            if (object.corners[c] >= object.positions.size())
                malformed(name_, 0, "E-3MF",
                          fmt::format("triangle {} of object {} refers to vertex {}, but the object has {}",
                                      c / 3, id, object.corners[c], object.positions.size()),
                          hint_for_rules);
        for (const Index end : object.beams)
            if (end >= object.positions.size())
                malformed(name_, 0, "E-3MF",
                          fmt::format("a beam of object {} refers to vertex {}, but the object has {}", id,
                                      end, object.positions.size()),
                          hint_for_rules);
        std::set<std::uint32_t> missing;
        check(id, object.properties, none, missing);
        for (const Properties& p : object.triangles) check(id, p, object.properties.group, missing);
        for (const std::uint32_t group : missing)
            model_.faults.push_back(fmt::format(
                "object {} refers to the properties {}, which do not exist, so these faces have no colour",
                id, group));
    }
    void check(std::uint32_t id, const Properties& p, std::uint32_t otherwise,
               std::set<std::uint32_t>& missing) {
        const std::uint32_t named = p.group == none ? otherwise : p.group;
        blend(named);
        const auto group = model_.groups.find(named);
        if (group == model_.groups.end()) {
            if (named != none && !resources_.contains(named)) missing.insert(named);
            return;
        }
        for (const std::uint32_t index : p.index)
            if (index != none && index >= group->second.size())
                malformed(name_, 0, "E-3MF",
                          fmt::format("object {} refers to property {} of group {}, which has {}", id, index,
                                      group->first, group->second.size()));
    }

    /// Makes a group of the layers that an object uses. Layers that nothing uses may be wrong. Without known
    /// layers, no colour hides the material.
    void blend(std::uint32_t id) {
        const auto layers = layers_.find(id);
        if (layers == layers_.end() || model_.groups.contains(id)) return;
        const auto known = [&](std::uint32_t group) { return model_.groups.contains(group); };
        if (std::any_of(layers->second.groups.begin(), layers->second.groups.end(), known))
            model_.groups[id] = blended(layers->second, model_);
    }

    std::string name_; ///< shown in messages: "a.3mf/3D/3dmodel.model"
    const std::string& path_;
    std::size_t max_vertices_, vertices_ = 0;
    Model model_;
    bool is_model_ = false;
    std::vector<std::string> open_; ///< the enclosing supported elements
    int skipping_ = 0;              ///< the depth inside an unsupported element
    bool reads_metadata_ = false;
    std::map<std::string, std::string> spaces_;
    Resources resources_;                         ///< all with an id
    std::set<std::string, std::less<>> metadata_; ///< the names so far
    Object* object_ = nullptr;
    Group* group_ = nullptr;
    std::map<std::uint32_t, Layers> layers_;
    Layers* layers_of_ = nullptr; ///< the resource being read
};

} // namespace

Model read_model(Span xml, const std::string& archive, const std::string& path, std::size_t max_vertices) {
    return ModelReader(archive, path, max_vertices).read(xml);
}

Unit unit_of_model(Span xml, const std::string& archive, const std::string& path) {
    struct Found {};
    ModelReader reader(archive, path, 0);
    XmlHandler handler = reader.handler();
    handler.start = [&](const Element& e) {
        reader.start(e);
        throw Found{};
    };
    try {
        read_xml(xml, archive + path, handler);
    } catch (const Found&) { // the first element has been read
    }
    return reader.unit();
}

} // namespace facetmill::io::threemf
