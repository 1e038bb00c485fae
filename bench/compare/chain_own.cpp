// chain_own FILE: runs a pipeline file without reading its outputs back, in this process, and prints as JSON
// what it took. For bench/compare/chain.py; the command line reads back always.

#include "compare/clock.hpp"
#include "pipeline/document.hpp"
#include "pipeline/run.hpp"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

using namespace facetmill;

namespace {

int run(const char* path) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto source = std::make_shared<const SourceText>(SourceText{path, text});
    Problems problems;
    const Value document = pipeline::parse_yaml(source, problems);
    pipeline::PlanSettings plan_settings;
    plan_settings.name = path;
    const pipeline::Plan plan = pipeline::make_plan(document, plan_settings, problems);
    problems.throw_if_any(ErrorKind::usage);
    pipeline::RunSettings settings;
    settings.read_back = false;
    bench::Clock clock;
    clock.start();
    const auto record = pipeline::run_plan(plan, settings);
    clock.stop();
    for (const auto& error : record.errors) fmt::print(stderr, "{}\n", render(error));
    fmt::print("{{\"wall\": {:.4f}, \"cpu\": {:.4f}}}\n", clock.wall_seconds, clock.cpu_seconds);
    return record.exit_code;
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 2) return run(argv[1]);
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 1;
    }
    fmt::print(stderr, "usage: chain_own FILE\n");
    return 2;
}
