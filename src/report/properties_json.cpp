#include "base/point_json.hpp"
#include "report/render.hpp"

#include <algorithm>

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

Json property_json(const Property& property, const Properties& properties) {
    if (property.kind == PropertyKind::box) return bounds_json(properties.bounds);
    const auto value = property.get(properties);
    if (!value) return nullptr;
    if (property.truth()) return *value != 0;
    if (property.words) return property.words()[static_cast<std::size_t>(*value)];
    if (property.kind == PropertyKind::count) return static_cast<std::int64_t>(*value);
    return *value;
}

Json properties_json(const Properties& properties) {
    Json json = Json::object();
    for (const auto& p : property_table()) {
        if (p.kind == PropertyKind::box || p.of_scene()) continue; // told below
        if (p.on_request() && !p.get(properties)) continue;        // not asked for, or it does not apply
        json[std::string(p.name)] = property_json(p, properties);
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

Json components_json(const Scene& scene, const Properties& properties, std::size_t limit) {
    struct Component {
        const Part* part;
        Properties properties;
    };
    std::vector<Component> all;
    for (const Part& part : scene.parts) {
        if (part.mesh.face_count() == 0) continue;
        if (properties.components == 1)
            all.push_back({&part, properties});
        else
            for (Properties& p : inspect_components(part.mesh, limit)) all.push_back({&part, std::move(p)});
    }
    std::stable_sort(all.begin(), all.end(), [](const Component& a, const Component& b) {
        return a.properties.faces > b.properties.faces;
    });
    all.resize(std::min(all.size(), limit));
    Json list = Json::array();
    for (const auto& [part, p] : all)
        list.push_back({{"part", part->name},
                        {"faces", p.faces},
                        {"euler", p.euler},
                        {"boundary_loops", p.boundary_loops},
                        {"closed", p.closed},
                        {"genus", p.genus ? Json(*p.genus) : Json()}});
    return list;
}

} // namespace facetmill::report
