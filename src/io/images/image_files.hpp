#pragma once
// Images that a mesh file refers to: the rule for reading them, their types, and their names next to the
// output. The directory rule allows files below the input's directory, or below one of its asset roots.

#include "io/codec.hpp"

#include <optional>
#include <set>

namespace facetmill::io {

/// The path to open for a file that the input refers to; none if the directory rule forbids it. Links are
/// resolved first, so they cannot bypass the rule.
[[nodiscard]] std::optional<std::filesystem::path> path_below(const Input& input,
                                                              const std::filesystem::path& relative);

/// A hint on how to allow a file that the directory rule refuses. Empty if no option allows it (an absolute
/// path, a URL).
[[nodiscard]] std::string hint_for_asset_root(const Input& input,
                                              const std::optional<std::filesystem::path>& relative);

/// The relative path in a text, with slashes or backslashes. It may leave the directory ("../wood.png").
/// None if it is empty or absolute.
[[nodiscard]] std::optional<std::filesystem::path> relative_path_of(std::string name);

/// The bytes of an image near the input. Adds its path to the log. If it cannot be read, returns none and
/// adds a warning (W-IMAGE) that begins with `where`. relative: none if the name is not a relative path.
[[nodiscard]] std::optional<Bytes> read_image(const Input& input,
                                              const std::optional<std::filesystem::path>& relative,
                                              const std::string& name, const std::string& where,
                                              ReadLog& log);

/// The media type by the first bytes: "image/png", "image/jpeg", "image/webp", "image/avif", "image/ktx2"
/// or "image/vnd-ms.dds"; otherwise empty.
[[nodiscard]] std::string media_type(Span bytes);

/// The colour channels of a PNG or JPEG, from its header.
struct ImageColours {
    bool grey = false, alpha = false;
};
/// None if the bytes are neither PNG nor JPEG, or end too early.
[[nodiscard]] std::optional<ImageColours> image_colours(Span bytes);

/// The file suffix for a media type ("image/png"); the PNG suffix for types other than JPEG, WebP, AVIF and
/// KTX2.
[[nodiscard]] std::string suffix_of_image(const std::string& type);

/// A file name for an embedded image of a document: its name, otherwise its number, with the suffix of its
/// kind. Contains no folder, and has at most about 100 bytes.
[[nodiscard]] std::filesystem::path file_name_of_image(const std::string& name, std::size_t index,
                                                       Span bytes);

/// Whether the file exists with these bytes.
bool has_bytes(const std::filesystem::path& path, Span bytes);

/// A relative path as a URI: special bytes become %XX.
[[nodiscard]] std::string uri_of(const std::filesystem::path& relative);

/// Names images next to an output. For lamp.gltf, "textures/wood.png" becomes "textures/lamp.wood.png", so
/// that two outputs in a folder never share a name for different images. "../textures/wood.png" gets the
/// same name, because no file is written outside the output's folder.
class ImageNames {
  public:
    enum class Spelling {
        kept, ///< the same as in the input
        plain ///< without blanks and quotes, for text lines with a file name among other words
    };
    /// The output's other files are named `stem` plus the suffix of a mesh format.
    explicit ImageNames(const std::string& stem, Spelling spelling = Spelling::kept);
    /// Returns the output name for an image with this name. Names that differ only in case count as equal.
    std::filesystem::path add(const std::filesystem::path& relative);

  private:
    Spelling spelling_;
    std::string stem_;
    std::set<std::string> taken_; ///< used names, in lower case
};

} // namespace facetmill::io
