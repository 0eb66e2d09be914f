// SPDX-License-Identifier: BSD-3-Clause
#include "labelledRun.h"

#include <CPictureWork.h>
#include <measurements.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/TPolarMeasurement.h>
#include <salma/laser/CCornerExtractor.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/slam/CDetectionModel.h>
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
        for (const auto& landmark : truth.landmarks) m_landmarks[landmark.id] = &landmark;
    }

    std::ptrdiff_t posters() const {
        return std::count_if(m_landmarks.begin(), m_landmarks.end(), [](const auto& entry) {
            return entry.second->kind == ELandmarkKind::salient;
        });
    }

    void add(const CObservationSalientLandmarks& record) {
        const double time = mrpt::Clock::toDouble(record.timestamp);
        ++m_run.pictures;
        std::set<int> found;
        for (const auto& patch : record.landmarks) found.insert(name(patch, time));
        slam::TViews views;
        views.camera = cameraView(record, record.landmarks.size());
        addViews(time, ELandmarkKind::salient, views, found);
    }

    /// \param corners That were found in it, in the robot frame.
    void add(const mrpt::obs::CObservation2DRangeScan& scan,
             const std::vector<laser::TCorner>& corners) {
        const double time = mrpt::Clock::toDouble(scan.timestamp);
        std::set<int> found;
        for (const auto& corner : corners) {
            slam::TAssociationRow row;
            row.time = time;
            row.kind = ELandmarkKind::corner;
            row.range = std::hypot(corner.position.x, corner.position.y);
            row.bearing = std::atan2(corner.position.y, corner.position.x);
            found.insert(m_matcher.match(row));
        }
        slam::TViews views;
        views.laser = laserView(scan);
        views.scanned = true;
        addViews(time, ELandmarkKind::corner, views, found);
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
        m_run.seen.push_back({time, poster, m_landmarks.at(poster)->texture, angle, patch});
        return poster;
    }

    void addViews(double time,
                  ELandmarkKind kind,
                  const slam::TViews& views,
                  const std::set<int>& found) {
        constexpr double kSkew = 0.001;  // as CTruthMatcher has it
        constexpr double kMaxGap = 0.5;  // [s]
        mrpt::poses::CPose2D T_w_r;
        if (!viz::interpolate(*m_truth.path, time, kMaxGap, T_w_r)) return;
        const auto first = std::lower_bound(
            m_truth.sightings.begin(), m_truth.sightings.end(), time - kSkew,
            [](const auto& sighting, double earliest) { return sighting.time < earliest; });
        for (auto s = first; s != m_truth.sightings.end() && s->time <= time + kSkew; ++s)
            if (s->kind == kind)
                addView(*m_landmarks.at(s->landmark), T_w_r, views, found.count(s->landmark) != 0);
    }

    void addView(const TTrueLandmark& landmark,
                 const mrpt::poses::CPose2D& T_w_r,
                 const slam::TViews& views,
                 bool seen) {
        const auto inRobot =
            (mrpt::poses::CPose2D(landmark.position.x, landmark.position.y, 0) - T_w_r);
        slam::TBelievedPlace place;
        place.point << inRobot.x(), inRobot.y();
        TTrueView view;
        view.kind = landmark.kind;
        view.seen = seen;
        Eigen::Vector2d from(0, 0);
        if (landmark.kind == ELandmarkKind::salient) {
            if (views.camera) from = views.camera->camera.head<2>();
            place.wallAngle = landmark.yaw - T_w_r.phi();
            const Eigen::Vector2d back = from - place.point;
            view.thing = landmark.texture;
            view.incidence =
                std::abs(mrpt::math::wrapToPi(std::atan2(back.y(), back.x()) - place.wallAngle));
            if (views.camera) view.inView = slam::CDetectionModel::posterInView(views, place);
        } else {
            if (!views.laser) return;
            from = views.laser->sensor.head<2>();
            view.thing = m_truth.name + " " + std::to_string(landmark.id);
            view.inView = slam::CDetectionModel::cornerInView(views, place);
        }
        view.range = (place.point - from).norm();
        m_run.views.push_back(view);
    }

    const TTruth& m_truth;
    CTruthMatcher m_matcher;
    TLabelledRun& m_run;
    std::map<int, const TTrueLandmark*> m_landmarks;
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
    const laser::CLineExtractor lines(config.lines);
    const laser::CCornerExtractor corners(config.corners);
    for (const auto& step : log.steps)
        for (const auto& o : step.observations)
            if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(o))
                labelling.add(*scan, corners.extract(lines.extract(*scan)).corners);
    if (run.pictures == 0)
        throw std::runtime_error(stem + ".rawlog: holds no picture that can be looked at");
    if (run.seen.empty())
        throw std::runtime_error(stem + ".rawlog: none of its " +
                                 std::to_string(labelling.posters()) + " posters was seen in " +
                                 std::to_string(run.pictures) + " pictures");
    return run;
}

}  // namespace salma::apps
