#include "io/footprint/dxf.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/text/spelling.hpp"
#include "io/footprint/nurbs.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace facetmill::io {

namespace {

/// A corner and the bulge of the segment after it: the tangent of a quarter of the arc's angle, 0 for
/// straight.
struct Corner {
    Vec2 at;
    double bulge = 0;
};

constexpr double degrees_per_segment = 5;
constexpr double step = pi / 36;

int pieces_of(double degrees) {
    return std::max(1, static_cast<int>(std::ceil(std::fabs(degrees) / degrees_per_segment)));
}

/// Appends points of the arc from a to b, without b.
void append_arc(const Corner& a, const Vec2& b, std::vector<Vec2>& out) {
    out.push_back(a.at);
    if (a.bulge == 0 || a.at == b) return;
    const double angle = 4 * arc_tangent(a.bulge, 1);
    const Vec2 chord = b - a.at;
    // From the chord's middle, the centre is off by (1 - bulge^2) / (4 bulge) of the chord, to the left.
    const double off = (1 - a.bulge * a.bulge) / (4 * a.bulge);
    const Vec2 centre = (a.at + b) * 0.5 + Vec2{-chord.y, chord.x} * off;
    const Vec2 from = a.at - centre;
    const int pieces = static_cast<int>(std::ceil(std::fabs(angle) / step));
    for (int i = 1; i < pieces; ++i) {
        const double c = cosine(angle * i / pieces), s = sine(angle * i / pieces);
        out.push_back(centre + Vec2{from.x * c - from.y * s, from.x * s + from.y * c});
    }
}

/// The unit vector at this angle; exact at multiples of 90 degrees.
Vec2 direction(double degrees) {
    double turn = std::fmod(degrees, 360);
    if (turn < 0) turn += 360;
    const int quarter = static_cast<int>(turn / 90);
    const double rest = turn - 90 * quarter;
    Vec2 v{1, 0};
    if (rest != 0) v = {cosine(rest * pi / 180), sine(rest * pi / 180)};
    for (int i = 0; i < quarter; ++i) v = {-v.y, v.x};
    return v;
}

/// The plane of a block or an entity, in the plane of the drawing.
struct PlaneMap {
    Vec2 x{1, 0}, y{0, 1}, origin;
    Vec2 point(const Vec2& p) const { return x * p.x + y * p.y + origin; }
    Vec2 vector(const Vec2& v) const { return x * v.x + y * v.y; }
    PlaneMap of(const PlaneMap& inner) const {
        return {vector(inner.x), vector(inner.y), point(inner.origin)};
    }
};

/// The direction that an entity is drawn from (210 to 230).
enum class Looks { from_above, from_below, tilted };

/// The place of a block in the drawing.
struct Insertion {
    PlaneMap map;
    std::string layer; ///< of entities on layer 0
    int depth = 0;
};

/// Text, dimensions and similar entities, which are never outlines.
bool is_annotation(std::string_view type) {
    constexpr std::array<std::string_view, 20> types{"TEXT",
                                                     "MTEXT",
                                                     "ATTDEF",
                                                     "ATTRIB",
                                                     "DIMENSION",
                                                     "ARC_DIMENSION",
                                                     "LEADER",
                                                     "MLEADER",
                                                     "TOLERANCE",
                                                     "MULTILEADER",
                                                     "POINT",
                                                     "VIEWPORT",
                                                     "SEQEND",
                                                     "VERTEX",
                                                     "RAY",
                                                     "XLINE",
                                                     "LARGE_RADIAL_DIMENSION",
                                                     "OLE2FRAME",
                                                     "OLEFRAME",
                                                     "LIGHT"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

std::string_view printable_type(std::string_view type) {
    const bool good = !type.empty() && type.size() <= 40 &&
                      type.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == type.npos;
    return good ? type : "unknown";
}

class DxfPlacer {
  public:
    DxfPlacer(const DxfFile& file, const std::string& name) : file_(file), name_(name) {}

    DxfCurves place() {
        place(file_.drawing, {{}, "0", 0});
        if (out_.curves.empty()) { // some programs draw everything on the paper sheet
            DxfCurves of_model = std::exchange(out_, {});
            is_paper_ = true;
            place(file_.drawing, {{}, "0", 0});
            if (out_.curves.empty()) return of_model;
        }
        return std::move(out_);
    }

  private:
    static constexpr std::size_t most_points = std::size_t{1} << 24, most_entities = std::size_t{1} << 22;
    static constexpr int deepest = 64; // of blocks in blocks

    // --- Groups

    const DxfGroup* group(const DxfEntity& e, std::int64_t code) const {
        for (std::size_t i = e.first; i < e.end; ++i)
            if (file_.groups[i].code == code) return &file_.groups[i];
        return nullptr;
    }
    [[noreturn]] void fail(std::int64_t line, std::string message) const {
        malformed(name_, line, "E-DXF", std::move(message));
    }
    double number(const DxfGroup& g) const {
        const auto x = parse_real(g.value);
        if (!x || !std::isfinite(*x))
            fail(g.line, fmt::format("expected a number, found {}", in_quotes(g.value)));
        return *x;
    }
    double number(const DxfEntity& e, std::int64_t code, double otherwise = 0) const {
        const DxfGroup* g = group(e, code);
        return g ? number(*g) : otherwise;
    }
    Vec2 point(const DxfEntity& e, std::int64_t code) const {
        return {number(e, code), number(e, code + 10)};
    }
    std::int64_t integer(const DxfEntity& e, std::int64_t code, std::int64_t otherwise = 0) const {
        const DxfGroup* g = group(e, code);
        return g ? parse_integer(g->value).value_or(otherwise) : otherwise;
    }
    std::string word(const DxfEntity& e, std::int64_t code, const char* otherwise) const {
        const DxfGroup* g = group(e, code);
        return lower_case(g ? std::string(g->value) : otherwise);
    }
    Looks looks(const DxfEntity& e) const {
        // A tilt of less than a millionth shortens by less than 1e-12: it is rounding.
        constexpr double rounding = 1e-6;
        const double x = number(e, 210), y = number(e, 220), z = number(e, 230, 1);
        if (!(std::fabs(x) <= rounding * std::fabs(z) && std::fabs(y) <= rounding * std::fabs(z)))
            return Looks::tilted;
        return z > 0 ? Looks::from_above : z < 0 ? Looks::from_below : Looks::tilted;
    }

    // --- Entities

    void place(const DxfBlock& block, const Insertion& into) {
        for (std::size_t i = block.first; i < block.end; ++i) {
            const DxfEntity& e = file_.entities[i];
            if (++entities_ > most_entities) beyond_limit(name_, "the drawing has too many entities");
            std::size_t vertices = i + 1; // the end of them
            while (vertices < block.end && file_.entities[vertices].type == "VERTEX") ++vertices;
            place(e, i + 1, vertices, into);
            if (e.type == "POLYLINE") i = vertices - 1;
        }
    }

    void place(const DxfEntity& e, std::size_t first_vertex, std::size_t end_vertices,
               const Insertion& into) {
        if (is_annotation(e.type)) return;
        std::string layer = word(e, 8, "0");
        if (layer == "0") layer = into.layer;
        const bool elsewhere = into.depth == 0 && (integer(e, 67) == 1) != is_paper_;
        if (elsewhere || integer(e, 60) == 1 || file_.hidden_layers.count(layer) > 0) {
            ++out_.hidden;
            return;
        }
        layer_ = layers_.try_emplace(layer, static_cast<std::uint32_t>(layers_.size())).first->second;
        looks_ = looks(e);
        map_ = into.map;
        // Curves of these types are in the coordinates of the block, others in their own plane.
        const bool in_block_plane = e.type == "LINE" || e.type == "ELLIPSE" || e.type == "SPLINE" ||
                                    (e.type == "POLYLINE" && (integer(e, 70) & 8) != 0);
        if (looks_ == Looks::from_below && !in_block_plane) map_ = map_.of({{-1, 0}, {0, 1}, {}});
        if (e.type == "INSERT")
            insert(e, into.depth, layer);
        else if (!curve(e, first_vertex, end_vertices))
            ++out_.unused[e.type == "SPLINE" ? "fit-point SPLINE" : std::string(printable_type(e.type))];
    }

    void insert(const DxfEntity& e, int depth, const std::string& layer) {
        const DxfGroup* block = group(e, 2);
        const auto found =
            block ? file_.blocks.find(lower_case(std::string(block->value))) : file_.blocks.end();
        if (found == file_.blocks.end())
            fail(e.line, fmt::format("the block {} is inserted but not defined",
                                     in_quotes(block ? block->value : std::string_view{})));
        if (depth == deepest)
            fail(e.line, fmt::format("blocks are nested too deeply, or the block {} contains itself",
                                     in_quotes(block->value)));
        if (looks_ == Looks::tilted) {
            ++out_.unused["tilted INSERT"];
            return;
        }
        const Vec2 c = direction(number(e, 50)), at = point(e, 10), base = found->second.base;
        const PlaneMap turned{c, {-c.y, c.x}, {}}, outer = map_;
        const Vec2 scale{number(e, 41, 1), number(e, 42, 1)};
        const auto columns = integer(e, 70, 1), rows = integer(e, 71, 1);
        for (std::int64_t row = 0; row < std::max<std::int64_t>(rows, 1); ++row)
            for (std::int64_t column = 0; column < std::max<std::int64_t>(columns, 1); ++column) {
                if (++entities_ > most_entities) beyond_limit(name_, "the drawing has too many entities");
                const Vec2 offset{static_cast<double>(column) * number(e, 44),
                                  static_cast<double>(row) * number(e, 45)};
                PlaneMap inner{turned.x * scale.x, turned.y * scale.y, at + turned.vector(offset)};
                inner.origin = inner.point(base * -1);
                place(found->second, {outer.of(inner), layer, depth + 1});
            }
    }

    /// False if the entity is no curve in the drawing's plane.
    bool curve(const DxfEntity& e, std::size_t first_vertex, std::size_t end_vertices) {
        DxfCurve c;
        c.type = e.type;
        bool known = true;
        if (e.type == "LINE")
            c.points = {point(e, 10), point(e, 11)};
        else if (e.type == "CIRCLE" || e.type == "ARC")
            arc(e, c);
        else if (e.type == "ELLIPSE")
            known = ellipse(e, c);
        else if (e.type == "LWPOLYLINE")
            polyline(lwpolyline_corners(e), (integer(e, 70) & 1) != 0, c);
        else if (e.type == "POLYLINE")
            known = polyline(e, first_vertex, end_vertices, c);
        else if (e.type == "SPLINE")
            known = spline(e, c);
        else
            known = false;
        if (!known) return false;
        const bool in_plane = looks_ != Looks::tilted || e.type == "LINE" || e.type == "SPLINE" ||
                              (e.type == "POLYLINE" && (integer(e, 70) & 8) != 0);
        if (!in_plane && c.closed) fail(e.line, "a closed outline is not in the drawing's plane");
        if (in_plane) add(e, std::move(c));
        return in_plane;
    }

    void add(const DxfEntity& e, DxfCurve c) {
        points_ += c.points.size();
        if (points_ > most_points) beyond_limit(name_, "the drawing has too many points");
        constexpr double largest = 1e100; // so that squares of differences are finite
        Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (Vec2& p : c.points) {
            p = map_.point(p) + Vec2{}; // -0 becomes 0
            if (!(std::fabs(p.x) < largest && std::fabs(p.y) < largest))
                fail(e.line, "a coordinate is out of range");
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        c.points.erase(std::unique(c.points.begin(), c.points.end()), c.points.end());
        while (c.closed && c.points.size() > 1 && c.points.front() == c.points.back()) c.points.pop_back();
        if (c.points.size() < 2) return; // a line along the direction of view, or a circle without a radius
        c.size = std::max(length(high - low), length(map_.vector({c.size, 0})));
        c.layer = layer_;
        out_.curves.push_back(std::move(c));
    }

    void arc(const DxfEntity& e, DxfCurve& c) const {
        const double radius = number(e, 40);
        const Vec2 centre = point(e, 10);
        if (!(radius > 0)) return;
        c.size = radius;
        const double from = number(e, 50);
        double sweep = std::fmod(number(e, 51) - from, 360);
        if (sweep <= 0) sweep += 360;
        c.closed = e.type == "CIRCLE" || sweep == 360;
        if (c.closed) { // two half circles
            const Vec2 r{radius, 0};
            polyline({{centre - r, 1}, {centre + r, 1}}, true, c);
            return;
        }
        const int pieces = pieces_of(sweep);
        for (int i = 0; i <= pieces; ++i)
            c.points.push_back(centre +
                               direction(i < pieces ? from + sweep * i / pieces : from + sweep) * radius);
    }

    bool ellipse(const DxfEntity& e, DxfCurve& c) const {
        if (looks_ == Looks::tilted) return false;
        const Vec2 centre = point(e, 10), major = point(e, 11);
        const double ratio = number(e, 40, 1) * (looks_ == Looks::from_below ? -1 : 1);
        const Vec2 minor = Vec2{-major.y, major.x} * ratio;
        const double from = number(e, 41), to = number(e, 42, 2 * pi);
        // Angles have six digits or more in files, so an arc that ends so near to its start is a whole
        // ellipse. Its ends are joined.
        constexpr double rounding = 1e-5;
        double sweep = to - from;
        if (!(std::fabs(sweep) < 1000)) fail(e.line, "an ellipse has angles out of range");
        while (sweep <= 0) sweep += 2 * pi;
        c.closed = sweep > 2 * pi - rounding;
        if (c.closed) sweep = 2 * pi;
        const int pieces = pieces_of(sweep * 180 / pi);
        for (int i = 0; i < pieces + (c.closed ? 0 : 1); ++i) {
            const double t = from + sweep * i / pieces;
            c.points.push_back(centre + major * cosine(t) + minor * sine(t));
        }
        c.size = length(major);
        return true;
    }

    std::vector<Corner> lwpolyline_corners(const DxfEntity& e) const {
        std::vector<Corner> corners;
        for (std::size_t i = e.first; i < e.end; ++i) {
            const DxfGroup& g = file_.groups[i];
            if (g.code == 10) corners.push_back({});
            if (corners.empty()) continue;
            if (g.code == 10) corners.back().at.x = number(g);
            if (g.code == 20) corners.back().at.y = number(g);
            if (g.code == 42) corners.back().bulge = number(g);
        }
        return corners;
    }

    static void polyline(std::vector<Corner> corners, bool closed, DxfCurve& c) {
        c.closed = closed && corners.size() > 1;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const bool last = i + 1 == corners.size();
            if (last && !closed)
                c.points.push_back(corners[i].at);
            else
                append_arc(corners[i], corners[last ? 0 : i + 1].at, c.points);
        }
    }

    bool polyline(const DxfEntity& e, std::size_t first_vertex, std::size_t end_vertices, DxfCurve& c) const {
        constexpr std::int64_t meshes = 16 | 64, frame = 16; // flags of POLYLINE and of VERTEX
        if ((integer(e, 70) & meshes) != 0) return false;
        std::vector<Corner> corners;
        for (std::size_t i = first_vertex; i < end_vertices; ++i) {
            const DxfEntity& v = file_.entities[i];
            if ((integer(v, 70) & frame) == 0) corners.push_back({point(v, 10), number(v, 42)});
        }
        polyline(std::move(corners), (integer(e, 70) & 1) != 0, c);
        return true;
    }

    /// False for a spline that is given by points on it only.
    bool spline(const DxfEntity& e, DxfCurve& c) const {
        Nurbs s;
        s.degree =
            static_cast<int>(std::clamp<std::int64_t>(integer(e, 71, 3), 0, Nurbs::highest_degree + 1));
        for (std::size_t i = e.first; i < e.end; ++i) {
            const DxfGroup& g = file_.groups[i];
            if (g.code == 40) s.knots.push_back(number(g));
            if (g.code == 41) s.weights.push_back(number(g));
            if (g.code == 10) s.points.push_back({number(g), 0});
            if (g.code == 20 && !s.points.empty()) s.points.back().y = number(g);
        }
        if (s.points.empty()) return false;
        if (!s.is_valid()) fail(e.line, "a spline has knots or weights that do not fit its points");
        c.points = flattened(s, most_points - std::min(points_, most_points));
        return true;
    }

    const DxfFile& file_;
    const std::string& name_;
    DxfCurves out_;
    std::map<std::string, std::uint32_t> layers_;
    std::size_t points_ = 0, entities_ = 0;
    bool is_paper_ = false; ///< entities of the paper sheet, not of the model
    // Of the entity:
    PlaneMap map_;
    Looks looks_ = Looks::from_above;
    std::uint32_t layer_ = 0;
};

} // namespace

DxfCurves curves_of(const DxfFile& file, const std::string& name) { return DxfPlacer(file, name).place(); }

} // namespace facetmill::io
