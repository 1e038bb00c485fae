#include "stage/other_names.hpp"

#include "base/text/spelling.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct OtherNames {
    std::string_view stage;
    std::vector<std::string_view> words;
};

/// Made when somebody asks, not at each start.
const std::vector<OtherNames>& other_names() {
    static const std::vector<OtherNames> all{
        {"clean", {"repair", "fix", "heal", "weld", "fill_holes", "close_holes", "fill"}},
        {"clip", {"cut", "trim", "slice_plane"}},
        {"combine",
         {"boolean", "bool", "csg", "union", "difference", "subtract", "intersection", "intersect"}},
        {"crumple", {"noise", "jitter", "displace"}},
        {"generate", {"create", "primitive", "sphere", "cube"}},
        {"load", {"read", "open", "import", "input"}},
        {"measure", {"volume", "area", "mass"}},
        {"merge", {"join", "concatenate", "append"}},
        {"optimize", {"dedup", "prune", "instance", "palette", "reorder"}},
        {"orient", {"flip", "invert", "fix_normals", "reorient"}},
        {"relax", {"smooth", "laplacian", "taubin", "fair"}},
        {"render", {"screenshot", "snapshot", "thumbnail"}},
        {"section", {"slice", "contours", "cross_section"}},
        {"separate", {"explode", "components"}},
        {"simplify", {"decimate", "decimation", "reduce", "quadric", "qem"}},
        {"split", {"subdivide", "refine", "subdivision"}},
        {"textures", {"ktx", "toktx", "webp"}},
        {"thicken", {"shell", "hollow", "offset", "solidify", "extrude", "wireframe"}},
        {"tile", {"chunk", "tiler"}},
        {"transform",
         {"translate", "rotate", "scale", "resize", "move", "center", "centre", "mirror", "convert_units"}},
        {"triangulate", {"tessellate", "tessellation"}},
        {"two-sided", {"double_sided", "doublesided", "doubleside"}},
        {"validate", {"check", "inspect", "info"}},
        {"write", {"save", "export", "output", "convert"}},
    };
    return all;
}

/// What other programs have as one operation, and what does it here: facetmill has no stage for what a few
/// of its stages do together.
struct Chain {
    std::vector<std::string_view> words;
    const char* stages;
};

const std::vector<Chain>& chains() {
    static const std::vector<Chain> all{
        {{"remesh", "remeshing", "isotropic_remesh", "isotropic_remeshing"},
         "edges of about one length come of three stages: split: {max_edge: 2%}, simplify: {ratio: 40%, "
         "method: "
         "shortest-edge}, relax: {iterations: 3, method: taubin}"},
    };
    return all;
}

} // namespace

std::string_view chain_called(std::string_view other_name) {
    std::string word = lower_case(std::string(other_name));
    std::replace(word.begin(), word.end(), '-', '_');
    for (const auto& [words, stages] : chains())
        if (std::find(words.begin(), words.end(), word) != words.end()) return stages;
    return {};
}

std::string_view stage_called(std::string_view other_name) {
    const std::string word = lower_case(std::string(other_name));
    for (const auto& [stage, words] : other_names())
        if (std::find(words.begin(), words.end(), word) != words.end()) return stage;
    return {};
}

std::string hint_for_stage(std::string_view word, const std::vector<std::string>& names) {
    if (const std::string_view chain = chain_called(word); !chain.empty()) return std::string(chain);
    const std::string_view stage = stage_called(word);
    if (!stage.empty())
        return fmt::format("'{}' is done by {} here: facetmill stages {}", word, stage, stage);
    return did_you_mean(word, names, "facetmill stages lists them all");
}

} // namespace facetmill
