#include "base/text/words.hpp"
#include "geometry/cut/cut.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "mesh/unit_text.hpp"
#include "stage/bind_pose.hpp"
#include "stage/context.hpp"
#include "stage/options/cap.hpp"
#include "stages/tile/help.hpp"
#include "stages/tile/options.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::tile_stage {

namespace {

struct ReportedTile {
    std::string part;
    std::array<std::optional<std::int64_t>, 3> cell{}; ///< the cell by axis, for the cut axes
    std::size_t faces = 0;
};

struct ReportedPeg {
    std::string low, high;
    Vec3 at;
};

struct TileReport {
    std::vector<ReportedTile> tiles;
    std::optional<std::vector<ReportedPeg>> pegs;
    std::optional<std::size_t> without_pegs;
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0;
};

void declare_tile(DeclareFields<ReportedTile>& d) {
    d.field("part", &ReportedTile::part, "The name of the tile.");
    for (std::size_t axis = 0; axis < 3; ++axis)
        d.field(
             std::string("tile_") + "xyz"[axis], [axis](const ReportedTile& t) { return t.cell[axis]; },
             "The index along this axis.")
            .only_when("this axis is cut");
    d.field("faces", &ReportedTile::faces, "The number of faces.");
}

void declare_peg(DeclareFields<ReportedPeg>& d) {
    d.field("low", &ReportedPeg::low, "The tile before the peg, along the axis of the peg. It has the peg.");
    d.field("high", &ReportedPeg::high, "The tile above it.");
    d.field("at", &ReportedPeg::at, "Its position in the plane between both tiles.").unit("scene units");
}

void declare_report(DeclareFields<TileReport>& d) {
    constexpr const char* pegs = "pegs is given";
    d.list("tiles", &TileReport::tiles, "Each tile with faces or points.", declare_tile);
    d.list("pegs", &TileReport::pegs, "Each peg, dowel or magnet.", declare_peg).only_when(pegs);
    d.field("without_pegs", &TileReport::without_pegs, "Pairs of neighbours without room for a peg.")
        .only_when(pegs);
    d.field("cut_faces", &TileReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &TileReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &TileReport::open_contours,
            "Contours that were not capped because they are open.");
}

/// The name of a tile, such as "body.x0.y-1". Tiles of `fit` also get a number from 1: "body.04.x0.y1.z1".
std::string name_of(const Part& part, const Tile& tile, const std::vector<TileAxis>& axes,
                    const std::string& number) {
    std::string name = part.name + number;
    for (const TileAxis& a : axes) name += fmt::format(".{}{}", "xyz"[a.axis], tile.cell[a.axis]);
    return name;
}

/// Warns about neighbours without a peg.
void warn_without_pegs(const Part& part, const PegsResult& pegs, const std::vector<std::string>& names,
                       Context& context) {
    if (pegs.without.empty()) return;
    std::string pairs;
    constexpr std::size_t most = 5;
    for (std::size_t i = 0; i < std::min(most, pegs.without.size()); ++i)
        append_item(
            pairs, fmt::format("'{}' and '{}'", names[pegs.without[i].first], names[pegs.without[i].second]));
    if (pegs.without.size() > most) pairs += fmt::format(", and {} more", pegs.without.size() - most);
    context.warn("W-TILE-PEGS",
                 fmt::format("tile: part '{}' has no room for a peg at {} of tiles: {}", part.name,
                             counted(pegs.without.size(), "pair"), pairs),
                 "use a smaller diameter, length or wall, or glue them");
}

class TileRun {
  public:
    TileRun(const TileOptions& o, const Scene& scene, Context& context)
        : o_(o), context_(context), pegs_(pegs_of(o, scene, context)) {
        if (!o.fits()) settings_.axes = grid_of(o, scene, context);
        settings_.clip.snap = true;
    }

    Scene run(Scene scene, TileReport& report) {
        if (o_.caps()) set_cap(settings_.clip, scene, o_.cap_material);
        if (pegs_) {
            pegs_->primitive = settings_.clip.cap_primitive;
            report.pegs.emplace();
            report.without_pegs = 0;
        }
        std::vector<Part> parts;
        std::vector<const Part*> cut;
        context_.for_each_part(scene, [&](Part& part) { cut.push_back(&part); });
        auto next = cut.begin(); // parts are in the scene's order
        for (Part& part : scene.parts) {
            if (next == cut.end() || *next != &part) {
                parts.push_back(std::move(part));
                continue;
            }
            ++next;
            if (o_.fits()) settings_.axes = grid_of_part(part, scene);
            if (o_.fits() && settings_.axes.empty() && part.mesh.vertex_count() > 0)
                keep_part(part, parts, report);
            else
                cut_part(part, parts, report);
        }
        scene.parts = std::move(parts);
        if (report.cap_faces > 0) add_material(scene, o_.cap_material);
        return scene;
    }

  private:
    std::vector<TileAxis> grid_of_part(const Part& part, const Scene& scene) {
        const Box box = box_of(in_world(part).positions);
        return box.empty() ? std::vector<TileAxis>{}
                           : fitted_grid(o_, box, pegs_ ? protrusion(*pegs_) : 0, scene, context_);
    }

    /// A part that fits is its own only tile.
    static void keep_part(Part& part, std::vector<Part>& parts, TileReport& report) {
        auto& entry = report.tiles.emplace_back();
        entry.part = part.name;
        entry.faces = part.mesh.face_count();
        parts.push_back(std::move(part));
    }

    void cut_part(Part& part, std::vector<Part>& parts, TileReport& report) {
        settings_.to_world = part.transform;
        settings_.clip.memory = part.cuts ? *part.cuts : CutMemory{};
        const Mesh whole = pegs_ ? whole_of(part) : Mesh{};
        TileResult r = tile(std::move(part.mesh), settings_);
        part.mesh = {};
        warn_of_open("tile", part, r.open, context_);
        context_.attribute_changes(part, r.changes);
        report.cut_faces += r.cut_faces;
        report.cap_faces += r.cap_faces;
        report.open_contours += r.open.size();
        if (r.tiles.empty())
            context_.warn("W-TILE-NOTHING",
                          fmt::format("tile: part '{}' is empty and gives no tile", part.name));
        const std::vector<std::string> names = names_of(part, r.tiles);
        if (pegs_) join(part, whole, r.tiles, names, report);
        const auto cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        for (std::size_t i = 0; i < r.tiles.size(); ++i) {
            Tile& t = r.tiles[i];
            Part& piece = parts.emplace_back(part);
            piece.name = names[i];
            piece.mesh = std::move(t.mesh);
            piece.cuts = cuts;
            auto& entry = report.tiles.emplace_back();
            entry.part = piece.name;
            for (const TileAxis& a : settings_.axes) entry.cell[a.axis] = t.cell[a.axis];
            entry.faces = piece.mesh.face_count();
        }
    }

    /// A copy of the solid, which pegs must stay inside.
    static Mesh whole_of(const Part& part) {
        Mesh whole = bare(part.mesh);
        if (whole.face_count() == 0 || !is_closed(whole) || !inverse(part.transform))
            throw Error(
                ErrorKind::stage, "E-TILE",
                fmt::format("tile: part '{}' is not a closed solid, so it cannot get pegs", part.name),
                "use clean: {holes: minimal} first to close it, or leave pegs out");
        return whole;
    }

    std::vector<std::string> names_of(const Part& part, const std::vector<Tile>& tiles) const {
        std::vector<std::string> names;
        names.reserve(tiles.size());
        const std::size_t digits = std::to_string(tiles.size()).size();
        for (std::size_t i = 0; i < tiles.size(); ++i)
            names.push_back(name_of(part, tiles[i], settings_.axes,
                                    o_.fits() ? fmt::format(".{:0{}}", i + 1, digits) : std::string()));
        return names;
    }

    void join(const Part& part, const Mesh& whole, std::vector<Tile>& tiles,
              const std::vector<std::string>& names, TileReport& report) {
        const PegsResult pegs = add_pegs(tiles, whole, settings_, *pegs_);
        if (pegs.failure)
            throw Error(ErrorKind::stage, "E-TILE",
                        fmt::format("tile: '{}' cannot get its pegs: {}", names[pegs.failure->first],
                                    pegs.failure->second),
                        "use clean: {self_intersections: union} first to repair the part, or leave pegs out");
        warn_without_pegs(part, pegs, names, context_);
        *report.without_pegs += pegs.without.size();
        for (const Peg& peg : pegs.pegs) report.pegs->push_back({names[peg.low], names[peg.high], peg.at});
    }

    const TileOptions& o_;
    Context& context_;
    TileSettings settings_; ///< shared by all parts, except transform, memory and the grid of `fit`
    std::optional<PegSettings> pegs_;
};

/// Replaces each selected part by its tiles. Warns about open contours (W-CAP-OPEN), parts without faces
/// (W-TILE-NOTHING) and tiles without room for pegs (W-TILE-PEGS).
Scene run(Scene scene, const TileOptions& o, Context& context, TileReport& report) {
    warn_of_bind_pose(scene, context);
    TileRun tiles(o, scene, context);
    return tiles.run(std::move(scene), report);
}

struct TileStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_tile(o, given, problems); }
};

const RegisterStage registered =
    make_stage<TileStage>({.name = "tile",
                           .also_called = "chunk tiler",
                           .about = help::tile::about,
                           .details = help::tile::details,
                           .examples = {"tile: 100", "tile: {size: 100, axes: xy, origin: [0, 0]}",
                                        "tile: {size: [10mm, 20mm, 5mm], axes: xyz, cap: true}",
                                        "tile: {fit: [200mm, 200mm, 180mm]}",
                                        "tile: {fit: 200mm, pegs: {diameter: 6mm, clearance: 0.2mm}}"},
                           .crossing_faces = CrossingFacePolicy::fill},
                          declare_tile_options, declare_report);

} // namespace

} // namespace facetmill::tile_stage
