#include "geometry/orient/orient.hpp"

#include "mesh/placement.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

void declare(Declare<OrientSettings>& d) {
    d.choice<OrientMethod>(
         "method", &OrientSettings::method,
         {{"outward", OrientMethod::outward, "neighbours agree, and the front is the outside"},
          {"consistent", OrientMethod::consistent,
           "neighbours agree; the front is what most faces had as front"},
          {"flip", OrientMethod::flip, "every face is turned round"}},
         "What is done to the order of corners.")
        .primary();
    d.choice<Nested>("nested", &OrientSettings::nested,
                     {{"cavities", Nested::cavities, "it is a cavity, its front looks into the hollow"},
                      {"solids", Nested::solids, "it is a solid of its own"}},
                     "What a closed piece inside another is (with outward).");
}

struct OrientedPart {
    std::string part;
    std::size_t flipped_faces = 0, pieces = 0, closed = 0, nested = 0, non_orientable = 0, undecided = 0;
};

struct OrientReport {
    std::vector<OrientedPart> parts;
};

void declare_part(DeclareFields<OrientedPart>& d) {
    d.field("part", &OrientedPart::part, "Its name.");
    d.field("flipped_faces", &OrientedPart::flipped_faces, "Faces that were turned round.");
    d.field("pieces", &OrientedPart::pieces, "Pieces that are connected through edges of two faces.");
    d.field("closed_pieces", &OrientedPart::closed, "Those of them that are closed.");
    d.field("nested_pieces", &OrientedPart::nested, "Those that lie inside another.");
    d.field("non_orientable_pieces", &OrientedPart::non_orientable, "Those that stayed as they were.");
    d.field("undecided_pieces", &OrientedPart::undecided, "Those without a side that is the outside.");
}

void declare_report(DeclareFields<OrientReport>& d) {
    d.list("parts", &OrientReport::parts, "Each part that was oriented.", declare_part).tallied("no faces");
}

OrientedPart counted(const Part& part, const OrientResult& r) {
    const auto count = [&](auto&& is) {
        return static_cast<std::size_t>(std::count_if(r.pieces.begin(), r.pieces.end(), is));
    };
    using Piece = OrientedPiece;
    return {part.name,
            r.flipped,
            r.pieces.size(),
            count([](const Piece& p) { return p.closed; }),
            count([](const Piece& p) { return p.depth > 0; }),
            count([](const Piece& p) { return !p.orientable; }),
            count([](const Piece& p) { return p.undecided; })};
}

/// Pieces that could not be oriented, or whose outside could not be told.
void warn(const Part& part, const OrientResult& r, Context& context) {
    std::size_t crossed = 0, undecided = 0;
    const OrientedPiece* first = nullptr;
    for (const auto& p : r.pieces) {
        if (!p.orientable && crossed++ == 0) first = &p;
        undecided += p.undecided;
    }
    if (crossed > 0) {
        const Vec3 at = in_world(part, first->conflict);
        context.warn(
            "W-ORIENT",
            fmt::format(
                "orient: {} of part '{}' is not orientable, like a Moebius strip, and stays as it was; "
                "neighbours cannot agree at ({:.6g}, {:.6g}, {:.6g})",
                crossed == 1 ? "a piece" : fmt::format("{} pieces", crossed), part.name, at.x, at.y, at.z),
            "cut it there, or make it two-sided");
    }
    if (undecided > 0)
        context.warn(
            "W-ORIENT-OPEN",
            fmt::format("orient: {} of part '{}' without a side that is the outside: only made consistent",
                        undecided == 1 ? "a piece" : fmt::format("{} pieces", undecided), part.name),
            "flip turns them round");
}

Scene run(Scene scene, const OrientSettings& settings, Context& context, OrientReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        OrientResult r = orient(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        warn(part, r, context);
        report.parts.push_back(counted(part, r));
    });
    return scene;
}

const RegisterStage registered = make_stage<OrientSettings>(
    {.name = "orient",
     .about = "Makes neighbouring faces agree about the outside, and turns the front outward.",
     .details = "Order is spread over edges of two faces; edges of more part the surface into pieces. The "
                "outside of a closed "
                "piece is told by its volume and by how many closed pieces it lies in: one inside another is "
                "its cavity and "
                "looks inward, one inside a cavity outward again; pieces that touch or cross are no cavities "
                "of each other. That is decided exactly, by rays along an "
                "axis that never "
                "hit an edge. The outside of an open piece is the side from which more rays escape; where "
                "both sides are alike "
                "(a flat sheet) it is only made consistent (W-ORIENT-OPEN). A piece that cannot be oriented, "
                "like a Moebius "
                "strip, stays as it was and is named (W-ORIENT).\n\n"
                "A part whose node mirrors is looked at in its own space, as glTF has it. Corners are "
                "reversed from the second "
                "on. Normals that then point against their faces turn, and the handedness of their tangents; "
                "all else is "
                "kept.\n\n"
                "Source: the note on facets, normals and vertex order.",
     .examples = {"orient", "orient: consistent", "orient: flip", "orient: {nested: solids}"}},
    declare, declare_report, run);

} // namespace

} // namespace facetmill
