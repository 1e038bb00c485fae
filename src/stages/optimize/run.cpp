#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/edit/equal_wedges.hpp"
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
    d.option("join", &OptimizeOptions::join, "Joins parts that have the same materials.");
    d.option("join_shared", &OptimizeOptions::join_shared,
             "Also joins parts that share their mesh with others: fewer draw calls, but more bytes.");
    d.option("prune", &OptimizeOptions::prune, "Removes unused items.");
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
};

std::size_t draw_calls_of(const Scene& scene) {
    std::size_t calls = 0;
    for (const Part& part : scene.parts) calls += draw_calls(part.mesh);
    return calls;
}

/// The scene during the optimization of its documents.
class Optimizing {
  public:
    Optimizing(Scene& scene, const OptimizeOptions& o, Context& context, OptimizeReport& report)
        : scene_(scene), o_(o), context_(context), report_(report), requests_(scene.documents.size()) {
        for (const auto& document : scene.documents) tidies_.emplace_back(*document);
    }

    void run() {
        report_.draw_calls_before = draw_calls_of(scene_);
        report_.parts_before = scene_.parts.size();
        bound_ = io::bound_parts(scene_, tidies_);
        if (o_.dedup) merge_materials();
        if (o_.dedup) merge_meshes();
        if (o_.drop_attributes || o_.drop_own) drop_attributes();
        if (o_.dedup) merge_vertices();
        if (o_.palette) paint();
        if (o_.flatten) flatten();
        if (o_.instance) instance();
        if (o_.join) join_parts();
        if (o_.dedup)
            for (auto& tidy : tidies_) report_.equal_accessors += tidy.merge_equal_accessors(o_.keep_names);
        if (o_.prune) drop_tracks();
        erase();
        report_.draw_calls_after = draw_calls_of(scene_);
        report_.parts_after = scene_.parts.size();
    }

  private:
    static std::size_t number(int i) { return static_cast<std::size_t>(i); }

    void merge_materials() {
        std::vector<std::vector<std::size_t>> stands_for;
        for (auto& tidy : tidies_) stands_for.push_back(tidy.merge_equal(o_.keep_names));
        std::vector<Index> instead(scene_.materials.size());
        std::map<MaterialKey, Index> known;
        for (Index m = 0; m < instead.size(); ++m) {
            const Material& material = scene_.materials[m];
            const bool unknown = material.document >= 0 && material.index < 0;
            instead[m] = unknown ? m : known.try_emplace(key_of(material, stands_for), m).first->second;
            report_.equal_materials += instead[m] != m;
        }
        for (Part& part : scene_.parts)
            for (Primitive& p : part.mesh.primitives)
                if (p.material < instead.size()) p.material = instead[p.material];
    }

    /// The key of equal materials: document, representative material (without a document: the name), sides
    /// and colour.
    using MaterialKey = std::tuple<int, std::size_t, std::string, bool, std::array<std::uint64_t, 4>>;

    MaterialKey key_of(const Material& m, const std::vector<std::vector<std::size_t>>& stands_for) const {
        std::array<std::uint64_t, 4> colour;
        std::transform(std::begin(m.base_colour), std::end(m.base_colour), colour.begin(),
                       [](double c) { return std::bit_cast<std::uint64_t>(c + 0.0); }); // -0 equals 0
        if (m.document < 0) return {m.document, 0, o_.keep_names ? m.name : "", m.double_sided, colour};
        return {m.document, stands_for[number(m.document)][number(m.index)], "", m.double_sided, colour};
    }

    /// Nodes with equal meshes reference the first of these. A mesh with a bound part stays separate.
    void merge_meshes() {
        const auto first = DistinctParts(scene_).first;
        using Source = std::pair<int, int>;
        const auto source = [&](std::size_t i) {
            return Source{scene_.parts[i].document, scene_.parts[i].source_mesh};
        };
        std::map<Source, std::set<std::size_t>> variants; // the different meshes that a source mesh became
        std::set<Source> bound;
        for (std::size_t i = 0; i < first.size(); ++i) {
            variants[source(i)].insert(first[i]);
            if (bound_[i]) bound.insert(source(i));
        }
        for (std::size_t i = 0; i < first.size(); ++i) {
            const Source own = source(i), other = source(first[i]);
            const Part &part = scene_.parts[i], &example = scene_.parts[first[i]];
            const bool fits = own != other && own.first >= 0 && own.first == other.first && own.second >= 0 &&
                              other.second >= 0 && variants[own].size() == 1 && variants[other].size() == 1 &&
                              !bound.contains(own) && !bound.contains(other) &&
                              part.changed == example.changed && part.node >= 0 && example.node >= 0;
            if (!fits || (o_.keep_names && part.name != example.name)) continue;
            report_.equal_meshes +=
                requests_[number(own.first)].equal_meshes.emplace(own.second, other.second).second;
        }
        for (Part& part : scene_.parts) {
            if (part.document < 0 || part.source_mesh < 0) continue;
            const auto& equal = requests_[number(part.document)].equal_meshes;
            const auto found = equal.find(number(part.source_mesh));
            if (found != equal.end()) part.source_mesh = static_cast<int>(found->second);
        }
    }

    /// Merges vertices of meshes that may change: all parts with the mesh are selected, and no data refers
    /// to vertex numbers.
    void merge_vertices() {
        for (const std::size_t i : changeable()) {
            Part& part = scene_.parts[i];
            const auto numbers = [](const Primitive& p) { return !p.json.empty(); };
            if (std::any_of(part.mesh.primitives.begin(), part.mesh.primitives.end(), numbers)) continue;
            const std::size_t before = part.mesh.wedge_count();
            merge_and_drop_wedges(part.mesh);
            const std::size_t merged = before - part.mesh.wedge_count();
            part.changed |= merged > 0;
            report_.equal_vertices += merged;
        }
    }

    void drop_attributes() {
        const auto needs = [&](Index m) -> std::optional<io::MaterialNeeds> {
            if (m >= scene_.materials.size()) return io::MaterialNeeds{};
            const Material& material = scene_.materials[m];
            if (material.document < 0 || material.index < 0) return io::MaterialNeeds{};
            const auto& tidy = tidies_[number(material.document)];
            if (!tidy.numbers_are_known()) return {};
            return tidy.needs_of(number(material.index));
        };
        std::set<std::string> names;
        for (Part& part : scene_.parts) {
            if (!context_.selects(part, scene_)) continue;
            const auto dropped = drop_unused_attributes(part.mesh, needs,
                                                        {.standard = o_.drop_attributes, .own = o_.drop_own});
            for (const std::string& name : dropped) {
                names.insert(name);
                context_.attribute_changes(part, {{name, Domain::wedge, AttributeChange::Kind::dropped,
                                                   "no drawn material needs it"}});
            }
            part.changed |= !dropped.empty();
        }
        report_.dropped_attributes.assign(names.begin(), names.end());
    }

    std::vector<std::size_t> selected() const {
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < scene_.parts.size(); ++i)
            if (context_.selects(scene_.parts[i], scene_)) all.push_back(i);
        return all;
    }

    /// Selected parts whose mesh is used by selected parts only.
    std::vector<std::size_t> changeable() const {
        std::set<std::pair<int, int>> fixed;
        for (const Part& part : scene_.parts)
            if (!context_.selects(part, scene_) && part.source_mesh >= 0)
                fixed.emplace(part.document, part.source_mesh);
        std::vector<std::size_t> all = selected();
        std::erase_if(all, [&](std::size_t i) {
            return fixed.contains({scene_.parts[i].document, scene_.parts[i].source_mesh});
        });
        return all;
    }

    void paint() {
        const PaletteCounts made =
            make_palettes(scene_, tidies_, selected(), static_cast<std::size_t>(o_.palette_min));
        report_.palettes = made.palettes;
        report_.palette_materials = made.materials;
        if (made.too_many_looks > 0)
            context_.warn("W-PALETTE",
                          fmt::format("optimize: no palette was made of {} materials: it has at most {}",
                                      made.too_many_looks, most_looks),
                          "use only: [...] to optimize fewer parts at a time");
    }

    void flatten() {
        std::vector<std::set<std::size_t>> nodes(tidies_.size());
        for (const std::size_t i : selected()) {
            const Part& part = scene_.parts[i];
            if (bound_[i] || part.document < 0 || part.node < 0 ||
                !tidies_[number(part.document)].numbers_are_known())
                continue;
            nodes[number(part.document)].insert(number(part.node));
        }
        for (std::size_t d = 0; d < nodes.size(); ++d)
            report_.flattened_parts += tidies_[d].flatten(nodes[d], requests_[d].emptied);
    }

    /// Parts by mesh, each alone at its node and not mirrored.
    std::map<std::pair<int, int>, std::vector<std::size_t>> parts_by_mesh() const {
        std::map<std::pair<int, int>, std::size_t> of_node;
        for (const Part& part : scene_.parts) ++of_node[{part.document, part.node}];
        const auto first = DistinctParts(scene_).first;
        std::map<std::pair<int, int>, std::vector<std::size_t>> all;
        for (const std::size_t i : selected()) {
            const Part& part = scene_.parts[i];
            if (bound_[i] || part.document < 0 || part.node < 0 || part.source_mesh < 0 ||
                part.mesh.face_count() == 0 || !(part.transform.determinant() > 0) ||
                of_node[{part.document, part.node}] > 1 ||
                !tidies_[number(part.document)].numbers_are_known())
                continue;
            auto& group = all[{part.document, part.source_mesh}];
            const Part* example = group.empty() ? nullptr : &scene_.parts[group.front()];
            if (!example || (first[i] == first[group.front()] && part.changed == example->changed))
                group.push_back(i);
        }
        return all;
    }

    void instance() {
        std::set<std::size_t> gone;
        for (const auto& [mesh, group] : parts_by_mesh()) {
            if (group.size() < static_cast<std::size_t>(o_.instance_min)) continue;
            std::vector<std::pair<std::size_t, Transform>> places;
            for (const std::size_t i : group)
                places.emplace_back(number(scene_.parts[i].node), scene_.parts[i].transform);
            const auto made = tidies_[number(mesh.first)].instance(places);
            if (!made) continue;
            for (const std::size_t i : group) {
                requests_[number(mesh.first)].emptied.insert(number(scene_.parts[i].node));
                if (i != group.front()) gone.insert(i);
            }
            Part& one = scene_.parts[group.front()];
            one.node = static_cast<int>(made->first);
            one.transform = made->second;
            ++report_.instanced_meshes;
            report_.instances += group.size();
        }
        erase_parts(gone);
        bound_ = io::bound_parts(scene_, tidies_);
    }

    void erase_parts(const std::set<std::size_t>& gone) {
        std::size_t i = 0;
        std::erase_if(scene_.parts, [&](const Part&) { return gone.contains(i++); });
    }

    /// Parts that could be merged because nothing else requires them to be separate.
    std::vector<std::size_t> candidates() const {
        std::map<std::pair<int, int>, std::size_t> of_mesh, of_node;
        for (const Part& part : scene_.parts) {
            ++of_mesh[{part.document, part.source_mesh}];
            ++of_node[{part.document, part.node}];
        }
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < scene_.parts.size(); ++i) {
            const Part& part = scene_.parts[i];
            const bool shared = (part.source_mesh >= 0 && of_mesh[{part.document, part.source_mesh}] > 1 &&
                                 !o_.join_shared) ||
                                (part.node >= 0 && of_node[{part.document, part.node}] > 1);
            if (!bound_[i] && !shared && part.mesh.face_count() > 0 && inverse(part.transform) &&
                context_.selects(part, scene_))
                all.push_back(i);
        }
        return all;
    }

    /// For each shared mesh, its parts, if all of them may be joined and each has its own node.
    std::vector<std::vector<std::size_t>> shared_candidates() const {
        std::map<std::pair<int, int>, std::size_t> of_node;
        for (const Part& part : scene_.parts) ++of_node[{part.document, part.node}];
        std::map<std::pair<int, int>, std::vector<std::size_t>> of_mesh;
        for (std::size_t i = 0; i < scene_.parts.size(); ++i)
            of_mesh[{scene_.parts[i].document, scene_.parts[i].source_mesh}].push_back(i);
        const auto first = DistinctParts(scene_).first;
        std::vector<std::vector<std::size_t>> all;
        for (const auto& [mesh, parts] : of_mesh) {
            const std::size_t one = parts.front();
            const Part& example = scene_.parts[one];
            const auto fits = [&](std::size_t i) {
                const Part& part = scene_.parts[i];
                return !bound_[i] && part.mesh.face_count() > 0 && inverse(part.transform) &&
                       context_.selects(part, scene_) && part.node >= 0 &&
                       of_node.at({part.document, part.node}) == 1 && first[i] == first[one] &&
                       part.changed == example.changed;
            };
            if (mesh.second >= 0 && parts.size() > 1 && std::all_of(parts.begin(), parts.end(), fits))
                all.push_back(parts);
        }
        return all;
    }

    void join_parts() {
        const auto able = candidates();
        for (const std::size_t i : changeable())
            if (join_primitives(scene_.parts[i].mesh)) scene_.parts[i].changed = true;
        if (o_.keep_names) return;
        std::set<std::size_t> gone;
        auto groups = groups_to_join(scene_, able);
        if (!o_.join_shared) {
            const auto together = groups_standing_together(scene_, shared_candidates());
            groups.insert(groups.end(), together.begin(), together.end());
        }
        for (const JoinedParts& group : groups) {
            report_.joined.push_back(scene_.parts[group.first].name);
            report_.joined_parts += group.others.size();
            join(scene_, group);
            for (const std::size_t i : group.others) {
                const Part& other = scene_.parts[i];
                if (other.document >= 0 && other.node >= 0)
                    requests_[number(other.document)].emptied.insert(number(other.node));
                gone.insert(i);
            }
        }
        erase_parts(gone);
    }

    void drop_tracks() {
        const Box box = io::drawn_bounds(scene_);
        constexpr double ratio = 1e-6; // of the diagonal
        const double within = box.empty() ? 0 : ratio * length(box.extent());
        for (auto& tidy : tidies_) tidy.drop_resting_tracks(within);
    }

    void erase() {
        for (const Part& part : scene_.parts)
            if (part.document >= 0 && part.source_mesh >= 0)
                requests_[number(part.document)].meshes.insert(number(part.source_mesh));
        if (o_.prune && !scene_.parts.empty()) drop_materials(); // a library of materials keeps them
        for (const Material& m : scene_.materials)
            if (m.document >= 0 && m.index >= 0)
                requests_[number(m.document)].materials.insert(number(m.index));
        for (std::size_t d = 0; d < tidies_.size(); ++d) {
            requests_[d].all = o_.prune;
            renumber(static_cast<int>(d), tidies_[d].erase_unused(requests_[d]));
            add(tidies_[d].erased());
            if (!tidies_[d].numbers_are_known())
                context_.warn("W-OPTIMIZE",
                              fmt::format("optimize: nothing was removed or joined in '{}' because it has an "
                                          "extension that may refer to items by their numbers",
                                          scene_.documents[d]->name));
            scene_.documents[d] = tidies_[d].finish(scene_.documents[d]);
        }
    }

    /// Removes unused materials of the scene, including merged duplicates.
    void drop_materials() {
        std::vector<Index> number_of(scene_.materials.size(), none);
        for (const Part& part : scene_.parts)
            for (const Primitive& p : part.mesh.primitives)
                if (p.material < number_of.size()) number_of[p.material] = 0;
        std::vector<Material> kept;
        for (std::size_t m = 0; m < number_of.size(); ++m) {
            const Material& material = scene_.materials[m];
            const bool unknown =
                material.document >= 0 && !tidies_[number(material.document)].numbers_are_known();
            if (number_of[m] == none && !unknown) continue;
            number_of[m] = static_cast<Index>(kept.size());
            kept.push_back(material);
        }
        scene_.materials = std::move(kept);
        for (Part& part : scene_.parts)
            for (Primitive& p : part.mesh.primitives)
                if (p.material < number_of.size()) p.material = number_of[p.material];
    }

    void renumber(int document, const io::TidyNumbers& numbers) {
        const auto follow = [](int& i, const std::vector<int>& all) {
            if (i >= 0 && number(i) < all.size()) i = all[number(i)];
        };
        for (Part& part : scene_.parts) {
            if (part.document != document) continue;
            follow(part.node, numbers.nodes);
            follow(part.source_mesh, numbers.meshes);
        }
        for (Material& material : scene_.materials)
            if (material.document == document) follow(material.index, numbers.materials);
    }

    void add(const io::TidyCounts& c) {
        io::TidyCounts& all = report_.erased;
        for (const auto member :
             {&io::TidyCounts::nodes, &io::TidyCounts::meshes, &io::TidyCounts::materials,
              &io::TidyCounts::textures, &io::TidyCounts::samplers, &io::TidyCounts::images,
              &io::TidyCounts::accessors, &io::TidyCounts::tracks})
            all.*member += c.*member;
    }

    Scene& scene_;
    const OptimizeOptions& o_;
    Context& context_;
    OptimizeReport& report_;
    std::vector<io::DocumentOptimizer> tidies_;
    std::vector<io::TidyRequest> requests_;
    std::vector<bool> bound_;
};

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
    d.object("erased", &OptimizeReport::erased, "Items that were removed from the documents.",
             declare_erased);
    d.tell([](const OptimizeReport& r) {
        std::vector<std::string> lines{fmt::format("{} -> {} draw calls, {} -> {} parts",
                                                   grouped(r.draw_calls_before), grouped(r.draw_calls_after),
                                                   grouped(r.parts_before), grouped(r.parts_after))};
        if (const auto erased = told(r.erased); !erased.empty())
            lines.push_back(fmt::format("erased: {}", fmt::join(erased, ", ")));
        return lines;
    });
}

Scene run(Scene scene, const OptimizeOptions& o, Context& context, OptimizeReport& report) {
    try {
        Optimizing(scene, o, context, report).run();
    } catch (const Json::exception&) {
        throw Error(ErrorKind::malformed, "E-GLTF",
                    "a member of the document has another type than glTF gives it", {}, context.where());
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
