// SPDX-License-Identifier: BSD-3-Clause
#include "duplicateRate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace salma::apps {

TDuplicateRate duplicateRate(const std::vector<TLabelledRun>& runs,
                             const std::vector<std::vector<TLabelledPair>>& pairs,
                             const std::function<double(const TLabelledPair&)>& ratio) {
    // Runs of one world have the same posters under the same ids.
    using TPlace = std::pair<int, std::string>;
    std::map<std::pair<TPlace, TPlace>, std::vector<double>> ratios;
    TDuplicateRate result;
    for (std::size_t r = 0; r < runs.size(); ++r)
        for (const auto& pair : pairs[r]) {
            if (pair.kind == EPair::same || pair.evidence == appearance::EEvidence::none) continue;
            TPlace a{runs[r].seen[pair.a].poster, pair.textureA};
            TPlace b{runs[r].seen[pair.b].poster, pair.textureB};
            auto& list = ratios[std::minmax(a, b)];
            if (list.empty() && pair.kind == EPair::duplicate) ++result.prints;
            list.push_back(ratio(pair));
        }
    result.posterPairs = ratios.size();
    const auto n = static_cast<double>(ratios.size());
    result.rate = 0.5;
    for (int step = 0; step < 1000; ++step) {
        double sum = 0.5;
        for (const auto& [places, list] : ratios) {
            double share = 0;
            for (const double lr : list)
                share += result.rate * lr / (1 - result.rate + result.rate * lr);
            sum += share / static_cast<double>(list.size());
        }
        const double next = sum / (n + 1);
        const bool settled = std::abs(next - result.rate) < 1e-9;
        result.rate = next;
        if (settled) break;
    }
    return result;
}

}  // namespace salma::apps
