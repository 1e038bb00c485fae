// The error of attributes: over a face, each number of an attribute is a linear function g.p + d. If a
// vertex has the value s, its faces differ from it by the sum of area * (g.p + d - s)^2. The mean is the
// best s, and the remaining error is again a quadric in p. Follows H. Hoppe, 'New quadric metric for
// simplifying meshes with appearance attributes' (1999).

#include "geometry/simplify/attributes.hpp"

#include "base/math/random.hpp"
#include "mesh/drawn_box.hpp"
#include "mesh/provenance.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::simplification {

namespace {

// Faces with less height than this share of their longest edge do not contribute gradients.
constexpr double least_height_share = 1e-3;
constexpr std::size_t max_sets = 2;      // sets of UVs
constexpr std::size_t skin_channels = 4; // channels of the projection of skin weights
constexpr double share_of_diagonal =
    0.01; // a difference of 1 counts as this share of the diagonal, except for UVs

/// The numbers of an attribute, or of its projection, that contribute to the error.
struct Channels {
    const Attribute* of = nullptr;
    const Attribute* joints = nullptr; ///< the joints of skin weights
    std::size_t count = 0;
    double scale = 0; ///< scale to lengths in the work's frame
};

Index element_of(const Mesh& mesh, const Attribute& a, Index corner) {
    return a.domain == Domain::wedge ? mesh.corners[corner] : mesh.vertex(corner);
}

/// The average surface length of a unit of texture; 0 when the texture has no area.
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
                if (!std::isfinite(surface) || !std::isfinite(texture)) continue;
                sum.surface += surface;
                sum.texture += texture;
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
        const double unit = share_of_diagonal * drawn_box(mesh).diagonal() * scale;
        std::size_t sets = 0;
        for (const Attribute& a : mesh.attributes) {
            if (a.domain == Domain::face) continue;
            if (a.role == Role::uv && sets++ < max_sets)
                add({&a, nullptr, 2, weights.uv > 0 ? weights.uv * length_of_uv(mesh, a, scale) : 0});
            if (a.role == Role::normal && normals && a.name == "NORMAL")
                add({&a, nullptr, 3, weights.normal * unit});
            if (a.role == Role::colour)
                add({&a, nullptr, static_cast<std::size_t>(a.components), weights.colour * unit});
            if (a.role != Role::weights) continue;
            std::string joints = a.name; // maps WEIGHTS_0 to JOINTS_0
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
        if (!(c.scale > 0) || !std::isfinite(c.scale)) return;
        all_.push_back(c);
        count_ += c.count;
    }

    /// Projects skin weights: every joint has a fixed random point in [-1, 1]^4. Differences of weights keep
    /// their size on average (W. Johnson and J. Lindenstrauss, 'Extensions of Lipschitz mappings into a
    /// Hilbert space', 1984).
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

/// The vertex or wedge that collects the error of a corner.
Index element(const State& s, Index corner) { return s.has_seams() ? s.wedge[corner] : s.tri[corner]; }

/// Adds a face's terms: area times the squares, and area times each gradient.
class FaceGradients {
  public:
    FaceGradients(const State& s, const Values& values)
        : s_(s), values_(values), at_(3 * values.count()), sums(4 * values.count()) {}

    bool look(Index f) {
        const Vec3 p = s_.at[s_.tri[3 * f]];
        const Vec3 u = s_.at[s_.tri[3 * f + 1]] - p, v = s_.at[s_.tri[3 * f + 2]] - p, n = cross(u, v);
        const double nn = dot(n, n), longest = std::max({dot(u, u), dot(v, v), dot(u - v, u - v)});
        if (!(nn > least_height_share * least_height_share * longest * longest)) return false;
        const double area = std::sqrt(nn) / 2;
        const Vec3 to_u = cross(v, n) / nn, to_v = cross(n, u) / nn; // the dual basis of u and v
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

    const State& s_;
    const Values& values_;
    std::vector<double> at_;

  public:
    Quadric square;
    std::vector<double> sums;
};

// Attributes of the result: converts the shape to a mesh, and finds the attributes from the log.

/// A point as a weighted mix of up to three elements. Unused elements have weight 0.
struct Mix {
    std::array<Index, 3> of{none, none, none};
    std::array<double, 3> weight{1, 0, 0};
    double distance = HUGE_VAL; ///< squared distance
};

/// Parameter of the point of a segment that is nearest to p, 0 at a.
double nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 edge = b - a;
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
}

/// Weights of the corners at the point of a triangle that is nearest to p.
std::array<double, 3> nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& q) {
    const Vec3 u = q[1] - q[0], v = q[2] - q[0], d = p - q[0];
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), du = dot(d, u), dv = dot(d, v);
    const double det = uu * vv - uv * uv;
    if (det > 0) {
        const double s = (vv * du - uv * dv) / det, t = (uu * dv - uv * du) / det;
        if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
    }
    std::array<double, 3> best{1, 0, 0};
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        const double t = nearest_on_segment(p, q[k], q[n]);
        const Vec3 off = mix(q[k], q[n], t) - p;
        if (!(dot(off, off) < least)) continue;
        least = dot(off, off);
        best = {0, 0, 0};
        best[k] = 1 - t;
        best[n] = t;
    }
    return best;
}

/// Maps the elements of a domain (vertices or wedges) from the input mesh to the result.
class Followed {
  public:
    /// survivors: the old element of each new element. vertex_of: the new vertex of each new element.
    /// element: the old element at a corner.
    template <class Element>
    Followed(const Shape& s, const Mesh& from, const Log& log, std::size_t old_count,
             const std::vector<Index>& survivors, const std::vector<Index>& vertex_of,
             const std::vector<Merge>& merges, Element&& element)
        : s_(s), from_(from), features_(log.features), survivors_(survivors), vertex_of_(vertex_of) {
        find_owners(old_count, merges);
        corner_element_.resize(from.corner_count());
        parallel_for(corner_element_.size(),
                     [&](std::size_t c) { corner_element_[c] = element(static_cast<Index>(c)); });
        gather_faces();
    }

    Provenance element_provenance() const {
        std::vector<Mix> mixes(survivors_.size());
        parallel_for(
            mixes.size(), [&](std::size_t e) { mixes[e] = mix_of(static_cast<Index>(e)); }, 1024);
        Provenance element_provenance;
        element_provenance.mix_offsets.assign(1, 0);
        for (const Mix& m : mixes) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!(m.weight[k] > 0)) continue;
                element_provenance.mix_sources.push_back(m.of[k]);
                element_provenance.mix_weights.push_back(m.weight[k]);
            }
            element_provenance.mix_offsets.push_back(
                static_cast<Index>(element_provenance.mix_sources.size()));
        }
        return element_provenance;
    }

  private:
    bool moved(Index e) const { return s_.moved[vertex_of_[e]] != 0; }

    /// Finds the new element that each old element merged into, from the last merge to the first.
    void find_owners(std::size_t old_count, const std::vector<Merge>& merges) {
        owner_.assign(old_count, none);
        for (std::size_t e = 0; e < survivors_.size(); ++e) owner_[survivors_[e]] = static_cast<Index>(e);
        for (auto m = merges.rbegin(); m != merges.rend(); ++m) owner_[m->b] = owner_[m->a];
    }

    /// Calls body(new element) once for each moved element that contains a corner of the face.
    template <class Body>
    void owners_of(Index f, Body&& body) const {
        const auto owner = [&](Index k) { return owner_[corner_element_[3 * f + k]]; };
        for (Index k = 0; k < 3; ++k) {
            const Index e = owner(k);
            if (e == none || !moved(e) || (k > 0 && e == owner(0)) || (k > 1 && e == owner(1))) continue;
            body(e);
        }
    }

    void gather_faces() {
        begin_.assign(survivors_.size() + 1, 0);
        const auto faces = static_cast<Index>(from_.face_count());
        for (Index f = 0; f < faces; ++f) owners_of(f, [&](Index e) { ++begin_[e]; });
        faces_.resize(exclusive_scan(begin_));
        std::vector<Index> at(begin_.begin(), begin_.end() - 1);
        for (Index f = 0; f < faces; ++f) owners_of(f, [&](Index e) { faces_[at[e]++] = f; });
    }

    Mix mix_of(Index e) const {
        Mix best;
        best.of[0] = survivors_[e];
        if (!moved(e)) return best;
        const Index v = vertex_of_[e];
        const Vec3 p = s_.frame.outside(s_.at[v]);
        if (!features_.empty())
            for (Index i = begin_[e]; i < begin_[e + 1]; ++i) try_lines(e, faces_[i], p, best);
        if (best.distance == HUGE_VAL)
            for (Index i = begin_[e]; i < begin_[e + 1]; ++i) try_face(faces_[i], p, best);
        order(best);
        return best;
    }

    void try_face(Index f, const Vec3& p, Mix& best) const {
        const std::array<Vec3, 3> q{from_.point(3 * f), from_.point(3 * f + 1), from_.point(3 * f + 2)};
        const auto w = nearest_on_triangle(p, q);
        const Vec3 off = q[0] * w[0] + q[1] * w[1] + q[2] * w[2] - p;
        if (!(dot(off, off) < best.distance)) return;
        best.distance = dot(off, off);
        for (std::size_t k = 0; k < 3; ++k) best.of[k] = corner_element_[3 * f + k];
        best.weight = w;
    }

    /// Tries the feature edges of a face that start at an element of e. They run from the lower vertex, so
    /// that both sides of a seam get the same numbers.
    void try_lines(Index e, Index f, const Vec3& p, Mix& best) const {
        for (Index k = 0; k < 3; ++k) {
            Index a = 3 * f + k, b = 3 * f + (k + 1) % 3;
            if (!features_[a]) continue;
            if (owner_[corner_element_[a]] != e && owner_[corner_element_[b]] != e) continue;
            if (from_.vertex(a) > from_.vertex(b)) std::swap(a, b);
            const double t = nearest_on_segment(p, from_.point(a), from_.point(b));
            const Vec3 off = mix(from_.point(a), from_.point(b), t) - p;
            if (!(dot(off, off) < best.distance)) continue;
            best = {{corner_element_[a], corner_element_[b], none}, {1 - t, t, 0}, dot(off, off)};
        }
    }

    /// Puts the element with the largest weight first: attributes that cannot be mixed come from it.
    static void order(Mix& m) {
        for (const std::size_t k : {1u, 2u}) {
            if (!(m.weight[k] > m.weight[0])) continue;
            std::swap(m.weight[k], m.weight[0]);
            std::swap(m.of[k], m.of[0]);
        }
    }

    const Shape& s_;
    const Mesh& from_;
    const std::vector<std::uint8_t>& features_; ///< see Log::features
    const std::vector<Index>&survivors_, &vertex_of_;
    std::vector<Index> owner_, corner_element_; ///< [old elements] new elements; [corners] old elements
    std::vector<Index> begin_, faces_;          ///< [new elements] the faces that contributed to each
};

/// Fills corners and wedge_vertex; returns the surviving wedges of the input, in the order of the new wedges.
std::vector<Index> number_wedges(Mesh& to, const Shape& s, std::size_t old_wedges) {
    if (!s.has_seams()) {
        to.corners = s.tri;
        return {};
    }
    std::vector<Index> number(old_wedges, none), survivors;
    to.corners.resize(s.wedge.size());
    for (std::size_t c = 0; c < s.wedge.size(); ++c) {
        Index& n = number[s.wedge[c]];
        if (n == none) {
            n = static_cast<Index>(survivors.size());
            survivors.push_back(s.wedge[c]);
            to.wedge_vertex.push_back(s.tri[c]);
        }
        to.corners[c] = n;
    }
    return survivors;
}

Provenance copies(std::vector<Index> old) {
    Provenance element_provenance;
    element_provenance.copies = std::move(old);
    return element_provenance;
}

/// Maps each number to itself.
std::vector<Index> identity(std::size_t n) {
    std::vector<Index> list(n);
    parallel_for(n, [&](std::size_t i) { list[i] = static_cast<Index>(i); });
    return list;
}

/// The sources of the shape's vertices.
Provenance vertex_provenance(const Shape& s, const Mesh& from, const Log& log) {
    std::vector<Merge> merges;
    merges.reserve(log.steps.size());
    for (const Step& step : log.steps) merges.push_back({step.a, step.b});
    return Followed(s, from, log, from.vertex_count(), s.source, identity(s.vertex_slots()), merges,
                    [&](Index c) { return from.vertex(c); })
        .element_provenance();
}

/// The sources of the shape's wedges, given wedge_vertex and the old wedges.
Provenance wedge_provenance(const Shape& s, const Mesh& from, const Log& log,
                            const std::vector<Index>& wedges, const std::vector<Index>& wedge_vertex) {
    return Followed(s, from, log, from.wedge_count(), wedges, wedge_vertex, log.wedges,
                    [&](Index c) { return from.corners[c]; })
        .element_provenance();
}

} // namespace

std::optional<AttributeError> attribute_error(const State& s, const Mesh& mesh,
                                              const AttributeWeights& weights, bool normals) {
    const Values values(mesh, weights, normals, s.frame.scale);
    if (values.count() == 0) return {};
    AttributeError error;
    error.channels = values.count();
    const std::size_t elements = s.has_seams() ? mesh.wedge_count() : s.vertex_slots();
    const std::size_t size = 4 * error.channels;
    error.squares.resize(elements);
    error.sums.resize(size * elements);
    // Each vertex visits its own faces, so no two workers touch the same element.
    parallel_chunks(s.vertex_slots(), [&](std::size_t begin, std::size_t end) {
        FaceGradients face(s, values);
        for (std::size_t v = begin; v < end; ++v)
            for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c]) {
                if (!face.look(c / 3)) continue;
                const Index e = element(s, c);
                error.squares[e] += face.square;
                double* sums = &error.sums[size * e];
                for (std::size_t i = 0; i < size; ++i) sums[i] += face.sums[i];
            }
    });
    return error;
}

Quadric residual(const AttributeError& error, Index a, Index b) {
    Quadric q = error.squares[a] + error.squares[b];
    if (!(q.weight > 0)) return {};
    const double share = 1 / q.weight;
    const std::size_t size = 4 * error.channels;
    const double *x = &error.sums[size * a], *y = &error.sums[size * b];
    for (std::size_t i = 0; i < size; i += 4) {
        const Vec3 g{x[i] + y[i], x[i + 1] + y[i + 1], x[i + 2] + y[i + 2]}, w = g * share;
        const double d = x[i + 3] + y[i + 3];
        q.xx -= w.x * g.x;
        q.xy -= w.x * g.y;
        q.xz -= w.x * g.z;
        q.yy -= w.y * g.y;
        q.yz -= w.y * g.z;
        q.zz -= w.z * g.z;
        q.b += w * d;
        q.c -= share * d * d;
    }
    return q;
}

void join(AttributeError& error, Index a, Index b) {
    error.squares[a] += error.squares[b];
    const std::size_t size = 4 * error.channels;
    for (std::size_t i = 0; i < size; ++i) error.sums[size * a + i] += error.sums[size * b + i];
}

bool carries_attributes(const Mesh& mesh) {
    return has_attributes(mesh, Domain::vertex) || has_attributes(mesh, Domain::wedge);
}

Finished finish(const Shape& s, const Mesh& from, const Log* log) {
    Finished done;
    Mesh& to = done.mesh;
    to.positions.resize(s.vertex_slots());
    parallel_for(to.positions.size(), [&](std::size_t v) {
        to.positions[v] = s.moved[v] ? s.frame.outside(s.at[v]) : from.positions[s.source[v]];
    });
    done.wedges = number_wedges(to, s, from.wedge_count());
    MeshProvenance provenance;
    provenance.faces = s.face_source;
    const bool any = log && !log->steps.empty();
    const bool of_wedges = has_attributes(from, Domain::wedge);
    if (any && (has_attributes(from, Domain::vertex) || (!s.has_seams() && of_wedges)))
        provenance.vertices = vertex_provenance(s, from, *log);
    else
        provenance.vertices = copies(s.source);
    if (!s.has_seams())
        provenance.wedges = provenance.vertices;
    else if (any && of_wedges)
        provenance.wedges = wedge_provenance(s, from, *log, done.wedges, to.wedge_vertex);
    else
        provenance.wedges = copies(done.wedges);
    done.changes = inherit_attributes(to, from, provenance);
    return done;
}

} // namespace facetmill::simplification
