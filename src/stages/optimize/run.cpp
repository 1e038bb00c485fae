#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "geometry/edit/primitives.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "mesh/equal_meshes.hpp"
#include "mesh/transform.hpp"
#include "stage/stage.hpp"
#include "stages/optimize/attributes.hpp"
#include "stages/optimize/help.hpp"
#include "stages/optimize/join.hpp"
#include "stages/optimize/palette.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::optimize_stage {

namespace {

struct OptimizeOptions {
    bool dedup = true, join = true, join_shared = false, prune = true, keep_names = false;
    bool drop_attributes = false, drop_own = false, palette = false, flatten = false, instance = false;
    std::int64_t palette_min = 5, instance_min = 5;
    std::optional<Ratio> max_motion;
    std::optional<double> resample;
};

void declare(Declare<OptimizeOptions>& d) {
    d.option("dedup", &OptimizeOptions::dedup,
             "Merges equal images, samplers, textures, materials, meshes and accessors.");
    d.option("drop_attributes", &OptimizeOptions::drop_attributes,
             "Removes texture coordinates, tangents, normals and white colours that no material needs.");
    d.option("drop_own", &OptimizeOptions::drop_own,
             "Removes attributes that glTF does not define, such as _quality. Viewers ignore them.");
    d.option("palette", &OptimizeOptions::palette,
             "Merges plain-coloured materials into one material whose texture has a pixel for each.");
    d.option("palette_min", &OptimizeOptions::palette_min,
             "The minimum number of different materials for a palette.")
        .between(2, 512);
    d.option("flatten", &OptimizeOptions::flatten,
             "Moves the nodes of parts to the top of the scene and removes groups that become empty.");
    d.option("instance", &OptimizeOptions::instance,
             "Replaces parts that share a mesh by one node (EXT_mesh_gpu_instancing), drawn in one call. "
             "Later stages see its mesh once.");
    d.option("instance_min", &OptimizeOptions::instance_min,
             "The minimum number of parts with the same mesh that become instances.")
        .between(2, 65536);
    d.option("join", &OptimizeOptions::join, "Joins parts that share a material.");
    d.option("join_shared", &OptimizeOptions::join_shared,
             "Also joins parts that share their mesh with others: fewer draw calls, but more bytes.");
    d.option("prune", &OptimizeOptions::prune, "Removes unused items.");
    d.option(
        "max_motion", &OptimizeOptions::max_motion,
        "Drops animation keys that interpolation gives anyway: no vertex moves by more than this ratio of "
        "the diagonal.");
    d.option("resample", &OptimizeOptions::resample,
             "Replaces linear animation keys by this many keys per second.")
        .between(1, 1000);
    d.option("keep_names", &OptimizeOptions::keep_names,
             "Does not merge items with different names: materials, meshes and parts.");
}

struct OptimizeReport {
    std::size_t draw_calls_before = 0, draw_calls_after = 0, parts_before = 0, parts_after = 0;
    std::size_t equal_materials = 0, equal_meshes = 0, equal_accessors = 0, joined_parts = 0;
    std::size_t equal_vertices = 0;
    std::vector<std::string> joined;
    std::size_t palettes = 0, palette_materials = 0, flattened_parts = 0, instanced_meshes = 0, instances = 0;
    std::vector<std::string> dropped_attributes;
    io::TidyCounts erased;
    std::optional<io::KeyCounts> keys;
};

std::size_t draw_calls_of(const Scene& scene) {
    std::size_t calls = 0;
    for (const Part& part : scene.parts) calls += draw_calls(part.mesh);
    return calls;
}

/// The scene, and the requested changes of its documents.
struct Optimization {
    Scene& scene;
    const OptimizeOptions& o;
    Context& context;
    OptimizeReport& report;
    std::vector<io::DocumentOptimizer> tidies{};
    std::vector<io::TidyRequest> requests{};
    std::vector<bool> bound{}; ///< [parts] see io::bound_parts
};

std::size_t number(int i) { return static_cast<std::size_t>(i); }

std::vector<std::size_t> selected(const Optimization& w) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < w.scene.parts.size(); ++i)
        if (w.context.selects(w.scene.parts[i], w.scene)) all.push_back(i);
    return all;
}

/// Selected parts whose mesh is used by selected parts only.
std::vector<std::size_t> changeable(const Optimization& w) {
    std::set<std::pair<int, int>> fixed;
    for (const Part& part : w.scene.parts)
        if (!w.context.selects(part, w.scene) && part.source_mesh >= 0)
            fixed.emplace(part.document, part.source_mesh);
    std::vector<std::size_t> all = selected(w);
    std::erase_if(all, [&](std::size_t i) {
        return fixed.contains({w.scene.parts[i].document, w.scene.parts[i].source_mesh});
    });
    return all;
}

/// How many parts each node has.
std::map<std::pair<int, int>, std::size_t> parts_of_nodes(const Scene& scene) {
    std::map<std::pair<int, int>, std::size_t> count;
    for (const Part& part : scene.parts) ++count[{part.document, part.node}];
    return count;
}

void erase_parts(Scene& scene, const std::set<std::size_t>& gone) {
    std::size_t i = 0;
    std::erase_if(scene.parts, [&](const Part&) { return gone.contains(i++); });
}

void renumber_materials(Scene& scene, const std::vector<Index>& numbers) {
    for (Part& part : scene.parts)
        for (Primitive& p : part.mesh.primitives)
            if (p.material < numbers.size()) p.material = numbers[p.material];
}

/// The key of equal materials: document, representative material (without a document: the name), sides
/// and colour.
using MaterialKey = std::tuple<int, std::size_t, std::string, bool, std::array<std::uint64_t, 4>>;

MaterialKey key_of(const Material& m, const std::vector<std::vector<std::size_t>>& stands_for,
                   bool keep_names) {
    std::array<std::uint64_t, 4> colour;
    std::transform(std::begin(m.base_colour), std::end(m.base_colour), colour.begin(),
                   [](double c) { return std::bit_cast<std::uint64_t>(c + 0.0); }); // -0 equals 0
    if (m.document < 0) return {m.document, 0, keep_names ? m.name : "", m.double_sided, colour};
    return {m.document, stands_for[number(m.document)][number(m.index)], "", m.double_sided, colour};
}

void merge_materials(Optimization& w) {
    std::vector<std::vector<std::size_t>> stands_for;
    for (auto& tidy : w.tidies) stands_for.push_back(tidy.merge_equal(w.o.keep_names));
    std::vector<Index> instead(w.scene.materials.size());
    std::map<MaterialKey, Index> known;
    for (Index m = 0; m < instead.size(); ++m) {
        const Material& material = w.scene.materials[m];
        const bool unknown = material.document >= 0 && material.index < 0;
        instead[m] =
            unknown ? m : known.try_emplace(key_of(material, stands_for, w.o.keep_names), m).first->second;
        w.report.equal_materials += instead[m] != m;
    }
    renumber_materials(w.scene, instead);
}

/// Nodes with equal meshes reference the first of these. A mesh with a bound part stays separate.
void merge_meshes(Optimization& w) {
    const auto first = DistinctParts(w.scene).first;
    using Source = std::pair<int, int>;
    const auto source = [&](std::size_t i) {
        return Source{w.scene.parts[i].document, w.scene.parts[i].source_mesh};
    };
    std::map<Source, std::set<std::size_t>> variants; // the different meshes that a source mesh became
    std::set<Source> bound;
    for (std::size_t i = 0; i < first.size(); ++i) {
        variants[source(i)].insert(first[i]);
        if (w.bound[i]) bound.insert(source(i));
    }
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Source own = source(i), other = source(first[i]);
        const Part &part = w.scene.parts[i], &example = w.scene.parts[first[i]];
        const bool fits = own != other && own.first >= 0 && own.first == other.first && own.second >= 0 &&
                          other.second >= 0 && variants[own].size() == 1 && variants[other].size() == 1 &&
                          !bound.contains(own) && !bound.contains(other) && part.changed == example.changed &&
                          part.node >= 0 && example.node >= 0;
        if (!fits || (w.o.keep_names && part.name != example.name)) continue;
        w.report.equal_meshes +=
            w.requests[number(own.first)].equal_meshes.emplace(own.second, other.second).second;
    }
    for (Part& part : w.scene.parts) {
        if (part.document < 0 || part.source_mesh < 0) continue;
        const auto& equal = w.requests[number(part.document)].equal_meshes;
        const auto found = equal.find(number(part.source_mesh));
        if (found != equal.end()) part.source_mesh = static_cast<int>(found->second);
    }
}

/// Merges vertices of meshes that may change: all parts with the mesh are selected, and no data refers
/// to vertex numbers.
void merge_vertices(Optimization& w) {
    for (const std::size_t i : changeable(w)) {
        Part& part = w.scene.parts[i];
        const auto numbers = [](const Primitive& p) { return !p.json.empty(); };
        if (std::any_of(part.mesh.primitives.begin(), part.mesh.primitives.end(), numbers)) continue;
        const std::size_t before = part.mesh.wedge_count();
        merge_and_drop_wedges(part.mesh);
        const std::size_t merged = before - part.mesh.wedge_count();
        part.changed |= merged > 0;
        w.report.equal_vertices += merged;
    }
}

void drop_attributes(Optimization& w) {
    const auto needs = [&](Index m) -> std::optional<io::MaterialNeeds> {
        if (m >= w.scene.materials.size()) return io::MaterialNeeds{};
        const Material& material = w.scene.materials[m];
        if (material.document < 0 || material.index < 0) return io::MaterialNeeds{};
        const auto& tidy = w.tidies[number(material.document)];
        if (!tidy.numbers_are_known()) return {};
        return tidy.needs_of(number(material.index));
    };
    std::set<std::string> names;
    for (Part& part : w.scene.parts) {
        if (!w.context.selects(part, w.scene)) continue;
        const auto dropped =
            drop_unused_attributes(part.mesh, needs, {.standard = w.o.drop_attributes, .own = w.o.drop_own});
        for (const std::string& name : dropped) {
            names.insert(name);
            w.context.attribute_changes(
                part, {{name, Domain::wedge, AttributeChange::Kind::dropped, "no drawn material needs it"}});
        }
        part.changed |= !dropped.empty();
    }
    w.report.dropped_attributes.assign(names.begin(), names.end());
}

void paint(Optimization& w) {
    const PaletteCounts made =
        make_palettes(w.scene, w.tidies, selected(w), static_cast<std::size_t>(w.o.palette_min));
    w.report.palettes = made.palettes;
    w.report.palette_materials = made.materials;
    if (made.too_many_looks > 0)
        w.context.warn("W-PALETTE",
                       fmt::format("optimize: no palette was made of {} materials: it has at most {}",
                                   made.too_many_looks, most_looks),
                       "use only: [...] to optimize fewer parts at a time");
}

void flatten(Optimization& w) {
    std::vector<std::set<std::size_t>> nodes(w.tidies.size());
    for (const std::size_t i : selected(w)) {
        const Part& part = w.scene.parts[i];
        if (w.bound[i] || part.document < 0 || part.node < 0 ||
            !w.tidies[number(part.document)].numbers_are_known())
            continue;
        nodes[number(part.document)].insert(number(part.node));
    }
    for (std::size_t d = 0; d < nodes.size(); ++d)
        w.report.flattened_parts += w.tidies[d].flatten(nodes[d], w.requests[d].emptied);
}

/// Parts by mesh, each alone at its node and not mirrored.
std::map<std::pair<int, int>, std::vector<std::size_t>> parts_by_mesh(const Optimization& w) {
    auto of_node = parts_of_nodes(w.scene);
    const auto first = DistinctParts(w.scene).first;
    std::map<std::pair<int, int>, std::vector<std::size_t>> all;
    for (const std::size_t i : selected(w)) {
        const Part& part = w.scene.parts[i];
        if (w.bound[i] || part.document < 0 || part.node < 0 || part.source_mesh < 0 ||
            part.mesh.face_count() == 0 || !(part.transform.determinant() > 0) ||
            of_node[{part.document, part.node}] > 1 || !w.tidies[number(part.document)].numbers_are_known())
            continue;
        auto& group = all[{part.document, part.source_mesh}];
        const Part* example = group.empty() ? nullptr : &w.scene.parts[group.front()];
        if (!example || (first[i] == first[group.front()] && part.changed == example->changed))
            group.push_back(i);
    }
    return all;
}

void instance(Optimization& w) {
    std::set<std::size_t> gone;
    for (const auto& [mesh, group] : parts_by_mesh(w)) {
        if (group.size() < static_cast<std::size_t>(w.o.instance_min)) continue;
        std::vector<std::pair<std::size_t, Transform>> places;
        for (const std::size_t i : group)
            places.emplace_back(number(w.scene.parts[i].node), w.scene.parts[i].transform);
        const auto made = w.tidies[number(mesh.first)].instance(places);
        if (!made) continue;
        for (const std::size_t i : group) {
            w.requests[number(mesh.first)].emptied.insert(number(w.scene.parts[i].node));
            if (i != group.front()) gone.insert(i);
        }
        Part& one = w.scene.parts[group.front()];
        one.node = static_cast<int>(made->first);
        one.transform = made->second;
        ++w.report.instanced_meshes;
        w.report.instances += group.size();
    }
    erase_parts(w.scene, gone);
    w.bound = io::bound_parts(w.scene, w.tidies);
}

/// Parts that could be merged because nothing else requires them to be separate.
std::vector<std::size_t> candidates(const Optimization& w) {
    auto of_node = parts_of_nodes(w.scene);
    std::map<std::pair<int, int>, std::size_t> of_mesh;
    for (const Part& part : w.scene.parts) ++of_mesh[{part.document, part.source_mesh}];
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < w.scene.parts.size(); ++i) {
        const Part& part = w.scene.parts[i];
        const bool shared =
            (part.source_mesh >= 0 && of_mesh[{part.document, part.source_mesh}] > 1 && !w.o.join_shared) ||
            (part.node >= 0 && of_node[{part.document, part.node}] > 1);
        if (!w.bound[i] && !shared && part.mesh.face_count() > 0 && inverse(part.transform) &&
            w.context.selects(part, w.scene))
            all.push_back(i);
    }
    return all;
}

/// For each shared mesh, its parts, if all of them may be joined and each has its own node.
std::vector<std::vector<std::size_t>> shared_candidates(const Optimization& w) {
    auto of_node = parts_of_nodes(w.scene);
    std::map<std::pair<int, int>, std::vector<std::size_t>> of_mesh;
    for (std::size_t i = 0; i < w.scene.parts.size(); ++i)
        of_mesh[{w.scene.parts[i].document, w.scene.parts[i].source_mesh}].push_back(i);
    const auto first = DistinctParts(w.scene).first;
    std::vector<std::vector<std::size_t>> all;
    for (const auto& [mesh, parts] : of_mesh) {
        const std::size_t one = parts.front();
        const Part& example = w.scene.parts[one];
        const auto fits = [&](std::size_t i) {
            const Part& part = w.scene.parts[i];
            return !w.bound[i] && part.mesh.face_count() > 0 && inverse(part.transform) &&
                   w.context.selects(part, w.scene) && part.node >= 0 &&
                   of_node.at({part.document, part.node}) == 1 && first[i] == first[one] &&
                   part.changed == example.changed;
        };
        if (mesh.second >= 0 && parts.size() > 1 && std::all_of(parts.begin(), parts.end(), fits))
            all.push_back(parts);
    }
    return all;
}

void join_parts(Optimization& w) {
    const auto able = candidates(w);
    for (const std::size_t i : changeable(w))
        if (join_primitives(w.scene.parts[i].mesh)) w.scene.parts[i].changed = true;
    if (w.o.keep_names) return;
    std::set<std::size_t> gone;
    auto groups = groups_to_join(w.scene, able);
    if (!w.o.join_shared) {
        const auto together = groups_standing_together(w.scene, shared_candidates(w));
        groups.insert(groups.end(), together.begin(), together.end());
    }
    for (const JoinedParts& group : groups) {
        w.report.joined.push_back(w.scene.parts[group.first].name);
        w.report.joined_parts += group.others.size();
        join(w.scene, group);
        for (const std::size_t i : group.others) {
            const Part& other = w.scene.parts[i];
            if (other.document >= 0 && other.node >= 0)
                w.requests[number(other.document)].emptied.insert(number(other.node));
            gone.insert(i);
        }
    }
    erase_parts(w.scene, gone);
}

void drop_keys(Optimization& w) {
    if (!w.o.max_motion && !w.o.resample) return;
    const double ratio = w.o.max_motion ? w.o.max_motion->value : 0;
    io::KeyCounts all;
    for (auto& tidy : w.tidies) {
        const io::KeyCounts keys = tidy.drop_keys(ratio, w.o.resample);
        all.before += keys.before;
        all.after += keys.after;
    }
    if (all.before > 0) w.report.keys = all;
}

void drop_tracks(Optimization& w) {
    const Box box = io::drawn_bounds(w.scene);
    constexpr double ratio = 1e-6; // of the diagonal
    const double within = box.empty() ? 0 : ratio * length(box.extent());
    for (auto& tidy : w.tidies) tidy.drop_resting_tracks(within);
}

/// Removes unused materials of the scene, including merged duplicates.
void drop_materials(Optimization& w) {
    std::vector<Index> number_of(w.scene.materials.size(), none);
    for (const Part& part : w.scene.parts)
        for (const Primitive& p : part.mesh.primitives)
            if (p.material < number_of.size()) number_of[p.material] = 0;
    std::vector<Material> kept;
    for (std::size_t m = 0; m < number_of.size(); ++m) {
        const Material& material = w.scene.materials[m];
        const bool unknown =
            material.document >= 0 && !w.tidies[number(material.document)].numbers_are_known();
        if (number_of[m] == none && !unknown) continue;
        number_of[m] = static_cast<Index>(kept.size());
        kept.push_back(material);
    }
    w.scene.materials = std::move(kept);
    renumber_materials(w.scene, number_of);
}

void add(io::TidyCounts& all, const io::TidyCounts& c) {
    for (const auto member : {&io::TidyCounts::nodes, &io::TidyCounts::meshes, &io::TidyCounts::materials,
                              &io::TidyCounts::textures, &io::TidyCounts::samplers, &io::TidyCounts::images,
                              &io::TidyCounts::accessors, &io::TidyCounts::tracks})
        all.*member += c.*member;
}

void erase(Optimization& w) {
    for (const Part& part : w.scene.parts)
        if (part.document >= 0 && part.source_mesh >= 0)
            w.requests[number(part.document)].meshes.insert(number(part.source_mesh));
    if (w.o.prune && !w.scene.parts.empty()) drop_materials(w); // a library of materials keeps them
    for (const Material& m : w.scene.materials)
        if (m.document >= 0 && m.index >= 0) w.requests[number(m.document)].materials.insert(number(m.index));
    for (std::size_t d = 0; d < w.tidies.size(); ++d) {
        w.requests[d].all = w.o.prune;
        io::renumber(w.scene, static_cast<int>(d), w.tidies[d].erase_unused(w.requests[d]));
        add(w.report.erased, w.tidies[d].erased());
        if (!w.tidies[d].numbers_are_known())
            w.context.warn("W-OPTIMIZE",
                           fmt::format("optimize: nothing was removed or joined in '{}' because it has an "
                                       "extension that may refer to items by their numbers",
                                       w.scene.documents[d]->name));
        w.scene.documents[d] = w.tidies[d].finish(w.scene.documents[d]);
    }
}

void optimize(Optimization w) {
    for (const auto& document : w.scene.documents) w.tidies.emplace_back(*document);
    w.requests.resize(w.tidies.size());
    w.bound = io::bound_parts(w.scene, w.tidies);
    w.report.draw_calls_before = draw_calls_of(w.scene);
    w.report.parts_before = w.scene.parts.size();
    if (w.o.dedup) merge_materials(w);
    if (w.o.dedup) merge_meshes(w);
    if (w.o.drop_attributes || w.o.drop_own) drop_attributes(w);
    if (w.o.dedup) merge_vertices(w);
    if (w.o.palette) paint(w);
    if (w.o.flatten) flatten(w);
    if (w.o.instance) instance(w);
    if (w.o.join) join_parts(w);
    if (w.o.prune) drop_tracks(w);
    drop_keys(w);
    if (w.o.dedup)
        for (auto& tidy : w.tidies) w.report.equal_accessors += tidy.merge_equal_accessors(w.o.keep_names);
    erase(w);
    w.report.draw_calls_after = draw_calls_of(w.scene);
    w.report.parts_after = w.scene.parts.size();
}

/// The nonzero counts of erased items as text: "2 nodes".
std::vector<std::string> told(const io::TidyCounts& erased) {
    std::vector<std::string> words;
    const auto add = [&](std::size_t count, const char* noun, const char* plural = "") {
        if (count > 0) words.push_back(counted(count, noun, plural));
    };
    add(erased.nodes, "node");
    add(erased.meshes, "mesh", "meshes");
    add(erased.materials, "material");
    add(erased.textures, "texture");
    add(erased.samplers, "sampler");
    add(erased.images, "image");
    add(erased.accessors, "accessor");
    add(erased.tracks, "track of animations", "tracks of animations");
    return words;
}

void declare_erased(DeclareFields<io::TidyCounts>& d) {
    d.field("nodes", &io::TidyCounts::nodes, "Nodes that join emptied, and groups that became empty.");
    d.field("meshes", &io::TidyCounts::meshes, "Joined, duplicate or unused meshes.");
    d.field("materials", &io::TidyCounts::materials, "Duplicate or unused items.");
    d.field("textures", &io::TidyCounts::textures, "Duplicate or unused items.");
    d.field("samplers", &io::TidyCounts::samplers, "Duplicate or unused items.");
    d.field("images", &io::TidyCounts::images, "Duplicate or unused items.");
    d.field("accessors", &io::TidyCounts::accessors, "Accessors of removed items, and unused accessors.");
    d.field("tracks", &io::TidyCounts::tracks, "Animation tracks that do not move a node.");
}

void declare_report(DeclareFields<OptimizeReport>& d) {
    d.field("draw_calls_before", &OptimizeReport::draw_calls_before,
            "Primitives of all parts in the input. Each primitive needs a draw call.");
    d.field("draw_calls_after", &OptimizeReport::draw_calls_after, "Primitives of all parts in the result.");
    d.field("parts_before", &OptimizeReport::parts_before, "Parts in the input.");
    d.field("parts_after", &OptimizeReport::parts_after, "Parts in the result.");
    d.field("equal_materials", &OptimizeReport::equal_materials, "Duplicate materials that were merged.");
    d.field("equal_meshes", &OptimizeReport::equal_meshes, "Duplicate meshes that were merged.");
    d.field("equal_accessors", &OptimizeReport::equal_accessors,
            "Duplicate accessors of the documents that were merged.");
    d.field("equal_vertices", &OptimizeReport::equal_vertices,
            "Vertices with equal positions and attributes that were merged.");
    d.field("dropped_attributes", &OptimizeReport::dropped_attributes,
            "Names of the removed attributes, which nothing drawn needs.");
    d.field("palettes", &OptimizeReport::palettes, "Palette materials that were made.");
    d.field("palette_materials", &OptimizeReport::palette_materials, "Materials that palettes replaced.");
    d.field("flattened_parts", &OptimizeReport::flattened_parts,
            "Parts that were moved to the top of the scene.");
    d.field("instanced_meshes", &OptimizeReport::instanced_meshes,
            "Meshes with one node for many positions.");
    d.field("instances", &OptimizeReport::instances,
            "The positions of these meshes, which were parts before.");
    d.field("joined_parts", &OptimizeReport::joined_parts, "Parts that were joined into another part.");
    d.field("joined", &OptimizeReport::joined, "Names of the parts that others were joined into.");
    d.object("keys", &OptimizeReport::keys, "Keys of animations.", [](DeclareFields<io::KeyCounts>& k) {
         k.field("before", &io::KeyCounts::before, "Keys in the input.");
         k.field("after", &io::KeyCounts::after, "Keys in the result.");
     }).only_when("keys were dropped or resampled");
    d.object("erased", &OptimizeReport::erased, "Items that were removed from the documents.",
             declare_erased);
    d.tell([](const OptimizeReport& r) {
        std::vector<std::string> lines{fmt::format("{} -> {} draw calls, {} -> {} parts",
                                                   grouped(r.draw_calls_before), grouped(r.draw_calls_after),
                                                   grouped(r.parts_before), grouped(r.parts_after))};
        if (r.keys)
            lines.push_back(
                fmt::format("{} -> {} keys of animations", grouped(r.keys->before), grouped(r.keys->after)));
        if (const auto erased = told(r.erased); !erased.empty())
            lines.push_back(fmt::format("erased: {}", fmt::join(erased, ", ")));
        return lines;
    });
}

Scene run(Scene scene, const OptimizeOptions& o, Context& context, OptimizeReport& report) {
    try {
        optimize({scene, o, context, report});
    } catch (const Json::exception&) {
        throw Error(ErrorKind::malformed, "E-GLTF",
                    "a member of the document does not have the type that glTF requires", {},
                    context.where());
    }
    return scene;
}

const RegisterStage registered = make_stage<StageOf<run>>(
    {.name = "optimize",
     .also_called = "dedup prune instance palette reorder",
     .about = help::optimize::about,
     .details = help::optimize::details,
     .examples = {"optimize", "optimize: {join: false}", "optimize: {keep_names: true}",
                  "optimize: {palette: true, drop_attributes: true}", "optimize: {instance: true}"},
     .changes_images = true,
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::optimize_stage
