#pragma once
// The options of separate, and the pieces that they define.

#include "stage/stage.hpp"

namespace facetmill::separate_stage {

struct SeparateOptions {
    enum class By { component, material, group };

    By by = By::component;
    std::string attribute = "group";
    bool cavities = false;
    std::int64_t max_parts = 10000;
};

void declare_separate(Declare<SeparateOptions>& d);
/// Reports options without effect (E-CONFLICT).
void verify_separate(const SeparateOptions& o, const Value& given, Problems& problems);

/// The pieces of a part: a label for each face, and a name for each label, in the order of their first
/// faces.
struct FaceLabels {
    std::vector<Index> of_face;
    std::vector<std::string> names;
};

/// The pieces of the part; none if it stays whole. Throws a stage error (E-GROUP) if a scene's only part
/// lacks the attribute, or if a value is not a whole number.
[[nodiscard]] FaceLabels face_labels(const Part& part, const Scene& scene, const SeparateOptions& o);

} // namespace facetmill::separate_stage
