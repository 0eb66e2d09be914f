// SPDX-License-Identifier: BSD-3-Clause
#include "revisitFigures.h"

#include <salma/laser/CPlaceClassifier.h>
#include <salma/simulator/CLaserModel.h>
#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <random>

#include "TPlaceSample.h"

namespace salma::bench {
namespace {

using laser::TPlaceMatrix;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kStep = 1;  // [m]
constexpr std::size_t kBins = 10;

/// All that a robot can do in a building, in steps of a metre; turns are between two steps.
struct TLattice {
    struct TNode {
        TPose2D pose;
        std::vector<std::size_t> next;
    };
    std::vector<TNode> nodes;

    explicit TLattice(const simulator::CBuilding& building) {
        const auto& stations = building.stations();
        std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> ways;
        for (std::size_t a = 0; a < stations.size(); ++a)
            for (const std::size_t b : stations[a].next) {
                const TPoint2D way = stations[b].at - stations[a].at;
                const auto count = static_cast<std::size_t>(std::ceil(way.norm() / kStep));
                const double phi = std::atan2(way.y, way.x);
                const std::size_t first = nodes.size();
                for (std::size_t k = 0; k < count; ++k) {
                    const double share = static_cast<double>(k) / static_cast<double>(count);
                    const TPoint2D p = stations[a].at + way * share;
                    nodes.push_back({{p.x, p.y, phi}, {}});
                    if (k > 0) nodes[nodes.size() - 2].next.push_back(nodes.size() - 1);
                }
                ways[{a, b}] = {first, nodes.size() - 1};
            }
        for (const auto& [way, ends] : ways)
            for (const std::size_t c : stations[way.second].next)
                if (c != way.first || stations[way.second].next.size() == 1)
                    nodes[ends.second].next.push_back(ways.at({way.second, c}).first);
    }
};

/// Scans and classifies at the nodes of a lattice.
class CObserver {
 public:
    CObserver(const simulator::CBuilding& building, std::uint32_t seed)
        : m_laser(placeLaser(), building.segments(), seed), m_random(seed) {}

    laser::TPlaceVector at(TPose2D pose) {
        std::normal_distribution<double> off(0, 0.1), lean(0, M_PI / 45);
        const double o = off(m_random);
        pose = {pose.x - o * std::sin(pose.phi), pose.y + o * std::cos(pose.phi),
                pose.phi + lean(m_random)};
        const auto p = m_classifier.classify(m_laser.scan(pose, m_scans++));
        if (p) return *p;
        laser::TPlaceVector any;
        any.fill(1.0 / laser::kPlaceClasses);
        return any;
    }

 private:
    simulator::CLaserModel m_laser;
    laser::CPlaceClassifier m_classifier;
    std::mt19937 m_random;
    std::uint64_t m_scans{0};
};

/// The corridors that the map holds: the first half of them, which hang together.
bool isMapped(const simulator::CBuilding& building, const TPose2D& pose) {
    const std::size_t half = (building.corridors().size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
        if (building.corridors()[i].area.contains(pose.x, pose.y)) return true;
    return false;
}

/// The explored half as the model wants it; `index` of each node, or -1.
std::vector<laser::TMapPlace> mapOf(const simulator::CBuilding& building,
                                    const TLattice& lattice,
                                    CObserver& observer) {
    std::vector<std::size_t> index(lattice.nodes.size(), lattice.nodes.size());
    std::vector<laser::TMapPlace> map;
    for (std::size_t i = 0; i < lattice.nodes.size(); ++i)
        if (isMapped(building, lattice.nodes[i].pose)) {
            index[i] = map.size();
            map.push_back({observer.at(lattice.nodes[i].pose), {}, false, false});
        }
    for (std::size_t i = 0; i < lattice.nodes.size(); ++i)
        for (const std::size_t next : lattice.nodes[i].next) {
            const bool from = index[i] < index.size(), to = index[next] < index.size();
            if (from && to) map[index[i]].next.push_back(index[next]);
            if (from && !to) map[index[i]].exit = true;
            if (!from && to) map[index[next]].entry = true;
        }
    return map;
}

struct TBin {
    double said{0};
    std::size_t outside{0}, all{0};
};

std::array<TBin, kBins> binsOf(const std::vector<TRevisitStep>& steps) {
    std::array<TBin, kBins> bins{};
    for (const TRevisitStep& s : steps) {
        TBin& bin = bins[std::min(static_cast<std::size_t>(s.outside * kBins), kBins - 1)];
        bin.said += s.outside;
        bin.outside += s.truth ? 1 : 0;
        ++bin.all;
    }
    return bins;
}

/// Of the share that is right at 0.5, from 2000 draws of whole buildings; 95 %.
std::pair<double, double> accuracyInterval(const std::vector<TRevisitStep>& steps) {
    constexpr std::size_t kDraws = 2000;
    std::map<std::uint32_t, std::pair<double, double>> counts;  // right, all
    for (const TRevisitStep& s : steps) {
        counts[s.building].first += (s.outside > 0.5) == s.truth ? 1 : 0;
        counts[s.building].second += 1;
    }
    std::vector<std::pair<double, double>> buildings;
    for (const auto& entry : counts) buildings.push_back(entry.second);
    std::mt19937 random(1);
    std::vector<double> draws;
    for (std::size_t d = 0; d < kDraws; ++d) {
        double right = 0, all = 0;
        for (std::size_t b = 0; b < buildings.size(); ++b) {
            const auto& one = buildings[random() % buildings.size()];
            right += one.first;
            all += one.second;
        }
        draws.push_back(right / all);
    }
    std::sort(draws.begin(), draws.end());
    return {draws[kDraws / 40], draws[kDraws - 1 - kDraws / 40]};
}

}  // namespace

TPlaceMatrix priorOfBuildings(const simulator::TBuildingOptions& options,
                              std::uint32_t seed,
                              int buildings) {
    std::vector<TPlaceMatrix> counts;
    for (std::uint32_t s = seed; s < seed + static_cast<std::uint32_t>(buildings); ++s) {
        const simulator::CBuilding building(options, s);
        const TLattice lattice(building);
        CObserver observer(building, s);
        std::vector<std::size_t> place;
        for (const auto& node : lattice.nodes)
            place.push_back(static_cast<std::size_t>(laser::mostLikely(observer.at(node.pose))));
        TPlaceMatrix c{};
        for (std::size_t i = 0; i < place.size(); ++i)
            for (const std::size_t next : lattice.nodes[i].next) ++c[place[i]][place[next]];
        counts.push_back(c);
    }
    return laser::fitPlacePrior(counts);
}

std::vector<TRevisitStep> walkHalfMapped(const simulator::TBuildingOptions& options,
                                         std::uint32_t seed,
                                         const TPlaceMatrix& prior,
                                         const TRevisitTrial& trial) {
    const simulator::CBuilding building(options, seed);
    const TLattice lattice(building);
    CObserver observer(building, seed);
    const auto map = mapOf(building, lattice, observer);
    std::mt19937 random(seed);
    std::vector<TRevisitStep> steps;
    for (int walk = 0; walk < trial.walks; ++walk) {
        laser::CRevisitModel model(trial.options, prior, map);
        std::size_t at = random() % lattice.nodes.size();
        // half of the walks begin inside
        while (isMapped(building, lattice.nodes[at].pose) != (walk % 2 == 0))
            at = random() % lattice.nodes.size();
        for (int k = 0; k < trial.steps; ++k) {
            const auto& node = lattice.nodes[at];
            const double outside = model.update(observer.at(node.pose));
            steps.push_back({seed, walk, k, outside, !isMapped(building, node.pose)});
            at = node.next[random() % node.next.size()];
        }
    }
    return steps;
}

void writeRevisitFigures(const std::vector<TRevisitStep>& steps, std::ostream& out) {
    std::size_t right = 0, outside = 0;
    double brier = 0;
    for (const TRevisitStep& s : steps) {
        right += (s.outside > 0.5) == s.truth ? 1 : 0;
        outside += s.truth ? 1 : 0;
        brier += std::pow(s.outside - (s.truth ? 1 : 0), 2);
    }
    const auto [low, high] = accuracyInterval(steps);
    const auto n = static_cast<double>(steps.size());
    const double share = static_cast<double>(outside) / n;
    out << std::fixed << std::setprecision(3) << steps.size() << " steps, outside " << share
        << " of them; right at 0.5: " << static_cast<double>(right) / n << " (95 %: " << low
        << " to " << high << ")"
        << "; Brier score " << brier / n << " (always saying " << share << ": "
        << share * (1 - share) << ")\n"
        << "| P(outside) said | steps | said, mean | was outside |\n|---|---:|---:|---:|\n";
    const auto bins = binsOf(steps);
    for (std::size_t i = 0; i < kBins; ++i) {
        if (bins[i].all == 0) continue;
        const auto all = static_cast<double>(bins[i].all);
        out << "| " << std::setprecision(1) << static_cast<double>(i) / kBins << " to "
            << static_cast<double>(i + 1) / kBins << " | " << bins[i].all << " | "
            << std::setprecision(3) << bins[i].said / all << " | "
            << static_cast<double>(bins[i].outside) / all << " |\n";
    }
    out << std::defaultfloat;
}

void plotRevisit(const std::vector<TRevisitStep>& steps, const std::string& file) {
    viz::CGnuplot plot(1200, 420);
    auto& data = plot.data("bins");
    for (const TBin& bin : binsOf(steps))
        if (bin.all > 0)
            data << bin.said / static_cast<double>(bin.all) << ' '
                 << static_cast<double>(bin.outside) / static_cast<double>(bin.all) << '\n';
    plot.endData();
    for (const int walk : {0, 1}) {
        auto& one = plot.data("walk" + std::to_string(walk));
        for (const TRevisitStep& s : steps)
            if (s.building == steps.front().building && s.walk == walk)
                one << s.step << ' ' << s.outside << ' ' << (s.truth ? 1 : 0) << '\n';
        plot.endData();
    }
    plot.script() << "set multiplot layout 1,3\nset yrange [0:1.02]\nset grid\n"
                     "set title 'how often it is right'\nset xlabel 'P(outside) said'\n"
                     "set ylabel 'share of steps outside'\nset xrange [0:1]\nset key top left\n"
                     "plot x with lines lc 'gray' title 'calibrated', $bins with linespoints pt 7 "
                     "lc '#1f5fa8' title 'model'\n"
                     "set ylabel 'P(outside)'\nset xlabel 'step [m]'\nset autoscale x\n"
                     "set title 'a walk that begins inside'\nset key off\n"
                     "plot $walk0 using 1:3 with fillsteps fs solid 0.15 noborder lc 'gray', "
                     "$walk0 using 1:2 with lines lw 2 lc '#1f5fa8'\n"
                     "set title 'a walk that begins outside'\n"
                     "plot $walk1 using 1:3 with fillsteps fs solid 0.15 noborder lc 'gray', "
                     "$walk1 using 1:2 with lines lw 2 lc '#1f5fa8'\n"
                     "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::bench
