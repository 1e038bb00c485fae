#include "geometry/triangulate/face_kinds_fields.hpp"

namespace facetmill {

void declare_face_kinds(DeclareFields<FaceKinds>& d) {
    for (int k = 0; k < polygon::kinds; ++k) {
        const auto kind = static_cast<polygon::Kind>(k);
        d.field(
            polygon::to_string(kind), [kind](const FaceKinds& kinds) { return kinds.count(kind); },
            "Faces of this kind.");
    }
    d.field("non_planar", &FaceKinds::non_planar,
            "Faces that are farther from their plane than float32 rounding can explain.");
    d.field("deviation", &FaceKinds::deviation,
            "The largest distance of a corner from the plane of its face.")
        .unit("scene units");
}

const Fields& face_kinds_fields() {
    static const Fields all = fields_of<FaceKinds>(declare_face_kinds);
    return all;
}

} // namespace facetmill
