// Skinned parts that have moved. glTF's skinning moves a vertex p to the sum of weight * joint world matrix *
// inverse bind matrix * p. To move the part by C, vertices become C p. The joint world matrices become C *
// joint world matrix, through a node above their roots. The inverse bind matrices B become B * inverse(C).
// The sum is then moved by C in every pose.

#include "io/gltf/read/skins.hpp"

#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

std::size_t root_of(const std::vector<NodeFrame>& frames, std::size_t node) {
    while (frames[node].parent >= 0) node = static_cast<std::size_t>(frames[node].parent);
    return node;
}

/// The roots above a skin's joints.
std::set<std::size_t> roots_of(const Json& document, const std::vector<NodeFrame>& frames, std::size_t skin) {
    std::set<std::size_t> roots;
    const JsonCursor joints = item(document, "skins", skin).at("joints");
    for (std::size_t j = 0; j < joints.size(); ++j)
        roots.insert(root_of(frames, joints.at(j).index(frames.size(), "node")));
    return roots;
}

} // namespace

std::vector<float> bind_matrices(Source& source, const JsonCursor& skin, std::size_t joints) {
    if (const auto reference = skin.find("inverseBindMatrices")) {
        const Accessor a = accessor(source, *reference);
        if (a.components != 16 || a.component_type != float32 || a.count < joints)
            reference->fail("expected a matrix of float32 for each joint");
        return std::get<std::vector<float>>(decode(source, a));
    }
    std::vector<float> all(16 * joints, 0.0F);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i % 16 % 5 == 0 ? 1.0F : 0.0F;
    return all;
}

Transform from_columns(const float* m) {
    Transform t;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) t.m[row][column] = m[4 * column + row];
    return t;
}

namespace {

void to_columns(const Transform& t, float* m) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            m[4 * column + row] = static_cast<float>(t.m[row][column]);
}

void move_bind_matrices(Patch& patch, std::size_t skin, const Transform& back) {
    const JsonCursor place = item(patch.builder.source().json(), "skins", skin);
    std::vector<float> matrices = bind_matrices(patch.builder.source(), place, place.at("joints").size());
    for (std::size_t i = 0; i + 16 <= matrices.size(); i += 16)
        to_columns(from_columns(&matrices[i]) * back, &matrices[i]);
    if (const auto old = place.find("inverseBindMatrices"))
        patch.builder.release({{"attributes", {{"old", old->json()}}}});
    Bytes bytes(matrices.size() * sizeof(float));
    std::memcpy(bytes.data(), matrices.data(), bytes.size());
    const std::size_t view = patch.builder.add_view(std::move(bytes));
    const std::size_t moved = patch.builder.add_accessor({{"bufferView", view},
                                                          {"componentType", int(float32)},
                                                          {"count", matrices.size() / 16},
                                                          {"type", "MAT4"}});
    patch.builder.json()["skins"][skin]["inverseBindMatrices"] = moved;
}

} // namespace

Scene in_bind_pose(Scene scene, int base, std::map<std::size_t, Transform>& skin_moves,
                   std::vector<Diagnostic>& warnings) {
    const Json document =
        base < 0 ? Json::object() : parse_document(scene.documents[static_cast<std::size_t>(base)]->json);
    const auto frames = node_frames(document);
    std::map<std::size_t, Transform> root_moves;
    for (Part& part : scene.parts) {
        if (!part.skinned) continue;
        const Transform move = std::exchange(part.transform, Transform{});
        apply(part.mesh, move);
        if (part.document != base || part.node < 0) continue;
        const auto skin = item(document, "nodes", static_cast<std::size_t>(part.node)).at("skin").natural();
        const auto roots = roots_of(document, frames, skin);
        const bool elsewhere = std::any_of(roots.begin(), roots.end(), [&](std::size_t root) {
            const auto known = root_moves.find(root);
            return known != root_moves.end() && known->second != move;
        });
        if (elsewhere || !inverse(move)) {
            part.skinned = false;
            warnings.push_back(
                {Severity::warning,
                 "W-SKIN",
                 fmt::format("part '{}' {} and loses its skin", part.name,
                             elsewhere ? "has moved away from others of its skeleton" : "has been flattened"),
                 {},
                 "move all parts of a skeleton in the same way"});
            continue;
        }
        for (const std::size_t root : roots) root_moves[root] = move;
        skin_moves[skin] = move;
    }
    return scene;
}

void move_skins(Patch& patch, Claims& claims, const std::map<std::size_t, Transform>& skin_moves) {
    std::map<std::size_t, Transform> roots;
    for (const auto& [skin, move] : skin_moves) {
        if (move.identity()) continue;
        for (const std::size_t root : roots_of(patch.builder.source().json(), claims.frames, skin))
            roots[root] = move;
        move_bind_matrices(patch, skin, inverse(move).value());
    }
    std::vector<std::size_t> root(claims.frames.size());
    for (std::size_t n = 0; n < root.size(); ++n) root[n] = root_of(claims.frames, n);
    for (std::size_t n = 0; n < root.size(); ++n)
        if (const auto move = roots.find(root[n]); move != roots.end())
            claims.frames[n].world = move->second * claims.frames[n].world;
    for (const auto& [node, move] : roots) move_from_above(patch, node, move);
    claims.above = std::move(roots);
}

} // namespace facetmill::io::gltf
