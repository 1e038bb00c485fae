#include "io/gltf/document/json.hpp"

#include "base/fast_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

constexpr int deepest = 256;

/// Refuses deep nesting before the parser builds it; brackets inside strings do not count.
void check_depth(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
        } else if (c == '"') {
            quoted = true;
        } else if (c == '{' || c == '[') {
            if (++depth > deepest)
                throw Error(ErrorKind::malformed, "E-JSON",
                            fmt::format("the JSON is nested deeper than {} levels at byte {}", deepest, i));
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

std::string shown(const Json& json) {
    if (json.is_object()) return "an object";
    if (json.is_array()) return "an array";
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 40) text = text.substr(0, 37) + "...";
    return text;
}

} // namespace

Json parse_document(std::string_view text, std::span<const std::string_view> unread) {
    if (auto read = fast_json(text, deepest, unread)) return *std::move(read);
    check_depth(text);
    try {
        return parse_json(text);
    } catch (const Json::parse_error& e) {
        throw Error(ErrorKind::malformed, "E-JSON", fmt::format("not valid JSON at byte {}", e.byte));
    } catch (const Json::exception& e) {
        throw Error(ErrorKind::malformed, "E-JSON", "not valid JSON: a number is out of range");
    }
}

std::string to_string(const Json& document) { return fast_text(document); }

std::string JsonCursor::path() const {
    std::string path = above_ ? *above_ : "";
    for (std::size_t i = 0; i < step_count_; ++i) {
        if (!steps_[i].key)
            path += fmt::format("[{}]", steps_[i].item);
        else
            path += path.empty() ? *steps_[i].key : "." + *steps_[i].key;
    }
    return path;
}

JsonCursor::JsonCursor(const JsonCursor& from, const Step& step, const Json& json) : json_(&json) {
    if (from.step_count_ == steps_.size()) {
        above_ = std::make_shared<const std::string>(from.path());
    } else {
        above_ = from.above_;
        steps_ = from.steps_;
        step_count_ = from.step_count_;
    }
    steps_[step_count_++] = step;
}

void JsonCursor::fail(const std::string& message, const char* id, std::string hint) const {
    const std::string where = path();
    throw Error(ErrorKind::malformed, id, where.empty() ? message : where + ": " + message, std::move(hint));
}

void JsonCursor::expected(const char* what) const {
    fail(fmt::format("expected {}, found {}", what, shown(*json_)));
}

const JsonCursor::Member* JsonCursor::member(const char* key) const {
    if (!json_->is_object()) expected("an object");
    const std::string_view wanted(key);
    for (const auto& member : json_->get_ref<const Json::object_t&>())
        if (member.first.size() == wanted.size() &&
            std::memcmp(member.first.data(), wanted.data(), wanted.size()) == 0)
            return &member;
    return nullptr;
}

std::optional<JsonCursor> JsonCursor::find(const char* key) const {
    if (const Member* found = member(key))
        return std::optional<JsonCursor>(std::in_place, *this, Step{&found->first, 0}, found->second);
    return std::nullopt;
}

JsonCursor JsonCursor::at(const char* key) const {
    const Member* found = member(key);
    if (!found) fail(fmt::format("\"{}\" is missing", key));
    return {*this, {&found->first, 0}, found->second};
}

JsonCursor JsonCursor::at(std::size_t i) const {
    if (i >= size()) fail(fmt::format("item {} of {} is missing", i, size()));
    return {*this, {nullptr, i}, (*json_)[i]};
}

std::size_t JsonCursor::size() const {
    if (!json_->is_array()) expected("an array");
    return json_->size();
}

std::uint64_t JsonCursor::natural(std::uint64_t most) const {
    std::uint64_t value = 0;
    if (json_->is_number_unsigned() || (json_->is_number_integer() && json_->get<std::int64_t>() >= 0)) {
        value = json_->get<std::uint64_t>();
    } else if (json_->is_number_float()) {
        // Some exporters write every number as a float, so 3.0 counts as an integer.
        const double x = json_->get<double>();
        if (!(x >= 0 && x < 9007199254740992.0 && x == std::floor(x)))
            expected("an integer that is not negative");
        value = static_cast<std::uint64_t>(x);
    } else {
        expected("an integer that is not negative");
    }
    if (value > most) fail(fmt::format("expected at most {}, found {}", most, value));
    return value;
}

std::size_t JsonCursor::index(std::size_t count, const char* what) const {
    const std::uint64_t i = natural();
    if (i >= count) fail(fmt::format("refers to {} {}, but there are {}", what, i, count));
    return static_cast<std::size_t>(i);
}

double JsonCursor::real() const {
    if (!json_->is_number()) expected("a number");
    return json_->get<double>();
}

bool JsonCursor::boolean() const {
    if (!json_->is_boolean()) expected("true or false");
    return json_->get<bool>();
}

std::string JsonCursor::text() const {
    if (!json_->is_string()) expected("a string");
    return json_->get<std::string>();
}

std::uint64_t JsonCursor::natural_or(const char* key, std::uint64_t otherwise) const {
    const auto found = find(key);
    return found ? found->natural() : otherwise;
}

std::string JsonCursor::text_or(const char* key, std::string otherwise) const {
    const auto found = find(key);
    return found ? found->text() : std::move(otherwise);
}

bool JsonCursor::boolean_or(const char* key, bool otherwise) const {
    const auto found = find(key);
    return found ? found->boolean() : otherwise;
}

std::optional<JsonCursor> list(const Json& document, const char* name) {
    auto found = JsonCursor(document, "").find(name);
    if (found) found->size(); // fails unless the value is an array
    return found;
}

std::size_t count_of(const Json& document, const char* name) {
    const JsonCursor whole(document);
    const auto* const found = whole.member(name);
    if (!found) return 0;
    return found->second.is_array() ? found->second.size() : list(document, name)->size(); // size() throws
}

JsonCursor item(const Json& document, const char* name, std::size_t i) {
    const JsonCursor whole(document);
    const auto* const found = whole.member(name);
    if (!found || !found->second.is_array() || i >= found->second.size())
        return whole.at(name).at(i); // at() throws
    JsonCursor place(found->second[i]);
    place.steps_[0] = {&found->first, 0};
    place.steps_[1] = {nullptr, i};
    place.step_count_ = 2;
    return place;
}

std::optional<std::size_t> index_at(const Json& owner, const char* key, std::size_t count) {
    if (!owner.is_object()) return {};
    const auto found = owner.find(key);
    if (found == owner.end() || !found->is_number_integer()) return {};
    // Numbers of a document are unsigned, but added numbers may be signed.
    if (!found->is_number_unsigned() && found->get<std::int64_t>() < 0) return {};
    const auto index = found->get<std::size_t>();
    return index < count ? std::optional(index) : std::nullopt;
}

bool uses_extension(const Json& document, std::string_view name) {
    const auto used = document.find("extensionsUsed");
    return used != document.end() && used->is_array() &&
           std::find(used->begin(), used->end(), name) != used->end();
}

void add_name(Json& document, const char* list, const std::string& name) {
    Json& names = document[list];
    if (!names.is_array()) names = Json::array();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void remove_name(Json& document, const char* list, const std::string& name) {
    const auto it = document.find(list);
    if (it == document.end() || !it->is_array()) return;
    Json kept = Json::array();
    for (auto& entry : *it)
        if (entry != name) kept.push_back(std::move(entry));
    *it = std::move(kept);
}

std::vector<std::string> keep_materials_only(Json& document) {
    std::vector<std::string> lost;
    for (const char* list : {"animations", "skins", "cameras"}) {
        if (document.contains(list) && !document[list].empty()) lost.emplace_back(list);
        document.erase(list);
    }
    const auto weighs = [&](const char* list) {
        return document.contains(list) && std::any_of(document[list].begin(), document[list].end(),
                                                      [](const Json& of) { return of.contains("weights"); });
    };
    if (weighs("nodes") || weighs("meshes")) lost.emplace_back("morph weights");
    for (const char* list : {"scenes", "scene", "nodes", "meshes"}) document.erase(list);
    return lost;
}

void drop_nulls(Json& json) {
    if (json.is_object()) {
        std::vector<std::string> nulls;
        for (auto& [key, value] : json.get_ref<Json::object_t&>()) {
            if (value.is_null()) nulls.push_back(key);
            if (value.is_structured() && key != "extras" && key != "extensions") drop_nulls(value);
        }
        for (const std::string& key : nulls) json.erase(key);
    } else if (json.is_array()) {
        for (Json& value : json.get_ref<Json::array_t&>())
            if (value.is_structured()) drop_nulls(value);
    }
}

void erase_empty(Json& document, const char* list) {
    const auto it = document.find(list);
    if (it != document.end() && it->empty()) document.erase(it);
}

} // namespace facetmill::io::gltf
