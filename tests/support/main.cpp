// The main function of the test runner. In addition to Catch2's arguments it has --ctest and --ctest-files,
// which write the list of tests for ctest. Each case or each file runs in its own process, with its folders
// as labels. Files serve sanitizers, because their processes take long to start.

#define CATCH_CONFIG_RUNNER
#include "support/catch.hpp"

#include <iostream>
#include <map>
#include <string>

namespace {

/// The command-line argument that selects a test case.
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

/// Turns each folder of the path into a label, so that -L geometry and -L clip select the tests of a folder.
std::string labels_of(std::string place) {
    for (char& c : place)
        if (c == '/') c = ';';
    return place;
}

void add_test(const std::string& name, const std::string& executable, const std::string& spec,
              const std::string& labels) {
    std::cout << "add_test([==[" << name << "]==] [==[" << executable << "]==] [==[" << spec << "]==])\n"
              << "set_tests_properties([==[" << name << "]==] PROPERTIES LABELS [==[" << labels << "]==])\n";
}

/// Each case is a test, or each file if by_file. Fails when a name cannot be selected, because a run that
/// selects nothing would pass.
int list_for_ctest(const std::string& executable, const Catch::IConfig& config, bool by_file) {
    std::map<std::string, std::string> spec_of_file;
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
        if (!by_file) {
            add_test(place + ": " + info.name, executable, spec, labels_of(place));
            continue;
        }
        std::string& specs = spec_of_file[place];
        specs += (specs.empty() ? "" : ",") + spec;
    }
    for (const auto& [place, specs] : spec_of_file) add_test(place, executable, specs, labels_of(place));
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    Catch::Session session;
    const std::string list = argc == 2 ? argv[1] : "";
    if (list == "--ctest" || list == "--ctest-files")
        return list_for_ctest(argv[0], session.config(), list == "--ctest-files");
    return session.run(argc, argv);
}
