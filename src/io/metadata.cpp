#include "io/metadata.hpp"

#include "base/text/words.hpp"
#include "io/flatten.hpp"
#include "io/stated.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

const Json& member(const Json& json, const char* name) {
    static const Json nothing;
    if (!json.is_object()) return nothing;
    const auto at = json.find(name);
    return at != json.end() ? *at : nothing;
}

bool is_text(const Json& value) { return value.is_string() && !value.get_ref<const std::string&>().empty(); }

std::string text_of(const Json& value) {
    return one_line(is_text(value) ? value.get<std::string>()
                                   : value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Extras that neither `kept` names nor readers of morph targets use.
bool has_extras(const Json& owner, const std::set<std::string>& kept) {
    const Json& extras = member(owner, "extras");
    if (!extras.is_object()) return !extras.is_null() && !extras.empty();
    const auto items = extras.items();
    return std::any_of(items.begin(), items.end(), [&](const auto& item) {
        return item.key() != "targetNames" && !kept.contains(item.key());
    });
}

std::size_t count_extras(const Json& owners, const std::set<std::string>& kept) {
    if (!owners.is_array()) return 0;
    return static_cast<std::size_t>(std::count_if(
        owners.begin(), owners.end(), [&](const Json& owner) { return has_extras(owner, kept); }));
}

/// The parts whose primitives have extras, such as the part number of an object in 3MF.
std::size_t count_parts_with_extras(const Scene& scene, const std::set<std::string>& kept) {
    const auto has = [&](const Primitive& p) {
        return p.json.find("\"extras\"") != p.json.npos &&
               has_extras(parse_json(p.json, Broken::discarded), kept);
    };
    return static_cast<std::size_t>(
        std::count_if(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
            return std::any_of(part.mesh.primitives.begin(), part.mesh.primitives.end(), has);
        }));
}

/// "2 cameras", "the lights", "the contents of KHR_xmp", "the extras of 3 nodes".
void add_contents(std::vector<std::string>& lost, const Json& json, const std::set<std::string>& kept) {
    if (const Json& cameras = member(json, "cameras"); cameras.is_array() && !cameras.empty())
        lost.push_back(counted(cameras.size(), "camera"));
    if (const Json& extensions = member(json, "extensions"); extensions.is_object())
        for (const auto& [name, content] : extensions.items())
            if (!content.empty())
                lost.push_back(name == "KHR_lights_punctual" ? "the lights" : "the contents of " + name);
    for (const auto& [list, one] :
         {std::pair{"scenes", "scene"}, {"nodes", "node"}, {"meshes", "mesh"}, {"materials", "material"}})
        if (const std::size_t count = count_extras(member(json, list), kept); count > 0)
            lost.push_back(fmt::format("the extras of {} {}", count, count == 1 ? one : list));
}

} // namespace

std::vector<Metadata> metadata_of(const Scene& scene) {
    std::vector<Metadata> all;
    const auto add = [&](std::string name, const Json& value) {
        const auto known = [&](const Metadata& m) { return m.name == name && m.value == value; };
        const bool is_known = std::any_of(all.begin(), all.end(), known);
        if (!is_known && !value.is_null()) all.push_back({std::move(name), value});
    };
    for (const auto& document : scene.documents) {
        const Json json = parse_json(document->json, Broken::discarded);
        const Json& asset = member(json, "asset");
        add("copyright", member(asset, "copyright"));
        const Json& extras = member(asset, "extras");
        if (extras.is_object())
            for (const auto& [name, value] : extras.items()) add(name, value);
        else
            add("extras", extras);
    }
    return all;
}

std::string metadata_comments(const Scene& scene, std::string_view before) {
    std::string text;
    const auto add = [&](const std::string& line) {
        // Readers must not take it for a unit, an axis or a texture.
        const bool is_statement = states(line) || line.starts_with("TextureFile");
        text += fmt::format("{}{}{}\n", before, is_statement ? "metadata " : "", line);
    };
    for (const auto& [name, value] : metadata_of(scene)) {
        if (name != comments_key || !value.is_array())
            add(fmt::format("{}: {}", one_line(name), text_of(value)));
        else
            for (const Json& comment : value) add(text_of(comment));
    }
    return text;
}

void warn_of_lost(Written& written, const Scene& scene, const char* format,
                  const std::set<std::string>& kept) {
    std::vector<std::string> lost, names;
    std::set<std::string> seen;
    for (const auto& [name, value] : metadata_of(scene)) {
        const bool is_first = seen.insert(name).second, has_place = kept.contains(name);
        // Comments name programs and dates more often than anything else.
        if (kept.contains("metadata") || (has_place && is_first) || name == comments_key) continue;
        names.push_back(one_line(name) + (has_place ? " of a further file" : ""));
    }
    if (!names.empty()) lost.push_back("the metadata " + some_of(names));
    for (const auto& document : scene.documents)
        add_contents(lost, parse_json(document->json, Broken::discarded), kept);
    if (const std::size_t parts = count_parts_with_extras(scene, kept); parts > 0)
        lost.push_back("the extras of the primitives of " + counted(parts, "part"));
    if (lost.empty()) return;
    written.warnings.push_back(
        {Severity::warning,
         "W-LOST",
         fmt::format("not written, because {} cannot hold it: {}", format, join_texts(lost)),
         {},
         "glTF keeps it: write .glb"});
}

} // namespace facetmill::io
