#pragma once
// What files of formats without a unit and an up axis tell of them in comments: "# unit: mm" and "# up: z" of
// OBJ and OFF, "comment unit: mm" of PLY, and the same words in the header of binary STL.

#include "io/codec.hpp"
#include "io/convert.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

/// What comments state, and what stands there in the place of a unit or an axis and is none.
struct Stated : Convention {
    std::string no_unit, no_up;
};

/// The comments of a scene, each behind `before`: one for its unit and one for what is up, where they are
/// known. Those of a reader: "# unit: m\n# up: y\n".
std::string stated_comments(const Scene& scene, std::string_view before, std::string_view after = "\n");

/// Takes what a comment states; the last one counts, and other comments say nothing.
void take_comment(std::string_view comment, Stated& stated);

/// What the comments (#) at the beginning of a text state, before its first line of anything else. keyword:
/// what the first such line may end with, but for a comment, for comments to go on behind it.
Stated stated_in_lines(std::string_view text, std::string_view keyword = {});

/// What the reader of a file takes for the scene's. Warns (W-UNITS, W-UP) of what is no unit or no axis,
/// unless load is given one.
void take_stated(Scene& scene, const Stated& stated, const std::string& file, const ReadSettings& settings,
                 ReadLog& log);
void take_stated(FileHeader& header, const Convention& stated);

/// W-OVERRIDDEN for the unit and for the axis, where a file states another one than load is given.
std::vector<ReadWarning> overridden(const std::string& file, const Convention& stated,
                                    const ReadSettings& settings);

} // namespace facetmill::io
