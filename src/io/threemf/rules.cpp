#include "io/threemf/rules.hpp"

#include "base/text/words.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

[[noreturn]] void breaks_rule(const std::string& name, std::size_t line, std::string message) {
    malformed(name, static_cast<std::int64_t>(line), "E-3MF", std::move(message), hint_for_rules);
}

ResourceKind kind_of(const Resources& resources, std::uint32_t id) {
    const auto found = resources.find(id);
    return found == resources.end() ? ResourceKind::other : found->second.kind;
}

/// A relationship of a part of the archive to another.
struct Relation {
    std::string type; ///< the last word of its type: "3dmodel"
    std::string target;
    std::size_t line = 0;
};

/// The relationships in a file. Throws malformed if one leaves the archive.
std::vector<Relation> relations_in(Span xml, const std::string& name) {
    std::vector<Relation> relations;
    const auto start = [&](const Element& e) {
        const auto type = e.find("Type"), target = e.find("Target");
        if (!type || !target) return;
        const auto slash = type->rfind('/');
        relations.push_back({std::string(slash == std::string_view::npos ? *type : type->substr(slash + 1)),
                             std::string(*target), e.line});
        const auto colon = target->find(':'), first = target->find('/');
        if (e.find("TargetMode") == "External" || (colon != std::string_view::npos && colon < first))
            breaks_rule(name, e.line,
                        fmt::format("a relation names {}, which is outside the archive", in_quotes(*target)));
    };
    read_xml(xml, name, {start, [] {}, {}});
    return relations;
}

std::vector<Relation> of_type(const std::vector<Relation>& relations, std::string_view type) {
    std::vector<Relation> some;
    std::copy_if(relations.begin(), relations.end(), std::back_inserter(some),
                 [&](const Relation& r) { return r.type == type; });
    return some;
}

} // namespace

void check_composites(const Resources& resources, const std::string& name) {
    for (const auto& [id, resource] : resources)
        if (resource.kind == ResourceKind::composites &&
            kind_of(resources, resource.materials) != ResourceKind::materials)
            breaks_rule(name, resource.line,
                        fmt::format("compositematerials {} mix the resource {}, which is no <basematerials>",
                                    id, resource.materials));
}

void check_layers(const Layers& layers, const Resources& resources, const std::string& name) {
    std::size_t materials = 0, colours = 0;
    for (std::size_t l = 0; l < layers.groups.size(); ++l) {
        const ResourceKind kind = kind_of(resources, layers.groups[l]);
        if (kind == ResourceKind::layers)
            breaks_rule(name, layers.line,
                        fmt::format("multiproperties refer to the multiproperties {}", layers.groups[l]));
        if (kind == ResourceKind::materials || kind == ResourceKind::composites) {
            if (l > 0 && materials == 0)
                breaks_rule(name, layers.line, "the material of multiproperties must be their first layer");
            ++materials;
        }
        colours += kind == ResourceKind::colours;
    }
    if (materials > 1)
        breaks_rule(name, layers.line, "multiproperties refer to more than one group of materials");
    if (colours > 1)
        breaks_rule(name, layers.line, "multiproperties refer to more than one group of colours");
}

std::string main_model(Archive& archive, const std::string& name) {
    const auto xml = archive.file("/_rels/.rels");
    if (!xml) return "/3D/3dmodel.model";
    const std::string file = name + "/_rels/.rels";
    const std::vector<Relation> relations = relations_in(*xml, file), models = of_type(relations, "3dmodel");
    if (models.empty()) breaks_rule(file, 0, "no relation names the 3D model");
    if (models.size() > 1)
        breaks_rule(file, models[1].line,
                    fmt::format("the relations name {} models, but must name one", models.size()));
    for (const Relation& thumbnail : of_type(relations, "thumbnail")) {
        const std::string path = (thumbnail.target.starts_with('/') ? "" : "/") + thumbnail.target;
        if (!archive.has(path) && path.find('%') == std::string::npos)
            breaks_rule(file, thumbnail.line,
                        fmt::format("the thumbnail {} is not in the archive", in_quotes(thumbnail.target)));
    }
    const std::string& path = models[0].target;
    return path.starts_with('/') ? path : "/" + path;
}

void check_relations_of(Archive& archive, const std::string& name, const std::string& model) {
    const auto slash = model.rfind('/') + 1;
    const std::string path = model.substr(0, slash) + "_rels/" + model.substr(slash) + ".rels";
    const auto xml = archive.file(path);
    if (!xml) return;
    const auto tickets = of_type(relations_in(*xml, name + path), "printticket");
    if (tickets.size() > 1)
        breaks_rule(name + path, tickets[1].line, "the relations name more than one print ticket");
}

} // namespace facetmill::io::threemf
