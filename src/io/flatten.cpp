#include "io/flatten.hpp"

#include "base/json.hpp"
#include "base/ordered_set.hpp"
#include "base/text/words.hpp"
#include "io/attributes.hpp"
#include "io/metadata.hpp"
#include "mesh/primitives_in_use.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace facetmill::io {

std::string hint_for_size(double size) {
    const std::string digits = fmt::format("{:.0e}", size); // "2e-120"
    const bool is_large = digits.find("e-") == digits.npos;
    const std::size_t sign = digits.find('e');
    const std::string power = sign == digits.npos ? "150" : digits.substr(sign + 2);
    return fmt::format("bring the scene near 1 in size: transform: {{scale: 1e{}{}}}", is_large ? "-" : "",
                       power);
}

void require_floats(const Mesh& mesh, const std::string& what) {
    constexpr double least = 1.1754943508222875e-38,
                     most = 3.4028234663852886e38; // the range of normal float32 numbers
    const Box box = mesh.bounds();
    double farthest = 0;
    for (std::size_t i = 0; i < 3 && !box.empty(); ++i)
        farthest = std::max({farthest, std::abs(box.min[i]), std::abs(box.max[i])});
    if (farthest == 0 || (farthest >= least && farthest <= most)) return;
    throw Error(ErrorKind::stage, "E-RANGE",
                fmt::format("{} has positions that float32 cannot hold, up to {}", what, farthest),
                hint_for_size(farthest));
}

WorldMesh::WorldMesh(const Part& part) {
    if (part.transform.identity()) {
        given_ = &part.mesh;
        return;
    }
    own_ = part.mesh;
    apply(own_, part.transform);
}

WorldMesh::WorldMesh(const Scene& scene) {
    if (scene.parts.size() == 1) {
        *this = WorldMesh(scene.parts.front());
        return;
    }
    for (const auto& part : scene.parts) facetmill::append(own_, *WorldMesh(part));
}

void leave_documents(Written& written, const Scene& scene, const char* format,
                     const std::set<std::string>& kept) {
    std::size_t animations = 0, skins = 0;
    for (const auto& document : scene.documents) {
        const Json json = parse_json(document->json, Broken::discarded);
        if (!json.is_object()) continue;
        const auto leave = [&](const std::string& what) {
            written.changes.push_back({what, Domain::face, AttributeChange::Kind::dropped,
                                       fmt::format("{} cannot represent it", format)});
        };
        const auto count = [&](const char* what) {
            const auto at = json.find(what);
            return at != json.end() && at->is_array() ? at->size() : 0;
        };
        for (const char* what : {"textures", "skins", "animations", "cameras"})
            if (count(what) > 0 && !kept.contains(what)) leave(fmt::format("{} ({})", what, count(what)));
        animations += count("animations");
        skins += count("skins");
        if (const auto at = json.find("extensionsUsed"); at != json.end() && at->is_array())
            for (const auto& name : *at)
                if (name.is_string() && !kept.contains(name.get<std::string>()))
                    leave(name.get<std::string>());
    }
    warn_of_lost(written, scene, format, kept);
    std::vector<std::string> left_out;
    if (animations > 0) left_out.push_back(counted(animations, "animation"));
    if (skins > 0) left_out.push_back(counted(skins, "skin"));
    if (!left_out.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-ANIMATION",
             fmt::format("{} {} not written to {}: the mesh is in its rest pose",
                         fmt::join(left_out, " and "), animations + skins == 1 ? "is" : "are", format),
             {},
             "glTF keeps them: write .glb"});
}

namespace {

/// Materials that faces use.
std::set<Index> materials_in_use(const Scene& scene) {
    std::set<Index> used;
    for (const auto& part : scene.parts) {
        if (part.mesh.face_count() == 0) continue;
        const std::vector<bool> primitives = primitives_in_use(part.mesh);
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (const Index m = part.mesh.primitives[p].material; primitives[p] && m < scene.materials.size())
                used.insert(m);
    }
    return used;
}

/// The name to show; the number for an unnamed material.
std::string shown_name(const Material& material, std::size_t number) {
    return material.name.empty() ? std::to_string(number) : material.name;
}

} // namespace

std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    if (names.size() <= most) return join_texts(names);
    return fmt::format("{} and {} more", join_texts({names.begin(), names.begin() + most}),
                       names.size() - most);
}

void warn_of_colours(Written& written, const Scene& scene, const char* format) {
    std::vector<std::string> coloured;
    for (const Index m : materials_in_use(scene)) {
        const Material& material = scene.materials[m];
        const auto& c = material.base_colour;
        if (c[0] != 1 || c[1] != 1 || c[2] != 1) coloured.push_back(shown_name(material, m));
    }
    if (!coloured.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-MATERIAL",
             fmt::format("the colours of {} are not written to {}: {}", counted(coloured.size(), "material"),
                         format, some_of(coloured)),
             {},
             "glTF, OBJ and 3MF keep them"});
}

namespace {

/// Calls body with each documented material that faces use: its name and its JSON.
void for_each_described(const Scene& scene,
                        const std::function<void(const std::string& name, const Json& said)>& body) {
    std::map<int, Json> documents;
    for (const Index m : materials_in_use(scene)) {
        const Material& material = scene.materials[m];
        if (material.document < 0 || material.index < 0) continue;
        const auto [at, fresh] = documents.try_emplace(material.document);
        if (fresh)
            at->second = parse_json(scene.documents[static_cast<std::size_t>(material.document)]->json,
                                    Broken::discarded);
        const Json::json_pointer place(fmt::format("/materials/{}", material.index));
        if (at->second.is_object() && at->second.contains(place))
            body(shown_name(material, static_cast<std::size_t>(material.index)), at->second[place]);
    }
}

/// The number at this JSON pointer.
double number_at(const Json& said, const char* place, double otherwise) {
    const Json::json_pointer at(place);
    return said.contains(at) && said[at].is_number() ? said[at].get<double>() : otherwise;
}

bool emits(const Json& said) {
    const auto at = said.find("emissiveFactor");
    return at != said.end() && at->is_array() && std::any_of(at->begin(), at->end(), [](const Json& c) {
               return c.is_number() && c.get<double>() > 0;
           });
}

} // namespace

void warn_of_looks(Written& written, const Scene& scene, const char* format) {
    std::vector<std::string> names;
    bool metal = false, rough = false, light = false;
    for_each_described(scene, [&](const std::string& name, const Json& said) {
        const bool is_metal = number_at(said, "/pbrMetallicRoughness/metallicFactor", 1) > 0,
                   is_rough = number_at(said, "/pbrMetallicRoughness/roughnessFactor", 1) < 1,
                   is_light = emits(said);
        metal |= is_metal;
        rough |= is_rough;
        light |= is_light;
        if (is_metal || is_rough || is_light) names.push_back(name);
    });
    if (names.empty()) return;
    std::vector<std::string> lost;
    if (metal) lost.emplace_back("metalness");
    if (rough) lost.emplace_back("roughness");
    if (light) lost.emplace_back("emission");
    written.warnings.push_back({Severity::warning,
                                "W-MATERIAL",
                                fmt::format("the {} of {} {} not written to {}, which has colours only: {}",
                                            join_texts(lost), counted(names.size(), "material"),
                                            lost.size() == 1 ? "is" : "are", format, some_of(names)),
                                {},
                                "glTF and OBJ keep them"});
}

void warn_of_textures(Written& written, const Scene& scene, const char* format) {
    std::vector<std::string> textured;
    for_each_described(scene, [&](const std::string& name, const Json& said) {
        if (said.dump(-1, ' ', false, Json::error_handler_t::replace).find("Texture\":") != std::string::npos)
            textured.push_back(name);
    });
    if (!textured.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-TEXTURES",
             fmt::format("the textures of {} are not written to {}: {}", counted(textured.size(), "material"),
                         format, some_of(textured)),
             {},
             "glTF keeps them: write .glb"});
}

void warn_of_point_materials(Written& written, const Scene& scene, const char* format, bool lines) {
    std::vector<std::string> names;
    for (const auto& part : scene.parts)
        if (part.mesh.face_count() == 0 && (lines || part.mesh.lines.empty()) &&
            std::any_of(part.mesh.primitives.begin(), part.mesh.primitives.end(),
                        [&](const Primitive& p) { return p.material < scene.materials.size(); }))
            names.push_back(part.name);
    if (!names.empty())
        written.warnings.push_back({Severity::warning,
                                    "W-MATERIAL",
                                    fmt::format("points {}have no material in {}: {}",
                                                lines ? "and lines " : "", format, fmt::join(names, ", ")),
                                    {},
                                    "glTF keeps it: write .glb"});
}

void drop_materials(Written& written, const Scene& scene, const char* format, bool points) {
    warn_of_textures(written, scene, format);
    warn_of_colours(written, scene, format);
    if (points) warn_of_point_materials(written, scene, format);
    if (!scene.materials.empty())
        written.changes.push_back({"materials", Domain::face, AttributeChange::Kind::dropped,
                                   fmt::format("{} has no materials", format)});
}

void warn_of_parts(Written& written, const Scene& scene, const char* format) {
    std::vector<std::string> names, lines; // files hold lines apart from faces
    for (const auto& part : scene.parts)
        if (part.mesh.vertex_count() > 0)
            (part.mesh.line_count() > 0 ? lines : names).push_back(one_line(part.name));
    if (names.size() < 2 && lines.size() < 2) return;
    names.insert(names.end(), lines.begin(), lines.end());
    std::string named;
    if (std::any_of(names.begin(), names.end(), [](const auto& name) { return !name.empty(); }))
        named = fmt::format(", without their names: {}", some_of(names));
    written.warnings.push_back(
        {Severity::warning,
         "W-PARTS",
         fmt::format("{} become one mesh in {}{}", counted(names.size(), "part"), format, named),
         {},
         "glTF, OBJ and 3MF keep them: write .glb"});
}

namespace {
bool is_control(unsigned char c) { return c < ' '; }
} // namespace

std::string one_line(std::string name) {
    std::replace_if(name.begin(), name.end(), is_control, ' ');
    return name;
}

void warn_of_names(Written& written, const Scene& scene, const char* format, bool materials) {
    std::vector<std::string> names;
    const auto look_at = [&](const std::string& name) {
        if (std::any_of(name.begin(), name.end(), is_control)) names.push_back(one_line(name));
    };
    for (const auto& part : scene.parts) look_at(part.name);
    if (materials)
        for (const Index m : materials_in_use(scene)) look_at(scene.materials[m].name);
    if (!names.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-NAME",
             fmt::format("{} control characters, which are not written to {}: {}",
                         names.size() == 1 ? "a name has" : "names have", format, some_of(names)),
             {},
             "glTF keeps them: write .glb"});
}

bool is_missed(const Attribute& attribute) {
    return attribute.role == Role::uv || attribute.role == Role::colour ||
           attribute.role == Role::morph_vector || attribute.role == Role::generic ||
           attribute.name == stl_attribute;
}

void warn_of_attributes(Written& written, const std::vector<std::string>& names, const char* format,
                        const char* hint) {
    if (!names.empty())
        written.warnings.push_back({Severity::warning,
                                    "W-ATTRIBUTE",
                                    fmt::format("{} cannot store attributes: {}", format, some_of(names)),
                                    {},
                                    hint});
}

void warn_of_dropped(Written& written, const Scene& scene, const char* format, bool uvs) {
    OrderedSet<std::string> names;
    bool faces = false;
    for (const AttributeChange& change : written.changes) {
        if (change.kind != AttributeChange::Kind::dropped) continue;
        for (const Part& part : scene.parts) {
            const Attribute* a = part.mesh.find(change.attribute, change.domain);
            if (!a || !is_missed(*a) || (a->role == Role::uv && !uvs)) continue;
            names.add(a->domain == Domain::face ? a->name + " of faces" : a->name);
            faces |= a->domain == Domain::face;
            break;
        }
    }
    warn_of_attributes(written, names.all(), format,
                       faces || std::string_view(format) == "glTF" ? "PLY keeps them: write .ply"
                                                                   : "glTF keeps them: write .glb");
}

void dropped(Written& written, const Attribute& attribute, std::string why) {
    written.changes.push_back(
        {attribute.name, attribute.domain, AttributeChange::Kind::dropped, std::move(why)});
}

namespace {
template <class T>
void put_shortest(std::string& out, T value) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    out.append(buffer, end);
}
} // namespace

void put_number(std::string& out, double value) { put_shortest(out, value); }
void put_number(std::string& out, float value) { put_shortest(out, value); }
void put_number(std::string& out, std::int64_t value) { put_shortest(out, value); }

void append(Bytes& bytes, std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    bytes.insert(bytes.end(), first, first + text.size());
}

} // namespace facetmill::io
