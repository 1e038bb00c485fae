#include "io/footprint/footprint.hpp"

#include "base/json.hpp"
#include "base/math/numbers.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/footprint/chains.hpp"
#include "io/footprint/dxf.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::io {

namespace {

bool is_dxf(std::string_view text) {
    const std::string_view head = text.substr(0, 4096);
    const char* at = head.data();
    std::int64_t code = 0;
    return scan_integer(at, head.data() + head.size(), code) &&
           head.find("SECTION") != std::string_view::npos;
}

Diagnostic warning_of_degrees(const char* what, Mark at) {
    return {Severity::warning, "W-FOOTPRINT",
            fmt::format("{}, but its numbers are taken as coordinates of the scene", what), std::move(at),
            "convert it to the coordinate system of the mesh, for example with ogr2ogr -t_srs"};
}

// --- DXF

/// "4 LINE and 2 ARC entities".
std::string counts_text(const std::map<std::string, std::size_t>& counts, std::string_view one,
                        std::string_view many) {
    std::string text;
    std::size_t all = 0, left = counts.size();
    for (const auto& [type, count] : counts) {
        append_item(text, fmt::format("{} {}", count, type), left == 1 ? " and " : ", ");
        all += count;
        --left;
    }
    return fmt::format("{} {}", text, noun_for(all, one, many));
}
std::string entities_text(const std::map<std::string, std::size_t>& counts) {
    return counts_text(counts, "entity", "entities");
}

/// Outlines of a DXF, with warnings about entities that are left out.
class DxfFootprint {
  public:
    DxfFootprint(std::string_view text, const std::string& name)
        : name_(name), file_(parse_dxf(text, name)), curves_(curves_of(file_, name)) {}

    FootprintFile read() {
        for (DxfCurve& c : curves_.curves) {
            const bool joined = !c.closed && c.points.front() == c.points.back();
            if (joined) c.points.pop_back();
            if ((joined || c.closed) && c.points.size() > 2) {
                out_.rings.push_back(std::move(c.points));
                continue;
            }
            if (joined) c.points.push_back(c.points.front());
            types_.push_back(c.type);
            open_.push_back({std::move(c.points), c.size, c.layer});
        }
        Chains chains = join_chains(open_, out_.rings, name_);
        if (chains.branching) refuse_branching(*chains.branching);
        std::map<std::string, std::size_t> open;
        for (const Index c : chains.open) ++open[std::string(types_[c])];
        if (chains.doubtful) refuse_gap(*chains.doubtful, open);
        out_.rings = std::move(chains.rings);
        if (!open.empty()) warn_of_open(open, chains.open.front());
        if (!curves_.unused.empty())
            warn(fmt::format("{} left out: only lines, arcs, circles, ellipses, polylines and splines with "
                             "control points form outlines",
                             are(entities_text(curves_.unused), curves_.unused)),
                 "if the outline needs them, explode them into such entities in the CAD program");
        if (curves_.hidden > 0)
            warn(fmt::format("{} left out: {} invisible, on a hidden layer or on a paper sheet",
                             are(curves_.hidden), curves_.hidden == 1 ? "it is" : "they are"),
                 "show their layers in the CAD program if they belong to the outline");
        out_.metres = file_.metres;
        out_.can_state_unit = true;
        return std::move(out_);
    }

  private:
    static std::string are(std::size_t count) {
        return counted(count, "entity", "entities") + (count == 1 ? " is" : " are");
    }
    static std::string are(const std::string& text, const std::map<std::string, std::size_t>& counts) {
        const bool one = counts.size() == 1 && counts.begin()->second == 1;
        return text + (one ? " is" : " are");
    }
    void warn(std::string message, std::string hint) {
        out_.warnings.push_back(
            {Severity::warning, "W-FOOTPRINT", std::move(message), file_mark(name_), std::move(hint)});
    }
    void warn_of_open(const std::map<std::string, std::size_t>& open, Index first) {
        const Vec2 &from = open_[first].points.front(), &to = open_[first].points.back();
        warn(fmt::format("{} open and left out; the first reaches from ({}) to ({})",
                         are(entities_text(open), open), readable_pair(from.x, from.y),
                         readable_pair(to.x, to.y)),
             "if they belong to the outline, join their ends in the CAD program");
    }
    [[noreturn]] void refuse_branching(const Vec2& at) const {
        malformed(name_, 0, "E-FOOTPRINT",
                  fmt::format("lines branch at ({}), so the outline is ambiguous", readable_pair(at.x, at.y)),
                  "delete the lines that divide the outline, or draw it as a closed polyline");
    }
    [[noreturn]] void refuse_gap(const OpenOutline& gap,
                                 const std::map<std::string, std::size_t>& open) const {
        malformed(
            name_, 0, "E-FOOTPRINT",
            fmt::format("an outline has a gap of {} between ({}) and ({}); {} open",
                        readable(length(gap.to - gap.from)), readable_pair(gap.from.x, gap.from.y),
                        readable_pair(gap.to.x, gap.to.y), are(entities_text(open), open)),
            "join the ends in the CAD program, or delete the lines if they do not belong to an outline");
    }

    const std::string& name_;
    DxfFile file_;
    DxfCurves curves_;
    std::vector<OpenCurve> open_;
    std::vector<std::string_view> types_; ///< [open_]
    FootprintFile out_;
};

// --- GeoJSON (RFC 7946)

class GeoJson {
  public:
    explicit GeoJson(const std::string& name) : name_(name) {}

    FootprintFile read(std::string_view text) {
        Json json;
        try {
            json = parse_json(text);
        } catch (const Json::parse_error& e) {
            malformed(name_, 0, "E-GEOJSON", fmt::format("this is not JSON at byte {}", e.byte));
        } catch (const Json::exception&) {
            malformed(name_, 0, "E-GEOJSON", "this is not JSON: a number is out of range");
        }
        geometry(json, 0);
        FootprintFile file;
        file.rings = std::move(rings_);
        if (!unused_.empty()) warn_of_unused(file);
        if (has_degrees(json))
            file.warnings.push_back(warning_of_degrees(
                "its coordinate system (crs) is longitude and latitude", file_mark(name_)));
        return file;
    }

  private:
    void warn_of_unused(FootprintFile& file) const {
        std::size_t all = 0;
        for (const auto& [type, count] : unused_) all += count;
        file.warnings.push_back(
            {Severity::warning, "W-FOOTPRINT",
             fmt::format("{} {} left out: only polygons have an inside",
                         counts_text(unused_, "geometry", "geometries"), all == 1 ? "is" : "are"),
             file_mark(name_), "close the lines to polygons if they belong to the outline"});
    }
    /// The member of files before RFC 7946 that names the coordinate system.
    static bool has_degrees(const Json& json) {
        const Json::json_pointer name("/crs/properties/name");
        if (!json.is_object() || !json.contains(name) || !json[name].is_string()) return false;
        const auto text = json[name].get<std::string>();
        return text.ends_with("CRS84") || text.ends_with(":4326") || text.ends_with("/4326");
    }
    void geometry(const Json& j, int depth) {
        if (depth > 32) fail("collections are nested too deeply");
        if (!j.is_object() || !j.contains("type") || !j["type"].is_string()) fail("an object has no type");
        const std::string type = j["type"].get<std::string>();
        if (type == "FeatureCollection")
            for (const Json& f : member(j, "features")) geometry(f, depth + 1);
        else if (type == "GeometryCollection")
            for (const Json& g : member(j, "geometries")) geometry(g, depth + 1);
        else if (type == "Feature") {
            if (j.contains("geometry") && !j["geometry"].is_null()) geometry(j["geometry"], depth + 1);
        } else if (type == "Polygon")
            polygon(member(j, "coordinates"));
        else if (type == "MultiPolygon")
            for (const Json& p : member(j, "coordinates")) polygon(p);
        else
            ++unused_[type];
    }
    const Json& member(const Json& j, const char* key) const {
        if (!j.contains(key) || !j[key].is_array()) fail(fmt::format("'{}' must be a list", key));
        return j[key];
    }
    void polygon(const Json& rings) {
        if (!rings.is_array()) fail("a polygon must be a list of rings");
        for (const Json& ring : rings) {
            if (!ring.is_array()) fail("a ring must be a list of positions");
            auto& out = rings_.emplace_back();
            for (const Json& p : ring) {
                if (!p.is_array() || p.size() < 2 || !p[0].is_number() || !p[1].is_number())
                    fail("a position must be a list of two or three numbers");
                out.push_back({p[0].get<double>(), p[1].get<double>()});
            }
        }
    }
    [[noreturn]] void fail(std::string message) const {
        malformed(name_, 0, "E-GEOJSON", std::move(message));
    }

    const std::string& name_;
    FootprintRings rings_;
    std::map<std::string, std::size_t> unused_; ///< geometries without an inside, by type
};

// --- WKT (OGC 06-103r4)

class Wkt {
  public:
    Wkt(std::string_view text, const std::string& name)
        : at_(text.data()), end_(text.data() + text.size()), begin_(at_), name_(name) {}

    FootprintRings read() {
        while (!at_end()) {
            std::string_view type = word();
            if (same_word(type, "SRID")) { // "SRID=4326;", as PostGIS writes it
                while (at_ < end_ && *at_ != ';') ++at_;
                expect(';');
                type = word();
            }
            if (!same_word(type, "POLYGON") && !same_word(type, "MULTIPOLYGON"))
                fail(fmt::format("expected POLYGON or MULTIPOLYGON, found {}", in_quotes(type)));
            const bool many = same_word(type, "MULTIPOLYGON");
            const std::string_view more = word(); // Z, M, ZM or EMPTY
            if (same_word(more, "EMPTY") || same_word(word(), "EMPTY")) continue;
            if (many)
                list([&] { polygon(); });
            else
                polygon();
            if (!at_end() && *at_ == ';') ++at_;
        }
        return std::move(rings_);
    }

  private:
    void polygon() {
        list([&] {
            auto& ring = rings_.emplace_back();
            list([&] {
                Vec2 p;
                p.x = number();
                p.y = number();
                int numbers = 2;
                const auto more = [&] {
                    skip();
                    return at_ < end_ && *at_ != ',' && *at_ != ')';
                };
                for (; more(); ++numbers) number(); // Z and M
                if (numbers_ == 0) numbers_ = numbers;
                if (numbers != numbers_ || numbers > 4)
                    fail(fmt::format("expected a position of {} numbers, found {}", std::min(numbers_, 4),
                                     numbers));
                ring.push_back(p);
            });
        });
    }
    template <class Item>
    void list(Item&& item) {
        expect('(');
        do item();
        while (take(','));
        expect(')');
    }
    double number() {
        skip();
        double x = 0;
        if (!scan_real(at_, end_, x) || !std::isfinite(x)) fail("expected a number");
        return x;
    }
    std::string_view word() {
        skip();
        const char* first = at_;
        while (at_ < end_ && ((*at_ >= 'A' && *at_ <= 'Z') || (*at_ >= 'a' && *at_ <= 'z'))) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }
    bool take(char c) {
        skip();
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!take(c)) fail(fmt::format("expected '{}'", c));
    }
    void skip() {
        while (at_ < end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\n' || *at_ == '\r')) ++at_;
    }
    bool at_end() {
        skip();
        return at_ == end_;
    }
    [[noreturn]] void fail(const std::string& message) const {
        malformed(name_, 1 + static_cast<int>(std::count(begin_, at_, '\n')), "E-WKT",
                  fmt::format("{} at character {}", message, at_ - begin_ + 1));
    }

    const char *at_, *end_, *begin_;
    const std::string& name_;
    int numbers_ = 0; ///< in the position; 0: none read
    FootprintRings rings_;
};

std::string_view without_space(std::string_view text) {
    text = without_byte_order_mark(text);
    const auto first = text.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

} // namespace

bool is_wkt(std::string_view text) {
    text = without_space(text);
    const auto begins = [&](std::string_view word) {
        return text.size() > word.size() && same_word(text.substr(0, word.size()), word);
    };
    if (begins("POLYGON") || begins("MULTIPOLYGON") || begins("SRID=")) return true;
    // Recognises other WKT types by their bracket, so that they are not taken for file names.
    for (const std::string_view other :
         {"POINT", "MULTIPOINT", "LINESTRING", "MULTILINESTRING", "GEOMETRYCOLLECTION", "CURVEPOLYGON",
          "MULTISURFACE", "TRIANGLE", "TIN", "POLYHEDRALSURFACE"})
        if (begins(other) && without_space(text.substr(other.size())).starts_with('(')) return true;
    return false;
}

FootprintRings parse_wkt(std::string_view text, const std::string& name) { return Wkt(text, name).read(); }

namespace {

[[noreturn]] void refuse_empty(const Input& input, const FootprintFile& file) {
    std::string message = "the file contains no polygon";
    for (const Diagnostic& w : file.warnings) message += ": " + w.message;
    malformed(input.name(), 0, "E-FOOTPRINT", std::move(message),
              file.can_state_unit
                  ? "draw the outline as closed polylines, or as lines and arcs whose ends meet"
                  : "give a POLYGON or MULTIPOLYGON; lines and points have no inside");
}

} // namespace

FootprintFile read_footprint(const Input& input) {
    const std::string_view text = without_space(as_text(input.bytes()));
    FootprintFile file;
    if (text.starts_with("{"))
        file = GeoJson(input.name()).read(text);
    else if (is_wkt(text))
        file.rings = parse_wkt(text, input.name());
    else if (text.starts_with("AutoCAD Binary DXF"))
        malformed(input.name(), 0, "E-DXF", "this is a binary DXF", "save it as a text (ASCII) DXF");
    else if (is_dxf(text))
        file = DxfFootprint(text, input.name()).read();
    else
        malformed(input.name(), 0, "E-FOOTPRINT", "this is neither GeoJSON nor WKT nor DXF as text",
                  "a footprint is a POLYGON or MULTIPOLYGON, or outlines of a DXF");
    if (file.rings.empty()) refuse_empty(input, file);
    if (const std::size_t repeated = remove_repeated(file.rings))
        file.warnings.push_back(
            {Severity::warning, "W-FOOTPRINT",
             fmt::format("{} left out, because {} another one",
                         repeated == 1 ? "1 ring is" : fmt::format("{} rings are", repeated),
                         repeated == 1 ? "it repeats" : "they repeat"),
             file_mark(input.name()), "delete the copies in the program that drew them"});
    return file;
}

} // namespace facetmill::io
