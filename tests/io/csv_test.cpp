#include "support/catch.hpp"

#include "io/csv.hpp"
#include "support/failure.hpp"

#include <array>

using namespace facetmill;

namespace {

io::Input input(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return io::Input::of("p.csv", {bytes.begin(), bytes.end()});
}

std::string complaint(const std::string& text, std::span<const std::string_view> names = {}) {
    try {
        io::read_table(input(text), 3, names);
    } catch (const Error& e) {
        return e.what();
    }
    return "none";
}

} // namespace

TEST_CASE("tables come in the forms that people write", "[io]") {
    const std::vector<double> expected{1, 2, 3, -4, 5e-1, 6};
    CHECK(io::read_table(input("1,2,3\n-4,5e-1,6\n"), 3) == expected);
    CHECK(io::read_table(input("\xEF\xBB\xBFx;y;z\r\n1;2;3\r\n-4; 0.5;6"), 3) == expected);
    CHECK(io::read_table(input("# points\n\n1 2\t3 # first\n-4 0.5 6 999 more\n"), 3) == expected);
    CHECK(io::read_table(input(""), 3).empty());
    CHECK(io::read_table(input("x,y,z\n"), 3).empty());
}

TEST_CASE("a row that is short or no numbers is named by its line", "[io]") {
    CHECK(complaint("1,2,3\n1,2\n").find("the row has 2 numbers, expected 3") != std::string::npos);
    CHECK(complaint("1,2,3\n1,b,2\n").find("expected a number, found 'b'") != std::string::npos);
    CHECK(complaint("1,2,inf\n").find("not finite") != std::string::npos);
    CHECK(complaint("1,2,3\n1,2\n").find("2") != std::string::npos);
}

TEST_CASE("texts with separators are quoted, and numbers read back", "[io]") {
    CHECK(io::csv_text("a,b") == "\"a,b\"");
    CHECK(io::csv_text("say \"x\"") == "\"say \"\"x\"\"\"");
    CHECK(io::csv_text("plain") == "plain");
    CHECK(io::csv_number(0.1) == "0.1");
    CHECK(io::csv_number(HUGE_VAL).empty());
}

TEST_CASE("columns are found by the names of the heading", "[io]") {
    const std::array<std::string_view, 3> names{"x", "y", "z"};
    const auto read = [&](const char* text) { return io::read_table(input(text), 3, names); };
    const std::vector<double> expected{1, 2, 3, -4, 0.5, 6};
    CHECK(read("id,label,X,Y,Z\n7,\"a b\",1,2,3\n8,,-4,0.5,6,\n") == expected);
    CHECK(read("z;y;x\n3;2;1\n6;0.5;-4\n") == expected);
    CHECK(read("name x y z\na  1 2 3\nb -4 0.5 6\n") == expected);
    CHECK(read("east,north,up,id\n1,2,3,9\n-4,0.5,6,9\n") == expected); // no such names: the first ones
    CHECK(read("1,2,3\n-4,0.5,6\n") == expected);
    CHECK(read("x,y,z\n1 2 3\n-4,,0.5;6\n") ==
          expected); // if the coordinates come first, cells may be separated freely
    CHECK(complaint("id,x,y,z\n7,1,2\n", names).find("the row has 3 columns, expected 4") !=
          std::string::npos);
    CHECK(complaint("id,x,y,z\n7,1,,3\n", names).find("expected a number") != std::string::npos);
    CHECK(complaint("id,x,y,z\n7,1,2,3m\n", names).find("expected a number, found '3m'") !=
          std::string::npos);
    CHECK(complaint("id,x,y,z\n7,1,2,inf\n", names).find("not finite") != std::string::npos);
}
