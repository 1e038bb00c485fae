#include "cells/sources/pieces.hpp"

#include "base/math/random.hpp"
#include "base/sort_unique.hpp"

#include <algorithm>
#include <bit>

namespace facetmill::cells {

std::uint64_t name_of_place(const Vec3& p, std::uint64_t seed) {
    std::uint64_t name = seed;
    for (std::size_t axis = 0; axis < 3; ++axis)
        name = hashed(name, std::bit_cast<std::uint64_t>(p[axis] + 0.0)); // -0 equals 0
    return name;
}

Piece some_faces(const Piece& all, const std::vector<Index>& faces) {
    std::vector<Index> kept;
    kept.reserve(3 * faces.size());
    for (const Index f : faces)
        for (const Index v : all.mesh.face_wedges(f)) kept.push_back(v);
    sort_unique(kept);
    Piece some;
    for (const Index v : kept) {
        some.mesh.positions.push_back(all.mesh.positions[v]);
        some.names.push_back(all.names[v]);
    }
    some.mesh.corners.reserve(3 * faces.size());
    for (const Index f : faces)
        for (const Index v : all.mesh.face_wedges(f))
            some.mesh.corners.push_back(
                static_cast<Index>(std::lower_bound(kept.begin(), kept.end(), v) - kept.begin()));
    for (const Attribute& whole : all.mesh.attributes) {
        Attribute& a = some.mesh.attributes.emplace_back(whole);
        a.select(a.domain == Domain::face ? faces : kept);
    }
    return some;
}

Vec3 centre_of(const Mesh& triangles, std::size_t face) {
    Vec3 centre;
    for (std::size_t c = 3 * face; c < 3 * face + 3; ++c)
        centre = centre + triangles.point(static_cast<Index>(c)) / 3;
    return centre;
}

void each_batch(FaceSource& source, std::size_t memory, const std::function<void(io::Span)>& use) {
    constexpr std::size_t at_once = 1 << 15; // number of faces
    const std::size_t full = at_once * source.record_size();
    io::Bytes waiting;
    source.each_record(
        [&](io::Span record) {
            waiting.insert(waiting.end(), record.begin(), record.end());
            if (waiting.size() < full) return;
            use(waiting);
            waiting.clear();
        },
        memory);
    if (!waiting.empty()) use(waiting);
}

} // namespace facetmill::cells
