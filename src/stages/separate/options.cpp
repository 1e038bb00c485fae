#include "stages/separate/options.hpp"

#include "geometry/clean/clean.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::separate_stage {

namespace {

using By = SeparateOptions::By;

template <class Key, class Name>
FaceLabels labelled(std::size_t faces, Key&& key_of, Name&& name_of) {
    FaceLabels labels;
    std::map<std::int64_t, Index> numbers;
    for (Index f = 0; f < faces; ++f) {
        const std::int64_t key = key_of(f);
        const auto [at, fresh] = numbers.try_emplace(key, static_cast<Index>(labels.names.size()));
        if (fresh) labels.names.push_back(name_of(key, labels.names.size()));
        labels.of_face.push_back(at->second);
    }
    return labels;
}

FaceLabels by_material(const Part& part, const Scene& scene) {
    const Mesh& mesh = part.mesh;
    const auto material_of = [&](Index f) {
        const Index p = mesh.primitive_of(f);
        return p < mesh.primitives.size() ? std::int64_t{mesh.primitives[p].material} : std::int64_t{none};
    };
    return labelled(mesh.face_count(), material_of, [&](std::int64_t material, std::size_t) {
        const bool named = material < static_cast<std::int64_t>(scene.materials.size()) &&
                           !scene.materials[static_cast<std::size_t>(material)].name.empty();
        return part.name + "." +
               (named                            ? scene.materials[static_cast<std::size_t>(material)].name
                : material == std::int64_t{none} ? "none"
                                                 : std::to_string(material));
    });
}

/// Groups of an OBJ file may already be parts. So a part without numbers counts as a single group if the
/// attribute is the default and the scene has other parts.
FaceLabels by_group(const Part& part, const Scene& scene, const std::string& attribute) {
    const Attribute* a = part.mesh.find(attribute, Domain::face);
    if (!a && attribute == SeparateOptions{}.attribute && scene.parts.size() > 1) return {};
    if (!a)
        throw Error(ErrorKind::stage, "E-GROUP",
                    fmt::format("separate: part '{}' has no face attribute '{}'", part.name, attribute),
                    "merge creates 'group'; facetmill info lists the attributes");
    constexpr double largest = 9007199254740992; // beyond 2^53, doubles skip integers
    for (Index f = 0; f < part.mesh.face_count(); ++f)
        if (const double x = a->value(f, 0); !(std::abs(x) <= largest) || x != std::floor(x))
            throw Error(ErrorKind::stage, "E-GROUP",
                        fmt::format("separate: '{}' of part '{}' does not number groups: it is {} at face {}",
                                    attribute, part.name, x, f),
                        "group numbers must be whole numbers");
    return labelled(
        part.mesh.face_count(), [&](Index f) { return static_cast<std::int64_t>(a->value(f, 0)); },
        [&](std::int64_t group, std::size_t) { return fmt::format("{}.{}", part.name, group); });
}

} // namespace

void declare_separate(Declare<SeparateOptions>& d) {
    d.choice<By>("by", &SeparateOptions::by,
                 {{"component", By::component,
                   "components connected through edges; each cavity stays with the solid around it"},
                  {"material", By::material, "faces with the same material"},
                  {"group", By::group, "faces with the same number in a face attribute"}},
                 "The faces that form a separate part.")
        .primary();
    d.option("attribute", &SeparateOptions::attribute,
             "The face attribute that numbers the groups (with group).")
        .also_called(attribute_synonyms);
    d.option("cavities", &SeparateOptions::cavities,
             "With component: turns cavities (closed components that face inward) into separate parts. By "
             "default, they stay with the solid around them.");
    d.option("max_parts", &SeparateOptions::max_parts,
             "The maximum number of parts. The stage fails if there are more.")
        .at_least(1);
}

void verify_separate(const SeparateOptions& o, const Value& given, Problems& problems) {
    if (given.find("attribute") && o.by != By::group)
        add_refusal(needs("attribute", "by: group"), "separate", given, problems);
    if (given.find("cavities") && o.by != By::component)
        add_refusal(needs("cavities", "by: component"), "separate", given, problems);
}

FaceLabels face_labels(const Part& part, const Scene& scene, const SeparateOptions& o) {
    const Mesh& mesh = part.mesh;
    if (o.by == By::material) return by_material(part, scene);
    if (o.by == By::group) return by_group(part, scene, o.attribute);
    const Components components = o.cavities ? face_components(mesh, false) : solid_components(mesh);
    return labelled(
        mesh.face_count(), [&](Index f) { return components.of_face[f]; },
        [&](std::int64_t, std::size_t n) { return fmt::format("{}.{}", part.name, n); });
}

} // namespace facetmill::separate_stage
