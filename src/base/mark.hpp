#pragma once
// A location in a text: a pipeline file, command line, or text mesh.

#include <memory>
#include <string>

namespace facetmill {

/// A text and its name in messages.
struct SourceText {
    std::string name;
    std::string text; ///< empty when only the name is known (binary files)
};

/// A location in a text. Lines and columns count from 1, columns in characters; line 0 means the whole file.
struct Mark {
    std::shared_ptr<const SourceText> source;
    int line = 0;
    int column = 0;
    int length = 1; ///< characters to underline

    bool known() const { return source != nullptr; }
};

/// A mark for a whole file.
[[nodiscard]] Mark file_mark(std::string name);
/// A mark for a line of a file that is not kept in memory.
[[nodiscard]] Mark line_mark(std::string name, int line);
/// "file:3:7", "file:3" or "file"; empty when unknown.
[[nodiscard]] std::string to_string(const Mark& mark);

} // namespace facetmill
