#pragma once
// The options of probe.

#include "stage/stage.hpp"
#include "stages/probe/rows.hpp"

namespace facetmill {

struct ProbeOptions {
    enum class Hits { first, all };

    std::optional<Rows<3>> points;
    std::optional<Rows<6>> segments, rays;
    std::vector<std::string> points_of;
    std::string along;
    bool reverse = false;
    Hits hits = Hits::all;
    std::optional<std::int64_t> face;
    Length tolerance = Length::scene(0);
    std::int64_t max_answers = 1000;
    std::vector<PathText> path;
};

void declare_probe(Declare<ProbeOptions>& d);
/// What the declaration cannot say: names of outputs, and options that do not go together.
void verify_probe(const ProbeOptions& o, const Value& given, Problems& problems);
/// What is read and written.
StageFiles probe_files(const ProbeOptions& o);
bool is_csv(const PathText& path);

} // namespace facetmill
