#include "report/face_kinds.hpp"

namespace facetmill::report {

Json face_kinds_json(const FaceKinds& kinds) {
    Json json = Json::object();
    for (int k = 0; k < polygon::kinds; ++k)
        json[polygon::to_string(static_cast<polygon::Kind>(k))] = kinds.of_kind[static_cast<std::size_t>(k)];
    json["non_planar"] = kinds.non_planar;
    json["deviation"] = kinds.deviation;
    return json;
}

} // namespace facetmill::report
