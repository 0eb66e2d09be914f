// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/CLogReader.h>
#include <salma/slam/TRunRecord.h>
#include <salma/viz/TTrajectory.h>

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "COutputFolder.h"
#include "CPictureWork.h"
#include "TSlamConfig.h"

namespace salma::apps {

/// The command line of salma-slam.
struct TSlamArguments {
    std::string config;
    std::string rawlog;
    std::string out;
    std::string backend;            //!< Empty: as the configuration has it.
    std::string association;        //!< "" leaves the method of the ini file.
    int seed{-1};                   //!< -1 leaves the seeds of the ini file.
    bool ignoreIdentities{false};   //!< Identities in the log are not read.
    bool saveRawlog{false};         //!< Keep the front end's records.
    bool embed{false};              //!< In one file with the log.
    bool acceptTruncated{false};    //!< Take what is whole of a log that breaks off.
    std::set<std::string> require;  //!< "laser", "pictures", "odometry".
};

/** The main job: a rawlog to a trajectory, a map and a report.
 *
 * Every failure is an exception with a one-line message; then nothing is left at `out`. */
class CSlamApp {
 public:
    /// Makes room for the results, reads configuration and log. \throw std::exception
    void initialize(const TSlamArguments& arguments);

    /// Works and writes the run folder. \throw std::exception
    void run();

    /// A few lines on what came out, with the error where the true path is known.
    std::string summary() const;

 private:
    std::string accuracy() const;
    void noticeWhatIsMissing();
    void noticeOfSpace();
    void noticeOfPictures(const TSeen& seen);
    void noticeOfCalibration();
    void notice(const std::string& text);
    void savePictureRecords(const TSeen& seen, const std::string& folder) const;
    void writeDatabase(const std::string& file) const;

    TSlamArguments m_arguments;
    std::unique_ptr<COutputFolder> m_out;
    TSlamConfig m_config;
    observations::TLog m_log;
    std::optional<viz::TTrajectory> m_truth;  //!< X.gt.tum beside X.rawlog, if it is there.
    slam::TRunRecord m_record;
};

}  // namespace salma::apps
