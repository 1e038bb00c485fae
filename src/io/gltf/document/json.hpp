#pragma once
// A glTF document as JSON; messages give the path of the value: "accessors[3].count: expected ...".

#include "base/error.hpp"
#include "base/json.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace facetmill::io::gltf {

/// Parses a document. Throws a malformed-input error: E-JSON with the byte of the syntax error, or for
/// nesting deeper than 256 levels, because the JSON library recurses when writing and copying. unread: lists
/// that the caller does not need; they are checked for syntax, but may be left empty.
[[nodiscard]] Json parse_document(std::string_view text, std::span<const std::string_view> unread = {});
/// The document as text; replaces invalid UTF-8 in names from other sources.
[[nodiscard]] std::string to_string(const Json& document);

/// A value of the document and its path. Every access checks and throws a malformed-input error (E-GLTF).
class JsonCursor {
  public:
    JsonCursor(const Json& json, std::string path) : json_(&json) {
        if (!path.empty()) above_ = std::make_shared<const std::string>(std::move(path));
    }

    const Json& json() const { return *json_; }
    std::string path() const; ///< "accessors[3].count"

    /// A member of an object; none when absent.
    std::optional<JsonCursor> find(const char* key) const;
    JsonCursor at(const char* key) const; ///< a required member
    JsonCursor at(std::size_t i) const;   ///< an item of an array
    std::size_t size() const;             ///< items of an array

    std::uint64_t natural(std::uint64_t max = UINT64_MAX) const;  ///< an integer from 0 to max
    std::size_t index(std::size_t count, const char* what) const; ///< an index below count
    double real() const;
    bool boolean() const;
    std::string text() const;

    std::uint64_t natural_or(const char* key, std::uint64_t otherwise) const;
    std::string text_or(const char* key, std::string otherwise) const;
    bool boolean_or(const char* key, bool otherwise) const;

    [[noreturn]] void fail(const std::string& message, const char* id = "E-GLTF",
                           std::string hint = {}) const;

    /// A step from an object to a member, by its key in the document, or from an array to an item.
    struct Step {
        const std::string* key = nullptr;
        std::size_t item = 0;
    };
    /// Appends a step to a cursor.
    JsonCursor(const JsonCursor& from, const Step& step, const Json& json);

  private:
    friend std::size_t count_of(const Json& document, const char* name);
    friend JsonCursor item(const Json& document, const char* name, std::size_t i);

    using Member = Json::object_t::value_type;

    explicit JsonCursor(const Json& document) : json_(&document) {}

    [[noreturn]] void expected(const char* what) const;
    const Member* member(const char* key) const;

    const Json* json_;
    std::array<Step, 6> steps_{}; // formatted only on request, because most values are valid
    std::size_t step_count_ = 0;
    std::shared_ptr<const std::string> above_; // path of the value before these steps; null: ""
};

/// An object with these members: key, value, key, value ... Unlike this function, an initialiser list would
/// copy each value and test whether it is a pair. Keys must differ.
template <class... Members>
[[nodiscard]] Json object_of(Members&&... members) {
    Json object = Json::object();
    auto& all = object.get_ref<Json::object_t&>();
    all.reserve(sizeof...(members) / 2);
    const auto add = [&all]<class Value, class... Rest>(const auto& self, const char* key, Value&& value,
                                                        Rest&&... rest) -> void {
        all.emplace_back(key, Json(std::forward<Value>(value)));
        if constexpr (sizeof...(rest) > 0) self(self, std::forward<Rest>(rest)...);
    };
    add(add, std::forward<Members>(members)...);
    return object;
}

/// A top-level array of the document ("accessors"), or none when it is absent.
[[nodiscard]] std::optional<JsonCursor> list(const Json& document, const char* name);
/// Length of a top-level array, 0 when absent.
[[nodiscard]] std::size_t count_of(const Json& document, const char* name);
/// Item i of a top-level array; i must have been checked against count_of.
[[nodiscard]] JsonCursor item(const Json& document, const char* name, std::size_t i);
/// The index owner[key] if it is below count; none otherwise. Use it for documents in which only the meshes
/// were checked.
[[nodiscard]] std::optional<std::size_t> index_at(const Json& owner, const char* key,
                                                  std::size_t count = SIZE_MAX);

/// Whether "extensionsUsed" has the extension.
bool uses_extension(const Json& document, std::string_view name);
/// True if the object has extensions or extras.
inline bool has_additions(const Json& object) {
    return object.contains("extensions") || object.contains("extras");
}
/// Adds a name to a top-level list ("extensionsUsed"), creating the list if necessary. An existing name stays
/// in its place.
void add_name(Json& document, const char* list, const std::string& name);
/// Removes a name from such a list; the list may become empty.
void remove_name(Json& document, const char* list, const std::string& name);
/// Removes everything except the data of materials. Returns the removed lists that had contents other than
/// mesh positions in the scene.
[[nodiscard]] std::vector<std::string> keep_materials_only(Json& document);
/// Erases an empty top-level array, because glTF forbids these.
void erase_empty(Json& document, const char* list);
/// Erases members that are null, except in extras and extensions. glTF has none; looking at a missing member
/// makes one.
void drop_nulls(Json& json);

} // namespace facetmill::io::gltf
