#include "base/text/glob.hpp"
#include "base/text/words.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/reference_mesh.hpp"
#include "stage/stage.hpp"
#include "stages/transfer/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::transfer_stage {

namespace {

struct TransferOptions {
    PathText with;
    std::vector<std::string> attributes;
    std::string distance = "distance";
};

void declare(Declare<TransferOptions>& d) {
    d.option("with", &TransferOptions::with, "The mesh file to take attributes from.")
        .also_called(with_synonyms)
        .also_called("from source")
        .required()
        .primary();
    d.option(
         "attributes", &TransferOptions::attributes,
         "The names of attributes to take, or globs: TEXCOORD_0, \"COLOR_*\". Default: all except normals, "
         "tangents, morph targets and materials.")
        .also_called(attribute_synonyms)
        .also_called("names attribute");
    d.option("distance", &TransferOptions::distance,
             "The name of the vertex attribute that stores the distance from the other mesh. An empty name "
             "stores none.");
}

struct TransferredPart {
    std::string part;
    std::vector<std::string> attributes;
    std::size_t across_seams = 0;
    double mean = 0, farthest = 0;
};

struct TransferReport {
    std::vector<TransferredPart> parts;
};

void declare_part(DeclareFields<TransferredPart>& d) {
    d.field("part", &TransferredPart::part, "The name of the part.");
    d.field("attributes", &TransferredPart::attributes, "The attributes that it got.");
    d.field("faces_across_seams", &TransferredPart::across_seams,
            "Faces that cross a seam of the other mesh.");
    d.field("mean_distance", &TransferredPart::mean, "The mean distance of the vertices from the other mesh.")
        .unit("scene units");
    d.field("farthest", &TransferredPart::farthest, "The largest of these distances.").unit("scene units");
}

void declare_report(DeclareFields<TransferReport>& d) {
    d.list("parts", &TransferReport::parts, "Each part.", declare_part);
    d.tell([](const TransferReport& r) {
        std::vector<std::string> lines;
        lines.reserve(r.parts.size());
        for (const TransferredPart& p : r.parts)
            lines.push_back(fmt::format(
                "{}: {}; distance {:.4g} on average, {:.4g} at most", p.part,
                p.attributes.empty() ? "no attributes" : fmt::format("{}", fmt::join(p.attributes, ", ")),
                p.mean, p.farthest));
        return lines;
    });
}

bool is_taken(const Attribute& a, const TransferOptions& o) {
    if (a.name == primitive_attribute && a.domain == Domain::face) return false;
    if (o.attributes.empty())
        return a.role != Role::normal && a.role != Role::tangent && a.role != Role::morph_vector;
    return std::any_of(o.attributes.begin(), o.attributes.end(),
                       [&](const std::string& pattern) { return glob_matches(pattern, a.name); });
}

/// Puts the attribute into the mesh, and replaces attributes with the same name.
void put_attribute(Mesh& mesh, Attribute a) {
    for (const Domain d : {Domain::vertex, Domain::wedge, Domain::face}) mesh.drop(a.name, d);
    for (Primitive& p : mesh.primitives)
        if (a.domain == Domain::wedge && !p.attributes.empty() && !p.lists(a.name))
            p.attributes.push_back(a.name);
    mesh.attributes.push_back(std::move(a));
}

void put_distances(Mesh& mesh, const std::vector<double>& distances, const std::string& name) {
    if (name.empty()) return;
    std::vector<float> values(distances.size());
    for (std::size_t v = 0; v < values.size(); ++v)
        values[v] = std::isfinite(distances[v]) ? static_cast<float>(distances[v]) : 0;
    put_attribute(mesh, {name, Domain::vertex, Role::generic, 1, false, std::move(values)});
}

class PartTransfer {
  public:
    PartTransfer(const TransferOptions& o, const ReferenceMesh& other, Context& context)
        : o_(o), other_(other), context_(context) {}

    TransferredPart operator()(Part& part) const {
        TransferredPart result{part.name, {}, 0, 0, 0};
        auto carried = other_.carried_to(part);
        if (!carried) return result;
        bool has_uv = false, has_skin = false;
        for (Attribute& a : carried->mesh.attributes) {
            has_uv = has_uv || a.role == Role::uv;
            has_skin = has_skin || a.role == Role::weights;
            result.attributes.push_back(a.name);
            context_.attribute_changes(part, {{a.name, a.domain, AttributeChange::Kind::recomputed,
                                               "from the nearest points of another mesh"}});
            put_attribute(part.mesh, std::move(a));
        }
        const auto& distances = carried->sources.distances;
        for (const double d : distances) {
            if (!std::isfinite(d)) continue;
            result.mean += d / static_cast<double>(distances.size());
            result.farthest = std::max(result.farthest, d);
        }
        put_distances(part.mesh, distances, o_.distance);
        if (has_uv)
            result.across_seams =
                faces_across_charts(other_.mesh(), carried->mesh, carried->sources.provenance);
        warn(part, result, has_skin);
        return result;
    }

  private:
    void warn(const Part& part, const TransferredPart& result, bool has_skin) const {
        if (result.across_seams > 0)
            context_.warn("W-TRANSFER-SEAMS",
                          fmt::format("transfer: {} of part '{}' cross a seam of '{}', so their texture "
                                      "coordinates mix both sides",
                                      counted(result.across_seams, "face"), part.name, o_.with.text),
                          "cut the part along the same seams, or list other names in attributes");
        if (has_skin && !part.skinned)
            context_.warn(
                "W-TRANSFER-SKIN",
                fmt::format("transfer: part '{}' got joints and weights, but has no skin", part.name),
                "list the attributes to take without JOINTS_0 and WEIGHTS_0");
    }

    const TransferOptions& o_;
    const ReferenceMesh& other_;
    Context& context_;
};

Scene run(Scene scene, const TransferOptions& o, Context& context, TransferReport& report) {
    ReferenceMesh other(o.with, scene, context);
    std::erase_if(other.mesh().attributes, [&](const Attribute& a) { return !is_taken(a, o); });
    merge_equal_wedges(other.mesh()); // other attributes split wedges where these have no seam
    if (other.mesh().attributes.empty())
        context.warn(
            "W-TRANSFER-NONE",
            fmt::format("transfer: '{}' has no such attribute, so only distances are taken", o.with.text),
            fmt::format("list its attributes with facetmill info {}", o.with.text));
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.vertex_count() == 0) return;
        report.parts.push_back(PartTransfer(o, other, context)(part));
    });
    return scene;
}

struct TransferStage : StageOf<run> {
    StageFiles files() const override { return {{o.with}, {}}; }
};

const RegisterStage registered = make_stage<TransferStage>(
    {.name = "transfer",
     .also_called =
         "project_attributes copy_attributes data_transfer vertex_attribute_transfer transfer_weights "
         "transfer_uvs bake_attributes",
     .about = help::transfer::about,
     .details = help::transfer::details,
     .examples = {"transfer: original.glb", "transfer: {with: body.glb, attributes: [JOINTS_0, WEIGHTS_0]}",
                  "transfer: {with: scan.ply, attributes: [\"COLOR_*\"], distance: from_scan}"},
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::transfer_stage
