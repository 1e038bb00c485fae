#include "options/fields.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// The schema of a value that is not null. Schemas of objects are built on request, because a run does not
/// need them.
Json schema_of_value(const Field& field) {
    if (!field.fields || !field.schema.is_null()) return field.schema;
    if (!field.is_list) return field.fields->schema();
    return {{"type", "array"}, {"items", field.fields->schema()}};
}

Json described(const Field& field) {
    Json schema = schema_of_value(field);
    if (!field.null_when.empty()) {
        if (!field.choices.empty())
            schema["enum"].push_back(nullptr);
        else
            schema["type"] = Json::array({schema["type"], "null"});
    }
    std::string about = field.help;
    if (!field.unit.empty()) about += fmt::format(" In {}.", field.unit);
    if (!field.null_when.empty()) about += fmt::format(" Null when {}.", field.null_when);
    if (!field.only_when.empty()) about += fmt::format(" Present only when {}.", field.only_when);
    if (!about.empty()) schema["description"] = about;
    return schema;
}

/// The sums over all items of the list, in the order of their fields: "filled holes 2, welded vertices 12".
std::string tally(const Field& list, const void* record) {
    std::string text;
    for (const Field& field : list.fields->all) {
        if (!field.count) continue;
        std::uint64_t sum = 0;
        list.each(record, [&](const void* item) { sum += field.count(item); });
        if (sum == 0) continue;
        std::string words = field.name;
        std::replace(words.begin(), words.end(), '_', ' ');
        append_item(text, fmt::format("{} {}", words, grouped(sum)));
    }
    return text.empty() ? *list.nothing_counted : text;
}

/// The phrases of the record's fields and of the objects in it.
void add_phrases(const Fields& fields, const void* record, std::string& line) {
    for (const Field& field : fields.all) {
        if (field.phrase && field.name != fields.heading)
            if (const auto phrase = field.phrase(record)) append_item(line, *phrase);
        if (field.fields && !field.is_list)
            field.each(record, [&](const void* object) { add_phrases(*field.fields, object, line); });
    }
}

} // namespace

Field::Field() = default;
Field::Field(const Field&) = default;
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(const Field&) = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

Fields::Fields() = default;
Fields::Fields(const Fields&) = default;
Fields::Fields(Fields&&) noexcept = default;
Fields& Fields::operator=(const Fields&) = default;
Fields& Fields::operator=(Fields&&) noexcept = default;
Fields::~Fields() = default;

Json FieldType<Vec3>::schema() { return fields::schema_of_list(FieldType<double>::schema(), false, 3); }
Json FieldType<Vec3>::json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

namespace fields {

Json schema_of_type(const char* type) { return {{"type", type}}; }

Json schema_of_count() { return {{"type", "integer"}, {"minimum", 0}}; }

Json schema_of_list(Json items, bool may_be_null, std::optional<std::size_t> size) {
    if (may_be_null) items["type"] = Json::array({items["type"], "null"});
    Json list = {{"type", "array"}, {"items", std::move(items)}};
    if (size) list.update({{"minItems", *size}, {"maxItems", *size}});
    return list;
}

void add_member(Json& object, const std::string& name, Json value) {
    object.get_ref<Json::object_t&>().emplace_back(name, std::move(value));
}

Field& start(Fields& fields, std::string_view name, const char* type, Json schema, std::string_view help,
             int optionals) {
    Field& f = fields.all.emplace_back();
    f.name = name;
    f.type = type;
    f.help = help;
    f.schema = std::move(schema);
    f.optionals = optionals;
    if (optionals > 0) f.null_when = "there is none";
    return f;
}

FieldRef object_field(Fields& fields, std::string_view name, std::string_view help,
                      std::shared_ptr<const Fields> inner, int optionals, Each each) {
    Field& f = start(fields, name, "object", nullptr, help, optionals);
    f.put = [inner, each](const Field& self, const void* record, Json& object) {
        const bool there =
            each(record, [&](const void* value) { add_member(object, self.name, inner->json(value)); });
        if (!there && self.only_when.empty()) add_member(object, self.name, nullptr);
    };
    f.fields = std::move(inner);
    f.each = std::move(each);
    return {fields, fields.all.size() - 1};
}

FieldRef list_field(Fields& fields, std::string_view name, std::string_view help,
                    std::shared_ptr<const Fields> inner, int optionals, Each each) {
    Field& f = start(fields, name, "list of objects", nullptr, help, optionals);
    f.is_list = true;
    f.put = [inner, each](const Field& self, const void* record, Json& object) {
        Json all = Json::array();
        const bool there = each(record, [&](const void* item) { all.push_back(inner->json(item)); });
        if (there)
            add_member(object, self.name, std::move(all));
        else if (self.only_when.empty())
            add_member(object, self.name, nullptr);
    };
    f.fields = std::move(inner);
    f.each = std::move(each);
    return {fields, fields.all.size() - 1};
}

void embed(Fields& fields, const Fields& inner, const Function<const void*(const void*)>& within) {
    for (Field f : inner.all) {
        f.put = [put = f.put, within](const Field& self, const void* record, Json& object) {
            put(self, within(record), object);
        };
        if (f.value)
            f.value = [value = f.value, within](const void* record) { return value(within(record)); };
        if (f.phrase)
            f.phrase = [told = f.phrase, within](const void* record) { return told(within(record)); };
        if (f.count)
            f.count = [count = f.count, within](const void* record) { return count(within(record)); };
        if (f.each)
            f.each = [each = f.each, within](const void* record,
                                             const std::function<void(const void*)>& look) {
                return each(within(record), look);
            };
        fields.all.push_back(std::move(f));
    }
}

std::shared_ptr<const Fields> shared(Fields&& fields) {
    return std::make_shared<const Fields>(std::move(fields));
}

#define FACETMILL_HERE(T)                                                                                    \
    template FieldRef typed_field<T>(Fields&, std::string_view, std::size_t, std::string_view);
FACETMILL_COMMON_FIELD_TYPES(FACETMILL_HERE)
#undef FACETMILL_HERE

} // namespace fields

Json Fields::json(const void* record) const {
    Json object = Json::object();
    object.get_ref<Json::object_t&>().reserve(all.size());
    for (const Field& field : all) field.put(field, record, object);
    return object;
}

Json Fields::schema() const {
    Json properties = Json::object(), required = Json::array();
    for (const Field& field : all) {
        properties[field.name] = described(field);
        if (field.only_when.empty()) required.push_back(field.name);
    }
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

std::vector<std::string> Fields::lines(const void* record) const {
    if (tell) return tell(record);
    std::vector<std::string> lines;
    std::string line;
    add_phrases(*this, record, line);
    if (!line.empty()) {
        const auto head =
            std::find_if(all.begin(), all.end(), [&](const Field& f) { return f.name == heading; });
        const auto name = head != all.end() && head->phrase ? head->phrase(record) : std::nullopt;
        lines.push_back(name ? *name + ": " + line : line);
    }
    for (const Field& field : all) {
        if (!field.is_list) continue;
        if (field.nothing_counted)
            lines.push_back(tally(field, record));
        else
            field.each(record, [&](const void* item) {
                for (auto& told : field.fields->lines(item)) lines.push_back(std::move(told));
            });
    }
    return lines;
}

FieldRef& FieldRef::unit(std::string_view text) {
    field().unit = text;
    return *this;
}

FieldRef& FieldRef::null_when(std::string_view text) {
    field().null_when = text;
    return *this;
}

FieldRef& FieldRef::only_when(std::string_view text) {
    Field& f = field();
    f.only_when = text;
    if (f.optionals == 1) f.null_when.clear();
    return *this;
}

FieldRef& FieldRef::heads() {
    owner_->heading = field().name;
    return *this;
}

FieldRef& FieldRef::said(std::string_view format) {
    field().phrase = [value = field().value,
                      format = std::string(format)](const void* record) -> std::optional<std::string> {
        const auto given = value(record);
        if (!given) return {};
        return std::visit([&](const auto& v) { return fmt::format(fmt::runtime(format), v); }, *given);
    };
    return *this;
}

FieldRef& FieldRef::tallied(std::string_view nothing) {
    field().nothing_counted = nothing;
    return *this;
}

} // namespace facetmill
