#pragma once
// Images that a mesh file names: which of them are read, of what kind they are, and how they are named beside
// what is written. The directory rule: only files in the directory of the file that is read, or below it, or
// below one of its asset roots.

#include "io/codec.hpp"

#include <optional>
#include <set>

namespace facetmill::io {

/// The path to open for a file that the input names, where the directory rule allows it; links are resolved,
/// which may not lead elsewhere either. Else none.
[[nodiscard]] std::optional<std::filesystem::path> path_below(const Input& input,
                                                              const std::filesystem::path& relative);

/// How to allow a file that the directory rule refuses; empty where nothing does (an absolute path, a URL).
[[nodiscard]] std::string hint_for_asset_root(const Input& input,
                                              const std::optional<std::filesystem::path>& relative);

/// The relative path that a text names, with slashes either way; it may leave the directory ("../wood.png").
/// None when it is empty or absolute.
[[nodiscard]] std::optional<std::filesystem::path> relative_path_of(std::string name);

/// The bytes of an image beside the input, whose path is added to the log. When it cannot be read: none, and
/// a warning (W-IMAGE) that begins with `where`. relative: none when the name is no relative path.
[[nodiscard]] std::optional<Bytes> read_image(const Input& input,
                                              const std::optional<std::filesystem::path>& relative,
                                              const std::string& name, const std::string& where,
                                              ReadLog& log);

/// "image/png", "image/jpeg", "image/webp", "image/ktx2" or "image/vnd-ms.dds" by the first bytes; empty for
/// others.
[[nodiscard]] std::string media_type(Span bytes);

/// What a PNG or JPEG says of its colours.
struct ImageColours {
    bool grey = false, alpha = false;
};
/// None when the bytes are neither PNG nor JPEG, or end before they say it.
[[nodiscard]] std::optional<ImageColours> image_colours(Span bytes);

/// The suffix of files of a media type ("image/png"): that of PNG where it is none of JPEG, WebP and KTX2.
[[nodiscard]] std::string suffix_of_image(const std::string& type);

/// A name for the file of an image that has none, of a document: its own name or else its place there, and
/// the suffix of its kind; no path, and at most about 100 bytes long.
[[nodiscard]] std::filesystem::path file_name_of_image(const std::string& name, std::size_t index,
                                                       Span bytes);

/// Whether the file is there and has these bytes.
bool has_bytes(const std::filesystem::path& path, Span bytes);

/// A relative path as a URI: bytes that a URI gives a meaning are written %XX.
[[nodiscard]] std::string uri_of(const std::filesystem::path& relative);

/// Names of the images beside an output: "textures/wood.png" beside lamp.gltf is "textures/lamp.wood.png", so
/// that two outputs in one folder never have the same name for different images. So is
/// "../textures/wood.png": nothing is written out of the output's folder.
class ImageNames {
  public:
    enum class Spelling {
        kept, ///< as the input has them
        plain ///< for a line of text that names the file among other words: without blanks, quotes ...
    };
    /// The names of the output's other files are the stem and a suffix of a mesh's files.
    explicit ImageNames(const std::string& stem, Spelling spelling = Spelling::kept);
    /// A name for the image that was called so. Names that differ only in case count as the same.
    std::filesystem::path add(const std::filesystem::path& relative);

  private:
    Spelling spelling_;
    std::string stem_;
    std::set<std::string> taken_; ///< in lower case
};

} // namespace facetmill::io
