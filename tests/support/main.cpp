// The test runner's main. Beside Catch2's own arguments it knows --ctest, which writes the script that tells
// ctest of every case: "geometry/clip/cap: a square hole is closed" runs in a process of its own, with its
// room as label.

#define CATCH_CONFIG_RUNNER
#include "support/catch.hpp"

#include <iostream>

namespace {

/// What selects one case on the command line.
std::string spec_of(const std::string& name) {
    std::string spec;
    for (const char c : name) {
        if (c == ',' || c == '[' || c == '"' || c == '\\' || c == '~' || c == '*') spec += '\\';
        spec += c;
    }
    return spec;
}

/// "geometry/clip/cap" for .../tests/geometry/clip/cap_test.cpp.
std::string place_of(const std::string& file) {
    const std::size_t folder = file.rfind("tests/");
    const std::size_t start = folder == std::string::npos ? 0 : folder + 6;
    return file.substr(start, file.rfind("_test.cpp") - start);
}

/// Each folder of a place is a label, so that -L geometry has all of geometry and -L clip the clip's.
std::string labels_of(std::string place) {
    for (char& c : place)
        if (c == '/') c = ';';
    return place;
}

/// Fails when a name cannot be selected, since a run that selects nothing would pass.
int list_for_ctest(const std::string& executable, const Catch::IConfig& config) {
    for (const auto& test : Catch::getAllTestCasesSorted(config)) {
        const auto& info = test.getTestCaseInfo();
        if (info.isHidden()) continue;
        const std::string spec = spec_of(info.name);
        const auto parsed = Catch::TestSpecParser(Catch::ITagAliasRegistry::get()).parse(spec).testSpec();
        if (!parsed.matches(info) || spec.starts_with('-')) {
            std::cerr << "no argument selects the case '" << info.name << "': choose another name\n";
            return 1;
        }
        const std::string place = place_of(info.lineInfo.file);
        const std::string name = place + ": " + info.name;
        std::cout << "add_test([==[" << name << "]==] [==[" << executable << "]==] [==[" << spec << "]==])\n"
                  << "set_tests_properties([==[" << name << "]==] PROPERTIES LABELS [==[" << labels_of(place)
                  << "]==])\n";
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    Catch::Session session;
    if (argc == 2 && std::string(argv[1]) == "--ctest") return list_for_ctest(argv[0], session.config());
    return session.run(argc, argv);
}
