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

    Scene run(Scene scene, const std::string& cap_material) {
        if (settings_.clip.cap) set_cap(settings_.clip, scene, cap_material);
        std::vector<Part> parts;
        std::vector<const Part*> cut;
        context_.for_each_part(scene, [&](Part& part) { cut.push_back(&part); });
        Json tiles = Json::array();
        for (Part& part : scene.parts) {
            if (std::find(cut.begin(), cut.end(), &part) == cut.end())
                parts.push_back(std::move(part));
            else
                cut_part(part, parts, tiles);
        }
        scene.parts = std::move(parts);
        if (cap_faces_ > 0) add_material(scene, cap_material);
        Json& result = context_.result();
        result["tiles"] = std::move(tiles);
        result["cut_faces"] = cut_faces_;
        result["cap_faces"] = cap_faces_;
        result["open_contours"] = open_;
        return scene;
    }

  private:
    void cut_part(Part& part, std::vector<Part>& parts, Json& tiles) {
        settings_.to_world = effective(part);
        settings_.clip.memory = part.cuts ? *part.cuts : CutMemory{};
        TileResult r = tile(std::move(part.mesh), settings_);
        part.mesh = {};
        warn_of_open("tile", part, r.open, context_);
        context_.ledger(part, r.fates);
        cut_faces_ += r.cut_faces, cap_faces_ += r.cap_faces, open_ += r.open.size();
        if (r.tiles.empty())
            context_.warn("W-TILE-NOTHING",
                          fmt::format("tile: part '{}' has no faces and gives no tile", part.name));
        const auto cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        for (Tile& t : r.tiles) {
            Part& piece = parts.emplace_back(part);
            piece.name = name_of(part, t, settings_.axes);
            piece.mesh = std::move(t.mesh);
            piece.cuts = cuts;
            Json entry = {{"part", piece.name}};
            for (const TileAxis& a : settings_.axes)
                entry[std::string("tile_") + "xyz"[a.axis]] = t.cell[a.axis];
            entry["faces"] = piece.mesh.face_count();
            tiles.push_back(std::move(entry));
        }
    }

    Context& context_;
    TileSettings settings_;
    std::size_t cut_faces_ = 0, cap_faces_ = 0, open_ = 0;
};

} // namespace

Scene tile_parts(Scene scene, const TileSettings& settings, const std::string& cap_material,
                 Context& context) {
    return TileRun(settings, context).run(std::move(scene), cap_material);
}

} // namespace facetmill
