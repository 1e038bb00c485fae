#include "batch/table.hpp"

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/math/numbers.hpp"
#include "base/text/words.hpp"
#include "io/bytes.hpp"
#include "pipeline/document.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::batch {

namespace {

[[noreturn]] void refuse_table(const Mark& where, std::string message, std::string hint = {}) {
    throw Error(ErrorKind::malformed, "E-TABLE", std::move(message), std::move(hint), where);
}

/// The records of a CSV text.
class CsvReader {
  public:
    explicit CsvReader(std::shared_ptr<const SourceText> source) : source_(std::move(source)) {
        const std::string& text = source_->text;
        const std::string heading = text.substr(0, text.find_first_of("\r\n"));
        for (const char c : {'\t', ';', ','})
            if (heading.find(c) != heading.npos) delimiter_ = c;
    }

    /// Reads the next record: its cells with their marks; false at the end. Skips empty lines.
    bool next(std::vector<Cell>& record) {
        const std::string& text = source_->text;
        while (at_ < text.size() && (text[at_] == '\n' || text[at_] == '\r')) advance();
        if (at_ >= text.size()) return false;
        record.clear();
        while (true) {
            record.push_back(cell());
            if (at_ >= text.size() || text[at_] != delimiter_) break;
            advance();
        }
        return true;
    }

  private:
    /// Moves on one character; continuation bytes do not change the column.
    void advance() {
        const char c = source_->text[at_++];
        if (c == '\n') {
            ++line_;
            column_ = 1;
        } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80)
            ++column_;
    }

    Cell cell() {
        const std::string& text = source_->text;
        Cell out;
        out.where = {source_, line_, column_};
        if (at_ < text.size() && text[at_] == '"')
            quoted(out);
        else
            while (at_ < text.size() && text[at_] != delimiter_ && text[at_] != '\n' && text[at_] != '\r') {
                out.text += text[at_];
                advance();
            }
        out.where.length = std::max(1, column_ - out.where.column);
        return out;
    }

    void quoted(Cell& out) {
        const std::string& text = source_->text;
        advance();
        while (true) {
            if (at_ >= text.size()) refuse_table(out.where, "a quote is not closed");
            if (text[at_] == '"') {
                advance();
                if (at_ >= text.size() || text[at_] != '"') break;
            }
            out.text += text[at_];
            advance();
        }
        if (at_ < text.size() && text[at_] != delimiter_ && text[at_] != '\n' && text[at_] != '\r')
            refuse_table({source_, line_, column_}, "something follows a closing quote",
                         "a quote inside quotes is doubled: \"\"");
    }

    std::shared_ptr<const SourceText> source_;
    char delimiter_ = ',';
    std::size_t at_ = 0;
    int line_ = 1, column_ = 1;
};

std::vector<Row> csv_rows(const std::shared_ptr<const SourceText>& source) {
    CsvReader reader(source);
    std::vector<Cell> heading, record;
    if (!reader.next(heading))
        refuse_table({source}, "the table is empty", "its first line must list params");
    std::set<std::string> names;
    for (const auto& cell : heading) {
        if (cell.text.empty()) refuse_table(cell.where, "a column has no name");
        if (!names.insert(cell.text).second)
            refuse_table(cell.where, fmt::format("two columns are named '{}'", cell.text));
    }
    std::vector<Row> rows;
    while (reader.next(record)) {
        if (record.size() != heading.size())
            refuse_table(record.front().where,
                         fmt::format("the row has {} cells, expected {}", record.size(), heading.size()));
        Row& row = rows.emplace_back();
        for (std::size_t c = 0; c < record.size(); ++c) {
            if (record[c].text.empty()) continue;
            record[c].param = heading[c].text;
            row.push_back(std::move(record[c]));
        }
    }
    return rows;
}

std::vector<Row> yaml_rows(std::shared_ptr<const SourceText> source) {
    Problems problems;
    const Value all = pipeline::parse_yaml(std::move(source), problems);
    problems.throw_if_any(ErrorKind::malformed);
    if (!all.is_list())
        refuse_table(all.mark, fmt::format("a table is a list of maps, found {}", all.described()),
                     "- {input: a.ply, keep: 10%}");
    std::vector<Row> rows;
    for (const auto& item : all.items) {
        if (!item.is_map())
            refuse_table(item.mark,
                         fmt::format("a row is a map of params to values, found {}", item.described()),
                         "- {input: a.ply, keep: 10%}");
        Row& row = rows.emplace_back();
        for (const auto& entry : item.entries) {
            if (entry.value.is_null()) continue;
            if (entry.value.is_map())
                refuse_table(entry.value.mark, fmt::format("'{}' is a value or a list of them, found {}",
                                                           entry.key, entry.value.described()));
            if (entry.value.is_list())
                row.push_back({entry.key, pipeline::emit_flow(entry.value), entry.value.mark, entry.value});
            else
                row.push_back({entry.key, entry.value.text, entry.value.mark});
        }
    }
    return rows;
}

// --- GeoJSON: a row per feature

class FeatureRows {
  public:
    explicit FeatureRows(const std::shared_ptr<const SourceText>& source) : where_{source} {}

    std::vector<Row> read() {
        Json json;
        try {
            json = parse_json(where_.source->text);
        } catch (const Json::exception&) {
            refuse_table(where_, "this is not JSON");
        }
        if (!json.is_object() || !json.contains("features") || !json["features"].is_array())
            refuse_table(where_, "this GeoJSON has no features", "save the polygons as a FeatureCollection");
        std::vector<Row> rows;
        std::set<std::string> names;
        const Json& features = json["features"];
        rows.reserve(features.size());
        for (const Json& feature : features) {
            if (!feature.is_object()) refuse_table(where_, "a feature is not an object");
            std::string name = name_of(feature);
            if (name.empty()) name = std::to_string(rows.size() + 1);
            if (!names.insert(name).second)
                refuse_table(where_, fmt::format("two features are named '{}'", name),
                             "give each feature its own name or id");
            rows.push_back({{"name", name, where_}, {"feature", wkt_of(feature, name), where_}});
        }
        return rows;
    }

  private:
    /// The property name or id, otherwise the feature's id. Characters that separate folders become _.
    static std::string name_of(const Json& feature) {
        std::string name;
        const auto take = [&](const Json& object, const char* key) {
            if (!name.empty() || !object.is_object() || !object.contains(key)) return;
            const Json& value = object[key];
            name = value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "";
        };
        static const Json nothing;
        const Json& properties = feature.contains("properties") ? feature["properties"] : nothing;
        for (const char* key : {"name", "Name", "NAME", "id", "ID", "fid"}) take(properties, key);
        take(feature, "id");
        for (char& c : name)
            if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ') c = '_';
        return name == "." || name == ".." ? "_" : name;
    }

    /// The polygons of a feature as WKT, which crop and volume read.
    std::string wkt_of(const Json& feature, const std::string& name) const {
        static const Json nothing;
        const Json& shape = feature.contains("geometry") ? feature["geometry"] : nothing;
        const std::string type = shape.is_object() ? shape.value("type", Json()).dump() : "";
        const Json coordinates = shape.is_object() ? shape.value("coordinates", Json()) : Json();
        if (type == "\"Polygon\"") return "POLYGON " + nested(coordinates, 2, name);
        if (type == "\"MultiPolygon\"") return "MULTIPOLYGON " + nested(coordinates, 3, name);
        refuse_table(where_, fmt::format("feature '{}' is not a polygon", name),
                     "save only features of type Polygon or MultiPolygon");
    }
    /// Lists of positions in brackets. depth: the levels of lists above a position.
    std::string nested(const Json& list, int depth, const std::string& name) const {
        if (!list.is_array() || (depth == 0 && list.size() < 2))
            refuse_table(where_, fmt::format("the coordinates of feature '{}' are malformed", name));
        std::string text;
        if (depth == 0) {
            for (std::size_t i = 0; i < 2; ++i) {
                if (!list[i].is_number())
                    refuse_table(where_, fmt::format("the coordinates of feature '{}' are malformed", name));
                text += (i > 0 ? " " : "") + to_string(list[i].get<double>());
            }
            return text;
        }
        for (const Json& item : list) text += (text.empty() ? "" : ", ") + nested(item, depth - 1, name);
        return "(" + text + ")";
    }

    Mark where_;
};

} // namespace

std::vector<Row> read_params_table(const std::filesystem::path& file) {
    const auto input = io::Input::open(file);
    std::string_view bytes = io::as_text(input.bytes());
    const std::string extension = file.extension().generic_string();
    const bool yaml = extension == ".yaml" || extension == ".yml";
    if (!yaml) bytes = without_byte_order_mark(bytes); // the YAML reader includes it in its marks
    const std::string name = file == "-" ? "standard input" : file.generic_string();
    const auto source = std::make_shared<const SourceText>(SourceText{name, std::string(bytes)});
    auto rows = extension == ".geojson" ? FeatureRows(source).read()
                : yaml                  ? yaml_rows(source)
                                        : csv_rows(source);
    std::erase_if(rows, [](const Row& row) { return row.empty(); });
    if (rows.empty()) refuse_table({source}, "the table has no rows");
    return rows;
}

} // namespace facetmill::batch
