#include "stages/simplify/report.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/deviation/deviation_fields.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::simplify_stage {

namespace {

struct Reason {
    std::size_t edges;
    const char* what;
    const char* hint;
};

std::vector<Reason> reasons(const SimplifyResult::Blocked& b) {
    return {{b.seams, "by seams and by borders of materials and groups",
             "use method: cluster, which does not keep the borders of texture islands, materials and groups"},
            {b.borders, "by boundaries and locks",
             "ask for more faces, lock fewer vertices, or use method: cluster, which moves boundaries"},
            {b.non_manifold, "at non-manifold regions", "use clean before simplify to repair them"},
            {b.topology, "by topology",
             "use topology: allow, which lets small components, holes and handles vanish"},
            {b.flips, "because a face would flip", "ask for more faces, or use method: cluster"},
            {b.error, "by max_quadric_error", "use a larger max_quadric_error, or max_quadric_error: off"}};
}

} // namespace

std::string held_by(const SimplifyResult& r) {
    if (r.cell) return "with larger cells no face would remain";
    std::string text;
    for (const auto& [edges, what, hint] : reasons(r.blocked))
        if (edges > 0) append_item(text, fmt::format("{} {}", grouped(edges), what));
    return text.empty() ? "no collapse was left within the constraints"
                        : "the remaining edges are blocked: " + text;
}

std::string hint_for(const SimplifyResult& r) {
    const auto all = reasons(r.blocked);
    const auto most = std::max_element(all.begin(), all.end(),
                                       [](const Reason& a, const Reason& b) { return a.edges < b.edges; });
    return r.cell || most->edges == 0 ? "ask for more faces" : most->hint;
}

namespace {

using Stop = SimplifyResult::Stop;
using Shading = NormalSeams::Shading;

/// Reads a member of the part's result.
template <class T>
auto of_result(T SimplifyResult::*member) {
    return [member](const SimplifiedPart& p) -> const T& { return p.result.*member; };
}
/// Reads a length, in scene units.
auto of_length(std::optional<double> SimplifyResult::*member) {
    return [member](const SimplifiedPart& p) {
        const auto& length = p.result.*member;
        return length ? std::optional(*length * p.scale) : std::nullopt;
    };
}

void declare_blocked(DeclareFields<SimplifyResult::Blocked>& d) {
    using Blocked = SimplifyResult::Blocked;
    d.field("borders", &Blocked::borders, "Edges blocked by boundaries and locks.");
    d.field("seams", &Blocked::seams, "Edges blocked by seams, or by borders of materials and groups.");
    d.field("non_manifold", &Blocked::non_manifold, "Edges blocked by non-manifold vertices.");
    d.field("topology", &Blocked::topology,
            "Edges whose collapse would change the genus, close a hole, or make a component vanish.");
    d.field("flips", &Blocked::flips, "Edges whose collapse would flip or flatten a face.");
    d.field("error", &Blocked::error, "Edges whose collapse would exceed max_error or max_quadric_error.");
}

void declare_intersections(DeclareFields<SimplifyResult>& d) {
    const auto count = [](std::optional<std::size_t> SimplifyResult::*member) {
        return [member](const SimplifyResult& r) { return (r.*member).value_or(0); };
    };
    d.field("before", count(&SimplifyResult::intersections_before), "Intersecting pairs of faces before.");
    d.field("after", count(&SimplifyResult::intersections_after), "Intersecting pairs of faces after.");
    d.field("held_vertices", &SimplifyResult::held,
            "Vertices whose allowed error was reduced to avoid intersections.");
}

void declare_topology(DeclareFields<Properties>& d) {
    const auto help = [](const char* name) { return std::string(property_named(name)->help); };
    d.field("components", &Properties::components, help("components"));
    d.field("euler", &Properties::euler, help("euler"));
    d.field("genus", &Properties::genus, help("genus")).null_when("it does not apply");
    d.field("boundary_loops", &Properties::boundary_loops, help("boundary_loops"));
    d.field("closed", &Properties::closed, help("closed"));
    d.field("edge_manifold", &Properties::edge_manifold, help("edge_manifold"));
    d.field("vertex_manifold", &Properties::vertex_manifold, help("vertex_manifold"));
}

void declare_topologies(DeclareFields<SimplifiedPart::Topology>& d) {
    d.object("before", &SimplifiedPart::Topology::before, "Before the stage.", declare_topology);
    d.object("after", &SimplifiedPart::Topology::after, "After the stage.", declare_topology);
}

void declare_posed(DeclareFields<PosedDeviation>& d) {
    d.field("poses", &PosedDeviation::poses, "The number of compared poses.");
    d.field("maximum", &PosedDeviation::maximum, "The largest distance from either surface to the other.")
        .unit("scene units");
    d.field("percent", &PosedDeviation::percent,
            "The maximum in percent of the diagonal of the input in that pose.");
    d.field("pose", &PosedDeviation::pose, "The pose with the maximum.");
}

void declare_size(DeclareFields<SimplifiedPart::Size>& d) {
    d.field("area", &SimplifiedPart::Size::area, "The surface area.").unit("square scene units");
    d.field("volume", &SimplifiedPart::Size::volume, "The enclosed volume.")
        .unit("cubic scene units")
        .null_when("the part is not closed");
}

void declare_sizes(DeclareFields<SimplifiedPart::Sizes>& d) {
    d.object("before", &SimplifiedPart::Sizes::before, "Before the stage.", declare_size);
    d.object("after", &SimplifiedPart::Sizes::after, "After the stage.", declare_size);
}

void declare_counts(DeclareFields<SimplifiedPart>& d) {
    d.field("triangles_before", of_result(&SimplifyResult::faces_before), "Triangles of the input.");
    d.field("triangles_after", of_result(&SimplifyResult::faces_after), "Triangles of the result.");
    d.field("vertices_before", of_result(&SimplifyResult::vertices_before),
            "Vertices of the input that faces use.");
    d.field("vertices_after", of_result(&SimplifyResult::vertices_after), "Vertices of the result.");
    const auto ratio = [](const SimplifiedPart& p) {
        const double before = double(p.result.faces_before), after = double(p.result.faces_after);
        return before > 0 ? std::optional(after / before) : std::nullopt;
    };
    d.field("ratio", ratio, "The number of triangles after, divided by the number before.")
        .null_when("the input had no triangles");
    d.choice("stopped_by", of_result(&SimplifyResult::stop),
             {{"nothing to do", Stop::nothing, "the part already met every target"},
              {"ratio", Stop::ratio, "met"},
              {"faces", Stop::faces, "met"},
              {"vertices", Stop::vertices, "met"},
              {"max_error", Stop::max_error, "further collapses would exceed the deviation"},
              {"max_quadric_error", Stop::max_quadric_error, "further collapses would exceed the error"},
              {"stuck", Stop::stuck, "no remaining collapse preserves the guarantees"}},
             "The reason why simplification ended.");
}

/// Declares the counts of the work, and of the reasons why edges could not collapse.
void declare_work(DeclareFields<SimplifiedPart>& d) {
    d.field("largest_error", of_length(&SimplifyResult::largest_error),
            "The largest error of a collapse, as the method measures it.")
        .unit("scene units")
        .null_when("the method has none");
    d.field("max_quadric_error", &SimplifiedPart::max_quadric_error, "The limit on largest_error.")
        .unit("scene units")
        .null_when("the error was not limited");
    d.field("collapses", of_result(&SimplifyResult::collapses),
            "The number of collapses that led to the result.");
    d.object("blocked_edges", of_result(&SimplifyResult::blocked),
             "The reasons that block the remaining edges.", declare_blocked);
    d.field("cell", of_length(&SimplifyResult::cell), "The edge length of the cells.")
        .unit("scene units")
        .only_when("the method is cluster");
    const auto measured = [](std::size_t SimplifyResult::*member) {
        return [member](const SimplifiedPart& p) {
            return p.result.measured ? std::optional(p.result.*member) : std::nullopt;
        };
    };
    d.field("rolled_back", measured(&SimplifyResult::rolled_back), "Collapses that were undone.")
        .only_when("max_error is given");
    d.field("measurements", measured(&SimplifyResult::measurements),
            "How many times the deviation was measured.")
        .only_when("max_error is given");
    const auto counted = [](const SimplifiedPart& p) {
        std::optional<SimplifyResult> counts;
        if (!p.result.intersections_after) return counts;
        counts.emplace();
        counts->intersections_before = p.result.intersections_before;
        counts->intersections_after = p.result.intersections_after;
        counts->held = p.result.held;
        return counts;
    };
    d.object("self_intersections", counted, "Intersecting pairs of faces.", declare_intersections)
        .only_when("intersections are counted or avoided");
}

void declare_part(DeclareFields<SimplifiedPart>& d) {
    d.choice(
        "normals", of_result(&SimplifyResult::shading),
        {{"seams merged", Shading::smoothed, "seams were merged between faces that meet at a small angle"},
         {"flat shading kept", Shading::faceted, "faces get their own normals"},
         {"as given", Shading::as_given, "nothing was changed"}},
        "The handling of seams that differ only in normals.");
    d.field("merged_wedges", of_result(&SimplifyResult::merged_wedges), "Wedges that were merged.");
    const auto turned = [](const SimplifiedPart& p) {
        return p.result.turned > 0 ? std::optional(p.result.turned) : std::nullopt;
    };
    d.field("turned_faces", turned,
            "Faces that were reversed temporarily to match their neighbours. In the result they have their "
            "original orientation.")
        .only_when("such faces exist");
    declare_counts(d);
    declare_work(d);
    d.field("part", &SimplifiedPart::part, "The name of the part.");
    d.field("joint_with", &SimplifiedPart::joint_with,
            "The parts that were simplified together with this part.")
        .only_when("such faces exist");
    d.object("topology", &SimplifiedPart::topology, "The topology before and after.", declare_topologies)
        .only_when("the method may change the topology");
    d.object("size", &SimplifiedPart::sizes, "The area and the volume before and after.", declare_sizes)
        .only_when("measure or certify is on");
    d.object("deviation", &SimplifiedPart::deviation, "The deviation from the input of this stage.",
             declare_deviation_fields)
        .only_when("measure or certify is on");
    d.object("posed_deviation", &SimplifiedPart::posed,
             "The deviation in at most 32 poses: evenly chosen keys of all animations, and each morph target "
             "alone.",
             declare_posed)
        .only_when("the part has a skin or morph targets, and its deviation is measured");
}

// --- lines for the terminal

constexpr std::size_t few = 5; // more parts are summarized

std::string counts_text(std::uint64_t before, std::uint64_t after) {
    std::string text = fmt::format("{} -> {} triangles", grouped(before), grouped(after));
    if (before > 0) text += fmt::format(" ({})", percentage(100 * double(after) / double(before)));
    return text;
}

std::string deviation_text(const DeviationResult& d) {
    std::string text = fmt::format("deviation {} (rms {}", percentage(d.percent(d.maximum())),
                                   percentage(d.percent(d.rms())));
    if (const auto bound = d.bound(); bound && std::isfinite(d.percent(*bound)))
        text += fmt::format(", certified {}", percentage(d.percent(*bound)));
    return text + ") of the diagonal";
}

std::string stop_text(Stop stop) {
    switch (stop) {
    case Stop::nothing:
        return ", nothing to do";
    case Stop::ratio:
        return ", stopped by ratio";
    case Stop::faces:
        return ", stopped by faces";
    case Stop::vertices:
        return ", stopped by vertices";
    case Stop::max_error:
        return ", stopped by max_error";
    case Stop::max_quadric_error:
        return ", stopped by max_quadric_error";
    case Stop::stuck:
        break;
    }
    return ", stopped above the target";
}

bool is_measured(const SimplifiedPart& part) {
    const auto& d = part.deviation;
    return d && std::isfinite(d->percent(d->maximum())) && std::isfinite(d->percent(d->rms()));
}

std::string line_of(const SimplifiedPart& part) {
    const SimplifyResult& r = part.result;
    const std::string line =
        part.part + ": " + counts_text(r.faces_before, r.faces_after) + stop_text(r.stop);
    const std::string text = is_measured(part) ? line + "; " + deviation_text(*part.deviation) : line;
    if (!part.posed || !std::isfinite(part.posed->percent)) return text;
    return fmt::format("{}; {} in the worst of {} ({})", text, percentage(part.posed->percent),
                       counted(part.posed->poses, "pose"), part.posed->pose);
}

std::vector<std::string> lines_of(const SimplifyReport& report) {
    std::vector<std::string> lines;
    if (report.parts.size() <= few) {
        for (const auto& part : report.parts)
            if (part.result.faces_before > 0) lines.push_back(line_of(part));
        return lines;
    }
    std::uint64_t before = 0, after = 0;
    const SimplifiedPart* worst = nullptr;
    const auto percent = [](const SimplifiedPart& p) { return p.deviation->percent(p.deviation->maximum()); };
    for (const auto& part : report.parts) {
        before += part.result.faces_before;
        after += part.result.faces_after;
        if (is_measured(part) && (!worst || percent(part) > percent(*worst))) worst = &part;
    }
    lines.push_back(fmt::format("{} parts: {}", report.parts.size(), counts_text(before, after)));
    if (worst)
        lines.back() += fmt::format("; largest {} (part {})", deviation_text(*worst->deviation), worst->part);
    return lines;
}

} // namespace

void declare_simplify_report(DeclareFields<SimplifyReport>& d) {
    d.list("parts", &SimplifyReport::parts, "Every simplified part and every level of detail.", declare_part);
    d.tell(lines_of);
}

} // namespace facetmill::simplify_stage
