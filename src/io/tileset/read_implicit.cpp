#include "io/gltf/document/container.hpp"
#include "io/tileset/files.hpp"
#include "io/tileset/implicit.hpp"

#include <deque>
#include <fmt/format.h>

namespace facetmill::io::tileset {

namespace {

using gltf::JsonCursor;

constexpr std::size_t most_places = std::size_t{1} << 22; // largest number of tiles in a subtree
constexpr std::size_t most_contents = std::size_t{1} << 22;

[[noreturn]] void too_many(const JsonCursor& place) {
    place.fail("has more tiles than facetmill supports", "E-LIMIT", "load some of its tiles");
}

/// A tile in the quadtree (z stays 0) or octree.
struct Coordinates {
    std::uint64_t level = 0, x = 0, y = 0, z = 0;
};

/// The template with the coordinates filled in.
std::string expanded(std::string text, const Coordinates& at) {
    for (const auto& [name, value] :
         {std::pair{"{level}", at.level}, {"{x}", at.x}, {"{y}", at.y}, {"{z}", at.z}})
        for (std::size_t i = 0; (i = text.find(name, i)) != std::string::npos;)
            text.replace(i, std::string_view(name).size(), std::to_string(value));
    return text;
}

/// The tree's parameters from an implicit tile.
struct Scheme {
    std::size_t dimensions = 2, subtree_levels = 1, levels = 1;
    std::vector<std::string> contents; ///< URI templates
    std::string subtrees;

    explicit Scheme(const JsonCursor& tile) {
        const JsonCursor implicit = tile.at("implicitTiling");
        const std::string scheme = implicit.at("subdivisionScheme").text();
        if (scheme != "QUADTREE" && scheme != "OCTREE")
            implicit.at("subdivisionScheme").fail("expected QUADTREE or OCTREE", "E-TILESET");
        dimensions = scheme == "OCTREE" ? 3 : 2;
        constexpr std::uint64_t deepest = 63; // coordinates have 64 bits
        levels = implicit.at("availableLevels").natural(deepest);
        subtree_levels = implicit.at("subtreeLevels").natural(deepest);
        if (levels == 0 || subtree_levels == 0) implicit.fail("expected at least one level", "E-TILESET");
        if (dimensions * subtree_levels > std::bit_width(most_places) - 1)
            too_many(implicit.at("subtreeLevels"));
        subtrees = text_of(implicit.at("subtrees").at("uri"));
        if (const auto content = tile.find("content")) contents.push_back(text_of(content->at("uri")));
        const auto several = tile.find("contents");
        for (std::size_t i = 0; several && i < several->size(); ++i)
            contents.push_back(text_of(several->at(i).at("uri")));
    }
    std::size_t places_in_level(std::size_t level) const { return std::size_t{1} << (dimensions * level); }
    /// The number of tiles above this level.
    std::size_t places_above(std::size_t level) const {
        return (places_in_level(level) - 1) / (places_in_level(1) - 1);
    }

  private:
    /// Requires all variables in the template; otherwise tiles would share files.
    std::string text_of(const JsonCursor& uri) const {
        const std::string text = uri.text();
        for (const char* name : {"{level}", "{x}", "{y}", "{z}"})
            if (text.find(name) == std::string::npos && (dimensions == 3 || name != std::string_view("{z}")))
                uri.fail(fmt::format("expected {} in the template '{}'", name, text), "E-TILESET");
        return text;
    }
};

Coordinates child_of(const Coordinates& at, std::size_t levels, std::size_t morton, std::size_t dimensions) {
    Coordinates child{at.level + levels, at.x << levels, at.y << levels, at.z << levels};
    for (std::size_t bit = 0; bit < levels; ++bit) {
        const std::size_t digit = morton >> (dimensions * bit);
        child.x |= static_cast<std::uint64_t>(digit & 1) << bit;
        child.y |= static_cast<std::uint64_t>(digit >> 1 & 1) << bit;
        if (dimensions == 3) child.z |= static_cast<std::uint64_t>(digit >> 2 & 1) << bit;
    }
    return child;
}

/// One bit per tile.
class Availability {
  public:
    Availability(const JsonCursor& place, std::size_t count, const std::vector<Span>& views) {
        if (const auto constant = place.find("constant")) {
            constant_ = constant->natural(1) == 1;
            return;
        }
        const JsonCursor bitstream = place.at("bitstream");
        bits_ = views[bitstream.index(views.size(), "bufferViews")];
        if (bits_.size() < (count + 7) / 8)
            bitstream.fail(
                fmt::format("has {} bytes, but {} tiles need {}", bits_.size(), count, (count + 7) / 8),
                "E-TILESET");
    }
    bool operator[](std::size_t place) const {
        if (bits_.empty()) return constant_;
        return (std::to_integer<unsigned>(bits_[place / 8]) >> (place % 8) & 1) != 0;
    }

  private:
    bool constant_ = false;
    Span bits_;
};

/// A subtree file, in binary form or as JSON.
struct Subtree {
    Json json;
    Span binary;

    explicit Subtree(Span bytes) {
        constexpr std::size_t header = 24;
        if (!as_text(bytes).starts_with("subt")) {
            json = gltf::parse_document(as_text(bytes));
            return;
        }
        const auto wrong = [](std::string message) {
            throw Error(ErrorKind::malformed, "E-TILESET", std::move(message));
        };
        if (bytes.size() < header) wrong("the header of a subtree has 24 bytes");
        if (const auto version = little_endian(bytes, 4, 4); version != 1)
            wrong(fmt::format("expected version 1 of subtrees, found {}", version));
        const std::uint64_t text = little_endian(bytes, 8, 8), rest = little_endian(bytes, 16, 8);
        const std::uint64_t there = bytes.size() - header;
        if (text > there || rest > there - text)
            wrong(fmt::format("its header announces {} and {} bytes, but {} follow it", text, rest, there));
        json = gltf::parse_document(as_text(bytes.subspan(header, text)));
        binary = bytes.subspan(header + text, rest);
    }
};

class ImplicitReader {
  public:
    ImplicitReader(const JsonCursor& tile, bool replaces, const Input& tileset)
        : tile_(tile), scheme_(tile), replaces_(replaces), tileset_(tileset) {}

    ImplicitContents run() {
        std::deque<Coordinates> subtrees = {{}};
        for (; !subtrees.empty(); subtrees.pop_front()) {
            const Coordinates root = subtrees.front();
            const Input file = file_below(tileset_, expanded(scheme_.subtrees, root),
                                          tile_.path() + ".implicitTiling.subtrees");
            found_.files.push_back(file);
            gltf::in_file(file, [&] { visit(Subtree(file.bytes()), file, root, subtrees); });
        }
        return std::move(found_);
    }

  private:
    std::vector<Span> views_of(const Subtree& subtree, const Input& file) {
        std::vector<Span> buffers, views;
        const Json& json = subtree.json;
        for (std::size_t b = 0; b < gltf::count_of(json, "buffers"); ++b) {
            const JsonCursor buffer = gltf::item(json, "buffers", b);
            const auto uri = buffer.find("uri");
            if (uri) found_.files.push_back(file_below(file, uri->text(), uri->path()));
            buffers.push_back(uri ? found_.files.back().bytes() : subtree.binary);
        }
        for (std::size_t v = 0; v < gltf::count_of(json, "bufferViews"); ++v) {
            const JsonCursor view = gltf::item(json, "bufferViews", v);
            const Span buffer = buffers[view.at("buffer").index(buffers.size(), "buffers")];
            const std::uint64_t from = view.natural_or("byteOffset", 0);
            const std::uint64_t bytes = view.at("byteLength").natural();
            if (from > buffer.size() || bytes > buffer.size() - from)
                view.fail(fmt::format("ends beyond the {} bytes of its buffer", buffer.size()), "E-TILESET");
            views.push_back(buffer.subspan(from, bytes));
        }
        return views;
    }

    void visit(const Subtree& subtree, const Input& file, const Coordinates& root,
               std::deque<Coordinates>& subtrees) {
        const std::vector<Span> views = views_of(subtree, file);
        const JsonCursor json(subtree.json, "");
        const std::size_t levels = scheme_.subtree_levels, all = scheme_.places_above(levels);
        const Availability tiles(json.at("tileAvailability"), all, views);
        const Availability below(json.at("childSubtreeAvailability"), scheme_.places_in_level(levels), views);
        if (!tiles[0]) json.at("tileAvailability").fail("leaves out the first tile", "E-TILESET");
        std::vector<Availability> contents;
        const auto listed = json.find("contentAvailability");
        for (std::size_t i = 0; listed && i < std::min(listed->size(), scheme_.contents.size()); ++i)
            contents.emplace_back(listed->at(i), all, views);
        const std::size_t fan = scheme_.places_in_level(1);
        for (std::size_t level = 0; level < levels && root.level + level < scheme_.levels; ++level)
            for (std::size_t m = 0; m < scheme_.places_in_level(level); ++m) {
                const std::size_t place = scheme_.places_above(level) + m;
                if (!tiles[place]) continue;
                bool is_refined = false;
                const bool last = level + 1 == levels;
                for (std::size_t c = 0; c < fan && root.level + level + 1 < scheme_.levels; ++c) {
                    if (!last) {
                        is_refined |= tiles[scheme_.places_above(level + 1) + fan * m + c];
                    } else if (below[fan * m + c]) {
                        is_refined = true;
                        subtrees.push_back(child_of(root, levels, fan * m + c, scheme_.dimensions));
                    }
                }
                if (is_refined && replaces_) continue;
                const Coordinates at = child_of(root, level, m, scheme_.dimensions);
                for (std::size_t i = 0; i < contents.size(); ++i)
                    if (contents[i][place]) found_.uris.push_back(expanded(scheme_.contents[i], at));
                if (found_.uris.size() + subtrees.size() > most_contents) too_many(tile_);
            }
    }

    const JsonCursor tile_;
    Scheme scheme_;
    bool replaces_;
    const Input& tileset_;
    ImplicitContents found_;
};

} // namespace

ImplicitContents read_implicit(const JsonCursor& tile, bool replaces, const Input& tileset) {
    return ImplicitReader(tile, replaces, tileset).run();
}

} // namespace facetmill::io::tileset
