#include "geometry/drain/drain.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/boolean/combine.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"
#include "geometry/tubes/tubes.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// The centre of a ball in a cavity.
struct DrainPlace {
    Vec3 at;
    double height = 0;
};

class Drainer {
  public:
    Drainer(Mesh mesh, const DrainSettings& settings)
        : settings_(settings), radius_(settings.diameter / 2), ball_(1.01 * radius_),
          world_(world_of(mesh, settings.to_world)), surface_(surface_of(world_)), tree_(surface_) {
        result_.mesh = std::move(mesh);
    }

    DrainResult run() {
        const Components components = face_components(world_, build_edges(world_));
        const std::vector<double> volumes = six_volumes(world_, components);
        for (Index c = 0; c < components.count; ++c)
            if (volumes[c] < 0) drain_cavity(components, c);
        if (!result_.holes.empty()) cut();
        return std::move(result_);
    }

  private:
    static Mesh world_of(const Mesh& mesh, const Transform& to_world) {
        Mesh world = bare(mesh);
        apply(world, to_world);
        return world;
    }

    void drain_cavity(const Components& components, Index cavity) {
        ++result_.cavities;
        std::vector<Index> triangles;
        for (Index t = 0; t < surface_.size(); ++t)
            if (components.of_face[surface_.face(t)] == cavity) triangles.push_back(t);
        const std::vector<Vec3> places = places_in(triangles);
        const std::size_t drains = add_holes(places, -settings_.up, settings_.count, false);
        const std::size_t vents = settings_.vent ? add_holes(places, settings_.up, 1, true) : 0;
        if (drains + vents == 0) ++result_.closed_cavities;
    }

    /// Centres of balls that touch the cavity's faces and fit into it.
    std::vector<Vec3> places_in(const std::vector<Index>& triangles) const {
        std::vector<std::vector<Vec3>> of_triangle(triangles.size());
        parallel_for(
            triangles.size(), [&](std::size_t i) { of_triangle[i] = places_on(triangles[i]); }, 64);
        std::vector<Vec3> all;
        for (const auto& places : of_triangle) all.insert(all.end(), places.begin(), places.end());
        return all;
    }

    std::vector<Vec3> places_on(Index t) const {
        const Vec3 &a = surface_.point(t, 0), &b = surface_.point(t, 1), &c = surface_.point(t, 2);
        const Vec3 n = normalised(cross(b - a, c - a));
        std::vector<Vec3> places;
        if (n == Vec3{} || !is_finite(n)) return places;
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        constexpr double most = 64; // along an edge
        const auto steps = static_cast<int>(std::clamp(std::ceil(longest / (radius_ / 2)), 1.0, most));
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3 at = a + (b - a) * (static_cast<double>(i) / steps) +
                                (c - a) * (static_cast<double>(j) / steps) + n * (1.02 * radius_);
                if (closest_point(tree_, at).distance >= ball_) places.push_back(at);
            }
        return places;
    }

    /// Adds up to this many holes in a direction. Returns their number.
    std::size_t add_holes(const std::vector<Vec3>& all, const Vec3& down, std::size_t count, bool vent) {
        std::vector<DrainPlace> places;
        places.reserve(all.size());
        for (const Vec3& p : all) places.push_back({p, -dot(p, down)});
        std::vector<Vec3> taken;
        while (taken.size() < count && !places.empty()) {
            const std::size_t best = choose(places, taken, count);
            const Vec3 at = places[best].at;
            places.erase(places.begin() + static_cast<std::ptrdiff_t>(best));
            const std::optional<double> depth = depth_at(at, down);
            if (!depth) continue;
            taken.push_back(at);
            result_.holes.push_back({at, at + down * *depth, vent});
            std::erase_if(places, [&](const DrainPlace& p) { return length(p.at - at) < 4 * radius_; });
        }
        return taken.size();
    }

    /// The best of the places that are about as low as the lowest.
    std::size_t choose(const std::vector<DrainPlace>& places, const std::vector<Vec3>& taken,
                       std::size_t count) const {
        double lowest = HUGE_VAL;
        for (const DrainPlace& p : places) lowest = std::min(lowest, p.height);
        const double level = lowest + radius_ / 4;
        Vec3 middle;
        double n = 0;
        for (const DrainPlace& p : places)
            if (p.height <= level) {
                middle += p.at;
                n += 1;
            }
        middle = middle / n;
        std::size_t best = places.size();
        double most = -HUGE_VAL;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i].height > level) continue;
            double merit = length(places[i].at - middle) * (count == 1 ? -1 : 1);
            for (std::size_t k = 0; k < taken.size(); ++k) {
                const double apart = length(places[i].at - taken[k]);
                merit = k == 0 ? apart : std::min(merit, apart);
            }
            if (merit > most) {
                most = merit;
                best = i;
            }
        }
        return best;
    }

    /// How far the hole reaches: until all of its section has left the wall.
    std::optional<double> depth_at(const Vec3& at, const Vec3& down) const {
        const Vec3 aside =
            normalised(std::fabs(down.x) < 0.9 ? cross(down, Vec3{1, 0, 0}) : cross(down, Vec3{0, 1, 0}));
        const Vec3 other = cross(down, aside);
        double left = 0, again = HUGE_VAL;
        constexpr int rays = 16;
        for (int i = 0; i <= rays; ++i) {
            const double angle = 2 * pi * i / rays;
            const Vec3 from = i == rays ? at : at + (aside * cosine(angle) + other * sine(angle)) * radius_;
            const std::vector<Hit> hits = all_hits(tree_, {from, from + down, true});
            const auto exit = std::find_if(hits.begin(), hits.end(), [](const Hit& h) { return h.way == 1; });
            if (exit == hits.end()) return {}; // the section's border is already outside
            left = std::max(left, exit->t);
            for (auto next = exit; next != hits.end(); ++next)
                if (next->way == -1) {
                    again = std::min(again, next->t);
                    break;
                }
        }
        if (!(again > left)) return {};
        return left + std::min(radius_, (again - left) / 2);
    }

    void cut() {
        std::vector<Mesh> all{result_.mesh};
        const Transform back = *inverse(settings_.to_world);
        for (const DrainHole& hole : result_.holes) {
            Mesh drill = rod(hole.from, hole.to, radius_, settings_.sides);
            apply(drill, back);
            all.push_back(std::move(drill));
        }
        CombineResult r = combine(std::move(all), {CombineOperation::subtract, 1});
        if (r.failure) {
            result_.failure = std::move(r.failure->why);
            result_.holes.clear();
            return;
        }
        result_.mesh = std::move(r.mesh);
        result_.changes = std::move(r.changes);
    }

    const DrainSettings& settings_;
    double radius_, ball_;
    Mesh world_;
    Surface surface_;
    FaceTree tree_;
    DrainResult result_;
};

} // namespace

DrainResult drain(Mesh mesh, const DrainSettings& settings) {
    return Drainer(std::move(mesh), settings).run();
}

} // namespace facetmill
