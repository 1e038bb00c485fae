// Lists in one text: one reader for numbers, rows, footprints and words.

#include "options/lists.hpp"

#include "support/catch.hpp"

namespace facetmill {

namespace {

std::string told(const Value& value) {
    if (!value.is_list()) return value.text;
    std::string text;
    for (const auto& item : value.items) text += (text.empty() ? "" : " ") + told(item);
    return "(" + text + ")";
}

std::string read(const char* text) {
    const auto list = list_in_text(Value::scalar(text));
    return list ? told(*list) : "none";
}

} // namespace

TEST_CASE("lists: what a text stands for", "[options]") {
    CHECK(read("1") == "(1)");
    CHECK(read("1, 2,3") == "(1 2 3)");
    CHECK(read("[1, 2, 3]") == "(1 2 3)");
    CHECK(read("boundary,seams") == "(boundary seams)");
    CHECK(read("1,2; 3,4") == "((1 2) (3 4))");
    CHECK(read("[[1,2],[3,4]]") == "((1 2) (3 4))");
    CHECK(read("[1,2],[3,4]") == "((1 2) (3 4))");
    CHECK(read("[[0,0],[1,0]],[[2,2],[3,2]]") == "(((0 0) (1 0)) ((2 2) (3 2)))");
    CHECK(read("1,,2") == "(1  2)"); // an empty item is not a number; the consumer refuses it
    CHECK(read(" [ a b , c ] ") == "(a b c)");
    CHECK(list_in_text(Value::scalar("a b, c"))->items.size() == 2); // blanks within an item stay
    CHECK(read("[]") == "()");
}

TEST_CASE("lists: of words, which may have brackets", "[options]") {
    const auto words = [](const char* text) { return told(list_of_words(text, {})); };
    CHECK(words("a,b") == "(a b)");
    CHECK(words("[a, b ]") == "(a b)");
    CHECK(words("[a[1], b;c]") == "(a[1] b;c)");
    CHECK(words("[ab]*,[cd]") == "([ab]* [cd])");
    CHECK(words("[a],[b]") == "([a] [b])");
    CHECK(words("[]") == "()");
    CHECK(words("[a,]") == "(a )");
}

TEST_CASE("lists: brackets that do not match are none", "[options]") {
    for (const char* text : {"[1,2", "1,2]", "[[1,2]", "[1]2", "][", "[1;2]"}) CHECK(read(text) == "none");
}

TEST_CASE("lists: values that are no text stay as they are", "[options]") {
    const Value map = Value::map({{"a", {}, Value::scalar("1,2")}});
    CHECK(listed(map).is_map());
    Value deferred = Value::scalar("1,2");
    deferred.deferred = true;
    CHECK(listed(deferred).is_scalar());
    CHECK(told(listed(Value::scalar("x,y"))) == "(x y)");
}

} // namespace facetmill
