// SPDX-License-Identifier: BSD-3-Clause
#include "CMapping.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/slam/rangeBearing.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "CProgressBar.h"
#include "measurements.h"

namespace salma::apps {
namespace {

constexpr double kLargestCarry = 1;  // a scan tells what is hidden within so much travel [m]

}  // namespace

using mrpt::obs::CObservation2DRangeScan;
using observations::CObservationSalientLandmarks;

/// What may become a step: observations that share one pose of the robot.
struct CMapping::TEvent {
    double time{0};  //!< [s since 1970]
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    mrpt::poses::CPose2D odometry;                           //!< T_o_r at `time`.
    std::optional<mrpt::poses::CPosePDFGaussian> increment;  //!< As the log states it.
    std::optional<mrpt::poses::CPose3DPDFGaussian> spatialIncrement;
};

CMapping::CMapping(const TSlamConfig& config,
                   const observations::TLog& log,
                   slam::CSlamBackend& backend)
    : m_config(config),
      m_log(log),
      m_backend(backend),
      m_lines(config.lines),
      m_corners(config.corners),
      m_walls(config.wallOdometry),
      m_noise(config.odometry),
      m_scale(config.odometry) {}

std::vector<CMapping::TEvent> CMapping::events(
    const std::vector<CObservationSalientLandmarks::Ptr>& records) const {
    std::map<mrpt::Clock::time_point, CObservationSalientLandmarks::Ptr> byPicture;
    for (const auto& record : records) byPicture[record->timestamp] = record;
    std::vector<TEvent> result;
    for (const auto& step : m_log.steps) {
        TEvent event{step.time, step.observations, step.odometry, step.increment,
                     step.spatialIncrement};
        for (auto& o : event.observations) {
            const bool isPicture =
                std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(o) != nullptr;
            const auto found = byPicture.find(o->timestamp);
            if (isPicture && found != byPicture.end()) o = found->second;
            const bool ofPicture =
                std::dynamic_pointer_cast<CObservationSalientLandmarks>(o) != nullptr;
            if (!ofPicture || m_log.actionFormat) continue;
            const auto& options = m_config.seeing.frontEnd;
            event.time = step.time - options.latencyCamera;
            event.odometry = m_log.odometry.at(event.time, options.maxSkew).value_or(step.odometry);
        }
        result.push_back(std::move(event));
    }
    if (!m_log.actionFormat)  // a camera's latency may change the order
        std::stable_sort(result.begin(), result.end(),
                         [](const TEvent& a, const TEvent& b) { return a.time < b.time; });
    return result;
}

/// True unless the robot has hardly moved since the last scan that was used.
bool CMapping::isDue(const TEvent& event) const {
    if (m_log.actionFormat || !m_log.hasOdometry || !m_lastScan) return true;
    const auto travel = event.odometry - *m_lastScan;
    return travel.norm() >= m_config.run.scanDistance ||
           std::abs(mrpt::math::wrapToPi(travel.phi())) >= m_config.run.scanTurn;
}

/// Fills the measurements of `step` and the walls seen; false if the event is none that makes a
/// step.
bool CMapping::measure(const TEvent& event,
                       slam::TStepInput& step,
                       std::vector<laser::TLine>& walls) const {
    if (m_config.isSpatial()) return measureInSpace(event, step);
    bool isStep = m_log.actionFormat;
    for (const auto& o : event.observations) {
        if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(o)) {
            if (!isDue(event)) continue;
            isStep = true;
            step.laser = laserView(*scan);
            step.scanned = m_config.run.corners;
            const auto lines = m_lines.extract(*scan);
            walls = lines.lines;
            if (!m_config.run.corners) continue;
            for (const auto& corner : m_corners.extract(lines).corners) addCorner(corner, step);
        } else if (const auto seen = std::dynamic_pointer_cast<CObservationSalientLandmarks>(o)) {
            for (const auto& patch : seen->landmarks) addPatch(patch, seen->cameraPose, step);
            step.camera =
                cameraView(*seen, static_cast<std::size_t>(m_config.seeing.selection.maxEntities));
            isStep = true;  // that nothing was found is worth knowing too
        } else if (const auto ranges =
                       std::dynamic_pointer_cast<mrpt::obs::CObservationBearingRange>(o)) {
            for (const auto& m : slam::measurementsOf(*ranges, m_config.rangeBearing))
                addMeasurement(m, step);
            isStep = true;
        }
    }
    return isStep;
}

bool CMapping::measureInSpace(const TEvent& event, slam::TStepInput& step) const {
    slam::TSpatialStep& spatial = step.spatial.emplace();
    bool found = false;
    for (const auto& o : event.observations) {
        const auto ranges = std::dynamic_pointer_cast<mrpt::obs::CObservationBearingRange>(o);
        if (!ranges) continue;
        if (found)
            throw std::invalid_argument(m_log.file +
                                        ": a step has two range-bearing records, but "
                                        "MRPT's filter in space takes one");
        spatial.sensor = ranges->sensorLocationOnRobot;
        spatial.measurements = slam::spatialMeasurementsOf(*ranges, m_config.rangeBearing);
        found = true;
    }
    return found || m_log.actionFormat;
}

/// A picture is taken shortly after a scan: what that saw is carried along by odometry.
void CMapping::noteView(const TEvent& event, slam::TStepInput& step) {
    if (step.laser) {
        m_laserView = step.laser;
    } else if (m_laserView && m_lastScan) {
        const auto moved = event.odometry - *m_lastScan;
        if (moved.norm() > kLargestCarry) return;
        const auto& s = m_laserView->sensor;
        const auto sensor = mrpt::poses::CPose2D(s[0], s[1], s[2]) - moved;
        step.laser = m_laserView;
        step.laser->sensor << sensor.x(), sensor.y(), sensor.phi();
    }
}

mrpt::poses::CPosePDFGaussian CMapping::incrementTo(const TEvent& event) {
    if (event.increment) return *event.increment;
    if (m_log.hasOdometry)
        return m_noise.increment(m_scale.corrected(event.odometry - m_lastOdometry));
    const double seconds = std::max(0.0, event.time - m_lastTime);
    mrpt::poses::CPosePDFGaussian unknown;
    const double position = m_config.run.unknownMotion * std::sqrt(seconds);
    const double turn = m_config.run.unknownTurn * std::sqrt(seconds);
    unknown.cov.setDiagonal(
        std::vector<double>{position * position, position * position, turn * turn});
    return unknown;
}

void CMapping::keepPoints(const CObservation2DRangeScan& scan) {
    constexpr std::size_t kThin =
        4;  // a picture of the walls, not a map: every fourth beam will do
    const mrpt::poses::CPose2D T_r_l(scan.sensorPose);
    const double sign = scan.rightToLeft ? 1 : -1;
    const std::size_t n = scan.getScanSize();
    const double beamStep = n > 1 ? scan.aperture / static_cast<double>(n - 1) : 0.0;
    for (std::size_t i = 0; i < n; i += kThin) {
        if (!scan.getScanRangeValidity(i)) continue;
        const double angle = sign * (static_cast<double>(i) * beamStep - 0.5 * scan.aperture);
        const double range = scan.getScanRange(i);
        mrpt::math::TPoint2D point;
        T_r_l.composePoint({range * std::cos(angle), range * std::sin(angle)}, point);
        m_points.push_back({m_steps, point});
    }
}

/// Where the whole run has them: a loop that was closed later moved them, too.
void CMapping::placePoints(slam::TRunRecord& record) const {
    record.scanPoints.clear();
    for (const TSeenPoint& seen : m_points) {
        mrpt::math::TPoint2D point;
        record.trajectory.at(seen.step).pose.composePoint(seen.point, point);
        record.scanPoints.push_back(point);
    }
}

void CMapping::run(const std::vector<CObservationSalientLandmarks::Ptr>& records,
                   slam::TRunRecord& record) {
    const auto all = events(records);
    CProgressBar progress("steps", all.size());
    bool first = true;
    for (const auto& event : all) {
        progress.step();
        slam::TStepInput step;
        std::vector<laser::TLine> walls;
        if (!measure(event, step, walls)) continue;
        step.time = event.time;
        step.odometry = event.odometry;
        noteView(event, step);
        if (first && !event.increment) m_lastOdometry = event.odometry;
        if (first) m_lastTime = event.time;
        first = false;
        step.increment = incrementTo(event);
        if (step.spatial)
            step.spatial->increment =
                event.spatialIncrement.value_or(mrpt::poses::CPose3DPDFGaussian(step.increment));
        if (!walls.empty())
            step.increment = m_walls.refine(step.increment, walls);
        else
            m_walls.advance(step.increment);
        m_backend.process(step);
        const slam::TStepMotion motion = m_backend.motion();
        m_walls.advance(mrpt::poses::CPosePDFGaussian(motion.slip));
        m_scale.learn(event.odometry - m_lastOdometry, motion);
        m_lastTime = event.time;
        m_lastOdometry = event.odometry;
        for (const auto& o : event.observations)
            if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(o)) {
                m_lastScan = event.odometry;
                keepPoints(*scan);
            }
        ++m_steps;
    }
    m_backend.finish();
    m_backend.results(record);
    placePoints(record);
}

}  // namespace salma::apps
