#include "stages/tile/parts.hpp"

#include "mesh/placement.hpp"
#include "stage/options/cap.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// "body.x0.y-1"
std::string name_of(const Part& part, const Tile& tile, const std::vector<TileAxis>& axes) {
    std::string name = part.name;
    for (const TileAxis& a : axes) name += fmt::format(".{}{}", "xyz"[a.axis], tile.cell[a.axis]);
    return name;
}

class TileRun {
  public:
    TileRun(const TileSettings& settings, Context& context) : context_(context), settings_(settings) {}

    Scene run(Scene scene, const std::string& cap_material, TileReport& report) {
        if (settings_.clip.cap) set_cap(settings_.clip, scene, cap_material);
        std::vector<Part> parts;
        std::vector<const Part*> cut;
        context_.for_each_part(scene, [&](Part& part) { cut.push_back(&part); });
        for (Part& part : scene.parts) {
            if (std::find(cut.begin(), cut.end(), &part) == cut.end())
                parts.push_back(std::move(part));
            else
                cut_part(part, parts, report);
        }
        scene.parts = std::move(parts);
        if (report.cap_faces > 0) add_material(scene, cap_material);
        return scene;
    }

  private:
    void cut_part(Part& part, std::vector<Part>& parts, TileReport& report) {
        settings_.to_world = effective(part);
        settings_.clip.memory = part.cuts ? *part.cuts : CutMemory{};
        TileResult r = tile(std::move(part.mesh), settings_);
        part.mesh = {};
        warn_of_open("tile", part, r.open, context_);
        context_.attribute_changes(part, r.changes);
        report.cut_faces += r.cut_faces;
        report.cap_faces += r.cap_faces;
        report.open_contours += r.open.size();
        if (r.tiles.empty())
            context_.warn("W-TILE-NOTHING",
                          fmt::format("tile: part '{}' has no faces and gives no tile", part.name));
        const auto cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        for (Tile& t : r.tiles) {
            Part& piece = parts.emplace_back(part);
            piece.name = name_of(part, t, settings_.axes);
            piece.mesh = std::move(t.mesh);
            piece.cuts = cuts;
            auto& entry = report.tiles.emplace_back();
            entry.part = piece.name;
            for (const TileAxis& a : settings_.axes) entry.cell[a.axis] = t.cell[a.axis];
            entry.faces = piece.mesh.face_count();
        }
    }

    Context& context_;
    TileSettings settings_;
};

} // namespace

Scene tile_parts(Scene scene, const TileSettings& settings, const std::string& cap_material, Context& context,
                 TileReport& report) {
    return TileRun(settings, context).run(std::move(scene), cap_material, report);
}

} // namespace facetmill
