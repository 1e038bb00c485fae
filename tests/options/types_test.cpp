#include "support/catch.hpp"

#include "options/types.hpp"

using namespace facetmill;

namespace {

template <class T>
std::optional<T> parsed(const Value& value) {
    Problems problems;
    T out{};
    if (!OptionType<T>::parse(value, out, problems)) return {};
    return out;
}

template <class T>
std::optional<T> parsed(const std::string& text) {
    return parsed<T>(Value::scalar(text));
}

template <class T>
std::string complaint(const std::string& text) {
    Problems problems;
    T out{};
    if (OptionType<T>::parse(Value::scalar(text), out, problems)) return "none";
    const auto& d = problems.all().at(0);
    return d.id + " " + d.message + (d.hint.empty() ? "" : " (" + d.hint + ")");
}

} // namespace

TEST_CASE("integers are decimal, 0x or 0o; leading zeros do not make them octal", "[options]") {
    CHECK(parsed<std::int64_t>("010") == 10);
    CHECK(parsed<std::int64_t>("0x1f") == 31);
    CHECK(parsed<std::int64_t>("0o17") == 15);
    CHECK(parsed<std::int64_t>("-3") == -3);
    CHECK_FALSE(parsed<std::int64_t>("3.0"));
    CHECK_FALSE(parsed<std::int64_t>("9223372036854775808"));
    CHECK_FALSE(parsed<std::int64_t>(""));
    CHECK_FALSE(parsed<std::int64_t>(Value::scalar("3", {}, true)));
}

TEST_CASE("numbers are finite", "[options]") {
    CHECK(parsed<double>("1e3") == 1000);
    CHECK(parsed<double>("+.5") == 0.5);
    CHECK_FALSE(parsed<double>(".nan"));
    CHECK_FALSE(parsed<double>("nan"));
    CHECK_FALSE(parsed<double>("inf"));
    CHECK_FALSE(parsed<double>("1e999"));
    CHECK_FALSE(parsed<double>("1,5"));
}

TEST_CASE("a number with a unit, and the name of a param in signs of other languages, say what to write",
          "[options]") {
    CHECK(complaint<double>("2mm") == "E-TYPE expected a finite number, found '2mm' (the number has no unit "
                                      "here: write 2; transform: {unit: mm} converts a scene to a unit)");
    CHECK(complaint<double>("10%") == "E-TYPE expected a finite number, found '10%' (write 0.1)");
    CHECK(complaint<double>("2 kg") == "E-TYPE expected a finite number, found '2 kg'");
    for (const char* text : {"$keep", "{keep}", "{{ keep }}"})
        CHECK(complaint<Ratio>(text).find("(write the value of a param as ${keep})") != std::string::npos);
    CHECK(complaint<Ratio>("{a, b}").find("param") == std::string::npos);
}

TEST_CASE("truths are true and false only", "[options]") {
    CHECK(parsed<bool>("true") == true);
    CHECK(parsed<bool>("False") == false);
    CHECK_FALSE(parsed<bool>("yes"));
    CHECK_FALSE(parsed<bool>("1"));
}

TEST_CASE("a bare whole number is no ratio, and both meanings are offered", "[options]") {
    CHECK(parsed<Ratio>("25%")->value == 0.25);
    CHECK(parsed<Ratio>("0.25")->value == 0.25);
    CHECK(parsed<Ratio>("10pct")->value == 0.1);
    CHECK(parsed<Ratio>("5e-1")->value == 0.5); // as programs write it
    CHECK(parsed<Ratio>("1e-05")->value == 0.00001);
    CHECK(complaint<Ratio>("5e1").find("expected a ratio") != std::string::npos);
    CHECK(complaint<Ratio>("1") == "E-TYPE expected a ratio (25% or 0.25), found '1' (write 100%, or name "
                                   "the option for a count (faces: 1))");
    CHECK(complaint<Ratio>("10k") ==
          "E-TYPE expected a ratio (25% or 0.25), found '10k' (name the option for a count (faces: 10000))");
    CHECK(complaint<Ratio>("-5") ==
          "E-TYPE expected a ratio (25% or 0.25), found '-5' (a ratio cannot be negative)");
    CHECK(complaint<Ratio>("5000") == "E-TYPE expected a ratio (25% or 0.25), found '5000' (a ratio needs a "
                                      "point or a % (50%); for a count write faces: 5000)");
}

TEST_CASE("lengths keep their unit until there is a scene", "[options]") {
    CHECK(parsed<Length>("2")->kind == Length::Kind::scene);
    CHECK(parsed<Length>("2mm")->amount == Approx(0.002));
    CHECK(parsed<Length>("0.1in")->amount == Approx(0.00254));
    CHECK(parsed<Length>("2 cm")->kind == Length::Kind::physical);
    CHECK(parsed<Length>("0.5%")->kind == Length::Kind::percent);
    CHECK(parsed<Length>("0.5% of part")->of == Length::Of::part);
    CHECK(parsed<Length>("0.5% of load")->of == Length::Of::load);
    CHECK_FALSE(parsed<Length>("0.5% of moon"));
    CHECK_FALSE(parsed<Length>("mm"));
    CHECK(complaint<Length>("2 furlong") ==
          "E-TYPE expected a length (2, 2mm, 0.5%, 0.5% of part), found '2 furlong' "
          "(units: um, mm, cm, m, km, in, ft, or %)");
}

TEST_CASE("angles are degrees unless they say rad", "[options]") {
    CHECK(parsed<Angle>("180")->radians == Approx(3.14159265358979));
    CHECK(parsed<Angle>("30deg")->radians == Approx(0.523598775598299));
    CHECK(parsed<Angle>("0.5rad")->radians == 0.5);
    CHECK_FALSE(parsed<Angle>("0.5grad"));
}

TEST_CASE("vectors are three numbers, as a list or with commas", "[options]") {
    CHECK(parsed<Vec3>("0,0,1") == Vec3{0, 0, 1});
    CHECK(parsed<Vec3>(Value::list({Value::scalar("1"), Value::scalar("2"), Value::scalar("3.5")})) ==
          Vec3{1, 2, 3.5});
    CHECK_FALSE(parsed<Vec3>("0,0"));
    CHECK_FALSE(parsed<Vec3>("0,0,x"));
    CHECK_FALSE(parsed<Vec3>("0,0,nan"));
}

TEST_CASE("bounds are a value, or min and max", "[options]") {
    CHECK(parsed<Bound>("2")->min == 2);
    CHECK(parsed<Bound>("2")->max == 2);
    CHECK_FALSE(parsed<Bound>("true"));
    CHECK_FALSE(parsed<Bound>("25%"));
    CHECK_FALSE(parsed<Bound>("5deg"));
    const auto between =
        parsed<Bound>(Value::map({{"min", {}, Value::scalar("0.25")}, {"max", {}, Value::scalar("5")}}));
    CHECK(between->min == 0.25);
    CHECK(between->max == 5);
    CHECK_FALSE(
        parsed<Bound>(Value::map({{"min", {}, Value::scalar("2")}, {"max", {}, Value::scalar("1")}})));
    CHECK_FALSE(parsed<Bound>(Value::map({{"mid", {}, Value::scalar("1")}})));
    CHECK_FALSE(parsed<Bound>(Value::map({})));
    CHECK(parsed<AngleBound>("30deg")->max == 30);
    CHECK(parsed<AngleBound>("30")->min == 30);
    CHECK(*parsed<AngleBound>("1rad")->min == Approx(57.29577951308232));
    CHECK_FALSE(parsed<AngleBound>("30mm"));
}

TEST_CASE("a bare limit is the most that may be", "[options]") {
    CHECK(parsed<CountLimit>("7")->max == 7);
    CHECK_FALSE(parsed<CountLimit>("7")->min.has_value());
    CHECK(parsed<CountLimit>(Value::map({{"min", {}, Value::scalar("3")}}))->min == 3);
    for (const char* wrong : {"-1", "2.5", "true", "10MB", "many"}) CHECK_FALSE(parsed<CountLimit>(wrong));
}

TEST_CASE("bytes are counted with decimal and with binary units", "[options]") {
    for (const auto& [text, bytes] :
         std::vector<std::pair<const char*, double>>{{"0", 0},
                                                     {"123", 123},
                                                     {"1e3", 1000},
                                                     {"12B", 12},
                                                     {"500 kB", 500000},
                                                     {"500KiB", 512000},
                                                     {"10MB", 10000000},
                                                     {"1.5MiB", 1572864},
                                                     {"2GB", 2e9},
                                                     {"2 GiB", 2147483648.0},
                                                     {"4.35kB", 4350},
                                                     {"10M", 10485760},
                                                     {"8G", 8589934592.0},
                                                     {"8g", 8589934592.0},
                                                     {"1TB", 1e12},
                                                     {"8192TiB", 9007199254740992.0}}) {
        CAPTURE(text);
        REQUIRE(parsed<ByteLimit>(text));
        CHECK(parsed<ByteLimit>(text)->max == bytes);
        CHECK_FALSE(parsed<ByteLimit>(text)->min.has_value());
        const std::string printed = OptionType<ByteLimit>::print(*parsed<ByteLimit>(text));
        CHECK(parsed<ByteLimit>(printed)->max == bytes);
    }
    const auto between = parsed<ByteLimit>(
        Value::map({{"min", {}, Value::scalar("1kB")}, {"max", {}, Value::scalar("1KiB")}}));
    CHECK(between->min == 1000);
    CHECK(between->max == 1024);
}

TEST_CASE("what is no count of bytes is refused with a hint", "[options]") {
    for (const auto& [text, told] : std::vector<std::pair<const char*, const char*>>{
             {"10 mb", "10MB (1000000 bytes each) or 10MiB (1048576)?"},
             {"10mib", "10MB (1000000 bytes each) or 10MiB (1048576)?"},
             {"5KB", "5kB (1000 bytes each) or 5KiB (1024)?"},
             {"1gib", "1GB (1000000000 bytes each) or 1GiB (1073741824)?"},
             {"10 bits",
              "units: B, kB, MB, GB, TB, KiB, MiB, GiB, TiB, and K, M, G, T for 1024 bytes each step"},
             {"10mm",
              "units: B, kB, MB, GB, TB, KiB, MiB, GiB, TiB, and K, M, G, T for 1024 bytes each step"},
             {"-5MB", "bytes cannot be negative"},
             {"-1", "bytes cannot be negative"},
             {"0.5", "a number of bytes must be whole"},
             {"0.0001kB", "a number of bytes must be whole"},
             {"8193TiB", "at most 9007199254740992 (8192TiB)"},
             {"1e300", "at most 9007199254740992 (8192TiB)"},
             {"1e300TB", "at most 9007199254740992 (8192TiB)"}}) {
        CAPTURE(text);
        Problems problems;
        ByteLimit limit;
        CHECK_FALSE(OptionType<ByteLimit>::parse(Value::scalar(text), limit, problems));
        REQUIRE(problems.all().size() == 1);
        CHECK(problems.all()[0].hint == told);
    }
    for (const char* wrong : {"", "MB", "1e999", "nan", "true", "MiB 3"})
        CHECK_FALSE(parsed<ByteLimit>(wrong));
}

TEST_CASE("what a type prints reads back as the same", "[options]") {
    CHECK(OptionType<Ratio>::print(*parsed<Ratio>("12.5%")) == "12.5%");
    CHECK(OptionType<Length>::print(Length::percent(0.2, Length::Of::part)) == "0.2% of part");
    CHECK(OptionType<Angle>::print(Angle::degrees(30)) == "30deg");
    CHECK(OptionType<Vec3>::print({0, -1.5, 1e300}) == "[0, -1.5, 1e+300]");
}
