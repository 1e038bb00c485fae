#include "io/gltf/read/features.hpp"

#include "io/gltf/document/json.hpp"

#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// The reason why a set of feature ids is no longer valid; empty if it is valid.
std::string reason_to_drop(const Json& ids, const std::function<bool(const std::string&)>& has) {
    const auto needs = [&](const std::string& attribute) {
        return has(attribute) ? std::string() : fmt::format("feature ids, because {} is missing", attribute);
    };
    if (const auto n = index_at(ids, "attribute")) return needs(fmt::format("_FEATURE_ID_{}", *n));
    if (ids.is_object() && ids.contains("texture"))
        return needs(fmt::format("TEXCOORD_{}", index_at(ids["texture"], "texCoord").value_or(0)));
    return "feature ids by the number of the vertex";
}

} // namespace

bool is_feature_id(std::string_view semantic) {
    return semantic.starts_with("_FEATURE_ID_") || semantic == "_BATCHID";
}

Json features_that_hold(const std::string& extension, const Json& value,
                        const std::function<bool(const std::string&)>& has, std::vector<std::string>& lost) {
    if (extension == "EXT_structural_metadata") return value; // refers to the document, which stays
    if (extension != "EXT_mesh_features" || !value.is_object() || !value.contains("featureIds"))
        return nullptr;
    Json kept = value;
    kept["featureIds"] = Json::array();
    for (const Json& ids : value["featureIds"]) {
        std::string reason = reason_to_drop(ids, has);
        if (reason.empty())
            kept["featureIds"].push_back(ids);
        else
            lost.push_back(std::move(reason));
    }
    return kept["featureIds"].empty() ? Json(nullptr) : kept;
}

} // namespace facetmill::io::gltf
