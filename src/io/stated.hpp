#pragma once
// Units and up axes stated in comments, for formats without them. OBJ and OFF use "# unit: mm" and "# up:
// z", PLY uses "comment unit: mm". The header of binary STL has the same words.

#include "io/codec.hpp"
#include "io/convert.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

/// The unit and axis that comments state. no_unit, no_up: a stated value that is not a unit or an axis.
struct Stated : Convention {
    std::string no_unit, no_up;
};

/// Comments that state the scene's unit and up axis, if known, each after `before`. With the default end and
/// `before` "# ": "# unit: m\n# up: y\n".
[[nodiscard]] std::string stated_comments(const Scene& scene, std::string_view before,
                                          std::string_view after = "\n");

/// Takes the unit or axis that a comment states. The last statement is used; other comments are ignored.
void take_comment(std::string_view comment, Stated& stated);

/// Whether a comment states a unit or an axis, possibly an unknown one.
[[nodiscard]] bool states(std::string_view comment);

/// The statements of the comments (#) at the start of a text, up to its first other line. If that line ends
/// with `keyword` (ignoring a comment), the comments after it count too.
[[nodiscard]] Stated stated_in_lines(std::string_view text, std::string_view keyword = {});

/// Sets the scene's unit and axis from the file's statements. Warns (W-UNITS, W-UP) of an invalid unit or
/// axis, unless the load settings give it.
void take_stated(Scene& scene, const Stated& stated, const std::string& file, const ReadSettings& settings,
                 ReadLog& log);
void take_stated(FileHeader& header, const Convention& stated);

/// Warnings W-OVERRIDDEN for the unit and for the axis, if the load settings differ from the file's
/// statement.
[[nodiscard]] std::vector<ReadWarning> overridden(const std::string& file, const Convention& stated,
                                                  const ReadSettings& settings);

} // namespace facetmill::io
