#include "io/footprint/footprint.hpp"

#include "base/json.hpp"
#include "io/footprint/dxf.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

// --- GeoJSON (RFC 7946)

class GeoJson {
  public:
    explicit GeoJson(const std::string& name) : name_(name) {}

    FootprintRings read(std::string_view text) {
        Json json;
        try {
            json = Json::parse(text);
        } catch (const Json::exception& e) {
            malformed(name_, 0, "E-GEOJSON", fmt::format("this is no JSON: {}", e.what()));
        }
        geometry(json, 0);
        return std::move(rings_);
    }

  private:
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
                p.x = number(), p.y = number();
                int numbers = 2;
                for (; skip(), at_ < end_ && *at_ != ',' && *at_ != ')'; ++numbers) number(); // Z and M
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
        return at_ < end_ && *at_ == c ? ++at_, true : false;
    }
    void expect(char c) {
        if (!take(c)) fail(fmt::format("expected '{}'", c));
    }
    void skip() {
        while (at_ < end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\n' || *at_ == '\r')) ++at_;
    }
    bool at_end() { return skip(), at_ == end_; }
    [[noreturn]] void fail(const std::string& message) const {
        malformed(name_, 1 + static_cast<int>(std::count(begin_, at_, '\n')), "E-WKT",
                  fmt::format("{} at character {}", message, at_ - begin_ + 1));
    }

    const char *at_, *end_, *begin_;
    const std::string& name_;
    int numbers_ = 0; ///< of a position; 0: none was read
    FootprintRings rings_;
};

std::string_view without_space(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

} // namespace

bool is_wkt(std::string_view text) {
    text = without_space(text);
    const auto begins = [&](std::string_view word) {
        return text.size() > word.size() && same_word(text.substr(0, word.size()), word);
    };
    if (begins("POLYGON") || begins("MULTIPOLYGON") || begins("SRID=")) return true;
    // What is WKT but no polygon is known by its bracket, so that it is not taken for the name of a file.
    for (const std::string_view other :
         {"POINT", "MULTIPOINT", "LINESTRING", "MULTILINESTRING", "GEOMETRYCOLLECTION", "CURVEPOLYGON",
          "MULTISURFACE", "TRIANGLE", "TIN", "POLYHEDRALSURFACE"})
        if (begins(other) && without_space(text.substr(other.size())).starts_with('(')) return true;
    return false;
}

FootprintRings parse_wkt(std::string_view text, const std::string& name) { return Wkt(text, name).read(); }

FootprintRings read_footprint(const Input& input) {
    const std::string_view text = without_space(as_text(input.bytes()));
    FootprintRings rings;
    if (text.starts_with("{"))
        rings = GeoJson(input.name()).read(text);
    else if (is_wkt(text))
        rings = parse_wkt(text, input.name());
    else if (is_dxf(text))
        rings = parse_dxf(text, input.name());
    else
        malformed(input.name(), 0, "E-FOOTPRINT", "this is neither GeoJSON nor WKT nor DXF as text",
                  "a footprint is a POLYGON or MULTIPOLYGON, or closed polylines of a DXF");
    if (rings.empty())
        malformed(input.name(), 0, "E-FOOTPRINT", "there is no polygon in this file",
                  "lines and points have no inside; in a DXF only closed polylines and circles do");
    return rings;
}

} // namespace facetmill::io
