#include "io/tileset/implicit.hpp"

#include "io/images/image_files.hpp"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <map>

namespace facetmill::io::tileset {

namespace {

constexpr std::size_t children_of_tile = 4;
constexpr std::string_view subtree_magic = "subt";

/// The number of tiles of a full quadtree of `levels` levels.
constexpr std::size_t places_of(std::size_t levels) {
    return ((std::size_t{1} << (2 * levels)) - 1) / (children_of_tile - 1);
}

/// The levels of the whole tree, and of each subtree file. Subtree files have nearly equal numbers of
/// levels, at most six, because 1,365 tiles take 140 kB.
struct Levels {
    std::size_t all = 0, of_subtree = 1;

    explicit Levels(const std::vector<TreeTile>& tiles) {
        constexpr std::size_t most = 6;
        for (const TreeTile& tile : tiles) all = std::max(all, tile.name.size() + 1);
        const std::size_t subtrees = (all + most - 1) / most;
        of_subtree = (all + subtrees - 1) / subtrees;
    }
};

/// The Morton index, in its level, of the tile with this path of child digits.
std::size_t morton_of(std::string_view way) {
    std::size_t place = 0;
    for (const char digit : way) place = place * children_of_tile + static_cast<std::size_t>(digit - '0');
    return place;
}

template <class T>
void put_number(Bytes& out, T value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) out.push_back(static_cast<std::byte>(bits & 0xff));
}

void pad(Bytes& out, std::byte with) {
    while (out.size() % 8 != 0) out.push_back(with);
}

/// The binary data of a subtree file: columns that begin at multiples of 8 bytes.
class Columns {
  public:
    std::size_t add(const Bytes& column) {
        views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", column.size()}});
        bytes_.insert(bytes_.end(), column.begin(), column.end());
        pad(bytes_, std::byte{0});
        return views_.size() - 1;
    }
    /// The availability with bits set for these tiles.
    Json availability(const std::vector<std::size_t>& places, std::size_t count) {
        if (places.empty()) return {{"constant", 0}};
        Bytes bits((count + 7) / 8);
        for (const std::size_t p : places) bits[p / 8] |= static_cast<std::byte>(1U << (p % 8));
        return {{"bitstream", add(bits)}, {"availableCount", places.size()}};
    }
    /// The whole file: the JSON, extended by the buffer views, and the columns.
    Bytes file(Json json) const {
        json["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
        json["bufferViews"] = views_;
        Bytes text = bytes_of_text(json.dump());
        pad(text, std::byte{' '});
        Bytes out = bytes_of_text(subtree_magic);
        for (const int byte : {1, 0, 0, 0}) out.push_back(static_cast<std::byte>(byte)); // version
        put_number(out, std::uint64_t{text.size()});
        put_number(out, std::uint64_t{bytes_.size()});
        out.insert(out.end(), text.begin(), text.end());
        out.insert(out.end(), bytes_.begin(), bytes_.end());
        return out;
    }

  private:
    Json views_ = Json::array();
    Bytes bytes_;
};

struct TilesOfSubtree {
    std::map<std::size_t, const TreeTile*> tiles; ///< tiles by their index in the subtree
    std::vector<std::size_t> below;               ///< indices of the child subtrees
};

Bytes subtree_file(const TilesOfSubtree& subtree, std::size_t levels) {
    Columns columns;
    std::vector<std::size_t> places;
    Bytes boxes, errors;
    for (const auto& [place, tile] : subtree.tiles) {
        places.push_back(place);
        for (const double number : numbers_of_box(tile->all)) put_number(boxes, number);
        put_number(errors, tile->error);
    }
    Json json;
    json["tileAvailability"] = columns.availability(places, places_of(levels));
    json["contentAvailability"] = Json::array({json["tileAvailability"]}); // no tile is empty
    json["childSubtreeAvailability"] = columns.availability(subtree.below, std::size_t{1} << (2 * levels));
    json["propertyTables"] = Json::array({{{"class", "tile"},
                                           {"count", subtree.tiles.size()},
                                           {"properties",
                                            {{"boundingBox", {{"values", columns.add(boxes)}}},
                                             {"geometricError", {{"values", columns.add(errors)}}}}}}});
    json["tileMetadata"] = 0;
    return columns.file(std::move(json));
}

} // namespace

std::string implicit_name(const std::string& name) {
    std::uint64_t x = 0, y = 0;
    for (const char digit : name) {
        const auto child = static_cast<std::uint64_t>(digit - '0');
        x = 2 * x + (child & 1);
        y = 2 * y + (child >> 1);
    }
    return fmt::format("{}-{}-{}", name.size(), x, y);
}

void add_implicit_tiling(Json& tileset, const std::vector<TreeTile>& tiles, const std::string& title) {
    const Levels levels(tiles);
    const auto uri_for = [&](const char* suffix) {
        return fmt::format("{}/{{level}}-{{x}}-{{y}}.{}", uri_of(title), suffix);
    };
    Json& root = tileset["root"];
    root["content"] = {{"uri", uri_for("glb")}};
    root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                              {"subtreeLevels", levels.of_subtree},
                              {"availableLevels", levels.all},
                              {"subtrees", {{"uri", uri_for("subtree")}}}};
    const Json number = {{"type", "SCALAR"}, {"componentType", "FLOAT64"}, {"required", true}};
    Json box = number, error = number;
    box.update({{"array", true}, {"count", 12}, {"semantic", "TILE_BOUNDING_BOX"}});
    error["semantic"] = "TILE_GEOMETRIC_ERROR";
    tileset["schema"] = {
        {"id", "tiles"},
        {"classes", {{"tile", {{"properties", {{"boundingBox", box}, {"geometricError", error}}}}}}}};
}

std::vector<OutputFile> subtree_files(const std::vector<TreeTile>& tiles, const std::string& title) {
    const std::size_t levels = Levels(tiles).of_subtree;
    std::map<std::pair<std::size_t, std::string>, TilesOfSubtree> subtrees; // subtrees by level and root
    for (const TreeTile& tile : tiles) {
        const std::size_t level = tile.name.size() % levels;
        const std::string root = tile.name.substr(0, tile.name.size() - level);
        const std::size_t place = places_of(level) + morton_of(tile.name.substr(root.size()));
        subtrees[{root.size(), root}].tiles[place] = &tile;
    }
    for (const auto& [key, subtree] : subtrees) {
        const auto& [level, root] = key;
        if (level == 0) continue;
        const std::string above = root.substr(0, level - levels);
        subtrees.at({above.size(), above}).below.push_back(morton_of(root.substr(above.size())));
    }
    std::vector<OutputFile> files;
    files.reserve(subtrees.size());
    for (const auto& [key, subtree] : subtrees)
        files.push_back(
            {fmt::format("{}/{}.subtree", title, implicit_name(key.second)), subtree_file(subtree, levels)});
    return files;
}

} // namespace facetmill::io::tileset
