#include "io/footprint/dxf.hpp"

#include "base/portable_math.hpp"
#include "base/numbers.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

/// A corner and how the segment after it bulges: the tangent of a quarter of its arc's angle, 0 for straight.
struct Corner {
    Vec2 at;
    double bulge = 0;
};

constexpr double step = pi / 36;

/// Points of the arc from a to b, b left out.
void append_arc(const Corner& a, const Vec2& b, std::vector<Vec2>& out) {
    out.push_back(a.at);
    if (a.bulge == 0 || a.at == b) return;
    const double angle = 4 * arc_tangent(a.bulge, 1);
    const Vec2 chord = b - a.at;
    // From the chord's middle, the centre is off by (1 - bulge^2) / (4 bulge) of the chord, to the left.
    const double off = (1 - a.bulge * a.bulge) / (4 * a.bulge);
    const Vec2 centre = (a.at + b) * 0.5 + Vec2{-chord.y, chord.x} * off, from = a.at - centre;
    const int pieces = static_cast<int>(std::ceil(std::fabs(angle) / step));
    for (int i = 1; i < pieces; ++i) {
        const double c = cosine(angle * i / pieces), s = sine(angle * i / pieces);
        out.push_back(centre + Vec2{from.x * c - from.y * s, from.x * s + from.y * c});
    }
}

class Dxf {
  public:
    Dxf(std::string_view text, const std::string& name) : text_(text, name, "E-DXF") {}

    FootprintRings read() {
        while (next()) {
            if (code_ == 0)
                start(value_);
            else
                field();
        }
        start("EOF");
        return std::move(rings_);
    }

  private:
    enum class Entity { other, section, lwpolyline, polyline, vertex, circle };

    /// The next group: a code and a value, a line each.
    bool next() {
        if (text_.at_end()) return false;
        code_ = text_.integer("a group code");
        if (!text_.next_line()) text_.fail("the file ends after a group code");
        value_ = text_.rest_of_line();
        text_.next_line();
        return true;
    }

    void start(std::string_view type) {
        const bool within = entity_ == Entity::polyline || entity_ == Entity::vertex;
        if (within && type == "VERTEX") {
            entity_ = Entity::vertex;
            corners_.push_back({});
            return;
        }
        finish();
        if (type == "ENDSEC") in_entities_ = false;
        entity_ = type == "SECTION"      ? Entity::section
                  : type == "LWPOLYLINE" ? Entity::lwpolyline
                  : type == "POLYLINE"   ? Entity::polyline
                  : type == "CIRCLE"     ? Entity::circle
                                         : Entity::other;
        corners_.clear(), closed_ = false, radius_ = 0, looks_ = {0, 0, 1};
        if (entity_ == Entity::circle) corners_.push_back({});
    }

    void field() {
        if (entity_ == Entity::other) return;
        if (entity_ == Entity::section && code_ == 2) in_entities_ = value_ == "ENTITIES";
        if (entity_ != Entity::vertex && code_ >= 210 && code_ <= 230 && code_ % 10 == 0)
            looks_[static_cast<std::size_t>(code_ - 210) / 10] = number();
        if (code_ == 70 && entity_ != Entity::vertex) closed_ = (parse_integer(value_).value_or(0) & 1) != 0;
        if (code_ == 40 && entity_ == Entity::circle) radius_ = number();
        if (entity_ == Entity::polyline) return; // 10 and 20 are its elevation
        if (code_ == 10 && entity_ == Entity::lwpolyline) corners_.push_back({});
        if (corners_.empty()) return;
        if (code_ == 10) corners_.back().at.x = number();
        if (code_ == 20) corners_.back().at.y = number();
        if (code_ == 42) corners_.back().bulge = number();
    }
    double number() const {
        const auto x = parse_real(value_);
        if (!x) text_.fail(fmt::format("expected a number, found {}", in_quotes(value_)));
        return *x;
    }

    void finish() {
        if (entity_ == Entity::circle && radius_ > 0) {
            const Vec2 c = corners_[0].at, r{radius_, 0};
            corners_ = {{c - r, 1}, {c + r, 1}}; // two half circles
            closed_ = true;
        }
        const bool joined = corners_.size() > 3 && corners_.front().at == corners_.back().at;
        if (!in_entities_ || (!closed_ && !joined) || corners_.size() < 2) return;
        if (looks_.x != 0 || looks_.y != 0 || looks_.z == 0)
            text_.fail("a closed outline does not lie in the drawing's plane");
        auto& ring = rings_.emplace_back();
        for (std::size_t i = 0; i < corners_.size(); ++i)
            append_arc(corners_[i], corners_[(i + 1) % corners_.size()].at, ring);
        if (looks_.z < 0) // drawn from behind: x runs the other way
            for (Vec2& p : ring) p.x = -p.x;
    }

    Text text_;
    std::int64_t code_ = 0;
    std::string_view value_;
    Entity entity_ = Entity::other;
    std::vector<Corner> corners_;
    bool closed_ = false;
    double radius_ = 0;
    Vec3 looks_{0, 0, 1};      ///< the direction that the entity is drawn from
    bool in_entities_ = false; ///< not in a block, which is drawn only where it is inserted
    FootprintRings rings_;
};

} // namespace

bool is_dxf(std::string_view text) {
    const std::string_view head = text.substr(0, 4096);
    const char* at = head.data();
    std::int64_t code = 0;
    return scan_integer(at, head.data() + head.size(), code) &&
           head.find("SECTION") != std::string_view::npos;
}

FootprintRings parse_dxf(std::string_view text, const std::string& name) { return Dxf(text, name).read(); }

} // namespace facetmill::io
