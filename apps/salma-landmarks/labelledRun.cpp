// SPDX-License-Identifier: BSD-3-Clause
#include "labelledRun.h"

#include <CPictureWork.h>
#include <measurements.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/TPolarMeasurement.h>
#include <salma/viz/CTrajectoryScore.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace salma::apps {
namespace {

using association::ELandmarkKind;
using observations::CObservationSalientLandmarks;

/// All records of a log: those it holds and those that the front end makes now.
std::vector<CObservationSalientLandmarks::Ptr> recordsOf(const observations::TLog& log,
                                                         const TSlamConfig& config) {
    auto records = CPictureWork(config, log).run().records;
    for (const auto& step : log.steps)
        for (const auto& o : step.observations)
            if (const auto held = std::dynamic_pointer_cast<CObservationSalientLandmarks>(o))
                records.push_back(held);
    std::stable_sort(records.begin(), records.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    return records;
}

class CLabelling {
 public:
    CLabelling(const TTruth& truth, TLabelledRun& run)
        : m_truth(truth), m_matcher({}, truth), m_run(run) {
        for (const auto& landmark : truth.landmarks)
            if (landmark.kind == ELandmarkKind::salient) m_posters[landmark.id] = &landmark;
    }

    std::size_t posters() const { return m_posters.size(); }

    void add(const CObservationSalientLandmarks& record) {
        const double time = mrpt::Clock::toDouble(record.timestamp);
        ++m_run.pictures;
        std::set<int> found;
        for (const auto& patch : record.landmarks) found.insert(name(patch, time));
        constexpr double kSkew = 0.001;  // as CTruthMatcher has it
        const auto first = std::lower_bound(
            m_truth.sightings.begin(), m_truth.sightings.end(), time - kSkew,
            [](const auto& sighting, double earliest) { return sighting.time < earliest; });
        for (auto s = first; s != m_truth.sightings.end() && s->time <= time + kSkew; ++s)
            if (s->kind == ELandmarkKind::salient) addView(*s, found.count(s->landmark) != 0);
    }

 private:
    /// Id of the poster that a patch shows; -1, counted, for none.
    int name(const observations::TPatch& patch, double time) {
        const auto polar = appearance::polarMeasurement(patch);
        const auto centre = centreOf(patch);
        slam::TAssociationRow row;
        row.time = time;
        row.kind = ELandmarkKind::salient;
        row.range = polar.z[0];
        row.bearing = polar.z[1];
        row.u = centre.x;
        row.v = centre.y;
        const int poster = m_matcher.match(row);
        if (poster < 0) {
            ++m_run.strangers;
            return poster;
        }
        const double angle = mrpt::math::wrapToPi(polar.z[1] + M_PI - polar.wallAngle);
        m_run.seen.push_back({time, poster, m_posters.at(poster)->texture, angle, patch});
        return poster;
    }

    void addView(const TTrueSighting& sighting, bool seen) {
        constexpr double kMaxGap = 0.5;  // [s]
        mrpt::poses::CPose2D T_w_r;
        if (!viz::interpolate(*m_truth.path, sighting.time, kMaxGap, T_w_r)) return;
        const TTrueLandmark& poster = *m_posters.at(sighting.landmark);
        const double towards =
            std::atan2(T_w_r.y() - poster.position.y, T_w_r.x() - poster.position.x);
        m_run.views.push_back(
            {std::abs(mrpt::math::wrapToPi(towards - poster.yaw)),
             std::hypot(T_w_r.x() - poster.position.x, T_w_r.y() - poster.position.y), seen});
    }

    const TTruth& m_truth;
    CTruthMatcher m_matcher;
    TLabelledRun& m_run;
    std::map<int, const TTrueLandmark*> m_posters;
};

}  // namespace

TLabelledRun labelRun(const std::filesystem::path& folder, const TSlamConfig& config) {
    const TTruth truth = loadTruth(folder, "");
    const std::string stem = (folder / truth.name).string();
    if (!truth.path) throw std::runtime_error(stem + ".gt.tum: no such file");
    TLabelledRun run;
    run.folder = folder.string();
    CLabelling labelling(truth, run);
    if (labelling.posters() == 0)
        throw std::invalid_argument(stem + ".landmarks.csv: holds no poster (kind = salient)");
    const auto log = observations::readLog(stem + ".rawlog");
    for (const auto& record : recordsOf(log, config)) labelling.add(*record);
    if (run.pictures == 0)
        throw std::runtime_error(stem + ".rawlog: holds no picture that can be looked at");
    if (run.seen.empty())
        throw std::runtime_error(stem + ".rawlog: none of its " +
                                 std::to_string(labelling.posters()) + " posters was seen in " +
                                 std::to_string(run.pictures) + " pictures");
    return run;
}

}  // namespace salma::apps
