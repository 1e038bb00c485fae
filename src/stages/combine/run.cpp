#include "base/text/readable_numbers.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "geometry/boolean/combine.hpp"
#include "geometry/cut/cap_paint.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/skin.hpp"
#include "mesh/transform.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/stage.hpp"
#include "stages/combine/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::combine_stage {

namespace {

using Operation = CombineOperation;

struct CombineOptions {
    Operation operation = Operation::unite;
    std::vector<std::string> with;
    bool keep = false;
};

void declare(Declare<CombineOptions>& d) {
    d.choice<Operation>(
         "operation", &CombineOptions::operation,
         {{"union", Operation::unite, "all parts, joined into one part"},
          {"difference", Operation::subtract, "each part minus the parts of `with`"},
          {"intersection", Operation::intersect, "the volume that each part shares with any part of `with`"}},
         "The boolean operation.")
        .primary();
    d.option("with", &CombineOptions::with,
             "The second operands: names or globs of parts or materials. \"!glob\" excludes.")
        .also_called(with_synonyms);
    d.option("keep", &CombineOptions::keep, "Keeps the parts of `with` in the scene.");
}

struct CombinedPart {
    std::string part;
    std::vector<std::string> with;
    std::size_t faces = 0, cut_faces = 0, removed_faces = 0, faces_of_with = 0;
};

struct CombineReport {
    std::vector<CombinedPart> parts;
};

void declare_part(DeclareFields<CombinedPart>& d) {
    d.field("part", &CombinedPart::part, "The name of the part.");
    d.field("with", &CombinedPart::with, "The parts that it was combined with.");
    d.field("faces", &CombinedPart::faces, "The number of faces in the result.");
    d.field("cut_faces", &CombinedPart::cut_faces,
            "Faces cut where they met others, counted in each repetition. Faces that meet only where a third "
            "solid covers them do not count.");
    d.field("removed_faces", &CombinedPart::removed_faces, "Faces that were removed without a cut.");
    d.field("faces_of_with", &CombinedPart::faces_of_with,
            "Faces of the result that come from the other parts.");
}

void declare_report(DeclareFields<CombineReport>& d) {
    d.list("parts", &CombineReport::parts, "Each combined part.", declare_part);
}

std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Part& part : scene.parts) names.push_back(part.name);
    return names;
}

/// [parts] 0: not involved, 1: in the first operand, 2: in the second operand. Throws a usage error (E-PART)
/// if a pattern of `with` matches no part, or if no part remains to be combined.
std::vector<int> operands_of(const Scene& scene, const CombineOptions& o, const Context& context) {
    for (const auto& pattern : o.with) {
        const PartFilter alone{{pattern}};
        const auto is_named = [&](const Part& part) { return alone.selects(part, scene); };
        if (!pattern.starts_with('!') && std::none_of(scene.parts.begin(), scene.parts.end(), is_named))
            throw Error(ErrorKind::usage, "E-PART",
                        fmt::format("combine: 'with' selects no part of the scene: {}", pattern),
                        did_you_mean(pattern, names_of(scene), "facetmill info lists them"));
    }
    const PartFilter with{o.with};
    std::vector<int> operand;
    for (const Part& part : scene.parts)
        operand.push_back(!o.with.empty() && with.selects(part, scene) ? 2
                          : context.selects(part, scene)               ? 1
                                                                       : 0);
    if (std::find(operand.begin(), operand.end(), 1) == operand.end() &&
        std::find(operand.begin(), operand.end(), 2) != operand.end())
        throw Error(ErrorKind::usage, "E-PART",
                    "combine: 'with' contains all parts, so no part is left to be combined",
                    "load another part, or name fewer parts in 'with'");
    return operand;
}

[[noreturn]] void refuse(const Part& part, const std::string& why, const char* hint) {
    throw Error(ErrorKind::stage, "E-COMBINE", fmt::format("combine: part '{}' {}", part.name, why), hint);
}

/// Checks all preconditions that need no cut.
void require_solid(const Part& part) {
    if (part.mesh.face_count() == 0)
        refuse(part, "has no faces", "exclude it with `only`, or check the stages before");
    if (!inverse(part.transform))
        refuse(part, "is flattened by its node", "a flat mesh is not a solid; exclude it with `only`");
}

constexpr const char* no_skin = "combined parts have no skin";

void warn_of_skin(const Part& part, Context& context) {
    if (part.skinned)
        context.warn("W-SKIN",
                     fmt::format("combine: part '{}' is in bind pose and loses its skin", part.name),
                     "exclude it with `only`, or write the parts without combine");
}

/// The mesh of a part in the space of another part.
Mesh in_space_of(const Part& space, const Part& part) {
    Mesh mesh = part.mesh;
    drop_skin(mesh, no_skin);
    if (part.transform != space.transform) apply(mesh, *inverse(space.transform) * part.transform);
    return mesh;
}

/// Throws E-COMBINE, or a limit error (E-MEMORY).
[[noreturn]] void fail(const CombineFailure& failure, const std::vector<const Part*>& parts,
                       bool short_of_memory) {
    const Vec3 at = parts[0]->transform.point(failure.at);
    const std::string place = readable(at, ", ");
    if (failure.mesh != none)
        refuse(*parts[failure.mesh], fmt::format("is not a solid: {}, at {}", failure.why, place),
               "use clean: {holes: minimal} to close it, clean to repair its faces, or orient to turn it "
               "outward");
    const std::string why = fmt::format("cannot be combined: {} (near {})", failure.why, place);
    if (short_of_memory)
        throw out_of_memory(fmt::format("combine: part '{}' {}", parts[0]->name, why),
                            "give more --memory, combine fewer parts at a time, nearest first (with `only`), "
                            "or simplify them before");
    refuse(*parts[0], why,
           "use clean: {precision: single} first to merge vertices that differ only by rounding, or clean: "
           "{self_intersections: union} for each part, or move one part a little");
}

/// Removes group numbers from an operand that cuts the first operand, because they number other things.
/// Groups of caps stay: group and cut_id together identify caps (later_caps). Returns whether it removed any
/// number.
bool forget_groups(Mesh& mesh) {
    Attribute* group = mesh.find(group_attribute, Domain::face);
    if (!group) return false;
    const Attribute* cut = mesh.find(cut_id_attribute, Domain::face);
    bool forgotten = false, any_left = false;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (!(group->value(f, 0) > 0)) continue;
        if (cut && cut->value(f, 0) > 0) {
            any_left = true;
            continue;
        }
        forgotten = true;
        group->set_value(f, 0, 0);
    }
    if (!any_left) mesh.drop(group_attribute, Domain::face);
    return forgotten;
}

void number_faces(Mesh& mesh, std::string_view name, std::vector<std::uint32_t> numbers) {
    mesh.drop(name, Domain::face);
    mesh.attributes.push_back(
        {std::string(name), Domain::face, Role::index, 1, false, AttributeData(std::move(numbers))});
}

/// After a union, numbers each face by its part (group). Otherwise numbers the faces of the second operand
/// (cut_id).
void tag(Mesh& mesh, const std::vector<Index>& mesh_of_face, bool unites, Index first_cut) {
    if (unites) return number_faces(mesh, group_attribute, {mesh_of_face.begin(), mesh_of_face.end()});
    std::vector<std::uint32_t> numbers(mesh.face_count());
    const Attribute* before = mesh.find(cut_id_attribute, Domain::face);
    for (Index f = 0; f < numbers.size(); ++f)
        numbers[f] = mesh_of_face[f] > 0 ? first_cut + mesh_of_face[f]
                     : before            ? static_cast<std::uint32_t>(before->value(f, 0))
                                         : 0;
    number_faces(mesh, cut_id_attribute, std::move(numbers));
}

/// [with] 1 if the part's bounding box contains a vertex of the others. The part may then remove a whole
/// component.
std::vector<std::uint8_t> reached(const std::vector<const Part*>& with, const std::vector<Part*>& others) {
    std::vector<std::uint8_t> all(with.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        Box box;
        for (const Vec3& p : with[i]->mesh.positions) box.add(with[i]->transform.point(p));
        const auto within = [&](const Vec3& p) {
            return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
                   p.z >= box.min.z && p.z <= box.max.z;
        };
        for (const Part* part : others)
            all[i] |= std::any_of(part->mesh.positions.begin(), part->mesh.positions.end(),
                                  [&](const Vec3& p) { return within(part->transform.point(p)); });
    }
    return all;
}

/// Warns about parts of `with` without a face in the result, for example a drill at the wrong height or
/// inside another. bounds: flags of parts that contribute or may contribute.
void warn_of_idle(const std::vector<const Part*>& with, const std::vector<std::uint8_t>& bounds,
                  Context& context) {
    std::string names;
    std::size_t idle = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
        if (bounds[i] != 0) continue;
        if (++idle <= 5) append_item(names, fmt::format("'{}'", with[i]->name));
    }
    if (idle == 0) return;
    if (idle > 5) names += fmt::format(" and {} more", idle - 5);
    context.warn("W-COMBINE-IDLE",
                 fmt::format("combine: {} {} nothing", names, idle == 1 ? "subtracts" : "subtract"),
                 "move it so that it meets the others (transform: {only: ..., translate: ...}), or leave it "
                 "out of with; facetmill info prints the bounds");
}

/// Combines a part with others: meshes before `second` belong to the first operand. The first part gets the
/// result. bounds: set for each other part with a face in the result.
CombinedPart combine_parts(Part& part, const std::vector<const Part*>& others, Operation operation,
                           std::vector<std::uint8_t>& bounds, Context& context) {
    std::vector<const Part*> all{&part};
    all.insert(all.end(), others.begin(), others.end());
    std::vector<Mesh> meshes;
    meshes.reserve(all.size());
    for (const Part* p : all) meshes.push_back(in_space_of(part, *p));
    const bool unites = operation == Operation::unite;
    bool forgot_groups = false;
    for (std::size_t i = 1; i < meshes.size() && !unites; ++i) forgot_groups |= forget_groups(meshes[i]);
    const Index first_cut = unites ? 0 : largest_number(part.mesh, cut_id_attribute);
    CombineResult r = facetmill::combine(std::move(meshes), {operation, unites ? none : Index{1}});
    if (r.short_of_memory) context.mark_uncacheable();
    if (r.failure) fail(*r.failure, all, r.short_of_memory);
    tag(r.mesh, r.mesh_of_face, unites, first_cut);
    CombinedPart report{part.name, {}, r.mesh.face_count(), r.cut_faces, r.covered_faces, 0};
    for (const Part* p : others) report.with.push_back(p->name);
    for (const Index mesh : r.mesh_of_face) {
        if (mesh == 0) continue;
        ++report.faces_of_with;
        bounds[mesh - 1] = 1;
    }
    context.attribute_changes(part, drop_skin(part.mesh, no_skin));
    if (forgot_groups)
        merge_changes(r.changes,
                      {{std::string(group_attribute), Domain::face,
                        r.mesh.find(group_attribute, Domain::face) ? AttributeChange::Kind::recomputed
                                                                   : AttributeChange::Kind::dropped,
                        "0 on faces of the parts of 'with', because they number other groups"}});
    context.attribute_changes(part, r.changes);
    part.skinned = false;
    part.mesh = std::move(r.mesh);
    part.changed = true;
    if (part.mesh.face_count() == 0)
        context.warn("W-COMBINE-NOTHING", fmt::format("combine: nothing of part '{}' remains", part.name),
                     operation == Operation::subtract
                         ? "the parts of 'with' cover it; facetmill info prints their bounds"
                         : "check that the parts overlap; facetmill info prints their bounds");
    return report;
}

/// Volumes of glass keep their thickness in the world, although meshes grow in the space of the first part.
void keep_thickness(Scene& scene, const std::vector<int>& operand, const Part& space) {
    std::vector<io::LengthGrowth> growth(scene.parts.size());
    for (std::size_t i = 0; i < growth.size(); ++i)
        if (operand[i] != 0 && scene.parts[i].transform != space.transform)
            growth[i].mesh = io::length_growth(*inverse(space.transform) * scene.parts[i].transform);
    io::scale_material_lengths(scene, growth);
}

Scene run(Scene scene, const CombineOptions& o, Context& context, CombineReport& report) {
    const std::vector<int> operand = operands_of(scene, o, context);
    std::vector<Part*> first;
    std::vector<const Part*> second;
    for (std::size_t i = 0; i < operand.size(); ++i) {
        if (operand[i] == 0) continue;
        require_solid(scene.parts[i]);
        warn_of_skin(scene.parts[i], context);
        if (operand[i] == 1) first.push_back(&scene.parts[i]);
        if (operand[i] == 2) second.push_back(&scene.parts[i]);
    }
    if (first.empty()) return scene;
    keep_thickness(scene, operand, *first.front());
    if (o.operation == Operation::unite) {
        std::vector<const Part*> others(first.begin() + 1, first.end());
        others.insert(others.end(), second.begin(), second.end());
        std::vector<std::uint8_t> bounds(others.size());
        report.parts.push_back(combine_parts(*first[0], others, o.operation, bounds, context));
    } else {
        const bool subtracts = o.operation == Operation::subtract;
        auto bounds = subtracts ? reached(second, first) : std::vector<std::uint8_t>(second.size());
        for (Part* part : first)
            report.parts.push_back(combine_parts(*part, second, o.operation, bounds, context));
        if (subtracts) warn_of_idle(second, bounds, context);
    }
    std::vector<Part> rest;
    for (std::size_t i = 0; i < operand.size(); ++i) {
        Part& part = scene.parts[i];
        const bool joined = operand[i] == 1 && o.operation == Operation::unite && &part != first.front();
        if (!joined && (operand[i] != 2 || o.keep)) rest.push_back(std::move(part));
    }
    scene.parts = std::move(rest);
    return scene;
}

struct CombineStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        if (o.operation != Operation::unite && o.with.empty())
            problems.add(given.mark, "E-MISSING",
                         fmt::format("combine: {} needs the parts of 'with'",
                                     o.operation == Operation::subtract ? "difference" : "intersection"),
                         "combine: {operation: difference, with: drill}");
    }
};

const RegisterStage registered = make_stage<CombineStage>(
    {.name = "combine",
     .also_called = "boolean bool csg union difference subtract intersection intersect",
     .about = help::combine::about,
     .details = help::combine::details,
     .examples = {"combine", "combine: {operation: difference, with: drill}",
                  "combine: {operation: intersection, with: [\"tool*\"], keep: true}"},
     .may_lose = MayLose::all,
     .crossing_faces = CrossingFacePolicy::fill},
    declare, declare_report);

} // namespace

} // namespace facetmill::combine_stage
