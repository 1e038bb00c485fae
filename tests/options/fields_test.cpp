// One declaration of the fields of a result gives its JSON, its schema and the lines on the terminal.

#include "options/fields.hpp"

#include "support/catch.hpp"

namespace facetmill {

namespace {

enum class Stop { target, passes };

struct Size {
    double area = 0;
    std::optional<double> volume;
};

struct Row {
    std::string part;
    std::size_t welded_vertices = 0, filled_holes = 0;
    Size size;
    Stop stop = Stop::target;
    std::optional<double> last_move;
    std::optional<std::optional<std::size_t>> pairs;
};

struct Result {
    std::vector<Row> parts;
    std::optional<Vec3> centroid;
    NamedCounts kinds;
};

void declare_size(DeclareFields<Size>& d) {
    d.field("area", &Size::area, "Of the surface.").unit("square scene units").said("area {:.3g}");
    d.field("volume", &Size::volume, "Of the inside.").null_when("it is open").said("volume {:.3g}");
}

void declare_row(DeclareFields<Row>& d) {
    d.field("part", &Row::part, "Its name.").said("{}").heads();
    d.field("welded_vertices", &Row::welded_vertices, "Made one with others.");
    d.field("filled_holes", &Row::filled_holes, "Closed.");
    d.object("size", &Row::size, "Its size.", declare_size);
    d.choice("stopped_by", &Row::stop, {{"target", Stop::target, "met"}, {"passes", Stop::passes, "used up"}},
             "What ended it.");
    d.field("last_move", &Row::last_move, "The last move.").only_when("until is given");
    d.field("pairs", &Row::pairs, "Pairs that meet.").only_when("asked for").null_when("not looked for");
}

Fields declared_fields(bool tallied = false) {
    return fields_of<Result>([&](DeclareFields<Result>& d) {
        auto parts = d.list("parts", &Result::parts, "Each part.", declare_row);
        if (tallied) parts.tallied("nothing to do");
        d.field("centroid", &Result::centroid, "The middle.");
        d.counts("kinds", &Result::kinds, {"quad", "triangle"}, "Faces by kind.");
    });
}

Result result() {
    Result r;
    r.parts = {{"a", 1200, 0, {6, 1.0}, Stop::target, 0.25, std::optional<std::size_t>()},
               {"b", 34, 2, {0.5, {}}, Stop::passes, {}, {}}};
    r.kinds = {{"quad", 6}};
    return r;
}

} // namespace

TEST_CASE("fields: what is empty is null, or not there", "[options]") {
    const Result r = result();
    const Json json = declared_fields().json(&r);
    CHECK(json.dump() ==
          R"({"parts":[{"part":"a","welded_vertices":1200,"filled_holes":0,"size":{"area":6.0,"volume":1.0},)"
          R"("stopped_by":"target","last_move":0.25,"pairs":null},)"
          R"({"part":"b","welded_vertices":34,"filled_holes":2,"size":{"area":0.5,"volume":null},)"
          R"("stopped_by":"passes"}],"centroid":null,"kinds":{"quad":6}})");
}

TEST_CASE("fields: the schema requires what is always there and allows nothing else", "[options]") {
    const Json schema = declared_fields().schema();
    CHECK(schema["additionalProperties"] == false);
    CHECK(schema["required"] == Json::array({"parts", "centroid", "kinds"}));
    const Json& row = schema["properties"]["parts"]["items"];
    CHECK(row["required"] == Json::array({"part", "welded_vertices", "filled_holes", "size", "stopped_by"}));
    CHECK(row["properties"]["pairs"]["type"] == Json::array({"integer", "null"}));
    CHECK(row["properties"]["last_move"]["type"] == "number");
    CHECK(row["properties"]["stopped_by"]["enum"] == Json::array({"target", "passes"}));
    CHECK(row["properties"]["size"]["properties"]["volume"]["description"] ==
          "Of the inside. Null when it is open.");
    CHECK(schema["properties"]["centroid"]["type"] == Json::array({"array", "null"}));
    CHECK(schema["properties"]["kinds"]["properties"].contains("triangle"));
}

TEST_CASE("fields: lines for the terminal", "[options]") {
    const Result r = result();
    CHECK(declared_fields().lines(&r) == std::vector<std::string>{"a: area 6, volume 1", "b: area 0.5"});
    CHECK(declared_fields(true).lines(&r) ==
          std::vector<std::string>{"welded vertices 1,234, filled holes 2"});
    const Result none;
    CHECK(declared_fields(true).lines(&none) == std::vector<std::string>{"nothing to do"});
    Fields told = declared_fields();
    told.tell = [](const void* record) {
        return std::vector<std::string>{std::to_string(static_cast<const Result*>(record)->parts.size())};
    };
    CHECK(told.lines(&r) == std::vector<std::string>{"2"});
}

TEST_CASE("fields: what is beyond the range of numbers is null", "[options]") {
    Size size;
    size.area = HUGE_VAL;
    CHECK(fields_of<Size>(declare_size).json(&size).dump() == R"({"area":null,"volume":null})");
}

} // namespace facetmill
