#include "geometry/surgery.hpp"
#include "mesh/topology.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill {

namespace {

enum class By { component, material, group };

struct SeparateOptions {
    By by = By::component;
    std::string attribute = "group";
    std::int64_t most = 10000;
};

void declare(Declare<SeparateOptions>& d) {
    d.choice<By>("by", &SeparateOptions::by,
                 {{"component", By::component, "pieces connected through edges"},
                  {"material", By::material, "faces of one material"},
                  {"group", By::group, "faces with the same number in a face attribute"}},
                 "What becomes a part of its own.")
        .primary();
    d.option("attribute", &SeparateOptions::attribute,
             "The face attribute that numbers the groups (with group).");
    d.option("most", &SeparateOptions::most, "Refuses to make more parts than this (a count).").at_least(1);
}

/// What a part is taken apart into: a label for each face, and a name for each label.
struct Labels {
    std::vector<Index> of_face;
    std::vector<std::string> names;
};

template <class Key, class Name>
Labels labelled(std::size_t faces, Key&& key_of, Name&& name_of) {
    Labels labels;
    std::map<std::int64_t, Index> numbers;
    for (Index f = 0; f < faces; ++f) {
        const std::int64_t key = key_of(f);
        const auto [at, fresh] = numbers.try_emplace(key, static_cast<Index>(labels.names.size()));
        if (fresh) labels.names.push_back(name_of(key, labels.names.size()));
        labels.of_face.push_back(at->second);
    }
    return labels;
}

Labels labels_of(const Part& part, const Scene& scene, const SeparateOptions& o) {
    const Mesh& mesh = part.mesh;
    const auto numbered = [&](std::int64_t, std::size_t n) { return fmt::format("{}.{}", part.name, n); };
    if (o.by == By::component) {
        const Components pieces = face_components(mesh, false);
        return labelled(
            mesh.face_count(), [&](Index f) { return pieces.of_face[f]; }, numbered);
    }
    if (o.by == By::material)
        return labelled(
            mesh.face_count(),
            [&](Index f) {
                const Index p = mesh.primitive_of(f);
                return p < mesh.primitives.size() ? std::int64_t{mesh.primitives[p].material}
                                                  : std::int64_t{none};
            },
            [&](std::int64_t material, std::size_t) {
                const bool named = material < static_cast<std::int64_t>(scene.materials.size()) &&
                                   !scene.materials[static_cast<std::size_t>(material)].name.empty();
                return part.name + "." +
                       (named ? scene.materials[static_cast<std::size_t>(material)].name
                        : material == std::int64_t{none} ? "none"
                                                         : std::to_string(material));
            });
    const Attribute* a = mesh.find(o.attribute, Domain::face);
    if (!a)
        throw Error(ErrorKind::stage, "E-GROUP",
                    fmt::format("separate: part '{}' has no face attribute '{}'", part.name, o.attribute),
                    "merge makes 'group'; info lists the attributes");
    return labelled(
        mesh.face_count(), [&](Index f) { return static_cast<std::int64_t>(a->value(f, 0)); },
        [&](std::int64_t group, std::size_t) { return fmt::format("{}.{}", part.name, group); });
}

std::string unique_name(std::string name, std::set<std::string>& taken) {
    std::string free = name;
    for (int n = 2; !taken.insert(free).second; ++n) free = fmt::format("{}_{}", name, n);
    return free;
}

Scene run(Scene scene, const SeparateOptions& o, Context& context) {
    std::vector<Part> parts;
    std::set<std::string> taken;
    Json result = Json::array();
    for (const Part& part : scene.parts)
        if (!context.selects(part, scene)) taken.insert(part.name);
    for (Part& part : scene.parts) {
        const Labels labels = context.selects(part, scene) ? labels_of(part, scene, o) : Labels{};
        if (labels.names.size() < 2) {
            if (context.selects(part, scene)) part.name = unique_name(part.name, taken);
            parts.push_back(std::move(part));
            continue;
        }
        if (parts.size() + labels.names.size() > static_cast<std::size_t>(o.most))
            throw Error(ErrorKind::stage, "E-PARTS",
                        fmt::format("separate: there would be {} parts or more, and most is {}",
                                    parts.size() + labels.names.size(), o.most),
                        "remove small pieces first (clean: {components: {faces: 10}}), or raise most");
        auto pieces = separated(part.mesh, labels.of_face, labels.names.size());
        Fates fates;
        for (const auto& a : part.mesh.attributes) fates.push_back({a.name, a.domain, Fate::Kind::kept, {}});
        context.ledger(part, fates);
        result.push_back({{"part", part.name}, {"pieces", labels.names.size()}});
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            Part piece{unique_name(labels.names[i], taken),
                       std::move(pieces[i]),
                       part.transform,
                       -1,
                       -1,
                       -1,
                       false,
                       true};
            if (i == 0) piece.skinned = part.skinned;
            if (i > 0 && part.skinned) piece.transform = {};
            if (i == 0)
                piece.document = part.document, piece.node = part.node, piece.source_mesh = part.source_mesh;
            parts.push_back(std::move(piece));
        }
    }
    scene.parts = std::move(parts);
    context.result() = {{"parts", scene.parts.size()}, {"separated", std::move(result)}};
    return scene;
}

const RegisterStage registered = make_stage<SeparateOptions>(
    {.name = "separate",
     .about = "Takes parts apart: by component, material or group.",
     .details =
         "Each piece becomes a part of its own, named after the part and its number, material or group, in "
         "the "
         "order of their first faces. Vertices and wedges that pieces share are copied, attributes kept, "
         "isolated vertices dropped. The first piece keeps the part's node, the others stand beside it. A "
         "part "
         "of one piece stays as it is.",
     .examples = {"separate", "separate: material", "separate: {by: group, attribute: cut_id}"}},
    declare, run);

} // namespace

} // namespace facetmill
