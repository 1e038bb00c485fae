#pragma once
// What the import helpers share. A helper reads the file from its standard input, and writes to its standard
// output: "FMIMPORT", the size of the notes (8 bytes, little-endian), the notes (JSON), and a GLB. facetmill
// starts it in a sandbox (src/platform/confined_program.hpp) and trusts nothing of its output.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#define JSON_USE_GLOBAL_UDLS 0
#include <nlohmann/json.hpp>

namespace importers {

inline constexpr int vertex_target = 34962; ///< of a buffer view with vertices

using Json = nlohmann::ordered_json;

struct Options {
    std::string format;                         ///< the name of the format, for example "fbx"
    std::string name;                           ///< the name of the file, without its folder; may be empty
    std::vector<std::filesystem::path> folders; ///< the folder of the file, then further ones
    bool keep_unit = false, keep_up = false;    ///< numbers, or axes, stay as they are in the file
    double deviation = 0, ratio = 0.001, degrees = 15; ///< for solids; the deviation in metres
    double unit = 0.001;                               ///< metres per unit of the result, for solids
};

/// The lists that the helper sends beside the GLB.
class Notes {
  public:
    void warn(std::string text) { add("warnings", std::move(text)); }
    void read_file(std::string name) { add("files", std::move(name)); }
    void absent_file(std::string name) { add("absent", std::move(name)); }
    [[nodiscard]] const Json& json() const { return json_; }

  private:
    /// Adds a text once.
    void add(const char* list, std::string text);

    Json json_ = Json::object();
};

/// A glTF document under construction, with its buffer.
class Glb {
  public:
    Glb();
    Json json;

    /// Adds an item to a list of the document and returns its index.
    int add(const char* list, Json item);
    /// Adds bytes as a buffer view. target: 0 for none.
    int view(std::span<const std::byte> bytes, int target = 0);
    /// Adds numbers as an accessor. type: "VEC3" and such.
    int floats(const std::vector<float>& values, const char* type, int target = 0, bool bounds = false);
    int shorts(const std::vector<std::uint16_t>& values, const char* type, bool normalised);
    int indices(const std::vector<std::uint32_t>& values);
    void use_extension(const char* name);

    [[nodiscard]] std::string container();

  private:
    std::string buffer_;
};

/// Decodes the options, reads the file, gives up rights, converts, and writes. Returns the exit code.
int run(int count, char** arguments,
        const std::function<void(const Options&, const std::string& file, Glb&, Notes&)>& convert);

} // namespace importers
