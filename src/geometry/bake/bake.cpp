#include "geometry/bake/bake.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/bake/fill.hpp"
#include "geometry/bake/projection.hpp"
#include "geometry/bake/target.hpp"
#include "geometry/bake/texels.hpp"
#include "geometry/render/srgb.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

using namespace baking;

namespace {

/// A footprint slightly smaller than a texel. It copies a texture of the same size unchanged.
constexpr double footprint_share = 0.99;

/// Values of a texel, averaged over its samples.
struct TexelSum {
    double weight = 0, colour_weight = 0;
    std::array<double, 3> colour{}, plain_colour{}, emission{};
    double alpha = 0, occlusion = 0, roughness = 0, metalness = 0, height = 0, thickness = 0;
    Vec3 normal, position;
    bool missed = false;

    void add(const SourceValues& v, const Vec3& tangent_normal) {
        ++weight;
        colour_weight += static_cast<double>(v.base[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            plain_colour[c] += static_cast<double>(v.base[c]);
            colour[c] += static_cast<double>(v.base[c] * v.base[3]);
            emission[c] += static_cast<double>(v.emission[c]);
        }
        alpha += static_cast<double>(v.base[3]);
        occlusion += static_cast<double>(v.occlusion);
        roughness += static_cast<double>(v.roughness);
        metalness += static_cast<double>(v.metalness);
        normal += tangent_normal;
    }
};

std::uint8_t level(double x) {
    return static_cast<std::uint8_t>(std::floor(std::clamp(x, 0.0, 1.0) * 255 + 0.5));
}

constexpr int phases = 16; ///< texels that share the rays: 4 x 4

/// At least `count` directions over a plane with normal z, spread with the cosine as density. Every 16th is a
/// set that is spread over the whole sky, too. After P. Shirley and K. Chiu, "A Low Distortion Map Between
/// Disk and Square" (1997); points of M. Roberts' sequence R2 (2018).
std::vector<Vec3> sky_directions(int count) {
    const int all_sets = (count + phases - 1) / phases * phases;
    const auto spread = [](double x) { return 2 * (x - std::floor(x)) - 1; };
    constexpr double plastic = 1.32471795724474602596; // the root of x^3 = x + 1
    std::vector<Vec3> all;
    all.reserve(static_cast<std::size_t>(all_sets));
    for (int i = 0; i < all_sets; ++i) {
        const double a = spread(0.5 + i / plastic), b = spread(0.5 + i / (plastic * plastic));
        double r = 0, angle = 0;
        if (a * a > b * b) {
            r = a;
            angle = pi / 4 * (b / a);
        } else if (b != 0) {
            r = b;
            angle = pi / 2 - pi / 4 * (a / b);
        }
        const double x = r * cosine(angle), y = r * sine(angle);
        all.push_back({x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))});
    }
    return all;
}

/// Two directions that complete n to a frame. After T. Duff et al., "Building an Orthonormal Basis,
/// Revisited" (2017).
std::pair<Vec3, Vec3> frame_of(const Vec3& n) {
    const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// The rays of a texel that reach the sky, and its direction, to find similar neighbours.
struct Sky {
    std::uint8_t open = 0, cast = 0;
    std::array<std::int8_t, 3> direction{};
};

/// Bakes bands of rows. All texels are independent.
class Baker {
  public:
    Baker(const BakeSource& source, const FaceTree& tree, const Mesh& target, const BakeSettings& settings)
        : tree_(tree), s_(settings), source_(source), target_(target),
          bands_(target, settings.size, settings.samples),
          projector_(tree, source_, settings.distance, settings.any_side), marks_(target.face_count()),
          directions_(sky_directions(settings.occlusion_rays)) {
        // Points are rounded by this much, in world units.
        const double extent = source.mesh.bounds().diagonal();
        skip_ = extent * 1e-6;
        emission_strength(source);
        resize();
    }

    BakedMaps run() {
        std::vector<Counts> counts(bands_.count());
        parallel_for(
            bands_.count(), [&](std::size_t band) { counts[band] = bake_band(band); }, 1);
        for (const Counts& c : counts) {
            maps_.covered += c.covered;
            maps_.missed += c.missed;
            maps_.transparent = maps_.transparent || c.transparent;
            maps_.glows = maps_.glows || c.glows;
        }
        for (const std::uint8_t m : marks_) {
            maps_.overlapping_faces += (m & 2) != 0;
            maps_.faces_without_texels += m == 0;
        }
        if (!sky_.empty()) spread_sky();
        fill();
        return std::move(maps_);
    }

  private:
    struct Counts {
        std::size_t covered = 0, missed = 0;
        bool transparent = false, glows = false;
    };

    void emission_strength(const BakeSource& source) {
        for (const MaterialLook& look : source.looks)
            for (const float c : look.emissive)
                maps_.emission_strength = std::max(maps_.emission_strength, c);
    }

    void resize() {
        const std::size_t n = static_cast<std::size_t>(s_.size) * static_cast<std::size_t>(s_.size);
        maps_.size = s_.size;
        covered_.resize(n);
        maps_.base.resize(4 * n);
        maps_.normal.resize(4 * n);
        maps_.surface.resize(4 * n);
        maps_.emission.resize(4 * n);
        if (s_.height) maps_.height.resize(n);
        if (s_.thickness) maps_.thickness.resize(n);
        if (s_.position) maps_.position.resize(3 * n);
        if (s_.occlusion_rays > 0) sky_.resize(n);
    }

    Counts bake_band(std::size_t band) {
        const std::vector<TexelPlace> places = bands_.places(band, marks_);
        const auto per_texel = static_cast<std::size_t>(s_.samples * s_.samples);
        const std::size_t first =
            static_cast<std::size_t>(bands_.first_row(band)) * static_cast<std::size_t>(s_.size);
        Counts counts;
        Index hint = none, last = none;
        TexelSteps steps;
        for (std::size_t i = 0; i * per_texel < places.size(); ++i) {
            TexelSum sum;
            for (std::size_t k = 0; k < per_texel; ++k) {
                const TexelPlace& place = places[i * per_texel + k];
                if (place.triangle == none) continue;
                if (place.triangle != last) {
                    last = place.triangle;
                    steps = target_.steps(last, bands_.corners(last));
                    const double share = footprint_share / s_.samples;
                    steps = {steps.right * share, steps.down * share};
                }
                add_sample(place, steps, first + i, sum, hint);
            }
            if (sum.weight == 0) continue;
            ++counts.covered;
            counts.missed += sum.missed;
            store(first + i, sum, counts);
        }
        return counts;
    }

    void add_sample(const TexelPlace& place, const TexelSteps& steps, std::size_t texel, TexelSum& sum,
                    Index& hint) {
        const TargetPoint at = target_.at(place.triangle, place.weights);
        const Projection found = projector_(at.position, at.direction, hint);
        if (found.place.face == none) return;
        SourceValues values = source_.at(found.place, steps);
        if (dot(values.facet, at.direction) < 0) { // seen from behind
            values.normal = -values.normal;
            values.facet = -values.facet;
        }
        sum.add(values, in_tangent_space(at, values.normal));
        sum.missed = sum.missed || found.missed;
        sum.height += found.height;
        sum.position += found.point;
        if (s_.thickness) {
            const double d = distance_to_surface(tree_, found.point, -values.facet, skip_);
            sum.thickness += d < HUGE_VAL ? d : 0;
        }
        if (!sky_.empty() && !values.has_occlusion && sky_[texel].cast == 0)
            look_up(found.point, values, texel);
    }

    /// Casts this texel's rays to the sky.
    void look_up(const Vec3& point, const SourceValues& values, std::size_t texel) {
        const std::size_t x = texel % static_cast<std::size_t>(s_.size),
                          y = texel / static_cast<std::size_t>(s_.size);
        const std::size_t phase = (x % 4) + 4 * (y % 4);
        const auto [u, v] = frame_of(values.facet);
        Sky& sky = sky_[texel];
        for (std::size_t i = phase; i < directions_.size(); i += phases) {
            const Vec3& d = directions_[i];
            const Vec3 ray = u * d.x + v * d.y + values.facet * d.z;
            ++sky.cast;
            sky.open = static_cast<std::uint8_t>(
                sky.open + !is_blocked(tree_, point, ray, skip_, s_.occlusion_distance));
        }
        for (std::size_t c = 0; c < 3; ++c)
            sky.direction[c] = static_cast<std::int8_t>(std::floor(values.normal[c] * 127 + 0.5));
    }

    void store(std::size_t texel, const TexelSum& sum, Counts& counts) {
        covered_[texel] = 1;
        const double w = 1 / sum.weight;
        const std::size_t at = 4 * texel;
        for (std::size_t c = 0; c < 3; ++c) {
            const double colour =
                sum.colour_weight > 0 ? sum.colour[c] / sum.colour_weight : sum.plain_colour[c] * w;
            maps_.base[at + c] = srgb_of(static_cast<float>(colour));
            const double glow = sum.emission[c] * w / static_cast<double>(maps_.emission_strength);
            maps_.emission[at + c] = srgb_of(static_cast<float>(glow));
            counts.glows = counts.glows || maps_.emission[at + c] > 0;
        }
        maps_.base[at + 3] = level(sum.alpha * w);
        counts.transparent = counts.transparent || maps_.base[at + 3] < 255;
        const Vec3 n = normalised(sum.normal);
        for (std::size_t c = 0; c < 3; ++c) maps_.normal[at + c] = level(n[c] / 2 + 0.5);
        maps_.surface[at] = level(sum.occlusion * w);
        maps_.surface[at + 1] = level(sum.roughness * w);
        maps_.surface[at + 2] = level(sum.metalness * w);
        maps_.normal[at + 3] = maps_.surface[at + 3] = maps_.emission[at + 3] = 255;
        if (s_.height) maps_.height[texel] = static_cast<float>(sum.height * w);
        if (s_.thickness) maps_.thickness[texel] = static_cast<float>(sum.thickness * w);
        if (s_.position)
            for (std::size_t c = 0; c < 3; ++c)
                maps_.position[3 * texel + c] = static_cast<float>(sum.position[c] * w);
    }

    /// Averages the sky over 4 x 4 texels, which have all rays together.
    void spread_sky() {
        const int size = s_.size;
        parallel_for(
            static_cast<std::size_t>(size),
            [&](std::size_t row) {
                const int y = static_cast<int>(row);
                for (int x = 0; x < size; ++x) {
                    const std::size_t texel =
                        row * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
                    if (sky_[texel].cast > 0) maps_.surface[4 * texel] = level(open_share(x, y, sky_[texel]));
                }
            },
            16);
    }

    double open_share(int x, int y, const Sky& own) const {
        int open = 0, cast = 0;
        for (int j = std::max(0, y - 1); j <= std::min(s_.size - 1, y + 2); ++j)
            for (int i = std::max(0, x - 1); i <= std::min(s_.size - 1, x + 2); ++i) {
                const Sky& other = sky_[static_cast<std::size_t>(j) * static_cast<std::size_t>(s_.size) +
                                        static_cast<std::size_t>(i)];
                int alike = 0;
                for (std::size_t c = 0; c < 3; ++c) alike += int{own.direction[c]} * other.direction[c];
                if (alike < 127 * 127 * 7 / 10) continue; // more than 45 degrees apart
                open += other.open;
                cast += other.cast;
            }
        return cast > 0 ? static_cast<double>(open) / cast : static_cast<double>(own.open) / own.cast;
    }

    /// Grows the borders of charts. The rest gets the mean, so that smaller levels have no fringes.
    void fill() {
        const auto from = nearest_covered(covered_, s_.size, s_.dilation);
        fill_bytes(maps_.base, from);
        fill_bytes(maps_.normal, from, std::array<std::uint8_t, 4>{128, 128, 255, 255});
        fill_bytes(maps_.surface, from);
        fill_bytes(maps_.emission, from);
        fill_floats(maps_.height, 1, from);
        fill_floats(maps_.thickness, 1, from);
        fill_floats(maps_.position, 3, from);
    }

    void fill_bytes(std::vector<std::uint8_t>& map, const std::vector<std::uint32_t>& from,
                    std::optional<std::array<std::uint8_t, 4>> rest = {}) const {
        if (!rest) {
            std::array<std::uint64_t, 4> sums{};
            for (std::size_t i = 0; i < covered_.size(); ++i)
                for (std::size_t c = 0; covered_[i] && c < 4; ++c) sums[c] += map[4 * i + c];
            rest.emplace();
            const std::size_t n = std::max<std::size_t>(1, maps_.covered);
            for (std::size_t c = 0; c < 4; ++c) (*rest)[c] = static_cast<std::uint8_t>((sums[c] + n / 2) / n);
        }
        parallel_for(covered_.size(), [&](std::size_t i) {
            if (covered_[i]) return;
            for (std::size_t c = 0; c < 4; ++c)
                map[4 * i + c] = from[i] == UINT32_MAX ? (*rest)[c] : map[4 * std::size_t{from[i]} + c];
        });
    }

    void fill_floats(std::vector<float>& map, std::size_t components,
                     const std::vector<std::uint32_t>& from) const {
        if (map.empty()) return;
        parallel_for(covered_.size(), [&](std::size_t i) {
            if (covered_[i] || from[i] == UINT32_MAX) return;
            for (std::size_t c = 0; c < components; ++c)
                map[components * i + c] = map[components * std::size_t{from[i]} + c];
        });
    }

    const FaceTree& tree_;
    const BakeSettings& s_;
    SourceReader source_;
    TargetReader target_;
    TexelBands bands_;
    Projector projector_;
    BakedMaps maps_;
    std::vector<std::uint8_t> covered_; ///< [texels]
    std::vector<std::uint8_t> marks_;   ///< [faces of the target]
    std::vector<Vec3> directions_;
    std::vector<Sky> sky_; ///< [texels] empty: not asked for
    double skip_ = 0;      ///< hits nearer than this are the face itself
};

/// Every n-th number below count, so that at most `most` remain.
std::vector<Index> some_of(std::size_t count, std::size_t most) {
    const std::size_t step = std::max<std::size_t>(1, (count + most - 1) / most);
    std::vector<Index> all;
    all.reserve(count / step + 1);
    for (std::size_t i = 0; i < count; i += step) all.push_back(static_cast<Index>(i));
    return all;
}

} // namespace

std::size_t faces_outside_texture(const Mesh& target) {
    const Attribute* uv = target.find("TEXCOORD_0", Domain::wedge);
    if (!uv || uv->components < 2) return target.face_count();
    // Quantised coordinates may be this far outside.
    constexpr double margin = 1e-4;
    std::size_t outside = 0;
    for (std::size_t f = 0; f < target.face_count(); ++f) {
        bool in = true;
        for (const Index w : target.face_wedges(static_cast<Index>(f)))
            for (const int c : {0, 1}) {
                const double x = uv->value(w, c);
                in = in && x >= -margin && x <= 1 + margin; // false for NaN
            }
        outside += !in;
    }
    return outside;
}

BakeGap bake_gap(const Mesh& source, const FaceTree& tree, const Mesh& target) {
    std::vector<Vec3> points;
    std::vector<Index> faces;
    for (const Index f : some_of(target.face_count(), 25000)) {
        const Vec3 &a = target.point(3 * f), &b = target.point(3 * f + 1), &c = target.point(3 * f + 2);
        for (const Vec3& p : {a, b, c, mix(a, b, 0.5), mix(b, c, 0.5), mix(c, a, 0.5), (a + b + c) / 3}) {
            points.push_back(p);
            faces.push_back(f);
        }
    }
    BakeGap gap;
    std::size_t agreeing = 0, facing = 0, finite = 0;
    const auto found = closest_points(tree, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (found[i].triangle == none || !std::isfinite(found[i].distance)) continue;
        ++finite;
        gap.mean += found[i].distance;
        gap.farthest = std::max(gap.farthest, found[i].distance);
        const auto t = tree.triangle(found[i].triangle);
        const Index f = 3 * faces[i];
        const Vec3 n = cross(target.point(f + 1) - target.point(f), target.point(f + 2) - target.point(f));
        const double along = dot(cross(t.b - t.a, t.c - t.a), n);
        facing += along != 0;
        agreeing += along > 0;
    }
    if (finite > 0) gap.mean /= static_cast<double>(finite);
    if (facing > 0) gap.agreeing = static_cast<double>(agreeing) / static_cast<double>(facing);
    std::vector<Vec3> back;
    for (const Index v : some_of(source.vertex_count(), 100000))
        if (is_finite(source.positions[v])) back.push_back(source.positions[v]);
    const FaceTree other(surface_of(target), FaceTree::Use::near);
    for (const Closest& c : closest_points(other, back))
        if (std::isfinite(c.distance)) gap.back = std::max(gap.back, c.distance);
    return gap;
}

BakedMaps bake(const BakeSource& source, const FaceTree& tree, const Mesh& target,
               const BakeSettings& settings) {
    return Baker(source, tree, target, settings).run();
}

} // namespace facetmill
