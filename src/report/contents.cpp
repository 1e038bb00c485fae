#include "report/contents.hpp"

#include <algorithm>
#include <limits>

namespace facetmill::report {

namespace {

/// The point as [x, y, z].
Json point_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

void declare_box_corners(DeclareFields<Box>& d) {
    d.field("min", &Box::min, "The corner with the smallest coordinates.");
    d.field("max", &Box::max, "The corner with the largest coordinates.");
}

std::optional<Box> bounds_of(const Brief& brief) {
    return brief.bounds.empty() ? std::nullopt : std::optional<Box>(brief.bounds);
}

const Fields& box_fields() {
    static const Fields fields = fields_of<Box>(declare_box_corners);
    return fields;
}

struct FoundJson {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const Corners& box) const {
        return {{"min", FieldType<Vec3>::json(box.min)}, {"max", FieldType<Vec3>::json(box.max)}};
    }
    template <class T>
    Json operator()(const T& value) const {
        return value;
    }
};

/// Infinite numbers and NaN are null in JSON.
std::optional<Vec3> corner_of(const Json& json) {
    if (!json.is_array() || json.size() != 3) return {};
    double numbers[3];
    for (std::size_t i = 0; i < 3; ++i) {
        if (!json[i].is_number() && !json[i].is_null()) return {};
        numbers[i] = json[i].is_null() ? std::numeric_limits<double>::quiet_NaN() : json[i].get<double>();
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
}

/// Null for a location, which has no owner.
const char* key_of(EvidenceEntry::Of of) {
    switch (of) {
    case EvidenceEntry::Of::place:
        return nullptr;
    case EvidenceEntry::Of::part:
        return "part";
    case EvidenceEntry::Of::material:
        return "material";
    case EvidenceEntry::Of::image:
        return "image";
    case EvidenceEntry::Of::extension:
        return "extension";
    case EvidenceEntry::Of::bytes:
        return "bytes_of";
    }
    return nullptr;
}

} // namespace

Brief brief_of(const Scene& scene) {
    Brief brief{.parts = scene.parts.size(), .faces = scene.face_count(), .bounds = scene.bounds()};
    for (const auto& part : scene.parts) brief.vertices += part.mesh.vertex_count();
    return brief;
}

const Fields& brief_fields() {
    static const Fields fields = fields_of<Brief>([](DeclareFields<Brief>& d) {
        d.field("parts", &Brief::parts, "");
        d.field("vertices", &Brief::vertices, "");
        d.field("faces", &Brief::faces, "");
        d.object("bounds", bounds_of, "The axis-aligned box in world space.", declare_box_corners)
            .null_when("the scene is empty");
    });
    return fields;
}

Json found_json(const Found& found) { return std::visit(FoundJson(), found); }

std::optional<Found> found_of(const Json& json) {
    if (json.is_null()) return Found();
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_object()) {
        const auto min = corner_of(json.value("min", Json())), max = corner_of(json.value("max", Json()));
        return min && max ? std::optional<Found>(Corners{*min, *max}) : std::nullopt;
    }
    std::vector<std::string> names;
    for (const Json& name : json) {
        if (!name.is_string()) return {};
        names.push_back(name.get<std::string>());
    }
    return names;
}

Json resolved_json(const std::vector<ResolvedLength>& lengths) {
    Json all = Json::object();
    for (const ResolvedLength& l : lengths) all[l.option] = {{"given", l.given}, {"is", l.is}};
    return all;
}

Json box_json(const Box& box) { return box.empty() ? Json() : box_fields().json(&box); }

Json box_schema() { return brief_fields().schema()["properties"]["bounds"]; }

std::vector<AttributeEntry> attributes_of(const Scene& scene) {
    std::vector<AttributeEntry> all;
    for (const auto& part : scene.parts)
        for (const auto& a : part.mesh.attributes) {
            if (a.name == primitive_attribute && a.domain == Domain::face) continue;
            AttributeEntry entry{a.name, a.domain, a.type(), static_cast<std::size_t>(a.components)};
            if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(std::move(entry));
        }
    return all;
}

std::vector<NamedChoice<Domain>> domain_choices() {
    std::vector<NamedChoice<Domain>> all;
    for (const Domain domain : {Domain::vertex, Domain::wedge, Domain::face})
        all.push_back({to_string(domain), domain, ""});
    return all;
}

const Fields& attribute_fields() {
    static const Fields fields = fields_of<AttributeEntry>([](DeclareFields<AttributeEntry>& d) {
        d.field("name", &AttributeEntry::name, "");
        d.choice("domain", &AttributeEntry::domain, domain_choices(), "");
        d.field("type", &AttributeEntry::type, "");
        d.field("components", &AttributeEntry::components, "");
    });
    return fields;
}

std::vector<PartEntry> parts_of(const Scene& scene) {
    std::vector<PartEntry> all;
    for (const auto& part : scene.parts)
        all.push_back({part.name, part.mesh.vertex_count(), part.mesh.wedge_count(), part.mesh.face_count()});
    return all;
}

const Fields& part_fields() {
    static const Fields fields = fields_of<PartEntry>([](DeclareFields<PartEntry>& d) {
        d.field("name", &PartEntry::name, "");
        d.field("vertices", &PartEntry::vertices, "");
        d.field("wedges", &PartEntry::wedges, "");
        d.field("faces", &PartEntry::faces, "");
    });
    return fields;
}

std::vector<Component> largest_components(const Scene& scene, const Properties& properties,
                                          std::size_t limit) {
    std::vector<Component> all;
    for (const Part& part : scene.parts) {
        if (part.mesh.face_count() == 0) continue;
        if (properties.components == 1)
            all.push_back({part.name, properties});
        else
            for (Properties& p : inspect_components(part.mesh, limit))
                all.push_back({part.name, std::move(p)});
    }
    std::stable_sort(all.begin(), all.end(), [](const Component& a, const Component& b) {
        return a.properties.faces > b.properties.faces;
    });
    if (all.size() > limit) all.erase(all.begin() + static_cast<std::ptrdiff_t>(limit), all.end());
    return all;
}

Json evidence_json(const EvidenceEntry& e) {
    Json json = Json::object();
    if (const char* key = key_of(e.of)) json[key] = e.name;
    if (e.at) json["at"] = point_json(*e.at);
    if (e.nearest) json["nearest"] = point_json(*e.nearest);
    if (!e.side.empty()) json["of"] = e.side;
    if (e.face) json["face"] = *e.face;
    if (e.with) json["with"] = *e.with;
    if (!e.attribute.empty()) json["attribute"] = e.attribute;
    if (e.loop) json.update({{"loop", *e.loop}, {"edges", e.edges}, {"length", e.length}});
    if (e.of == EvidenceEntry::Of::extension) json["document"] = e.document;
    if (e.of == EvidenceEntry::Of::image) json.update({{"width", e.width}, {"height", e.height}});
    if (e.amount) json["amount"] = e.is_count ? Json(static_cast<std::int64_t>(*e.amount)) : Json(*e.amount);
    return json;
}

Json evidence_json(const std::optional<CheckEvidence>& evidence) {
    if (!evidence) return nullptr;
    Json list = Json::array();
    for (const EvidenceEntry& entry : *evidence) list.push_back(evidence_json(entry));
    return list;
}

const Fields& component_fields() {
    static const Fields fields = fields_of<Component>([](DeclareFields<Component>& d) {
        d.field("part", &Component::part, "The part that contains the component.");
        d.embed(&Component::properties, [](DeclareFields<Properties>& p) {
            p.field("faces", &Properties::faces, "");
            p.field("euler", &Properties::euler, "");
            p.field("boundary_loops", &Properties::boundary_loops, "");
            p.field("closed", &Properties::closed, "");
            p.field("genus", &Properties::genus, "The genus.").null_when("the component is not closed");
        });
    });
    return fields;
}

} // namespace facetmill::report
