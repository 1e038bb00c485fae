#pragma once
// Records all progress reports.

#include "base/progress.hpp"

#include <algorithm>
#include <map>

namespace facetmill::test {

struct Heard : Progress {
    std::vector<double> shares;                        ///< of the current stage
    std::map<std::string, std::vector<double>> before; ///< of finished stages, by name
    std::string now;

    void stage(int, int, const std::string& name) override { begin(name); }
    void beside_stages(const std::string& what) override { begin(what); }
    void share(double done) override { shares.push_back(done); }
    void done() override { begin({}); }

    double last() const { return shares.empty() ? -1 : shares.back(); }
    /// The number of times that the progress decreased.
    std::size_t falls() const {
        std::size_t count = 0;
        for (std::size_t i = 1; i < shares.size(); ++i) count += shares[i] < shares[i - 1];
        return count;
    }

  private:
    void begin(const std::string& what) {
        if (!now.empty()) before[now] = shares;
        now = what;
        shares.clear();
    }
};

} // namespace facetmill::test
