// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CCornerExtractor.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/CWallOdometry.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/slam/COdometryNoise.h>
#include <salma/slam/COdometryScale.h>
#include <salma/slam/CSlamBackend.h>

#include <optional>
#include <vector>

#include "TSlamConfig.h"

namespace salma::apps {

/** Feeds a back end with the steps of a log.
 *
 * In an observation-only log each scan (thinned by travel), each picture with a landmark and each
 * range-bearing record is a step at its own stamp; in an action/SF log each sensory frame is one.
 */
class CMapping {
 public:
    /// All arguments must outlive this object.
    CMapping(const TSlamConfig& config, const observations::TLog& log, slam::CSlamBackend& backend);

    /** \param records Of the log's pictures, beside those that the log itself holds.
     * \param record Of the whole run, the laser's points included. */
    void run(const std::vector<observations::CObservationSalientLandmarks::Ptr>& records,
             slam::TRunRecord& record);

 private:
    struct TEvent;
    /// Where a beam ended.
    struct TSeenPoint {
        std::size_t step{0};
        mrpt::math::TPoint2D point;  //!< In the robot frame [m].
    };
    std::vector<TEvent> events(
        const std::vector<observations::CObservationSalientLandmarks::Ptr>& records) const;
    bool measure(const TEvent& event,
                 slam::TStepInput& step,
                 std::vector<laser::TLine>& walls) const;
    bool measureInSpace(const TEvent& event, slam::TStepInput& step) const;
    bool isDue(const TEvent& event) const;
    mrpt::poses::CPosePDFGaussian incrementTo(const TEvent& event);
    void noteView(const TEvent& event, slam::TStepInput& step);
    void keepPoints(const mrpt::obs::CObservation2DRangeScan& scan);
    void placePoints(slam::TRunRecord& record) const;

    const TSlamConfig& m_config;
    const observations::TLog& m_log;
    slam::CSlamBackend& m_backend;
    laser::CLineExtractor m_lines;
    laser::CCornerExtractor m_corners;
    laser::CWallOdometry m_walls;
    slam::COdometryNoise m_noise;
    slam::COdometryScale m_scale;
    std::size_t m_steps{0};
    std::vector<TSeenPoint> m_points;                //!< By step.
    double m_lastTime{0};                            //!< Of the last step [s].
    mrpt::poses::CPose2D m_lastOdometry;             //!< Of the last step.
    std::optional<mrpt::poses::CPose2D> m_lastScan;  //!< Odometry of the last scan that was used.
    std::optional<slam::TLaserView> m_laserView;     //!< Of that scan, in the robot frame then.
};

}  // namespace salma::apps
