#include "report/contents.hpp"
#include "report/render.hpp"

namespace facetmill::report {

Found property_value(const Property& property, const Properties& properties) {
    if (property.kind == PropertyKind::box) {
        const Box& box = properties.bounds;
        return box.empty() ? Found() : Corners{box.min, box.max};
    }
    const auto value = property.get(properties);
    if (!value) return {};
    if (property.truth()) return *value != 0;
    if (property.words) return std::string(property.words()[static_cast<std::size_t>(*value)]);
    if (property.kind == PropertyKind::count) return static_cast<std::int64_t>(*value);
    return *value;
}

Json property_json(const Property& property, const Properties& properties) {
    return found_json(property_value(property, properties));
}

std::vector<const Property*> told_properties(const Properties& properties) {
    std::vector<const Property*> told;
    for (const auto& p : property_table()) {
        if (p.kind == PropertyKind::box || p.of_scene()) continue; // reported separately
        if (p.on_request() && !p.get(properties)) continue;        // not requested, or not applicable
        if (p.where_any && p.get(properties) == 0) continue;
        told.push_back(&p);
    }
    return told;
}

Json properties_json(const Properties& properties) {
    Json json = Json::object();
    for (const Property* p : told_properties(properties))
        json[std::string(p->name)] = property_json(*p, properties);
    json["bounds"] = box_json(properties.bounds);
    return json;
}

Json scene_json(const Scene& scene, const Properties& properties) {
    Json json = properties_json(properties);
    json["unit"] = to_string(scene.unit);
    json["up"] = to_string(scene.up);
    json["attributes"] = list_json(attributes_of(scene), attribute_fields());
    json["materials"] = Json::array();
    for (const auto& m : scene.materials) json["materials"].push_back(m.name);
    json["parts"] = list_json(parts_of(scene), part_fields());
    return json;
}

} // namespace facetmill::report
