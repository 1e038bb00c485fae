#include "geometry/pegs/pegs.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/boolean/combine.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"
#include "geometry/tubes/tubes.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

/// A cylinder along a world axis, from `below` under its position to `above` over it.
struct Bore {
    double radius = 0, below = 0, above = 0;
};

/// The cylinders of one kind of peg, at its position. A radius of 0 means none.
struct PegShape {
    Bore added;                         ///< added to the lower tile
    Bore taken_low, taken_high;         ///< subtracted from the lower and the upper tile
    double free = 0;                    ///< the distance that the axis keeps to all surfaces
    double deep_low = 0, deep_high = 0; ///< how far the axis reaches into the lower and the upper tile

    explicit PegShape(const PegSettings& s) {
        const double radius = s.diameter / 2;
        const double hole = (radius + s.clearance) / cosine(pi / s.sides);
        const double depth = (s.kind == PegKind::dowels ? s.length / 2 : s.length) + s.clearance;
        free = hole + s.wall;
        // A hole begins in the air above its mouth, and a peg inside of its tile.
        if (s.kind == PegKind::pegs)
            added = {radius, radius, s.length};
        else
            taken_low = {hole, depth, radius};
        taken_high = {hole, radius, depth};
        deep_low = s.kind == PegKind::pegs ? radius : depth;
        deep_high = depth;
    }
};

Vec3 along(std::size_t axis, double by) {
    Vec3 v;
    v[axis] = by;
    return v;
}

/// A candidate for the place of a peg.
struct PegPlace {
    Vec3 at;
    double room = 0; ///< the distance to the nearest surface
};

/// A square of the plane between two tiles.
struct PegSquare {
    double u = 0, v = 0; ///< its centre
};

/// Two neighbours and the rectangle of the plane between them.
struct PegPair {
    std::size_t axis = 0, low = 0, high = 0;
    double level = 0;
    Box room; ///< of both tiles together, up to the grid's planes
};

class PegPlaces {
  public:
    PegPlaces(const FaceTree& tree, const PegShape& shape) : tree_(tree), shape_(shape) {}

    /// Places with enough room in the plane itself, in the order of the grid.
    std::vector<PegPlace> of(const PegPair& pair) const {
        const std::size_t u = (pair.axis + 1) % 3, v = (pair.axis + 2) % 3;
        const double low_u = pair.room.min[u] + shape_.free, low_v = pair.room.min[v] + shape_.free;
        const double wide = pair.room.max[u] - shape_.free - low_u,
                     high = pair.room.max[v] - shape_.free - low_v;
        if (!(wide >= 0 && high >= 0)) return {};
        constexpr double cells = 16; // along the longer side
        double half = std::max({wide, high, shape_.free}) / cells / 2;
        std::vector<PegSquare> squares;
        const auto rows = [&](double side) {
            return static_cast<int>(std::min(std::floor(side / half / 2), cells - 1)) + 1;
        };
        const int columns = rows(wide), lines = rows(high);
        squares.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(lines));
        for (int j = 0; j < lines; ++j)
            for (int i = 0; i < columns; ++i)
                squares.push_back({low_u + wide * (i + 0.5) / columns, low_v + high * (j + 0.5) / lines});
        for (;; half /= 2) {
            std::vector<PegPlace> found;
            std::vector<PegSquare> left;
            for (const PegSquare& square : squares) {
                const PegPlace place = place_at(pair, square);
                if (place.room >= shape_.free) found.push_back(place);
                // No point of the square has more room than this.
                if (place.room + 1.4143 * half >= shape_.free) left.push_back(square);
            }
            if (!found.empty() || left.empty() || half < shape_.free / 4) return found;
            squares = quarters(left, half / 2);
            for (PegSquare& s : squares) {
                s.u = std::clamp(s.u, low_u, low_u + wide);
                s.v = std::clamp(s.v, low_v, low_v + high);
            }
        }
    }

    /// Whether the whole axis has room on both sides of the plane.
    bool has_depth(const PegPair& pair, const Vec3& at) const {
        const double end = shape_.deep_high;
        if (pair.level - shape_.deep_low - wall() < pair.room.min[pair.axis] ||
            pair.level + end + wall() > pair.room.max[pair.axis])
            return false;
        for (double t = -shape_.deep_low;;) {
            const double free = closest_point(tree_, at + along(pair.axis, t)).distance;
            if (free < shape_.free) return false;
            if (t >= end) return true;
            t = std::min(end, t + std::max(free - shape_.free, std::max(wall(), shape_.free / 16) / 8));
        }
    }

  private:
    double wall() const { return shape_.free - shape_.taken_high.radius; }

    PegPlace place_at(const PegPair& pair, const PegSquare& square) const {
        PegPlace place;
        place.at[pair.axis] = pair.level;
        place.at[(pair.axis + 1) % 3] = square.u;
        place.at[(pair.axis + 2) % 3] = square.v;
        const double distance = closest_point(tree_, place.at).distance;
        place.room = winding(tree_, place.at) > 0 ? distance : -distance;
        return place;
    }

    static std::vector<PegSquare> quarters(const std::vector<PegSquare>& squares, double half) {
        std::vector<PegSquare> all;
        all.reserve(4 * squares.size());
        for (const PegSquare& s : squares)
            for (const double dv : {-half, half})
                for (const double du : {-half, half}) all.push_back({s.u + du, s.v + dv});
        return all;
    }

    const FaceTree& tree_;
    const PegShape& shape_;
};

double distance_squared(const Vec3& a, const Vec3& b) { return dot(a - b, a - b); }

/// The distance between two boxes.
double distance_between(const Box& a, const Box& b) {
    Vec3 apart;
    for (std::size_t i = 0; i < 3; ++i) apart[i] = std::max({0.0, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    return length(apart);
}

class PegJoiner {
  public:
    PegJoiner(std::vector<Tile>& tiles, const Mesh& whole, const TileSettings& settings,
              const PegSettings& pegs)
        : tiles_(tiles), settings_(settings), pegs_(pegs), shape_(pegs), world_(world_of(whole, settings)),
          bounds_(world_.bounds()), tree_(world_), places_(tree_, shape_) {}

    PegsResult run() {
        const std::vector<PegPair> pairs = find_pairs();
        std::vector<std::vector<PegPlace>> candidates(pairs.size());
        parallel_for(
            pairs.size(), [&](std::size_t i) { candidates[i] = places_.of(pairs[i]); }, 1);
        for (std::size_t i = 0; i < pairs.size(); ++i) choose(pairs[i], std::move(candidates[i]));
        for (std::size_t t = 0; t < tiles_.size() && !result_.failure; ++t) change(t);
        return std::move(result_);
    }

  private:
    static Surface world_of(const Mesh& whole, const TileSettings& settings) {
        Surface surface = surface_of(whole);
        for (Vec3& p : surface.positions) p = settings.to_world.point(p);
        if (settings.to_world.determinant() < 0) // the front stays outside
            for (std::size_t c = 0; c < surface.corners.size(); c += 3)
                std::swap(surface.corners[c + 1], surface.corners[c + 2]);
        return surface;
    }

    std::vector<PegPair> find_pairs() const {
        std::map<std::array<std::int64_t, 3>, std::size_t> at;
        for (std::size_t t = 0; t < tiles_.size(); ++t) at[tiles_[t].cell] = t;
        std::vector<PegPair> pairs;
        for (std::size_t t = 0; t < tiles_.size(); ++t)
            for (const TileAxis& a : settings_.axes) {
                std::array<std::int64_t, 3> next = tiles_[t].cell;
                ++next[a.axis];
                const auto other = at.find(next);
                if (other == at.end()) continue;
                Box room = box_of_cell(tiles_[t].cell);
                room.max[a.axis] = box_of_cell(next).max[a.axis];
                pairs.push_back(
                    {a.axis, t, other->second, a.origin + static_cast<double>(next[a.axis]) * a.size, room});
            }
        return pairs;
    }

    /// The cell's box, within the bounds of the solid.
    Box box_of_cell(const std::array<std::int64_t, 3>& cell) const {
        Box box = bounds_;
        for (const TileAxis& a : settings_.axes) {
            const auto k = static_cast<double>(cell[a.axis]);
            box.min[a.axis] = std::max(box.min[a.axis], a.origin + k * a.size);
            if (a.count == 0 || cell[a.axis] + 1 < a.count)
                box.max[a.axis] = std::min(box.max[a.axis], a.origin + (k + 1) * a.size);
        }
        return box;
    }

    /// Takes candidates that are far from each other, the first far from the middle. A single peg goes where
    /// it has the most room.
    void choose(const PegPair& pair, std::vector<PegPlace> places) {
        std::vector<Vec3> taken;
        Vec3 middle;
        for (const PegPlace& p : places) middle += p.at * (1.0 / static_cast<double>(places.size()));
        while (taken.size() < pegs_.count && !places.empty()) {
            const auto merit = [&](const PegPlace& p) {
                if (pegs_.count == 1) return p.room;
                if (taken.empty()) return distance_squared(p.at, middle);
                double least = HUGE_VAL;
                for (const Vec3& t : taken) least = std::min(least, distance_squared(p.at, t));
                return least;
            };
            const auto best =
                std::max_element(places.begin(), places.end(),
                                 [&](const PegPlace& a, const PegPlace& b) { return merit(a) < merit(b); });
            const Vec3 at = best->at;
            places.erase(best);
            if (!is_clear(pair, at) || !places_.has_depth(pair, at)) continue;
            taken.push_back(at);
            result_.pegs.push_back({pair.axis, pair.low, pair.high, at});
        }
        if (taken.empty()) result_.without.emplace_back(pair.low, pair.high);
    }

    /// Whether a peg here keeps the wall to the other pegs of both tiles.
    bool is_clear(const PegPair& pair, const Vec3& at) const {
        const double apart = shape_.free + shape_.taken_high.radius;
        const Box own = axis_box(pair.axis, at);
        return std::none_of(result_.pegs.begin(), result_.pegs.end(), [&](const Peg& peg) {
            const bool shares =
                peg.low == pair.low || peg.low == pair.high || peg.high == pair.low || peg.high == pair.high;
            return shares && distance_between(own, axis_box(peg.axis, peg.at)) < apart;
        });
    }
    Box axis_box(std::size_t axis, const Vec3& at) const {
        return {at - along(axis, shape_.deep_low), at + along(axis, shape_.deep_high)};
    }

    void change(std::size_t t) {
        std::vector<Mesh> added, taken;
        for (const Peg& peg : result_.pegs) {
            if (peg.low == t && shape_.added.radius > 0) added.push_back(cylinder(shape_.added, peg));
            if (peg.low == t && shape_.taken_low.radius > 0) taken.push_back(cylinder(shape_.taken_low, peg));
            if (peg.high == t) taken.push_back(cylinder(shape_.taken_high, peg));
        }
        combine_with(t, std::move(taken), CombineOperation::subtract);
        combine_with(t, std::move(added), CombineOperation::unite);
    }

    void combine_with(std::size_t t, std::vector<Mesh> others, CombineOperation operation) {
        if (others.empty() || result_.failure) return;
        Mesh& mesh = tiles_[t].mesh;
        std::vector<Mesh> all;
        all.reserve(others.size() + 1);
        all.push_back(std::move(mesh));
        for (Mesh& other : others) all.push_back(std::move(other));
        CombineResult r = combine(std::move(all), {operation, 1});
        if (r.failure) {
            result_.failure.emplace(t, r.failure->why);
            return;
        }
        mesh = std::move(r.mesh);
        number(tiles_[t]);
    }

    /// The new faces belong to the same tile.
    void number(Tile& tile) const {
        for (const TileAxis& a : settings_.axes)
            if (Attribute* own = tile.mesh.find(std::string("tile_") + "xyz"[a.axis], Domain::face))
                for (std::size_t f = 0; f < own->size(); ++f)
                    own->set_value(f, 0, static_cast<double>(tile.cell[a.axis]));
    }

    /// In the space of the tiles.
    Mesh cylinder(const Bore& bore, const Peg& peg) const {
        Mesh mesh = rod(peg.at - along(peg.axis, bore.below), peg.at + along(peg.axis, bore.above),
                        bore.radius, pegs_.sides);
        if (pegs_.primitive) mesh.primitives = {*pegs_.primitive};
        apply(mesh, *inverse(settings_.to_world));
        return mesh;
    }

    std::vector<Tile>& tiles_;
    const TileSettings& settings_;
    const PegSettings& pegs_;
    PegShape shape_;
    Surface world_;
    Box bounds_;
    FaceTree tree_;
    PegPlaces places_;
    PegsResult result_;
};

} // namespace

PegsResult add_pegs(std::vector<Tile>& tiles, const Mesh& whole, const TileSettings& settings,
                    const PegSettings& pegs) {
    return PegJoiner(tiles, whole, settings, pegs).run();
}

} // namespace facetmill
