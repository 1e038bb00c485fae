#include "stages/clip/cutter.hpp"

namespace facetmill {

namespace {

/// The value of an option as written, or the whole.
const Value& written(const Value& given, const char* name) {
    const Value* value = given.is_map() ? given.find(name) : nullptr;
    return value ? *value : given;
}

std::vector<Plane> resolved(const CutterOption& o, const Scene& scene, Context& context, const Part* local) {
    std::vector<Plane> planes;
    if (o.box) planes = planes_of(*o.box);
    if (o.plane) planes.push_back(resolve_plane(*o.plane, scene, context, "plane", local));
    for (const PlaneOption& p : o.planes) planes.push_back(resolve_plane(p, scene, context, "planes", local));
    return planes;
}

} // namespace

void verify_cutter(const CutterOption& option, const Value& given, Problems& problems) {
    const Value& planes = written(given, "planes");
    if (option.plane) verify_plane(*option.plane, written(given, "plane").mark, problems);
    if (option.box) verify_box(*option.box, written(given, "box").mark, problems);
    if (given.is_map() && given.find("planes") && planes.is_list() && planes.items.empty())
        problems.add(planes.mark, "E-PLANE", "'planes' is empty", "for example planes: [z=0, x=centre]");
    for (std::size_t i = 0; i < option.planes.size(); ++i) {
        const bool listed = planes.is_list() && i < planes.items.size();
        verify_plane(option.planes[i], listed ? planes.items[i].mark : given.mark, problems);
    }
}

Cutter::Cutter(const CutterOption& option, const Scene& scene, Context& context)
    : option_(option), scene_(scene), context_(context) {
    if (option.space == Space::local) return;
    world_ = resolved(option, scene, context, nullptr);
}

std::vector<Plane> Cutter::planes_for(const Part& part) const {
    if (option_.space == Space::local) return resolved(option_, scene_, context_, &part);
    std::vector<Plane> planes = world_;
    for (Plane& p : planes) p = pulled_back(p, part.transform);
    return planes;
}

} // namespace facetmill
