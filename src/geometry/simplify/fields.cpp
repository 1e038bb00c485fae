// Attributes in the error of simplification. Over a face each number of an attribute is g.p + d. With the
// value s at a vertex, the faces that it stands for are off by the sum of area * (g.p + d - s)^2; the best s
// is the mean, and what is left then is a quadric in p again. After H. Hoppe, 'New quadric metric for
// simplifying meshes with appearance attributes' (1999).

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

namespace {

// Faces with less height than this share of their longest edge say nothing about gradients.
constexpr double least_height = 1e-3;
constexpr std::size_t most_sets = 2;       // of UVs
constexpr std::size_t skin_channels = 4;   // of the projection of skin weights
constexpr double share_of_diagonal = 0.01; // that a difference of 1 counts as, but for UVs

/// Numbers of an attribute, or of a projection, that enter the error.
struct Channels {
    const Attribute* of = nullptr;
    const Attribute* joints = nullptr; ///< of skin weights
    std::size_t count = 0;
    double scale = 0; ///< to lengths in the work's frame
};

Index element_of(const Mesh& mesh, const Attribute& a, Index corner) {
    return a.domain == Domain::wedge ? mesh.corners[corner] : mesh.vertex(corner);
}

/// How long a unit of texture is on the surface, on average: 0 when the texture has no area.
double length_of_uv(const Mesh& mesh, const Attribute& uv, double scale) {
    struct Areas {
        double surface = 0, texture = 0;
    };
    const Areas all = parallel_reduce(
        mesh.face_count(), Areas{},
        [&](std::size_t begin, std::size_t end) {
            Areas sum;
            for (Index c = 3 * static_cast<Index>(begin); c < 3 * end; c += 3) {
                Vec3 t[3];
                for (Index k = 0; k < 3; ++k) {
                    const Index e = element_of(mesh, uv, c + k);
                    t[k] = {uv.value(e, 0), uv.value(e, 1), 0};
                }
                const Vec3 p = mesh.point(c);
                const double surface =
                    length(cross((mesh.point(c + 1) - p) * scale, (mesh.point(c + 2) - p) * scale));
                const double texture = length(cross(t[1] - t[0], t[2] - t[0]));
                if (std::isfinite(surface) && std::isfinite(texture))
                    sum.surface += surface, sum.texture += texture;
            }
            return sum;
        },
        [](const Areas& a, const Areas& b) {
            return Areas{a.surface + b.surface, a.texture + b.texture};
        });
    return all.texture > 0 ? std::sqrt(all.surface / all.texture) : 0;
}

/// The numbers of one face's corner, scaled.
class Values {
  public:
    Values(const Mesh& mesh, const AttributeWeights& weights, bool normals, double scale) : mesh_(mesh) {
        const double unit = share_of_diagonal * mesh.bounds().diagonal() * scale;
        std::size_t sets = 0;
        for (const Attribute& a : mesh.attributes) {
            if (a.domain == Domain::face) continue;
            if (a.role == Role::uv && sets++ < most_sets)
                add({&a, nullptr, 2, weights.uv > 0 ? weights.uv * length_of_uv(mesh, a, scale) : 0});
            if (a.role == Role::normal && normals && a.name == "NORMAL")
                add({&a, nullptr, 3, weights.normal * unit});
            if (a.role == Role::colour)
                add({&a, nullptr, static_cast<std::size_t>(a.components), weights.colour * unit});
            if (a.role != Role::weights) continue;
            std::string joints = a.name; // WEIGHTS_0 -> JOINTS_0
            if (joints.rfind("WEIGHTS", 0) == 0) joints.replace(0, 7, "JOINTS");
            const Attribute* j = mesh.find(joints, a.domain);
            if (j && j->components == a.components) add({&a, j, skin_channels, weights.skin * unit});
        }
    }

    std::size_t count() const { return count_; }

    void at(Index corner, double* out) const {
        for (const Channels& c : all_) {
            const Index e = element_of(mesh_, *c.of, corner);
            if (c.joints)
                project(c, e, out);
            else
                for (std::size_t k = 0; k < c.count; ++k)
                    out[k] = c.scale * c.of->value(e, static_cast<int>(k));
            out += c.count;
        }
    }

  private:
    void add(const Channels& c) {
        if (c.scale > 0 && std::isfinite(c.scale)) all_.push_back(c), count_ += c.count;
    }

    /// Every joint has a place in four dimensions, in [-1, 1] each; differences of weights keep their size on
    /// average (Johnson and Lindenstrauss).
    static void project(const Channels& c, Index e, double* out) {
        for (std::size_t k = 0; k < skin_channels; ++k) out[k] = 0;
        for (int i = 0; i < c.of->components; ++i) {
            const double weight = c.of->value(e, i);
            const auto joint = static_cast<std::uint64_t>(std::clamp(c.joints->value(e, i), 0.0, 65535.0));
            for (std::size_t k = 0; k < skin_channels; ++k)
                out[k] += c.scale * weight * (2 * uniform(hashed(joint, k)) - 1);
        }
    }

    const Mesh& mesh_;
    std::vector<Channels> all_;
    std::size_t count_ = 0;
};

/// The vertex or wedge whose fields a corner adds to.
Index element(const Work& s, Index corner) { return s.wedge.empty() ? s.tri[corner] : s.wedge[corner]; }

/// What a face says: area times the squares, and area times each gradient.
class FaceFields {
  public:
    FaceFields(const Work& s, const Values& values)
        : s_(s), values_(values), at_(3 * values.count()), sums(4 * values.count()) {}

    bool look(Index f) {
        const Vec3 p = s_.at[s_.tri[3 * f]];
        const Vec3 u = s_.at[s_.tri[3 * f + 1]] - p, v = s_.at[s_.tri[3 * f + 2]] - p, n = cross(u, v);
        const double nn = dot(n, n), longest = std::max({dot(u, u), dot(v, v), dot(u - v, u - v)});
        if (!(nn > least_height * least_height * longest * longest)) return false;
        const double area = std::sqrt(nn) / 2;
        const Vec3 to_u = cross(v, n) / nn, to_v = cross(n, u) / nn; // dual to u and v
        const std::size_t count = values_.count();
        for (Index k = 0; k < 3; ++k) values_.at(3 * s_.face_source[f] + k, &at_[k * count]);
        square = {};
        for (std::size_t k = 0; k < count; ++k) {
            const double s0 = at_[k];
            const Vec3 g = to_u * (at_[count + k] - s0) + to_v * (at_[2 * count + k] - s0);
            const double d = s0 - dot(g, p);
            if (!is_finite(g) || !std::isfinite(d)) return false;
            add_square(g, d, area);
            for (std::size_t i = 0; i < 3; ++i) sums[4 * k + i] = area * g[i];
            sums[4 * k + 3] = area * d;
        }
        square.weight = area;
        return true;
    }

  private:
    void add_square(const Vec3& g, double d, double area) {
        const Vec3 w = g * area;
        square += {w.x * g.x, w.x * g.y, w.x * g.z, w.y * g.y, w.y * g.z, w.z * g.z, w * -d, area * d * d, 0};
    }

    const Work& s_;
    const Values& values_;
    std::vector<double> at_;

  public:
    Quadric square;
    std::vector<double> sums;
};

} // namespace

void sum_fields(Work& s, const Mesh& mesh, const AttributeWeights& weights, bool normals) {
    const Values values(mesh, weights, normals, s.scale);
    Fields& fields = s.fields;
    fields = {};
    fields.channels = values.count();
    if (fields.channels == 0) return;
    const std::size_t elements = s.wedge.empty() ? s.vertex_slots() : mesh.wedge_count();
    fields.squares.resize(elements), fields.sums.resize(4 * fields.channels * elements);
    // Each vertex looks at its own faces, so that no two workers meet at an element.
    parallel_chunks(s.vertex_slots(), [&](std::size_t begin, std::size_t end) {
        FaceFields face(s, values);
        for (std::size_t v = begin; v < end; ++v)
            for (Index c = s.first[v]; c != none; c = s.next[c]) {
                if (!face.look(c / 3)) continue;
                const Index e = element(s, c);
                fields.squares[e] += face.square;
                double* sums = &fields.sums[4 * fields.channels * e];
                for (std::size_t i = 0; i < 4 * fields.channels; ++i) sums[i] += face.sums[i];
            }
    });
}

Quadric residual(const Fields& fields, Index a, Index b) {
    Quadric q = fields.squares[a] + fields.squares[b];
    if (!(q.weight > 0)) return {};
    const double share = 1 / q.weight;
    const std::size_t size = 4 * fields.channels;
    const double *x = &fields.sums[size * a], *y = &fields.sums[size * b];
    for (std::size_t i = 0; i < size; i += 4) {
        const Vec3 g{x[i] + y[i], x[i + 1] + y[i + 1], x[i + 2] + y[i + 2]}, w = g * share;
        const double d = x[i + 3] + y[i + 3];
        q.xx -= w.x * g.x, q.xy -= w.x * g.y, q.xz -= w.x * g.z;
        q.yy -= w.y * g.y, q.yz -= w.y * g.z, q.zz -= w.z * g.z;
        q.b += w * d, q.c -= share * d * d;
    }
    return q;
}

void join_fields(Fields& fields, Index a, Index b) {
    if (fields.channels == 0) return;
    fields.squares[a] += fields.squares[b];
    const std::size_t size = 4 * fields.channels;
    for (std::size_t i = 0; i < size; ++i) fields.sums[size * a + i] += fields.sums[size * b + i];
}

} // namespace facetmill::simplification
