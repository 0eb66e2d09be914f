// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <salma/observations/CPanTiltHistory.h>
#include <salma/observations/CPoseHistory.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace salma::observations {

/// One instant at which something was observed.
struct TLogStep {
    /// [s since 1970]; of a sensory frame the stamp of its first observation that has one, else the
    /// time of the frame before.
    double time{0};
    /// One observation in an observation-only log, a whole sensory frame in an action/SF log.
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    mrpt::poses::CPose2D
        odometry;  //!< T_o_r at `time`; the identity where the log has no odometry.
    /// Motion of the robot since the previous step with the covariance that the action states;
    /// only in action/SF logs.
    std::optional<mrpt::poses::CPosePDFGaussian> increment;
    /// The same motion in space, where the action states it so.
    std::optional<mrpt::poses::CPose3DPDFGaussian> spatialIncrement;
};

/** A rawlog as the rest of the system sees it, whichever of MRPT's two formats it has.
 *
 * Odometry and pan/tilt records make no step of their own in an observation-only log. The steps of
 * an observation-only log are in order of time, those of an action/SF log in order of the file. */
struct TLog {
    std::string file;
    std::string companionFile;  //!< The merged X.salient.rawlog; "" if there was none.
    std::string imagesFolder;   //!< Where external pictures lie: X_Images beside X.rawlog.
    bool actionFormat{false};   //!< Actions and sensory frames, not single observations.
    bool hasOdometry{false};
    bool truncated{false};   //!< The file broke off; only with acceptTruncated.
    double lastGoodTime{0};  //!< [s] of the last whole record.
    std::vector<TLogStep> steps;
    CPoseHistory odometry;    //!< Empty for an action/SF log whose stamps do not strictly increase.
    CPanTiltHistory panTilt;  //!< Empty if the log has no pan/tilt records.
    std::map<std::string, std::size_t> counts;  //!< Observations by class name.
    /// What could not be used, by reason: records without a stamp, odometry or heads beside the
    /// first one (told by sensor label).
    std::map<std::string, std::size_t> dropped;
    /// Odometry and pan/tilt records that came later in the file than younger ones. They are put
    /// in order of time.
    std::size_t outOfOrder{0};
};

struct TLogReaderOptions {
    bool acceptTruncated{false};  //!< Take what is whole of a file that breaks off.
    bool mergeCompanion{true};    //!< Look for X.salient.rawlog beside X.rawlog.
};

/** Reads a whole rawlog (gzip or plain) and its companion file. External pictures are not loaded;
 * loadPicture() finds them with TLog::imagesFolder.
 *
 * Odometry of an observation-only log is interpolated to the time of each step; before the first
 * and after the last record the end pose is held, however long (TLog::odometry tells the gap). In
 * an action/SF log the motions of the actions add up; where no action states one, odometry records
 * in the frames take their place. The observations of a companion join an observation-only log in
 * order of time; in an action/SF log each goes to the frame that holds the observation nearest in
 * time. Where log and companion both hold records of a picture, both are kept.
 *
 * Damage is told before it is used: gzip check sums are verified first, and counts in the common
 * records are held against the length of the file. A plain file with false lengths elsewhere, such
 * as in a text, can still make MRPT claim up to 4 GB before it is refused.
 * \throw std::runtime_error one line, naming the file and what is wrong: missing, empty, not a
 * rawlog, a class that is not registered, or truncated (with the last good time). */
TLog readLog(const std::string& file, const TLogReaderOptions& options = {});

/// Name of the companion file of a rawlog: X.rawlog -> X.salient.rawlog.
std::string companionOf(const std::string& rawlog);

}  // namespace salma::observations
