#include "geometry/inspect/place_keys.hpp"

#include "base/random.hpp"

#include <bit>
#include <limits>

namespace facetmill {

namespace {

std::uint64_t bits_of(double x) {
    if (x == 0) return 0;
    return std::bit_cast<std::uint64_t>(x == x ? x : std::numeric_limits<double>::quiet_NaN());
}

bool is_lower(const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

} // namespace

std::uint64_t key_of_point(const Vec3& p) {
    return hashed(hashed(hashed(1, bits_of(p.x)), bits_of(p.y)), bits_of(p.z));
}

// Sums do not ask for an order; the last hash tells apart what sums alike.
std::uint64_t key_of_edge(const Vec3& a, const Vec3& b) {
    return hashed(2, key_of_point(a) + key_of_point(b));
}

std::uint64_t key_of_face(const Mesh& mesh, Index f) {
    std::uint64_t sum = 0;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += key_of_point(mesh.point(c));
    return hashed(hashed(3, mesh.face_size(f)), sum);
}

std::uint64_t key_of_pair(const Mesh& mesh, Index f, Index g) {
    return hashed(4, key_of_face(mesh, f) + key_of_face(mesh, g));
}

std::vector<std::uint64_t> keys_of_pieces(const Mesh& mesh, const std::vector<Index>& of_face,
                                          std::size_t count) {
    std::vector<Vec3> lowest(count, {HUGE_VAL, HUGE_VAL, HUGE_VAL});
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            if (is_lower(mesh.point(c), lowest[of_face[f]])) lowest[of_face[f]] = mesh.point(c);
    std::vector<std::uint64_t> keys;
    for (const Vec3& p : lowest) keys.push_back(hashed(5, key_of_point(p)));
    return keys;
}

} // namespace facetmill
