#include "geometry/normals/unit_vectors.hpp"

#include "mesh/face.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

bool is_direction(const Attribute& a) { return a.role == Role::normal || a.role == Role::tangent; }

/// The sums of the area vectors of the faces at each element of the attribute.
std::vector<Vec3> area_vectors(const Mesh& mesh, const Attribute& a) {
    std::vector<Vec3> sums(a.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 area = area_vector(mesh, f);
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            sums[a.domain == Domain::face     ? f
                 : a.domain == Domain::vertex ? mesh.vertex(c)
                                              : mesh.corners[c]] += area;
    }
    return sums;
}

/// The direction of v, which may be very long or short; none if it has no direction.
std::optional<Vec3> direction_of(Vec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0) || !std::isfinite(largest)) return {};
    v = v / largest;
    return v / length(v);
}

/// A wrong sign of a tangent becomes 1 or -1. Returns whether it was wrong.
bool mend_sign(Attribute& a, std::size_t i) {
    const double sign = a.value(i, 3);
    if (sign == 1 || sign == -1) return false;
    a.set_value(i, 3, sign < 0 ? -1 : 1);
    return a.value(i, 3) != sign;
}

std::size_t scale_directions(const Mesh& mesh, Attribute& a) {
    // The validator of Khronos accepts 0.00674 for normals. Bytes round by up to 0.0068.
    constexpr double accepted_of_floats = 1.0 / 256, accepted_of_integers = 1.0 / 127;
    const double accepted = a.normalised ? accepted_of_integers : accepted_of_floats;
    std::size_t scaled = 0;
    std::vector<Vec3> of_faces;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool sign = a.role == Role::tangent && a.components == 4 && mend_sign(a, i);
        const Vec3 v{a.value(i, 0), a.value(i, 1), a.value(i, 2)};
        if (std::abs(length(v) - 1) <= accepted) {
            scaled += sign;
            continue;
        }
        auto unit = direction_of(v);
        if (!unit && a.role == Role::normal) {
            if (of_faces.empty()) of_faces = area_vectors(mesh, a);
            unit = direction_of(of_faces[i]);
        }
        if (!unit) unit = Vec3{1, 0, 0};
        for (int c = 0; c < 3; ++c) a.set_value(i, c, (*unit)[static_cast<std::size_t>(c)]);
        ++scaled;
    }
    return scaled;
}

/// The joint weights of a mesh, element by element, over all sets.
class JointWeights {
  public:
    explicit JointWeights(Mesh& mesh) {
        for (Attribute& a : mesh.attributes) {
            if (a.role != Role::weights) continue;
            Attribute* joints = nullptr;
            for (Attribute& j : mesh.attributes)
                if (j.role == Role::joints && j.domain == a.domain && set_of(j) == set_of(a) &&
                    j.components == a.components)
                    joints = &j;
            sets_.push_back({&a, joints});
        }
    }

    std::size_t mend_all() {
        std::size_t mended = 0;
        for (std::size_t i = 0; !sets_.empty() && i < sets_.front().weights->size(); ++i) mended += mend(i);
        return mended;
    }

  private:
    struct Set {
        Attribute *weights, *joints; ///< joints may be null
    };
    struct Weight {
        Attribute *weights, *joints;
        int component;
        double value, joint;
    };

    static std::string_view set_of(const Attribute& a) {
        return std::string_view(a.name).substr(std::min(a.name.find('_'), a.name.size()));
    }

    bool mend(std::size_t i) {
        weights_.clear();
        for (const Set& s : sets_)
            for (int c = 0; i < s.weights->size() && c < s.weights->components; ++c)
                weights_.push_back({s.weights, s.joints, c, s.weights->value(i, c),
                                    s.joints ? s.joints->value(i, c) : -1 - static_cast<double>(c)});
        if (is_sound()) return false;
        merge_repeated();
        scale();
        round_integers();
        for (const Weight& w : weights_) {
            w.weights->set_value(i, w.component, w.value);
            if (w.joints) w.joints->set_value(i, w.component, w.value > 0 ? w.joint : 0);
        }
        return true;
    }

    bool is_sound() const {
        double sum = 0, slack = 0;
        for (std::size_t k = 0; k < weights_.size(); ++k) {
            const Weight& w = weights_[k];
            if (!(w.value >= 0) || !std::isfinite(w.value)) return false;
            sum += w.value;
            // glTF 2.0 allows 2e-7 for each weight of floats. Integers must sum to their maximum.
            if (w.value > 0) slack += w.weights->normalised ? 1e-9 : 2e-7;
            for (std::size_t m = 0; m < k; ++m)
                if (w.joints && w.value > 0 && weights_[m].value > 0 && weights_[m].joint == w.joint)
                    return false;
        }
        return std::abs(sum - 1) <= slack;
    }

    void merge_repeated() {
        for (std::size_t k = 0; k < weights_.size(); ++k) {
            Weight& w = weights_[k];
            if (!(w.value > 0) || !std::isfinite(w.value)) w.value = 0;
            for (std::size_t m = 0; m < k && w.value > 0; ++m)
                if (w.joints && weights_[m].value > 0 && weights_[m].joint == w.joint) {
                    weights_[m].value += w.value;
                    w.value = 0;
                }
        }
    }

    void scale() {
        double largest = 0, sum = 0;
        for (const Weight& w : weights_) largest = std::max(largest, w.value);
        if (!(largest > 0)) {
            weights_.front().value = 1;
            return;
        }
        for (Weight& w : weights_) sum += w.value /= largest;
        for (Weight& w : weights_) w.value /= sum;
    }

    /// Rounds to the steps of the type so that the sum is exact: the largest weight takes the rest.
    void round_integers() {
        const auto steps = [](const Weight& w) {
            return std::string_view(w.weights->type()) == "uint16" ? 65535.0 : 255.0;
        };
        if (!weights_.front().weights->normalised) return;
        double rest = 1;
        Weight* largest = &weights_.front();
        for (Weight& w : weights_) {
            w.value = std::floor(w.value * steps(w) + 0.5) / steps(w);
            rest -= w.value;
            if (w.value > largest->value) largest = &w;
        }
        largest->value += rest;
    }

    std::vector<Set> sets_;
    std::vector<Weight> weights_;
};

} // namespace

AttributeChanges scale_to_unit(Mesh& mesh, std::size_t& mended) {
    AttributeChanges changes = kept_changes(mesh.attributes);
    const auto record = [&](bool (*concerns)(const Attribute&), std::size_t count) {
        mended += count;
        for (std::size_t i = 0; count > 0 && i < changes.size(); ++i)
            if (concerns(mesh.attributes[i])) {
                changes[i].kind = AttributeChange::Kind::recomputed;
                changes[i].why = "scaled to unit length or sum";
            }
    };
    std::size_t directions = 0;
    for (Attribute& a : mesh.attributes)
        if (is_direction(a)) directions += scale_directions(mesh, a);
    record(is_direction, directions);
    record([](const Attribute& a) { return a.role == Role::weights || a.role == Role::joints; },
           JointWeights(mesh).mend_all());
    return changes;
}

} // namespace facetmill
