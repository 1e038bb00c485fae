#include "base/point_json.hpp"
#include "report/render.hpp"

#include <map>

namespace facetmill::report {

namespace {

Json bounds_json(const Box& box) {
    if (box.empty()) return nullptr;
    return {{"min", point_json(box.min)}, {"max", point_json(box.max)}};
}

/// Each attribute once, in order of first appearance, with its domain and component type.
Json attributes_json(const Scene& scene) {
    Json all = Json::array();
    for (const auto& part : scene.parts)
        for (const auto& a : part.mesh.attributes) {
            if (a.name == primitive_attribute && a.domain == Domain::face) continue;
            Json entry = {{"name", a.name},
                          {"domain", to_string(a.domain)},
                          {"type", a.type()},
                          {"components", a.components}};
            if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(std::move(entry));
        }
    return all;
}

} // namespace

Json properties_json(const Properties& properties) {
    Json json = Json::object();
    for (const auto& p : property_table()) {
        const auto value = p.get(properties);
        if (p.kind == PropertyKind::box || p.of_scene || (p.quality && !value))
            continue; // told below, or not asked for
        Json& slot = json[std::string(p.name)];
        if (!value) continue;
        if (p.truth())
            slot = *value != 0;
        else if (p.kind == PropertyKind::count)
            slot = static_cast<std::int64_t>(*value);
        else
            slot = *value;
    }
    json["bounds"] = bounds_json(properties.bounds);
    return json;
}

Json scene_json(const Scene& scene, const Properties& properties) {
    Json json = properties_json(properties);
    json["unit"] = to_string(scene.unit);
    json["up"] = to_string(scene.up);
    json["attributes"] = attributes_json(scene);
    json["materials"] = Json::array();
    for (const auto& m : scene.materials) json["materials"].push_back(m.name);
    json["parts"] = Json::array();
    for (const auto& part : scene.parts)
        json["parts"].push_back({{"name", part.name},
                                 {"vertices", part.mesh.vertex_count()},
                                 {"wedges", part.mesh.wedge_count()},
                                 {"faces", part.mesh.face_count()}});
    return json;
}

} // namespace facetmill::report
