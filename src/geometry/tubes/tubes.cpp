#include "geometry/tubes/tubes.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/tubes/chains.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace facetmill {

namespace {

constexpr double step = pi / 8; ///< angle of a step around a corner

/// The direction d of a line, and an up direction perpendicular to it.
struct TubeFrame {
    Vec3 d, up;
    Vec3 aside() const { return cross(d, up); }
};

TubeFrame frame_along(const Vec3& d) {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const Vec3 other = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return {d, normalised(cross(other, d))};
}

/// The frame turned by the smallest rotation that brings its direction to d. Half a turn is not allowed.
TubeFrame turned(const TubeFrame& f, const Vec3& d) {
    const Vec3 up = f.up - (f.d + d) * (dot(f.up, d) / (1 + dot(f.d, d)));
    return {d, normalised(up - d * dot(up, d))};
}

/// Sweeps a section along chains, one chain at a time.
class Sweep {
  public:
    Sweep(const Lines& lines, const TubesSettings& settings)
        : lines_(lines), radius_(settings.thickness / 2), sides_(static_cast<Index>(settings.sides)) {
        for (Index k = 0; k < sides_; ++k) {
            const double angle = 2 * pi * k / sides_;
            section_.push_back({cosine(angle), sine(angle)});
        }
    }

    void add(const Chain& chain) {
        read(chain);
        const std::size_t lines = directions_.size();
        if (lines == 0) return;
        r.tubes += 1;
        r.segments += lines;
        rings_ = 0;
        base_ = static_cast<Index>(r.mesh.positions.size());
        chain.closed ? closed() : open();
        r.face_material.resize(r.mesh.face_count(), chain.material);
        if (r.mesh.corners.size() >= none)
            throw Error(ErrorKind::limit, "E-LIMIT", "the tubes have more corners than can be numbered",
                        "load: {line_sides: 3} gives them fewer sides");
    }

    TubesResult r;

  private:
    using Turn = std::array<double, 2>; ///< cosine and sine

    void read(const Chain& chain) {
        points_.clear();
        directions_.clear();
        lengths_.clear();
        for (const Index p : chain.points) points_.push_back(lines_.points[p]);
        const std::size_t n = points_.size();
        for (std::size_t i = 0; i + 1 < n + chain.closed; ++i) {
            const Vec3 along = points_[(i + 1) % n] - points_[i];
            const double most = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
            directions_.push_back(
                normalised(along / most)); // scaled first, so that lines of any length have a direction
            lengths_.push_back(length(directions_.back() * most));
        }
    }

    void open() {
        TubeFrame frame = frame_along(directions_.front());
        ring(points_.front(), frame);
        for (std::size_t i = 1; i < directions_.size(); ++i) frame = corner(i, i - 1, i, frame);
        ring(points_.back(), frame);
        for (Index k = 0; k + 1 < rings_; ++k) wall(k, k + 1, 0, false);
        end(0, true);
        end(rings_ - 1, false);
    }

    void closed() {
        const std::size_t n = directions_.size();
        const TubeFrame start = frame_along(directions_.back());
        twist_ = {1, 0};
        // The first pass measures how far the frame has turned about the line at its return; the second
        // distributes this turn.
        TubeFrame frame = start;
        for (std::size_t i = 0; i < n; ++i) frame = carried((i + n - 1) % n, i, frame);
        const double left = arc_tangent(dot(frame.up, start.aside()), dot(frame.up, start.up));
        const double side = 2 * pi / sides_;
        const double shift = std::floor(left / side + 0.5);
        const double each = (left - shift * side) / static_cast<double>(n);
        frame = start;
        for (std::size_t i = 0; i < n; ++i) {
            const double turn = -each * static_cast<double>(i);
            twist_ = {cosine(turn), sine(turn)};
            frame = corner(i, (i + n - 1) % n, i, frame);
        }
        const bool twisted = std::abs(each) > 1e-12; // a limit in radians: far above rounding, but invisible
        for (Index k = 0; k + 1 < rings_; ++k) wall(k, k + 1, 0, twisted);
        const auto shifted = static_cast<Index>((static_cast<long>(shift) + 2L * sides_) % sides_);
        wall(rings_ - 1, 0, shifted, twisted);
        twist_ = {1, 0};
    }

    /// The offset of the section's k-th point in this frame.
    Vec3 offset(const TubeFrame& f, Index k) const {
        const auto [c, s] = section_[k];
        const double x = c * twist_[0] - s * twist_[1], y = c * twist_[1] + s * twist_[0];
        return (f.up * x + f.aside() * y) * radius_;
    }

    void ring(const Vec3& centre, const TubeFrame& f) {
        for (Index k = 0; k < sides_; ++k) r.mesh.positions.push_back(centre + offset(f, k));
        ++rings_;
    }

    /// Whether both lines at a corner have room for a mitre.
    bool has_room(std::size_t before, std::size_t after, double cosine_of_half) const {
        const double sine_of_half = std::sqrt(std::max(0.0, 1 - cosine_of_half * cosine_of_half));
        const double most = std::min({2 * radius_, lengths_[before] / 2, lengths_[after] / 2});
        return radius_ * sine_of_half <= most * cosine_of_half;
    }

    /// The frame after a corner.
    TubeFrame carried(std::size_t before, std::size_t after, const TubeFrame& f) const {
        const Vec3 &from = directions_[before], &to = directions_[after];
        if (dot(from, to) > -0.5) return turned(f, to);
        TubeFrame done = f;
        for (const Vec3& d : directions_between(from, to, f.up)) done = turned(done, d);
        return done;
    }

    TubeFrame corner(std::size_t i, std::size_t before, std::size_t after, const TubeFrame& f) {
        const Vec3 &from = directions_[before], &to = directions_[after], &at = points_[i];
        const double half = std::sqrt(std::max(0.0, (1 + dot(from, to)) / 2)); // cosine of half the turn
        const TubeFrame behind = carried(before, after, f);
        if (has_room(before, after, half)) {
            const Vec3 across = normalised(from + to); // normal of the plane that halves the angle
            for (Index k = 0; k < sides_; ++k) {
                const Vec3 q = offset(f, k);
                r.mesh.positions.push_back(at + q - from * (dot(q, across) / dot(from, across)));
            }
            ++rings_;
            return behind;
        }
        ++r.sharp;
        ring(at, f);
        TubeFrame g = f;
        for (const Vec3& d : directions_between(from, to, f.up)) {
            g = turned(g, d);
            ring(at, g);
        }
        return g;
    }

    /// The directions from one to another in even steps, without the first. `up` decides the way of half a
    /// turn.
    static std::vector<Vec3> directions_between(const Vec3& from, const Vec3& to, const Vec3& up) {
        const Vec3 sideways = to - from * dot(from, to);
        const double sine_of_turn = length(sideways);
        const double turn = arc_tangent(sine_of_turn, dot(from, to));
        const Vec3 other =
            sine_of_turn > 1e-12 ? sideways / sine_of_turn : up; // below 1e-12, the sine is only rounding
        const int steps = std::max(1, static_cast<int>(std::ceil(turn / step)));
        std::vector<Vec3> all;
        for (int k = 1; k < steps; ++k) {
            const double angle = turn * k / steps;
            all.push_back(from * cosine(angle) + other * sine(angle));
        }
        all.push_back(to);
        return all;
    }

    /// Adds the faces between two rings. The points of the second ring are shifted by `shift`.
    void wall(Index ring_a, Index ring_b, Index shift, bool triangles) {
        const Index a = base_ + ring_a * sides_, b = base_ + ring_b * sides_;
        for (Index k = 0; k < sides_; ++k) {
            const Index next = (k + 1) % sides_;
            const Index p = a + k, q = a + next, s = b + (next + shift) % sides_,
                        t = b + (k + shift) % sides_;
            if (triangles) {
                add_face(r.mesh, std::array{p, q, s});
                add_face(r.mesh, std::array{p, s, t});
            } else {
                add_face(r.mesh, std::array{p, q, s, t});
            }
        }
    }

    void end(Index ring, bool first) {
        std::vector<Index> around(sides_);
        for (Index k = 0; k < sides_; ++k) around[k] = base_ + ring * sides_ + k;
        if (first) std::reverse(around.begin(), around.end());
        add_face(r.mesh, around);
    }

    const Lines& lines_;
    double radius_;
    Index sides_;
    std::vector<Turn> section_;
    Turn twist_{1, 0};
    std::vector<Vec3> points_,
        directions_; ///< points of the chain; directions_[i] leads away from points_[i]
    std::vector<double> lengths_;
    Index base_ = 0, rings_ = 0;
};

} // namespace

TubesResult tubes(const Lines& lines, const TubesSettings& settings) {
    constexpr double bytes_per_side = 48; // a position, four corners, an offset and a material
    require_memory(bytes_per_side * settings.sides * static_cast<double>(lines.segments.size()),
                   "making tubes of lines", "give them fewer sides");
    const Chains chains = chains_of(lines);
    Sweep sweep(lines, settings);
    for (const Chain& chain : chains.chains) sweep.add(chain);
    sweep.r.skipped = chains.skipped;
    normalise_offsets(sweep.r.mesh);
    return std::move(sweep.r);
}

Mesh rod(const Vec3& from, const Vec3& to, double radius, int sides) {
    return tubes({{}, {from, to}, {{0, 1, none}}}, {2 * radius, sides}).mesh;
}

} // namespace facetmill
