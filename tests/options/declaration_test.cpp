#include "support/catch.hpp"

#include "options/declaration.hpp"

#include <fmt/format.h>

using namespace facetmill;

namespace {

enum class Method { plain, better };

struct Plane {
    Vec3 normal{0, 0, 1};
};

struct OptionSettings {
    std::int64_t iterations = 1;
    double factor = 0.5;
    Method method = Method::better;
    std::optional<Ratio> ratio;
    std::optional<std::int64_t> faces;
    std::optional<Plane> plane;
    std::vector<PathText> paths;
};

Declaration declared_options() {
    Declare<OptionSettings> d;
    d.option("iterations", &OptionSettings::iterations, "How many times.").at_least(1).primary();
    d.option("factor", &OptionSettings::factor, "How far.").above(0).at_most(1);
    d.choice("method", &OptionSettings::method,
             {{"plain", Method::plain, "the plain one"}, {"better", Method::better, "ours"}}, "Which.");
    d.option("ratio", &OptionSettings::ratio, "Of the faces.").above(0).at_most(1);
    d.option("faces", &OptionSettings::faces, "How many are left.").at_least(1);
    d.group("plane", &OptionSettings::plane, "Where.",
            [](Declare<Plane>& p) { p.option("normal", &Plane::normal, "Its direction.").required(); });
    d.option("paths", &OptionSettings::paths, "Files.");
    d.at_most_one({"ratio", "faces"});
    return d.declaration;
}

Value map(std::initializer_list<std::pair<const char*, Value>> entries) {
    Value v = Value::map({});
    for (const auto& [key, value] : entries) v.set(key, value);
    return v;
}

/// All complaints about the value, one a line.
std::string complaints(const Value& value) {
    Problems problems;
    OptionSettings s;
    const bool good = declared_options().parse(value, &s, "relax", problems, {"name"});
    std::string text;
    for (const auto& d : problems.all())
        text += d.id + " " + d.message + (d.hint.empty() ? "" : " (" + d.hint + ")") + "\n";
    CHECK(good == text.empty());
    return text;
}

} // namespace

TEST_CASE("a bare value sets the primary option, nothing takes the defaults", "[options]") {
    Problems problems;
    OptionSettings s;
    CHECK(declared_options().parse(Value::scalar("7"), &s, "relax", problems));
    CHECK(s.iterations == 7);
    CHECK(s.factor == 0.5);
    CHECK(declared_options().parse({}, &s, "relax", problems));
    CHECK_FALSE(problems.any_errors());
}

TEST_CASE("defaults are the members' initialisers", "[options]") {
    const auto d = declared_options();
    CHECK(d.find("iterations")->default_text == "1");
    CHECK(d.find("factor")->default_text == "0.5");
    CHECK(d.find("method")->default_text == "better");
    CHECK(d.find("ratio")->default_text.empty());
    CHECK(d.primary()->name == "iterations");
}

TEST_CASE("every wrong option is reported at once", "[options]") {
    CHECK(complaints(map({{"iterations", Value::scalar("0")},
                          {"factr", Value::scalar("1")},
                          {"method", Value::scalar("beter")},
                          {"name", Value::scalar("smooth")}})) ==
          "E-RANGE 'iterations' must be in the range x >= 1, found '0'\nE-KEY relax has no option 'factr' "
          "(did you mean 'factor'?)\nE-CHOICE 'method' must be one of plain, better, found 'beter' (did you "
          "mean 'better'?)\n");
}

TEST_CASE("options that exclude each other", "[options]") {
    CHECK(complaints(map({{"ratio", Value::scalar("10%")}, {"faces", Value::scalar("10")}})) ==
          "E-CONFLICT relax: only one of ratio, faces may be given, found ratio and faces\n");
}

TEST_CASE("nested groups say what they miss", "[options]") {
    CHECK(complaints(map({{"plane", Value::map({})}})) ==
          "E-MISSING plane: 'normal' is needed (Its direction.)\n");
    CHECK(complaints(map({{"plane", map({{"normal", Value::scalar("0,1,0")}})}})).empty());
}

TEST_CASE("open ends of a range are exclusive", "[options]") {
    CHECK(complaints(map({{"factor", Value::scalar("0")}})) ==
          "E-RANGE 'factor' must be in the range 0 < x <= 1, found '0'\n");
    CHECK(complaints(map({{"factor", Value::scalar("1")}})).empty());
}

TEST_CASE("a list option takes one value or several", "[options]") {
    Problems problems;
    OptionSettings s;
    CHECK(declared_options().parse(map({{"paths", Value::scalar("a.ply")}}), &s, "load", problems));
    CHECK(s.paths.size() == 1);
    const Value two = Value::list({Value::scalar("a"), Value::scalar("b")});
    CHECK(declared_options().parse(map({{"paths", two}}), &s, "load", problems));
    CHECK(s.paths.size() == 2);
}

TEST_CASE("a bare value that is a choice of another option is answered with its name", "[options]") {
    CHECK(complaints(Value::scalar("plain")) == "E-TYPE a bare value of relax is its option 'iterations', "
                                                "found 'plain' (plain is a value of 'method', so "
                                                "write that name)\n");
    CHECK(complaints(Value::scalar("fancy")) == "E-TYPE expected an integer, found 'fancy'\n");
}

TEST_CASE("a share where a count belongs is answered with the option that takes one", "[options]") {
    struct Reduction {
        std::optional<Ratio> ratio;
        std::optional<std::int64_t> faces;
        bool draco = false;
    };
    Declare<Reduction> d;
    d.option("ratio", &Reduction::ratio, "Of the faces.").primary();
    d.option("faces", &Reduction::faces, "How many are left.").also_called("target_faces");
    d.option("draco", &Reduction::draco, "Compressed.");
    Reduction read;
    Problems problems;
    for (const char* share : {"10%", "0.1"}) {
        d.declaration.parse(map({{"faces", Value::scalar(share)}}), &read, "reduce", problems);
        CHECK(problems.all().back().hint ==
              fmt::format("a ratio sets 'ratio': write reduce: {{ratio: {}}}", share));
    }
    d.declaration.parse(map({{"faces", Value::scalar("1.5")}}), &read, "reduce", problems);
    CHECK(problems.all().back().hint.empty());
    d.declaration.parse(map({{"target_faces", Value::scalar("3")}}), &read, "reduce", problems);
    CHECK(problems.all().back().hint == "'target_faces' is called 'faces' here");
}

TEST_CASE("a bare value where none may stand is often the name of an option", "[options]") {
    struct Checks {
        bool closed = false;
        std::int64_t faces = 0;
    };
    Declare<Checks> d;
    d.option("closed", &Checks::closed, "No boundary.").also_called("watertight");
    d.option("faces", &Checks::faces, "How many.");
    Checks read;
    const auto hint = [&](const char* bare) {
        Problems problems;
        d.declaration.parse(Value::scalar(bare), &read, "check", problems);
        return problems.all().back().hint;
    };
    CHECK(hint("closed") == "write check: {closed: true}");
    CHECK(hint("watertight") == "write check: {closed: true}");
    CHECK(hint("faces") == "write check: {faces: ...}");
    CHECK(hint("3") == "its options are: closed, faces");
}

TEST_CASE("true gives a group its defaults where it is a switch, false leaves it out", "[options]") {
    struct Lines {
        double spacing = 0.5;
    };
    struct Drawing {
        std::optional<Lines> hatch, frame;
    };
    Declare<Drawing> d;
    const auto declare_lines = [](Declare<Lines>& lines) {
        lines.option("spacing", &Lines::spacing, "How far apart.").above(0).primary();
    };
    d.group("hatch", &Drawing::hatch, "Lines.", declare_lines).option().may_be_true = true;
    d.group("frame", &Drawing::frame, "A frame.", declare_lines);

    Problems problems;
    Drawing read;
    CHECK(d.declaration.parse(map({{"hatch", Value::scalar("false")}}), &read, "draw", problems));
    CHECK_FALSE(read.hatch);
    CHECK(d.declaration.parse(map({{"hatch", Value::scalar("true")}}), &read, "draw", problems));
    REQUIRE(read.hatch);
    CHECK(read.hatch->spacing == 0.5);
    CHECK(d.declaration.parse(map({{"hatch", Value::scalar("2")}}), &read, "draw", problems));
    CHECK(read.hatch->spacing == 2);
    CHECK_FALSE(d.declaration.parse(map({{"frame", Value::scalar("true")}}), &read, "draw", problems));
    CHECK(d.declaration.schema()["properties"]["hatch"]["anyOf"].back()["type"] == "boolean");
    CHECK(d.declaration.schema()["properties"]["frame"]["anyOf"].back()["type"] == "number");
}

TEST_CASE("a deferred value is good for any option", "[options]") {
    Value later = Value::scalar("${part}");
    later.deferred = true;
    CHECK(complaints(map({{"iterations", later}, {"method", later}, {"plane", later}, {"ratio", later}}))
              .empty());
}

TEST_CASE("the schema lists every option once and is closed", "[options]") {
    const Json schema = declared_options().schema();
    const Json& object = schema["anyOf"][0];
    CHECK(object["additionalProperties"] == false);
    CHECK(object["properties"].size() == 7);
    const Json& factor = object["properties"]["factor"];
    CHECK(factor["exclusiveMinimum"] == 0);
    CHECK(factor["maximum"] == 1);
    CHECK(factor["description"].get<std::string>().find("Range: 0 < x <= 1.") != std::string::npos);
    CHECK(schema["anyOf"][1]["type"] == "integer");
    CHECK(object["dependentSchemas"]["ratio"]["properties"]["faces"] == false);
    CHECK(object["dependentSchemas"]["faces"]["properties"]["ratio"] == false);
    CHECK(object["properties"]["iterations"]["default"] == 1);
    CHECK(object["properties"]["method"]["default"] == "better");
    CHECK_FALSE(object["properties"]["paths"].contains("default"));
}

TEST_CASE("options of an embedded struct are options of the one around it", "[options]") {
    struct Algorithm {
        double alpha = 0.5;
        Method method = Method::better;
    };
    struct Around {
        bool on = false;
        Algorithm settings{0.25, Method::plain};
    };
    Declare<Around> d;
    d.option("on", &Around::on, "Whether.");
    d.embed(&Around::settings, [](Declare<Algorithm>& inner) {
        inner.option("alpha", &Algorithm::alpha, "How far.").above(0);
        inner.choice("method", &Algorithm::method,
                     {{"plain", Method::plain, "the plain one"}, {"better", Method::better, "ours"}},
                     "Which.");
    });
    CHECK(d.declaration.names() == std::vector<std::string>{"on", "alpha", "method"});
    CHECK(d.declaration.find("alpha")->default_text == "0.25");
    CHECK(d.declaration.find("method")->default_text == "plain");

    Problems problems;
    Around read;
    CHECK(d.declaration.parse(map({{"alpha", Value::scalar("2")}, {"method", Value::scalar("better")}}),
                              &read, "test", problems));
    CHECK(read.settings.alpha == 2);
    CHECK(read.settings.method == Method::better);
    CHECK_FALSE(read.on);
    CHECK_FALSE(d.declaration.parse(map({{"alpha", Value::scalar("-1")}}), &read, "test", problems));
    CHECK(problems.all().size() == 1);
}
