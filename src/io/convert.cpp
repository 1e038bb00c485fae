#include "io/convert.hpp"

#include "base/text/unique_names.hpp"
#include "io/gltf/gltf.hpp"

#include <utility>

namespace facetmill::io {

namespace {

Transform scaling(double factor) {
    Transform t;
    for (int i = 0; i < 3; ++i) t.m[i][i] = factor;
    return t;
}

} // namespace

Transform turn_up(UpAxis from, UpAxis to) {
    Transform t;
    if (from == to) return t;
    const double s = to == UpAxis::y ? 1 : -1; // from z up to y up: (x, y, z) -> (x, z, -y)
    t.m[1][1] = t.m[2][2] = 0;
    t.m[1][2] = s;
    t.m[2][1] = -s;
    return t;
}

Conversion convert(Scene& scene, const Convention& target) {
    Conversion done;
    if (target.unit != Unit::unknown) {
        done.unit_guessed = scene.unit == Unit::unknown;
        if (!done.unit_guessed) done.factor = metres(scene.unit) / metres(target.unit);
        scene.unit = target.unit;
    }
    if (target.up != UpAxis::unknown) {
        done.up_guessed = scene.up == UpAxis::unknown;
        done.turned = !done.up_guessed && scene.up != target.up;
        if (done.turned) done.transform = turn_up(scene.up, target.up);
        scene.up = target.up;
    }
    if (done.factor != 1) done.transform = scaling(done.factor) * done.transform;
    if (done.transform.identity()) return done;
    for (auto& part : scene.parts) {
        part.transform = done.transform * part.transform;
    }
    std::vector<LengthGrowth> lengths;
    lengths.reserve(scene.parts.size());
    for (const Part& part : scene.parts) lengths.push_back({part.skinned ? done.factor : 1, done.factor});
    scale_material_lengths(scene, lengths);
    done.keys_kept =
        !move_cameras_and_lights(scene, std::vector<bool>(scene.parts.size(), true), done.transform);
    return done;
}

Conversion add_scene(Scene& scene, Scene more) {
    Conversion done;
    if (scene.parts.empty()) {
        scene.unit = more.unit;
        scene.up = more.up;
    } else {
        if (scene.unit == Unit::unknown) scene.unit = more.unit;
        if (scene.up == UpAxis::unknown) scene.up = more.up;
        done = convert(more, {scene.unit, scene.up});
    }
    const auto materials = static_cast<Index>(scene.materials.size());
    const int documents = static_cast<int>(scene.documents.size());
    for (auto& m : more.materials) {
        if (m.document >= 0) m.document += documents;
        scene.materials.push_back(std::move(m));
    }
    for (auto& d : more.documents) scene.documents.push_back(std::move(d));
    UniqueNames names;
    for (const auto& part : scene.parts) names.take(part.name);
    for (auto& part : more.parts) {
        for (auto& p : part.mesh.primitives)
            if (p.material != none) p.material += materials;
        if (part.document >= 0) part.document += documents;
        part.name = names.add(part.name);
        scene.parts.push_back(std::move(part));
    }
    return done;
}

} // namespace facetmill::io
