#pragma once
// The options of separate, and what they take a part apart into.

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
/// Names what has no effect (E-CONFLICT).
void verify_separate(const SeparateOptions& o, const Value& given, Problems& problems);

/// What a part is taken apart into: a label for each face, and a name for each label, in the order of their
/// first faces.
struct FaceLabels {
    std::vector<Index> of_face;
    std::vector<std::string> names;
};

/// The pieces of the part; none where it stays as it is. Throws stage (E-GROUP) when it has no such attribute
/// and is not one of several parts, or one whose values are not all whole numbers.
FaceLabels face_labels(const Part& part, const Scene& scene, const SeparateOptions& o);

} // namespace facetmill::separate_stage
